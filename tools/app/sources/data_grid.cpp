#include "app/sources/data_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "app/sources/bounds.hpp"
#include "app/terminal/console.hpp"

namespace vorocl::command {

namespace {

constexpr char names[] = {'x', 'y', 'z'};

std::array<double, 3> coordinates(const Point& point) { return {point.x, point.y, point.z}; }

/// What bounds are along an axis.
struct Side {
  double low, high;
  friend bool operator!=(const Side& a, const Side& b) { return a.low != b.low || a.high != b.high; }
};
std::array<Side, 3> sides_of(const Bounds& box) {
  return {Side{box.x0, box.x1}, Side{box.y0, box.y1}, Side{box.z0, box.z1}};
}

bool has_axis(Axes axes, std::size_t axis) { return (static_cast<unsigned>(axes) >> axis & 1u) != 0; }

/// Without a size it has few voxels, which do not count.
Grid grid_of(const SeedOptions& options, const std::array<Side, 3>& sides, Axes periodic) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (has_axis(periodic, i) && sides[i].low == sides[i].high) {
      throw Error(fmt::format("there is no extent in {}, which is to be periodic", names[i]));
    }
  }
  const Grid voxels = options.size.value_or(Grid(1, 1, 2));
  const auto& [x, y, z] = sides;
  return with_bounds(Grid(voxels.width(), voxels.height(), voxels.depth(), periodic),
                     {x.low, y.low, x.high, y.high, z.low, z.high}, true);
}

void check_inside(const std::vector<Point>& points, const std::vector<std::uint32_t>& ids, const Grid& grid) {
  const Axis* const axes[] = {&grid.x(), &grid.y(), &grid.z()};
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (axes[axis]->covers(coordinates(points[i])[axis])) continue;
      throw Error(
          fmt::format("{} {} at ({}, {}, {}) is outside the bounds, in {} from {} to {}; give bounds that "
                      "hold all points",
                      ids.empty() ? "point" : "particle", ids.empty() ? i : ids[i], points[i].x, points[i].y,
                      points[i].z, names[axis], axes[axis]->from(), axes[axis]->to()));
    }
  }
}

Grid with_spacing(const Grid& grid, const std::array<int, 3>& spacing) {
  return {grid.x().spaced(spacing[0]), grid.y().spaced(spacing[1]), grid.z().spaced(spacing[2])};
}

/// By how much the units by which axes are spaced differ in length in data units: 1 where they do not. An
/// axis without an extent fits all.
double spread_of_units(const Grid& grid) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Axis* axis : {&grid.x(), &grid.y(), &grid.z()}) {
    const double unit = AxisScale{*axis}.side_of_pixel() / axis->spacing();
    if (unit == 0) continue;
    least = std::min(least, unit);
    most = std::max(most, unit);
  }
  return most > 0 ? most / least : 1;
}

constexpr double exact = 1.001, rounded = 1.01;  // as the number of voxels of a side is, which are whole
constexpr int few = 16;  // units of a side: of frames no more, for each new spacing needs programs of its own

bool has_scale(const Grid& grid) { return spread_of_units(grid) <= rounded; }

bool is_short_enough(const Axis& axis) {
  return axis.pixels() * axis.spacing() <= Window::max_side_of_volume / (axis.is_periodic() ? 2 : 1);
}

/// The least spacing, up to `most`, that gives distances a scale and that a volume can have; none counts
/// voxels as cubes.
std::array<int, 3> spacing_of(const Grid& grid, int most = few) {
  const Axis* const axes[] = {&grid.x(), &grid.y(), &grid.z()};
  std::array<double, 3> sides = {};
  for (std::size_t i = 0; i < 3; ++i) sides[i] = AxisScale{*axes[i]}.side_of_pixel();
  double shortest = std::numeric_limits<double>::infinity();
  for (const double side : sides) shortest = side > 0 ? std::min(shortest, side) : shortest;
  for (const auto& [limit, spread] :
       {std::pair(few, exact), {few, rounded}, {most, exact}, {most, rounded}}) {
    for (int units = 1; units <= limit; ++units) {  // of the shortest side
      std::array<int, 3> spacing = {1, 1, 1};
      for (std::size_t i = 0; i < 3; ++i) {
        const double length = units * (sides[i] / shortest);
        if (length >= 1) spacing[i] = static_cast<int>(std::lround(std::min(length, limit + 1.0)));
      }
      if (*std::max_element(spacing.begin(), spacing.end()) > limit) break;
      const Grid spaced = with_spacing(grid, spacing);
      if (!is_short_enough(spaced.x()) || !is_short_enough(spaced.y()) || !is_short_enough(spaced.z())) break;
      if (spread_of_units(spaced) <= spread) return spacing;
    }
  }
  return {1, 1, 1};
}

