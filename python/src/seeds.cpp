// Seeds: points of NumPy's as pixels.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/unique_ptr.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "module.hpp"

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

/// The pixel's centre; none outside the grid.
std::optional<Point> to_pixel(const Point& point, const Grid& grid, bool y_up) {
  const double x = std::floor(wrapped(point.x, grid.width(), grid.periodic_x()));
  const double y = std::floor(wrapped(point.y, grid.height(), grid.periodic_y()));
  if (!(x >= 0 && x < grid.width() && y >= 0 && y < grid.height())) return std::nullopt;
  return Point{x + 0.5, (y_up ? grid.height() - 1 - y : y) + 0.5};
}

void place(const Placement& placement, const Points& points, std::vector<std::optional<Point>>& pixels) {
  const Grid& grid = placement.grid;
  pixels.clear();
  pixels.reserve(points.shape(0));
  for (const double* xy = points.data(); pixels.size() < points.shape(0); xy += 2) {
    const Point point = {xy[0], xy[1]};
    if (std::isnan(point.x) || std::isnan(point.y)) {
      pixels.emplace_back();
      continue;
    }
    if (std::isinf(point.x) || std::isinf(point.y)) {
      throw BadPoint(pixels.size(), point, "is infinite; a seed that is absent is NaN");
    }
    pixels.push_back(placement.bounds ? to_pixel(point, *placement.bounds, grid, placement.y_up)
                                      : to_pixel(point, grid, placement.y_up));
    if (!pixels.back()) {
      const std::string where = placement.bounds ? "the bounds"
                                                 : "the grid of " + std::to_string(grid.width()) + " x " +
                                                       std::to_string(grid.height()) + " pixels";
      throw BadPoint(pixels.size() - 1, point, "is outside " + where);
    }
  }
}

/// How far apart two positions are along an axis, the shorter way round if that is periodic.
double along(double a, double b, int count, bool periodic) {
  const double apart = std::abs(a - b);
  return periodic ? std::min(apart, count - apart) : apart;
}

/// Of the seeds that are in both frames.
double greatest_displacement(const SeedsObject& seeds) {
  const Grid& grid = seeds.placement.grid;
  double greatest = 0;
  for (std::size_t id = 0; id < std::min(seeds.pixels.size(), seeds.last_pixels.size()); ++id) {
    const std::optional<Point>&now = seeds.pixels[id], &before = seeds.last_pixels[id];
    if (!now || !before) continue;
    greatest = std::max({greatest, along(now->x, before->x, grid.width(), grid.periodic_x()),
                         along(now->y, before->y, grid.height(), grid.periodic_y())});
  }
  return greatest;
}

/// Returns the greatest displacement.
double move_to(SeedsObject& seeds, const Points& points) {
  const std::lock_guard<std::mutex> lock(seeds.mutex);
  std::swap(seeds.pixels, seeds.last_pixels);
  try {
    place(seeds.placement, points, seeds.pixels);
    seeds.seeds.move_to(seeds.pixels);
  } catch (...) {
    std::swap(seeds.pixels, seeds.last_pixels);  // the seeds are where they were
    throw;
  }
  return greatest_displacement(seeds);
}

void make(SeedsObject* memory, const Device& device, const Grid& grid, const std::optional<Corners>& bounds,
          bool y_up) {
  new (memory) SeedsObject(device, placement(grid, bounds, y_up));
}

std::unique_ptr<SeedsObject> from_mask(const Device& device, const Grid& grid,
                                       const Array<const std::uint8_t, nb::ndim<2>>& mask) {
  const std::vector<std::uint8_t> pixels(mask.data(), mask.data() + mask.size());
  auto seeds =
      std::make_unique<SeedsObject>(Seeds::from_mask(device, grid, pixels), Placement{grid, {}, false});
  seeds->pixels = seeds->seeds.read();
  return seeds;
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
      .def("read", read, nb::arg("points"), without_gil())
      .def_prop_ro("size", size, without_gil())
      .def_prop_ro("alive", alive, without_gil());
}

}  // namespace vorocl::python
