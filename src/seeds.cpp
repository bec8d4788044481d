#include "vorocl/seeds.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

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

constexpr std::uint32_t absent = 0x80008000u;  // EMPTY of position.cl

std::uint32_t snap(const Grid& grid, std::size_t index, const Point& point) {
  // Written so that a NaN fails.
  if (!(point.x >= 0 && point.x < grid.width() && point.y >= 0 && point.y < grid.height())) {
    throw Error(describe_bad_point(index, point.x, point.y, grid));
  }
  return pack(static_cast<int>(point.x), static_cast<int>(point.y));
}

std::size_t checked_count(std::size_t count) {
  if (count > most_seeds) {
    throw Error(std::to_string(count) + " seeds are too many; at most 2^30 are possible");
  }
  return count;
}

void check_points_buffer(const Device& device, const cl::Buffer& points, std::size_t count) {
  check_foreign_buffer(device, points, checked_count(count) * sizeof(cl_float2),
                       "the buffer of " + std::to_string(count) + " points", Access::read);
}

}  // namespace

/// The verdict on points that only the device has seen, read at each wait. It stays: a bad point is never
/// forgotten.
struct Seeds::DeferredCheck {
  cl::Buffer first_bad;  // one uint32: the least index of a bad point, or no_label
  cl::Buffer kept;       // four uint32: whether there was one, its index, and the bits of its x and y
};

Seeds::Seeds(const Device& device, const Grid& grid, std::size_t size) : device_(device), grid_(grid) {
  resize(size);
}

Seeds::Seeds(const Device& device, const Grid& grid, const std::vector<Point>& points)
    : device_(device), grid_(grid) {
  std::vector<std::uint32_t> positions;
  positions.reserve(points.size() + 1);
  for (const Point& point : points) positions.push_back(snap(grid, positions.size(), point));
  resize(points.size());
  upload(std::move(positions));
}

Seeds::Seeds(const Device& device, const Grid& grid, const cl::Buffer& points, std::size_t count)
    : device_(device), grid_(grid) {
  check_points_buffer(device, points, count);
  resize(count);
  snap_on_device(points);
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
  seeds.upload(std::move(positions));
  return seeds;
}

Seeds Seeds::random(const Device& device, const Grid& grid, std::size_t count, std::uint64_t rng_seed) {
  Seeds seeds(device, grid, count);
  const cl_uint2 key = {{static_cast<cl_uint>(rng_seed), static_cast<cl_uint>(rng_seed >> 32)}};
  Kernel(device, "seeds.cl", "random_positions", grid)
      .over_items(count + 1, seeds.positions_, static_cast<cl_uint>(count), grid.width(), grid.height(), key);
  return seeds;
}

void Seeds::move_to(const std::vector<std::optional<Point>>& points) {
  std::vector<std::uint32_t> positions;
  positions.reserve(points.size() + 1);
  for (const std::optional<Point>& point : points) {
    positions.push_back(point ? snap(grid_, positions.size(), *point) : absent);
  }
  const std::vector<bool> before = present_;
  const std::size_t size_before = size_;
  resize(points.size());
  bool vanished = size_ < size_before;
  for (std::size_t id = 0; id < size_; ++id) {
    present_[id] = points[id].has_value();
    vanished = vanished || (!present_[id] && id < size_before && before[id]);
    alive_ -= present_[id] ? 0 : 1;
  }
  vanishings_ += vanished ? 1 : 0;
  upload(std::move(positions));
}

void Seeds::move_to(const cl::Buffer& points, std::size_t count) {
  check_points_buffer(device_, points, count);
  vanishings_ += count < size_ ? 1 : 0;
  resize(count);
  snap_on_device(points);
}

/// Makes room for the positions; all seeds count as present until some are said to be absent.
void Seeds::resize(std::size_t size) {
  const std::size_t bytes = (checked_count(size) + 1) * sizeof(std::uint32_t);
  if (positions_() == nullptr || size_of(positions_) < bytes) {
    positions_ = allocate(device_, bytes, "the seeds");
  }
  size_ = alive_ = size;
  present_.assign(size, true);
}

void Seeds::upload(std::vector<std::uint32_t> positions) {
  positions.push_back(absent);
  vorocl::upload(device_, positions_, positions);
}

void Seeds::snap_on_device(const cl::Buffer& points) {
  if (!deferred_) {
    deferred_ = std::make_shared<DeferredCheck>();
    deferred_->first_bad = allocate(device_, sizeof(std::uint32_t), "the seeds");
    fill(device_, deferred_->first_bad, no_label, 1);
    deferred_->kept = allocate(device_, 4 * sizeof(std::uint32_t), "the seeds");
    fill(device_, deferred_->kept, cl_uint{0}, 4);
  }
  Kernel(device_, "seeds.cl", "snap_points", grid_)
      .over_items(size_ + 1, points, positions_, static_cast<cl_uint>(size_), grid_.width(), grid_.height(),
                  deferred_->first_bad);
  Kernel(device_, "seeds.cl", "keep_bad_point", grid_)
      .over_items(1, points, deferred_->first_bad, deferred_->kept);
}

std::vector<Point> Seeds::read() const {
  check();
  std::vector<Point> points;
  points.reserve(size_);
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const std::uint32_t position : download<std::uint32_t>(device_, positions_, size_)) {
    points.push_back(position == absent ? Point{none, none}
                                        : Point{(position & 0xffff) + 0.5, (position >> 16) + 0.5});
  }
  return points;
}

void Seeds::check() const {
  if (!deferred_) return;
  const auto kept = download<std::uint32_t>(device_, deferred_->kept, 4);
  if (kept[0] == 0) return;
  const auto coordinate = [&](std::size_t i) {
    float value = 0;
    std::memcpy(&value, &kept[i], sizeof value);
    return static_cast<double>(value);
  };
  throw Error(describe_bad_point(kept[1], coordinate(2), coordinate(3), grid_));
}

}  // namespace vorocl
