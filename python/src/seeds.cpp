// Seeds: points of NumPy's on the pixels of a grid.
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

using Turn = std::lock_guard<std::mutex>;

Outside outside_of(const std::string& name) {
  if (name == "count") return Outside::count;
  return name == "absent" ? Outside::absent : Outside::refuse;
}

using Weights = std::optional<Array<const double, nb::ndim<1>>>;

/// The rows as they lie in memory, and their weights; those with a NaN are absent.
Points view(const Rows& rows, const Weights& weights, std::vector<std::uint8_t>& present) {
  constexpr auto size = static_cast<std::int64_t>(sizeof(double));
  const double* const x = rows.data();
  const double* const y = x + rows.stride(1);
  const std::int64_t stride = rows.stride(0) * size;
  const double* const z = rows.shape(1) == 3 ? y + rows.stride(1) : nullptr;
  const Points points(x, y, z, rows.shape(0), stride);
  present.resize(points.size());
  for (std::size_t row = 0; row < points.size(); ++row) {
    const Point point = points[row];
    const bool is_absent = std::isnan(point.x) || std::isnan(point.y) || std::isnan(point.z);
    present[row] = is_absent ? 0 : 1;
  }
  return points.marked(present.data()).weighted(weights ? weights->data() : nullptr);
}

void make(SeedsObject* memory, const Device& device, const Grid& grid, const Rows& rows,
          const std::string& outside, bool snap, const Weights& weights) {
  std::vector<std::uint8_t> present;
  const Snap snapped = snap ? Snap::to_pixels : Snap::none;
  new (memory)
      SeedsObject(Seeds(device, grid, view(rows, weights, present), {outside_of(outside), snapped}), snapped);
}

std::unique_ptr<SeedsObject> from_mask(const Device& device, const Grid& grid,
                                       const Array<const std::uint8_t>& mask) {
  const std::vector<std::uint8_t> pixels(mask.data(), mask.data() + mask.size());
  return std::make_unique<SeedsObject>(Seeds::from_mask(device, grid, pixels));
}

/// On another grid, or on the one of the last frame.
void move_to(SeedsObject& seeds, const Rows& rows, const std::optional<Grid>& grid, const Weights& weights) {
  const Turn turn(seeds.mutex);
  const Points points = view(rows, weights, seeds.present);
  if (grid) {
    seeds.seeds.move_to(*grid, points);
  } else {
    seeds.seeds.move_to(points);
  }
}

/// A buffer on the device, its rows and columns, and whether it is of doubles.
using There = std::tuple<std::uintptr_t, std::size_t, int, bool>;

PointBuffer points_there(const There& there) {
  const auto& [buffer, count, columns, are_doubles] = there;
  const PointFormat flat = are_doubles ? PointFormat::doubles_xy : PointFormat::floats_xy;
  const PointFormat deep = are_doubles ? PointFormat::doubles_xyz : PointFormat::floats_xyz;
  return {retained<cl::Buffer>(buffer), count, columns == 3 ? deep : flat};
}

std::unique_ptr<SeedsObject> from_buffer(const Device& device, const Grid& grid, const There& points,
                                         const std::string& outside, bool snap) {
  const Snap snapped = snap ? Snap::to_pixels : Snap::none;
  const SeedsOptions options = {outside_of(outside), snapped};
  return std::make_unique<SeedsObject>(Seeds(device, grid, points_there(points), options), snapped);
}

void move_to_buffer(SeedsObject& seeds, const There& points) {
  const Turn turn(seeds.mutex);
  seeds.seeds.move_to(points_there(points));
}

/// What the seeds say of themselves.
template <auto say>
auto said(SeedsObject& seeds) {
  const Turn turn(seeds.mutex);
  return (seeds.seeds.*say)();
}

/// Where exact diagrams have the seeds, in pixels or in the units of their points, or where these lie
/// themselves: rows (x, y), or (x, y, z).
void read(SeedsObject& seeds, const Array<double, nb::ndim<2>>& points, bool in_pixels, bool themselves) {
  const Turn turn(seeds.mutex);
  const std::vector<std::optional<Point>> places =
      themselves ? seeds.seeds.read() : seeds.seeds.read_pixels();
  if (places.size() != points.shape(0)) throw Error("the seeds were moved while they were read");
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Grid grid = seeds.seeds.grid();
  double* row = points.data();
  for (const std::optional<Point>& place : places) {
    const Point point = !place                    ? Point{none, none, none}
                        : in_pixels || themselves ? *place
                                                  : grid.point(*place);
    const double coordinates[] = {point.x, point.y, point.z};
    row = std::copy_n(coordinates, points.shape(1), row);
  }
}

}  // namespace

void bind_seeds(nb::module_& module) {
  nb::class_<SeedsObject>(module, "Seeds")
      .def_static("from_buffer", from_buffer, nb::arg("device"), nb::arg("grid"), nb::arg("points"),
                  nb::arg("outside"), nb::arg("snap"), without_gil())
      .def("move_to_buffer", move_to_buffer, nb::arg("points"), without_gil())
      .def("__init__", make, nb::arg("device"), nb::arg("grid"), nb::arg("points"), nb::arg("outside"),
           nb::arg("snap"), nb::arg("weights").none(), without_gil())
      .def_static("from_mask", from_mask, nb::arg("device"), nb::arg("grid"), nb::arg("mask"), without_gil())
      .def("move_to", move_to, nb::arg("points"), nb::arg("grid").none(), nb::arg("weights").none(),
           without_gil())
      .def_prop_ro("displacement", said<&Seeds::displacement>, without_gil())
      .def("read", read, nb::arg("points"), nb::arg("in_pixels"), nb::arg("themselves") = false,
           without_gil())
      .def_prop_ro("size", said<&Seeds::size>, without_gil())
      .def_prop_ro("alive", said<&Seeds::alive>, without_gil());
}

}  // namespace vorocl::python
