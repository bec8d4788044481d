#include "app/sources/volume_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "app/sources/bounds.hpp"
#include "app/sources/seed_input.hpp"
#include "app/terminal/console.hpp"
#include "formats/csv.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

namespace {

constexpr char names[] = {'x', 'y', 'z'};

std::array<double, 3> coordinates(const Point& point) { return {point.x, point.y, point.z}; }

VolumeSides bounding_sides(const std::vector<Point>& points) {
  VolumeSides sides;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto is_less = [axis](const Point& a, const Point& b) {
      return coordinates(a)[axis] < coordinates(b)[axis];
    };
    const auto [least, most] = std::minmax_element(points.begin(), points.end(), is_less);
    sides[axis] = {coordinates(*least)[axis], coordinates(*most)[axis], false};
  }
  return sides;
}

VolumeSides sides_of(const Box& box) {
  return {VolumeSide{box.x0, box.x1, box.periodic_x}, VolumeSide{box.y0, box.y1, box.periodic_y},
          VolumeSide{box.z0, box.z1, box.periodic_z}};
}

/// The bounds that are given; none without them.
std::optional<VolumeSides> given_sides(const SeedOptions& options) {
  if (!options.bounds) return std::nullopt;
  return VolumeSides{VolumeSide{options.bounds->x0, options.bounds->x1, false},
                     VolumeSide{options.bounds->y0, options.bounds->y1, false},
                     VolumeSide{options.z_bounds->first, options.z_bounds->second, false}};
}

void take_periodic_axes(const SeedOptions& options, VolumeSides& sides) {
  if (!options.periodic) return;
  sides[0].is_periodic = has_x(*options.periodic);
  sides[1].is_periodic = has_y(*options.periodic);
  sides[2].is_periodic = has_z(*options.periodic);
}

/// Without a size it has few voxels, which do not count.
Grid grid_of(const SeedOptions& options, const VolumeSides& sides) {
  const auto axis = [](std::int64_t voxels, const VolumeSide& side) {
    const Axis open(voxels, side.low, side.high);
    return side.is_periodic ? open.periodic() : open.closed();
  };
  for (std::size_t i = 0; i < 3; ++i) {
    if (sides[i].is_periodic && sides[i].low == sides[i].high) {
      throw Error(fmt::format("there is no extent in {}, which is to be periodic", names[i]));
    }
  }
  const Size size = options.size.value_or(Size(1, 1));
  return {axis(size.width(), sides[0]), axis(size.height(), sides[1]),
          axis(options.size ? options.depth : 2, sides[2])};
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

/// Spaced as its voxels are, if it is to have some.
Grid with_voxels(const SeedOptions& options, const Grid& grid, int most = few) {
  return options.size ? with_spacing(grid, spacing_of(grid, most)) : grid;
}

/// Where the volume of `where` ("frame 3: ") is no picture of the data to scale, a warning says so. Returns
/// whether it did.
bool warn_of_voxels(const Grid& grid, const std::string& where) {
  if (has_scale(grid)) return false;
  print_warning(fmt::format(
      "{}the axes get different scales on {} voxels, so the cells are not Voronoi cells in data units; a "
      "--size like the bounds makes voxels cubes, and others whose sides are as small whole numbers do as "
      "well",
      where, to_string(VolumeSize{grid.width(), grid.height(), grid.depth()})));
  return true;
}

/// Says what may surprise: distances that count voxels as they are long, and data without an extent.
void note_scales(const Grid& grid) {
  const double spread = spread_of_units(grid);
  const bool is_rounded = spread > exact && has_scale(grid);  // else a warning says more
  if (grid.is_spaced() || is_rounded) {
    print_note(
        fmt::format("the sides of a voxel are as {} : {} : {} in the data{}, and distances count them so",
                    grid.x().spacing(), grid.y().spacing(), grid.z().spacing(),
                    is_rounded ? fmt::format(" to {:.1g} %", 100 * (spread - 1)) : ""));
  }
  const Axis* const axes[] = {&grid.x(), &grid.y(), &grid.z()};
  for (std::size_t i = 0; i < 3; ++i) {
    if (axes[i]->from() < axes[i]->to()) continue;
    return print_note(fmt::format(
        "the data have no extent in {}, so all measures stay in voxels; --bounds can give one", names[i]));
  }
}

/// How a volume stands in the data, of which a voxel of random seeds knows nothing.
View view_of(const Grid& grid, bool in_pixels) {
  View view = {Size(grid.width(), grid.height()), grid};
  view.units = in_pixels ? Units::of_voxels(grid) : Units(grid, has_scale(grid));
  return view;
}

Input input_from(const View& view, const std::vector<Point>& points, const std::vector<std::uint32_t>& ids,
                 Snap snap, std::optional<std::int64_t> timestep) {
  const auto place = [grid = view.window.grid(), points, snap](const Device& device) {
    return Seeds(device, grid, points, {Outside::refuse, snap});
  };
  return {view, place, ids, {}, false, timestep};
}

Input input_from_points(const SeedOptions& options) {
  const CsvPoints read = read_points(options, true);
  const std::vector<Point>& points = read.points;
  try {
    const auto is_bad = [](const Point& point) {
      return !std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z);
    };
    const auto bad = std::find_if(points.begin(), points.end(), is_bad);
    if (bad != points.end()) {
      throw Error(fmt::format("point {} at ({}, {}, {}) is not finite", bad - points.begin(), bad->x, bad->y,
                              bad->z));
    }
    const std::optional<VolumeSides> given = given_sides(options);
    VolumeSides sides = given ? *given : bounding_sides(points);
    take_periodic_axes(options, sides);
    const Grid grid = with_voxels(options, grid_of(options, sides), Axis::max_spacing);
    check_inside(points, read.ids, grid);
    if (options.size) {
      warn_of_voxels(grid, "");
      note_scales(grid);
    }
    if (!given &&
        std::any_of(sides.begin(), sides.end(), [](const VolumeSide& side) { return side.is_periodic; })) {
      print_note("the periods are those of the points' bounding box; --bounds says others");
    }
    Input input = input_from(view_of(grid, in_pixels(options)), points, read.ids, options.snapping(), {});
    input.kept = {read.kept_names, read.kept};
    return input;
  } catch (const Error& error) {
    throw Error(options.points + ": " + error.what());
  }
}