/// Spaced as its voxels are, if it is to have some. Throws Error for weights if they are no cubes.
Grid with_voxels(const SeedOptions& options, const Grid& grid, int most = few) {
  if (options.size && !options.weight_column.empty()) {
    if (has_scale(grid)) return grid;
    throw Error(
        fmt::format("weights need voxels that are cubes in the data, and these are {:g} x {:g} x {:g}; "
                    "give a --size like the bounds",
                    AxisScale{grid.x()}.side_of_pixel(), AxisScale{grid.y()}.side_of_pixel(),
                    AxisScale{grid.z()}.side_of_pixel()));
  }
  return options.size ? with_spacing(grid, spacing_of(grid, most)) : grid;
}

}  // namespace

bool warn_of_voxels(const Grid& grid, const std::string& where) {
  if (has_scale(grid)) return false;
  print_warning(fmt::format(
      "{}the axes get different scales on {} voxels, so the cells are not Voronoi cells in data units; a "
      "--size like the bounds makes voxels cubes, and others whose sides are as small whole numbers do as "
      "well",
      where, sides_of(grid)));
  return true;
}

namespace {
Bounds bounds_of(const Grid& grid) {
  return {grid.x().from(), grid.y().from(), grid.x().to(), grid.y().to(), grid.z().from(), grid.z().to()};
}
}  // namespace

void note_scales(const SeedOptions& options, const Grid& grid) {
  note_no_extent(options, bounds_of(grid), true);
  const double spread = spread_of_units(grid);
  const bool is_rounded = spread > exact && has_scale(grid);  // else a warning says more
  if (grid.is_spaced() || is_rounded) {
    print_note(
        fmt::format("the sides of a voxel are as {} : {} : {} in the data{}, and distances count them so",
                    grid.x().spacing(), grid.y().spacing(), grid.z().spacing(),
                    is_rounded ? fmt::format(" to {:.1g} %", 100 * (spread - 1)) : ""));
  }
}

View view_of_grid(const Grid& grid, bool in_pixels) {
  View view = {{Size(grid.width(), grid.height()), grid.depth()}, grid};
  view.units = in_pixels ? Units::of_voxels(grid) : Units(grid, has_scale(grid));
  const Bounds bounds = bounds_of(grid);
  if (view.units.are_of_data()) view.picture.georeference = Georeference{bounds, false, {}};
  return view;
}

namespace {

/// What the volume of a frame shows: see box_of_frame() for `all`.
std::array<Side, 3> sides_of_frame(const SeedOptions& options, const Frame& frame,
                                   const std::vector<Point>& points, const std::optional<Bounds>& all,
                                   Axes periodic) {
  const std::optional<Bounds>& given = options.bounds;
  if (!frame.box && !given && !all && points.empty()) {
    throw Error("the frame has neither a box nor particles to tell the bounds by: give --bounds");
  }
  const std::array<Side, 3> whole = sides_of(frame.box ? *bounds_of(frame)
                                             : given   ? *given
                                             : all     ? *all
                                                       : bounding_box(points, true));
  std::array<Side, 3> sides = given ? sides_of(*given) : all ? sides_of(*all) : whole;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!has_axis(periodic, i)) continue;
    if (given && sides[i] != whole[i]) {
      throw Error(
          fmt::format("volumes show whole periods: in {}, which is periodic, --bounds must be from {} to {}",
                      names[i], whole[i].low, whole[i].high));
    }
    sides[i] = whole[i];
  }
  return sides;
}

}  // namespace

