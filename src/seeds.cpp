#include "vorocl/seeds.hpp"

#include <cmath>
#include <mutex>
#include <string>

#include "buffer.hpp"
#include "kernel.hpp"

namespace vorocl {

namespace {

constexpr std::size_t most_seeds = Grid::max_pixels;  // ids are uint32, and work-item ids must not wrap

std::string describe_bad_point(std::size_t index, double x, double y, const Grid& grid) {
  return "point " + std::to_string(index) + " (" + std::to_string(x) + ", " + std::to_string(y) + ") is " +
         (std::isfinite(x) && std::isfinite(y) ? "outside the grid" : "not finite") + "; x must be in [0, " +
         std::to_string(grid.width()) + ") and y in [0, " + std::to_string(grid.height()) + ")";
}

std::uint32_t pack(int x, int y) {
  return static_cast<std::uint32_t>(y) << 16 | static_cast<std::uint32_t>(x);
}

std::vector<std::uint32_t> snap(const Grid& grid, const std::vector<Point>& points) {
  std::vector<std::uint32_t> positions;
  positions.reserve(points.size());
  for (const Point& point : points) {
    // Written so that a NaN fails.
    if (!(point.x >= 0 && point.x < grid.width() && point.y >= 0 && point.y < grid.height())) {
      throw Error(describe_bad_point(positions.size(), point.x, point.y, grid));
    }
    positions.push_back(pack(static_cast<int>(point.x), static_cast<int>(point.y)));
  }
  return positions;
}

std::size_t checked_count(std::size_t count) {
  if (count > most_seeds) {
    throw Error(std::to_string(count) + " seeds are too many; at most 2^30 are possible");
  }
  return count;
}

void check_points_buffer(const Device& device, const cl::Buffer& points, std::size_t count) {
  if (points() == nullptr) throw Error("the buffer of points is null");
  if (points.getInfo<CL_MEM_CONTEXT>()() != device.context()()) {
    throw Error("the buffer of points belongs to another OpenCL context than the device");
  }
  const std::size_t needed = count * sizeof(cl_float2), there_is = points.getInfo<CL_MEM_SIZE>();
  if (there_is < needed) {
    throw Error("the buffer of points holds " + std::to_string(there_is) + " bytes; " +
                std::to_string(count) + " points need " + std::to_string(needed));
  }
}

}  // namespace

/// The verdict on points that only the device has seen, read at the first wait.
struct Seeds::DeferredCheck {
  cl::Buffer points;     // the caller's, to quote the bad point from
  cl::Buffer first_bad;  // one uint32: the least index of a bad point, or no_label
  std::mutex mutex;
  bool known = false;
  std::string error;  // empty if all points are good
};

Seeds::Seeds(const Device& device, const Grid& grid, std::size_t size)
    : device_(device), grid_(grid), size_(checked_count(size)) {
  positions_ = allocate(device, size * sizeof(std::uint32_t), "the seeds");
}

Seeds::Seeds(const Device& device, const Grid& grid, const std::vector<Point>& points)
    : device_(device), grid_(grid), size_(checked_count(points.size())) {
  const std::vector<std::uint32_t> positions = snap(grid, points);
  positions_ = allocate(device, size_ * sizeof(std::uint32_t), "the seeds");
  upload(device, positions_, positions);
}

Seeds::Seeds(const Device& device, const Grid& grid, const cl::Buffer& points, std::size_t count)
    : device_(device), grid_(grid), size_(checked_count(count)) {
  check_points_buffer(device, points, count);
  positions_ = allocate(device, size_ * sizeof(std::uint32_t), "the seeds");
  deferred_ = std::make_shared<DeferredCheck>();
  deferred_->points = points;
  deferred_->first_bad = allocate(device, sizeof(std::uint32_t), "the seeds");
  fill(device, deferred_->first_bad, no_label, 1);
  Kernel(device, "seeds.cl", "snap_points", grid)
      .over_items(count, points, positions_, static_cast<cl_uint>(count), grid.width(), grid.height(),
                  deferred_->first_bad);
}

Seeds Seeds::from_mask(const Device& device, const Grid& grid, const std::vector<std::uint8_t>& mask) {
  if (mask.size() != grid.pixels()) {
    throw Error("the mask has " + std::to_string(mask.size()) + " pixels, the grid " +
                std::to_string(grid.pixels()));
  }
  std::vector<std::uint32_t> positions;
  std::size_t i = 0;
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      if (mask[i++] != 0) positions.push_back(pack(x, y));
    }
  }
  Seeds seeds(device, grid, positions.size());
  upload(device, seeds.positions_, positions);
  return seeds;
}

Seeds Seeds::random(const Device& device, const Grid& grid, std::size_t count, std::uint64_t rng_seed) {
  Seeds seeds(device, grid, count);
  const cl_uint2 key = {{static_cast<cl_uint>(rng_seed), static_cast<cl_uint>(rng_seed >> 32)}};
  Kernel(device, "seeds.cl", "random_positions", grid)
      .over_items(count, seeds.positions_, static_cast<cl_uint>(count), grid.width(), grid.height(), key);
  return seeds;
}

std::vector<Point> Seeds::read() const {
  check();
  std::vector<Point> points;
  points.reserve(size_);
  for (const std::uint32_t position : download<std::uint32_t>(device_, positions_, size_)) {
    points.push_back({(position & 0xffff) + 0.5, (position >> 16) + 0.5});
  }
  return points;
}

void Seeds::check() const {
  if (!deferred_) return;
  const std::lock_guard<std::mutex> lock(deferred_->mutex);
  if (!deferred_->known) {
    const auto first_bad = download<std::uint32_t>(device_, deferred_->first_bad, 1).front();
    if (first_bad != no_label) {
      const auto point = download<cl_float2>(device_, deferred_->points, 1, first_bad).front();
      deferred_->error = describe_bad_point(first_bad, point.s[0], point.s[1], grid_);
    }
    deferred_->known = true;
  }
  if (!deferred_->error.empty()) throw Error(deferred_->error);
}

}  // namespace vorocl