Input input_at_random(const SeedOptions& options) {
  const Grid grid(options.size->width(), options.size->height(), options.depth,
                  options.periodic.value_or(Axes::none));
  return {view_of(grid, true),
          [grid, count = options.random, seed = options.rng_seed](const Device& device) {
            return Seeds::random(device, grid, count, seed);
          },
          {},
          {}};
}

/// What the volume of a frame shows: see VolumeFrames for `all`.
VolumeSides sides_of_frame(const SeedOptions& options, const Frame& frame, const std::vector<Point>& points,
                           const std::optional<VolumeSides>& all) {
  const std::optional<VolumeSides> given = given_sides(options);
  if (!frame.box && !given && !all && points.empty()) {
    throw Error("the frame has neither a box nor particles to tell the bounds by: give --bounds");
  }
  VolumeSides whole = frame.box ? sides_of(*frame.box) : given ? *given : all ? *all : bounding_sides(points);
  take_periodic_axes(options, whole);
  VolumeSides sides = whole;
  for (std::size_t i = 0; i < 3; ++i) {
    if (given) {
      sides[i].low = (*given)[i].low;
      sides[i].high = (*given)[i].high;
    } else if (all && !sides[i].is_periodic) {
      sides[i].low = (*all)[i].low;
      sides[i].high = (*all)[i].high;
    }
    if (!sides[i].is_periodic || (sides[i].low == whole[i].low && sides[i].high == whole[i].high)) continue;
    throw Error(
        fmt::format("volumes show whole periods: in {}, which is periodic, --bounds must be from {} to {}",
                    names[i], whole[i].low, whole[i].high));
  }
  return sides;
}

}  // namespace

void note_of_volume(const SeedOptions& options, const Frame& frame) {
  note_of_turn(frame);
  if (!frame.box || !options.periodic) return;
  const Box& box = *frame.box;
  const std::string of_file = to_string(axes_of(box.periodic_x, box.periodic_y, box.periodic_z));
  const std::string told = to_string(*options.periodic);
  if (told == of_file) return;
  print_note(
      fmt::format("the periodic axes of the file's box are {}; --periodic {} counts instead", of_file, told));
}

