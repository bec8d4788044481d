#include "vorocl/seeds.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/seeds_state.hpp"
#include "masks/marks.hpp"
#include "runtime/buffer.hpp"

namespace vorocl {

namespace {

/// Throws Error for something ("a mask") that needs a diagram of all of the grid.
PixelGrid pixels_of(const Grid& grid, const char* what) {
  if (!has_voxels(grid) && !fits_in_a_diagram(grid)) {
    throw Error(std::string(what) + " needs a grid that is no larger than a diagram, " +
                std::to_string(Window::max_side) + " pixels along a side; this one has " +
                std::to_string(grid.width()) + " x " + std::to_string(grid.height()));
  }
  return PixelGrid{Window(grid)};
}

/// Where kernels cannot go round the ends themselves, the host places the images.
void place_images_of_long_periods(SeedsState& state, const PixelGrid& pixels) {
  const Grid& grid = state.grid();
  if (has_voxels(grid) || kernels_go_round(grid, pixels)) return;
  state.place(grid, state.frame()->places(), false);
}

}  // namespace

Points::Points(const Point* points, std::size_t count)
    : Points(points == nullptr ? nullptr : &points->x, points == nullptr ? nullptr : &points->y,
             points == nullptr ? nullptr : &points->z, count, sizeof(Point)) {}

Points::Points(const double* x, const double* y, const double* z, std::size_t count, std::ptrdiff_t stride)
    : Points(Kind::doubles, x, y, z, count, stride) {}

Points::Points(const float* x, const float* y, const float* z, std::size_t count, std::ptrdiff_t stride)
    : Points(Kind::floats, x, y, z, count, stride) {}

Points::Points(const double* x, const double* y, std::size_t count, std::ptrdiff_t stride)
    : Points(Kind::doubles, x, y, nullptr, count, stride) {}

Points::Points(const float* x, const float* y, std::size_t count, std::ptrdiff_t stride)
    : Points(Kind::floats, x, y, nullptr, count, stride) {}

Points Points::marked(const std::uint8_t* present) const {
  Points points = *this;
  points.present_ = present;
  return points;
}

Points Points::weighted(const double* weights) const {
  Points points = *this;
  points.weights_ = weights;
  return points;
}

Seeds::Seeds(OwnState<SeedsState> state) : state_(std::move(state)) {}

Seeds Internal::no_seeds(const Device& device, const Grid& grid) {
  return Seeds(make_state<SeedsState>(device, grid, SeedsOptions{}));
}

SeedsState& Seeds::state() const {
  if (!state_)
    throw Error("these seeds were moved from, and have no points; use the ones they were moved to");
  return *state_;
}

Seeds::Seeds(const Device& device, const Grid& grid, const Points& points, const SeedsOptions& options)
    : state_(make_state<SeedsState>(device, grid, options)) {
  state_->place(grid, points);
}

Seeds::Seeds(const Device& device, const Grid& grid, std::initializer_list<Point> points,
             const SeedsOptions& options)
    : Seeds(device, grid, Points(points), options) {}

Seeds::Seeds(const Device& device, const Grid& grid, const PointBuffer& points, const SeedsOptions& options)
    : state_(make_state<SeedsState>(device, grid, options)) {
  state_->place(points);
}

Seeds Seeds::from_mask(const Device& device, const Grid& grid, const std::vector<std::uint8_t>& mask) {
  if (mask.size() != grid.pixels()) {
    throw Error("the mask has " + std::to_string(mask.size()) + " pixels, the grid " +
                std::to_string(grid.pixels()));
  }
  pixels_of(grid, "a mask");
  const std::size_t bytes = mask.size();
  if (!shares_memory(device)) return from_mask(device, grid, allocate_with(device, mask, "a mask"));
  return with_host_memory(device, [&] {  // which is read when the marks are counted
    return from_mask(device, grid,
                     buffer_at(device, const_cast<std::uint8_t*>(mask.data()), bytes, "a mask"));
  });
}

Seeds Seeds::from_mask(const Device& device, const Grid& grid, const cl::Buffer& mask) {
  const PixelGrid pixels = pixels_of(grid, "a mask");
  check_foreign_buffer(device, mask, pixels.pixels(), "the buffer of the mask", Access::read);
  Seeds seeds = Internal::no_seeds(device, grid);
  SeedsState& state = seeds.state();
  const auto marks = std::make_shared<Marks>(device, ImageShape(pixels));
  marks->mark(state.kernels, mask, PixelType::uint8, Marked::non_zeros);
  marks->rank(state.kernels);
  state.place_marks(marks);
  place_images_of_long_periods(state, pixels);
  return seeds;
}

Seeds Seeds::random(const Device& device, const Grid& grid, std::size_t count, std::uint64_t rng_seed) {
  const PixelGrid pixels = pixels_of(grid, "random seeds");
  Seeds seeds = Internal::no_seeds(device, grid);
  SeedsState& state = seeds.state();
  const std::shared_ptr<cl::Buffer> positions = state.room_for_positions(count);
  const cl_uint2 key = {{static_cast<cl_uint>(rng_seed), static_cast<cl_uint>(rng_seed >> 32)}};
  Kernel kernel(device, "core/seeds.cl", "random_positions", pixels);
  kernel.over_items(count / kernel.vector_width() + 1, *positions, static_cast<cl_uint>(count),
                    cl_int4{{pixels.width(), pixels.height(), pixels.depth(), 0}}, key);
  state.place_on_device(count, positions);
  place_images_of_long_periods(state, pixels);
  return seeds;
}

Seeds Seeds::clone() const {
  auto copied = make_state<SeedsState>(device(), grid(), state().options);
  copied->copy_from(state());
  return Seeds(std::move(copied));
}

void Seeds::move_to(const Points& points) { state().place(grid(), points); }
void Seeds::move_to(std::initializer_list<Point> points) { move_to(Points(points)); }
void Seeds::move_to(const PointBuffer& points) { state().place(points); }
void Seeds::move_to(const Grid& grid, const Points& points) { state().place(Grid(grid), points); }

const Device& Seeds::device() const { return state().device; }
const Grid& Seeds::grid() const { return state().grid(); }
std::size_t Seeds::size() const { return state().size(); }
std::size_t Seeds::alive() const { return state().frame()->alive(); }
std::size_t Seeds::outside() const { return state().frame()->outside; }
double Seeds::displacement() const { return state().frame()->way_of_last_move(); }
void Seeds::check() const { state().frame()->check(); }

std::vector<std::optional<Point>> Seeds::read() const {
  check();
  return state().frame()->read_given();
}

std::vector<std::optional<Point>> Seeds::read_pixels() const {
  check();
  return state().frame()->read_positions();
}

}  // namespace vorocl