Grid box_of_points(const SeedOptions& options, const std::vector<Point>& points,
                   const std::vector<std::uint32_t>& ids) {
  const Bounds box = bounding_box(points, true);  // of finite points
  const Axes periodic = options.periodic.value_or(Axes::none);
  Grid grid = with_voxels(options, grid_of(options, sides_of(options.bounds.value_or(box)), periodic),
                          Axis::max_spacing);
  check_inside(points, ids, grid);
  if (options.size) {
    note_scales(options, grid);
    warn_of_voxels(grid, "");
  }
  if (!options.bounds && periodic != Axes::none) {
    print_note("the periods are those of the points' bounding box; --bounds says others");
  }
  return grid;
}

Grid box_of_frame(const SeedOptions& options, const Frame& frame, const std::vector<Point>& points,
                  const std::optional<Bounds>& all) {
  const Axes of_file = frame.box ? periodic_axes(*frame.box, true) : Axes::none;
  const Axes periodic = options.periodic.value_or(of_file);
  Grid grid =
      with_voxels(options, grid_of(options, sides_of_frame(options, frame, points, all, periodic), periodic));
  if (frame.box && (frame.box->tilt != 0 || frame.box->xz != 0 || frame.box->yz != 0)) {
    if (!options.keeps_inside.empty()) throw Error("the box is tilted, which " + options.keeps_inside);
    if (periodic != of_file)
      throw Error(
          "the box is tilted and repeats as the file says that it is periodic, so leave --periodic out");
    grid = grid.tilted(frame.box->tilt, frame.box->xz, frame.box->yz);
  }
  check_inside(points, frame.ids, grid);
  return grid;
}

namespace {

/// `repeats` is what does along the periodic axes, with a tilt: bounds that are given must be the same there.
Grid rectangle_of(const SeedOptions& options, const Bounds& repeats, Axes periodic, const char* name,
                  double tilt = 0) {
  const Bounds& shown = options.bounds ? *options.bounds : repeats;
  const bool parts_x = has_x(periodic) && (shown.x0 != repeats.x0 || shown.x1 != repeats.x1);
  const bool parts_y = has_y(periodic) && (shown.y0 != repeats.y0 || shown.y1 != repeats.y1);
  if (parts_x || parts_y) {
    throw Error(fmt::format("--exact cuts whole periods: along a periodic axis --bounds {} must be {}, {}",
                            to_string(shown), name, to_string(repeats)));
  }
  check_bounds(shown, periodic);
  const bool closed = (!options.bounds && !options.domain) || options.outside == Outside::refuse;
  return with_bounds(Grid(1, 1, periodic), shown, closed).tilted(tilt);
}

void note_points(const SeedOptions& options, const Grid& grid, const std::vector<Point>& points) {
  if (options.outside == Outside::refuse) return;
  const auto is_outside = [&](const Point& point) {
    return !grid.x().covers(point.x) || !grid.y().covers(point.y);
  };
  note_outside(static_cast<std::size_t>(std::count_if(points.begin(), points.end(), is_outside)),
               points.size(), {grid.x().from(), grid.y().from(), grid.x().to(), grid.y().to()});
}

}  // namespace

Grid rectangle_of_points(const SeedOptions& options, const std::vector<Point>& points) {
  const Bounds repeats = options.domain   ? *options.domain
                         : options.bounds ? *options.bounds
                                          : widened(bounding_box(points), options.margin);
  Grid grid = rectangle_of(options, repeats, options.periodic.value_or(Axes::none), "the domain");
  note_points(options, grid, points);
  return grid;
}

Grid rectangle_of_frame(const SeedOptions& options, const Frame& frame, bool is_first) {
  const std::optional<Bounds> filled = bounds_of(frame);
  if (!filled && !options.bounds) throw Error("it has neither a box nor particles: give --bounds");
  const Axes periodic = options.periodic.value_or(frame.box ? periodic_axes(*frame.box, false) : Axes::none);
  const double tilt = frame.box ? frame.box->tilt : 0;
  if (tilt != 0 && periodic != Axes::xy) {
    throw Error(
        "the box is tilted: --exact cuts it as periodic in x and y, so leave --periodic out, or give "
        "--periodic xy");
  }
  Grid grid = rectangle_of(options, filled ? *filled : *options.bounds, periodic, "the box", tilt);
  if (is_first) note_points(options, grid, frame.positions);
  return grid;
}

}  // namespace vorocl::command