std::vector<Point> points_of(const Frame& frame) {
  std::vector<Point> points;
  points.reserve(frame.positions.size());
  for (std::size_t i = 0; i < frame.positions.size(); ++i) {
    points.push_back({frame.positions[i].x, frame.positions[i].y, frame.z[i]});
  }
  return points;
}

Grid grid_of_frame(const SeedOptions& options, const Frame& frame, const std::vector<Point>& points,
                   const std::optional<VolumeSides>& all) {
  const Grid grid = with_voxels(options, grid_of(options, sides_of_frame(options, frame, points, all)));
  check_inside(points, frame.ids, grid);
  return grid;
}

std::optional<VolumeSides> sides_of_all_frames(const std::string& path, std::optional<int> frames,
                                               const Interruption& interruption) {
  std::optional<VolumeSides> all;
  read_all_frames(path, Wanted::box_of_volume, frames, interruption, [&all](const Frame& frame) {
    if (!frame.box && frame.positions.empty()) return;
    const VolumeSides sides = frame.box ? sides_of(*frame.box) : bounding_sides(points_of(frame));
    if (!all) all = sides;
    for (std::size_t i = 0; i < 3; ++i) {
      (*all)[i].low = std::min((*all)[i].low, sides[i].low);
      (*all)[i].high = std::max((*all)[i].high, sides[i].high);
    }
  });
  return all;
}

VolumeFrames::VolumeFrames(const SeedOptions& options, int start, const std::optional<VolumeSides>& all)
    : options_(options), all_(all), reader_(open_trajectory(options.trajectory, "", Wanted::volume)) {
  while (number_ < start) {
    if (!reader_->next(frame_)) {
      throw Error(fmt::format("{}: there is no frame {}; the last one of the file is {}, counted from 0",
                              options.trajectory, start, number_));
    }
    ++number_;
  }
  take_frame();
  note_of_volume(options, frame_);
}

bool VolumeFrames::next() {
  if (!reader_->next(frame_)) return false;
  ++number_;
  take_frame();
  return true;
}

View VolumeFrames::view() const { return view_of(*grid_, in_pixels(options_)); }

void VolumeFrames::take_frame() {
  points_ = points_of(frame_);
  try {
    const bool is_first = !grid_;
    grid_ = grid_of_frame(options_, frame_, points_, all_);
    if (is_first) note_scales(*grid_);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: frame {}: {}", options_.trajectory, number_, error.what()));
  }
  if (!has_warned_) has_warned_ = warn_of_voxels(*grid_, fmt::format("frame {}: ", number_));
}

void refuse_in_volumes(const std::string& option) {
  throw UsageError(option + " is for planes, not for volumes");
}

void check_volume_options(const SeedOptions& options) {
  const char* const of_planes = !options.mask.empty()           ? "--mask"
                                : options.width != 0            ? "--width"
                                : options.outside               ? "--outside"
                                : options.y_up                  ? "--y-up"
                                : options.y_down                ? "--y-down"
                                : options.margin > 0            ? "--margin"
                                : !options.value_column.empty() ? "--color column:NAME"
                                                                : nullptr;
  if (of_planes != nullptr) refuse_in_volumes(of_planes);
  if (options.domain) throw UsageError("--domain is for planes; the periods of a volume are its --bounds");
  const char* const of_data = options.bounds                        ? "--bounds"
                              : options.snap == Snap::to_pixels     ? "--snap"
                              : options.snap == Snap::none          ? "--no-snap"
                              : options.units == MeasureUnits::data ? "--units data"
                                                                    : nullptr;
  if (of_data != nullptr && options.random > 0) {
    throw UsageError(std::string(of_data) + " needs --points or --trajectory");
  }
  if (options.bounds && !options.z_bounds) {
    throw UsageError("the --bounds of a volume are six numbers: X0,Y0,Z0,X1,Y1,Z1");
  }
  if (options.columns && options.columns->z.empty()) {
    throw UsageError("the --columns of a volume are three: X,Y,Z");
  }
}

Input read_volume_input(const SeedOptions& options) {
  check_volume_options(options);
  if (options.random > 0) return input_at_random(options);
  if (!options.points.empty()) return input_from_points(options);
  const VolumeFrames frames(options, options.frame);
  return input_from(frames.view(), frames.points(), frames.ids(), options.snapping(), frames.timestep());
}

}  // namespace vorocl::command
