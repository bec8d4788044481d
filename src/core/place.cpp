#include "core/place.hpp"

#include <utility>

#include "core/placement.hpp"
#include "runtime/buffer.hpp"
#include "runtime/has_doubles.hpp"
#include "runtime/process.hpp"
// Last: it defines macros.
#include "core/place_sizes.cl"

namespace vorocl {

static_assert(fractions_of_pixel == PARTS_OF_PIXEL);
static_assert(static_cast<int>(Outside::count) == OUTSIDE_COUNTS &&
              static_cast<int>(Outside::absent) == OUTSIDE_IS_ABSENT &&
              static_cast<int>(Outside::refuse) == OUTSIDE_IS_BAD);

cl_int kind_of(const Axis& axis) {
  return (Internal::is_in_pixels(axis) ? AXIS_IN_PIXELS : 0) | (axis.is_periodic() ? AXIS_PERIODIC : 0) |
         (axis.is_reversed() ? AXIS_REVERSED : 0) | (axis.is_closed() ? AXIS_CLOSED : 0);
}

bool places_points(const Device& device) {
  return has_doubles(device) && environment("VOROCL_PLACE_ON") != "host";
}

cl_int numbers_of_place(const Grid& grid) { return has_voxels(grid) ? 4 : 2; }

cl::Event place_on_grid(const Device& device, KernelSet& kernels, const Grid& grid, Outside outside,
                        const PointsThere& points, const Absence& absence, const cl::Buffer& positions,
                        const cl::Buffer& places, const cl::Buffer& found) {
  const auto ends_of = [](const Axis& axis) { return cl_double2{{axis.from(), axis.to()}}; };
  const auto of_axes = [&grid](auto number) {
    return cl_int4{{number(grid.x()), number(grid.y()), number(grid.z()), 0}};
  };
  const auto pixels_of = [](const Axis& axis) { return static_cast<cl_int>(axis.pixels()); };
  if (has_voxels(grid) && outside == Outside::count) outside = Outside::refuse;
  const PackedPositions packed{PixelGrid(Window(grid))};
  const bool has_marks = absence.marks() != nullptr, has_places = places() != nullptr;
  const cl_int absent_by = has_marks ? MARKED_BY_BYTES : absence.of_nans ? MARKED_BY_POINTS : ALL_PRESENT;
  const PixelGrid any(MOST_POINTS_OF_ITEM, 1);  // so that one program serves all grids
  Kernel& kernel =
      kernels.get(device, "core/place.cl", points.are_doubles ? "place_doubles" : "place_floats", any);
  return kernel.over_items(points.count / kernel.vector_width() + 1, *points.points,
                           cl_int{points.dimensions}, has_marks ? absence.marks : positions, absent_by,
                           ends_of(grid.x()), ends_of(grid.y()), ends_of(grid.z()), of_axes(pixels_of),
                           of_axes(kind_of), cl_double4{{grid.tilt(), grid.tilt_xz(), grid.tilt_yz(), 0}},
                           static_cast<cl_int>(outside), static_cast<cl_uint>(points.count), packed.bits,
                           packed.empty, positions, has_places ? numbers_of_place(grid) : cl_int{0},
                           has_places ? places : positions, found);
}

GivenPoints read_points(const Device& device, const PointsThere& points) {
  const std::size_t count = points.count * static_cast<std::size_t>(points.dimensions);
  auto numbers = std::make_shared<std::vector<double>>();
  if (points.are_doubles) {
    *numbers = download<double>(device, *points.points, count);
  } else {
    const auto floats = download<float>(device, *points.points, count);
    numbers->assign(floats.begin(), floats.end());
  }
  return {std::move(numbers), points.dimensions};
}

}  // namespace vorocl
