// Seeds: points of NumPy's as pixels.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/unique_ptr.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <tuple>

#include "module.hpp"
#include "seeds_state.hpp"

namespace vorocl::python {

namespace {

using Corners = std::tuple<double, double, double, double>;

Placement placement(const Grid& grid, const std::optional<Corners>& corners, bool y_up) {
  if (!corners) return {grid, std::nullopt, y_up};
  const auto [x0, y0, x1, y1] = *corners;
  const Bounds bounds = {x0, y0, x1, y1};
  check_bounds(bounds, grid);
  return {grid, bounds, y_up};
}

/// A position along an axis in pixels, wrapped if that is periodic.
double wrapped(double position, int count, bool periodic) {
  if (!periodic) return position;
  position = std::fmod(position, count);
  if (position < 0) position += count;
  return position < count ? position : 0;  // the sum may be rounded up to the period
}

/// Where a point in pixels is; none outside the grid.
std::optional<Point> to_pixel(const Point& point, const Grid& grid, bool y_up) {
  const double x = wrapped(point.x, grid.width(), grid.periodic_x());
  const double y = wrapped(point.y, grid.height(), grid.periodic_y());
  if (!(x >= 0 && x < grid.width() && y >= 0 && y < grid.height())) return std::nullopt;
  return Point{x, y_up ? grid.height() - 1 - static_cast<int>(y) : y};
}

[[noreturn]] void refuse(std::size_t row, const Point& point, const Placement& placement) {
  if (std::isinf(point.x) || std::isinf(point.y)) {
    throw BadPoint(row, point, "is infinite; a seed that is absent is NaN");
  }
  const Grid& grid = placement.grid;
  const std::string pixels = std::to_string(grid.width()) + " x " + std::to_string(grid.height()) + " pixels";
  throw BadPoint(row, point, placement.bounds ? "is outside the bounds" : "is outside the grid of " + pixels);
}

/// Writes the positions, with room for the one more that the library adds.
void place(const Placement& placement, const Points& points, std::vector<std::uint32_t>& positions) {
  const Grid& grid = placement.grid;
  positions.clear();
  positions.reserve(points.shape(0) + 1);
  for (const double* xy = points.data(); positions.size() < points.shape(0); xy += 2) {
    const Point point = {xy[0], xy[1]};
    if (std::isnan(point.x) || std::isnan(point.y)) {
      positions.push_back(absent_position);
      continue;
    }
    std::optional<Point> pixel;
    if (std::isfinite(point.x) && std::isfinite(point.y)) {
      pixel = placement.bounds ? to_pixel(point, *placement.bounds, grid, placement.y_up)
                               : to_pixel(point, grid, placement.y_up);
    }
    if (!pixel) refuse(positions.size(), point, placement);
    positions.push_back(pack(static_cast<int>(pixel->x), static_cast<int>(pixel->y)));
  }
}

/// How far apart two positions are along an axis, the shorter way round if that is periodic.
int along(std::uint32_t a, std::uint32_t b, int count, bool periodic) {
  const int apart = std::abs(static_cast<int>(a) - static_cast<int>(b));
  return periodic ? std::min(apart, count - apart) : apart;
}

/// Of the seeds that are in the last two frames, along an axis.
int displacement(SeedsObject& seeds) {
  const std::lock_guard<std::mutex> lock(seeds.mutex);
  const Grid& grid = seeds.placement.grid;
  const std::size_t count = std::min(seeds.positions.size(), seeds.last_positions.size());
  int greatest = 0;
  for (std::size_t id = 0; id < count; ++id) {
    const std::uint32_t now = seeds.positions[id], before = seeds.last_positions[id];
    if (now == absent_position || before == absent_position) continue;
    greatest = std::max({greatest, along(now & 0xffff, before & 0xffff, grid.width(), grid.periodic_x()),
                         along(now >> 16, before >> 16, grid.height(), grid.periodic_y())});
  }
  return greatest;
}

void move_to(SeedsObject& seeds, const Points& points) {
  const std::lock_guard<std::mutex> lock(seeds.mutex);
  std::swap(seeds.positions, seeds.last_positions);
  try {
    place(seeds.placement, points, seeds.positions);
    Internal::state(seeds.seeds).place({seeds.positions, {}});
  } catch (...) {
    std::swap(seeds.positions, seeds.last_positions);  // the seeds are where they were
    throw;
  }
}

void make(SeedsObject* memory, const Device& device, const Grid& grid, const std::optional<Corners>& bounds,
          bool y_up) {
  new (memory) SeedsObject(device, placement(grid, bounds, y_up));
}

std::unique_ptr<SeedsObject> from_mask(const Device& device, const Grid& grid,
                                       const Array<const std::uint8_t, nb::ndim<2>>& mask) {
  const std::vector<std::uint8_t> pixels(mask.data(), mask.data() + mask.size());
  return std::make_unique<SeedsObject>(Seeds::from_mask(device, grid, pixels), Placement{grid, {}, false});
}

std::size_t size(SeedsObject& seeds) {
  const std::lock_guard<std::mutex> lock(seeds.mutex);
  return seeds.seeds.size();
}

std::size_t alive(SeedsObject& seeds) {
  const std::lock_guard<std::mutex> lock(seeds.mutex);
  return seeds.seeds.alive();
}

void read(SeedsObject& seeds, const Array<double, nb::shape<-1, 2>>& points) {
  const std::lock_guard<std::mutex> lock(seeds.mutex);
  const std::vector<std::optional<Point>> pixels = seeds.seeds.read();
  if (pixels.size() != points.shape(0)) throw Error("the seeds were moved while they were read");
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double* xy = points.data();
  for (const std::optional<Point>& pixel : pixels) {
    *xy++ = pixel ? pixel->x : none;
    *xy++ = pixel ? pixel->y : none;
  }
}

}  // namespace

void bind_seeds(nb::module_& module) {
  nb::class_<SeedsObject>(module, "Seeds")
      .def("__init__", make, nb::arg("device"), nb::arg("grid"), nb::arg("bounds").none(), nb::arg("y_up"),
           without_gil())
      .def_static("from_mask", from_mask, nb::arg("device"), nb::arg("grid"), nb::arg("mask"), without_gil())
      .def("move_to", move_to, nb::arg("points"), without_gil())
      .def_prop_ro("displacement", displacement, without_gil())
      .def("read", read, nb::arg("points"), without_gil())
      .def_prop_ro("size", size, without_gil())
      .def_prop_ro("alive", alive, without_gil());
}

}  // namespace vorocl::python
