// Seeds: points of NumPy's as pixels.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/unique_ptr.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <tuple>

#include "core/seeds_state.hpp"
#include "module.hpp"
#include "runtime/bad_point.hpp"

namespace vorocl::python {

namespace {

using Corners = std::tuple<double, double, double, double>;

Placing placing(const Grid& grid, const std::optional<Corners>& corners, bool y_up, bool outside_counts) {
  Placing result = {grid, std::nullopt, y_up, outside_counts && grid.periodic() == Periodic::none};
  if (corners) {
    const auto [x0, y0, x1, y1] = *corners;
    const Bounds bounds = {x0, y0, x1, y1};
    result.map.emplace(bounds, grid, y_up, !result.outside_counts);
    result.map->repeat(grid.periodic(), bounds);
  }
  return result;
}

/// A position along an axis in pixels, wrapped if that is periodic.
double wrapped(double position, int count, bool periodic) {
  if (!periodic) return position;
  position = std::fmod(position, count);
  if (position < 0) position += count;
  return position < count ? position : 0;  // the sum may be rounded up to the period
}

/// The centre of a point's pixel, which may lie outside the grid.
Point pixel_of(const Placing& placing, const Point& point) {
  if (placing.map) return placing.map->pixel(point);
  const Grid& grid = placing.grid;
  const double x = std::floor(wrapped(point.x, grid.width(), grid.periodic_x()));
  const double y = std::floor(wrapped(point.y, grid.height(), grid.periodic_y()));
  return {x + 0.5, (placing.y_up ? grid.height() - 1 - y : y) + 0.5};
}

[[noreturn]] void refuse(std::size_t row, const Point& point, const Placing& placing) {
  if (std::isinf(point.x) || std::isinf(point.y)) {
    throw BadPoint(row, point, "is infinite; a seed that is absent is NaN");
  }
  const Grid& grid = placing.grid;
  const std::string pixels = std::to_string(grid.width()) + " x " + std::to_string(grid.height()) + " pixels";
  const std::string outside = placing.map ? "is outside the bounds" : "is outside the grid of " + pixels;
  const bool is_periodic = grid.periodic() != Periodic::none;
  throw BadPoint(row, point, outside + (is_periodic ? ", along the axis that is not periodic" : ""));
}

/// Calls `use` with each point's pixel, none for an absent seed.
template <typename Use>
void each_pixel(const Placing& placing, const Points& points, Use use) {
  constexpr double far = 2147483648.0 - Grid::max_side;
  const double* xy = points.data();
  for (std::size_t row = 0; row < points.shape(0); ++row, xy += 2) {
    const Point point = {xy[0], xy[1]};
    if (std::isnan(point.x) || std::isnan(point.y)) {
      use(std::nullopt);
      continue;
    }
    if (std::isinf(point.x) || std::isinf(point.y)) refuse(row, point, placing);
    const Point pixel = pixel_of(placing, point);
    if (std::max(std::abs(pixel.x), std::abs(pixel.y)) >= far) throw point_too_far(row, point);
    if (!placing.grid.holds(pixel) && !placing.outside_counts) refuse(row, point, placing);
    use(std::optional<Point>(pixel));
  }
}

/// Writes the positions, with room for the one more that the library adds, of seeds outside as of absent
/// ones. Returns where seeds are in the plane, if some lie outside.
std::vector<PlanePosition> place(const Placing& placing, const Points& points,
                                 std::vector<std::uint32_t>& positions) {
  positions.clear();
  positions.reserve(points.shape(0) + 1);
  bool all_inside = true;
  each_pixel(placing, points, [&](const std::optional<Point>& pixel) {
    const bool inside = pixel && placing.grid.holds(*pixel);
    positions.push_back(inside ? pack(static_cast<int>(pixel->x), static_cast<int>(pixel->y))
                               : absent_position);
    all_inside = all_inside && (inside || !pixel);
  });
  std::vector<PlanePosition> in_the_plane;
  if (all_inside) return in_the_plane;
  in_the_plane.reserve(points.shape(0) + 1);
  each_pixel(placing, points, [&](const std::optional<Point>& pixel) {
    in_the_plane.push_back(pixel ? PlanePosition{{static_cast<cl_int>(std::floor(pixel->x)),
                                                  static_cast<cl_int>(std::floor(pixel->y))}}
                                 : PlanePosition{{absent_coordinate, 0}});
  });
  return in_the_plane;
}

/// How far apart two positions are along an axis, the shorter way round if that is periodic.
int along(std::uint32_t a, std::uint32_t b, int count, bool periodic) {
  const int apart = std::abs(static_cast<int>(a) - static_cast<int>(b));
  return periodic ? std::min(apart, count - apart) : apart;
}

/// Of the seeds that are in the last two frames, along an axis.
int displacement(SeedsObject& seeds) {
  const std::lock_guard<std::mutex> lock(seeds.mutex);
  const Grid& grid = seeds.placing.grid;
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
    std::vector<PlanePosition> in_the_plane = place(seeds.placing, points, seeds.positions);
    Internal::state(seeds.seeds).place({seeds.positions, std::move(in_the_plane)});
  } catch (...) {
    std::swap(seeds.positions, seeds.last_positions);  // the seeds are where they were
    throw;
  }
}

void make(SeedsObject* memory, const Device& device, const Grid& grid, const std::optional<Corners>& bounds,
          bool y_up, bool outside_counts) {
  new (memory) SeedsObject(device, placing(grid, bounds, y_up, outside_counts));
}

std::unique_ptr<SeedsObject> from_mask(const Device& device, const Grid& grid,
                                       const Array<const std::uint8_t, nb::ndim<2>>& mask) {
  const std::vector<std::uint8_t> pixels(mask.data(), mask.data() + mask.size());
  return std::make_unique<SeedsObject>(Seeds::from_mask(device, grid, pixels),
                                       Placing{grid, {}, false, false});
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
           nb::arg("outside_counts"), without_gil())
      .def_static("from_mask", from_mask, nb::arg("device"), nb::arg("grid"), nb::arg("mask"), without_gil())
      .def("move_to", move_to, nb::arg("points"), without_gil())
      .def_prop_ro("displacement", displacement, without_gil())
      .def("read", read, nb::arg("points"), without_gil())
      .def_prop_ro("size", size, without_gil())
      .def_prop_ro("alive", alive, without_gil());
}

}  // namespace vorocl::python
