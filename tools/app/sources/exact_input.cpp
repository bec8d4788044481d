#include "app/sources/exact_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include "app/sources/bounds.hpp"
#include "app/sources/volume_input.hpp"
#include "app/terminal/console.hpp"
#include "formats/files.hpp"
#include "formats/npy.hpp"
#include "formats/trajectory/trajectory.hpp"

namespace vorocl::command {

namespace {

/// Whether a file has places of a volume, or a box that is tilted in z. What can be read once alone has none.
bool has_depth(const SeedOptions& options) {
  std::error_code code;
  const std::string& path = options.points + options.trajectory;  // one of these
  if (!std::filesystem::is_regular_file(path, code)) return false;
  Frame frame;
  if (!options.trajectory.empty()) {
    return open_trajectory(path, "", Wanted::depth)->next(frame) &&
           (frame.z_span > 0 || (frame.box && (frame.box->xz != 0 || frame.box->yz != 0)));
  }
  return extension_of(path) == ".npy" && holds_points_of_volume(path);
}

/// See read_exact_input(). Checks the options.
bool is_volume(const SeedOptions& options) {
  const bool is_told = options.is_volume() || (options.bounds && options.bounds->is_box()) ||
                       (options.periodic && has_z(*options.periodic)) ||
                       (options.columns && !options.columns->z.empty());
  const bool may_be_told = !options.bounds && !options.columns && !options.domain && options.mask.empty();
  const bool is_volume = is_told || (may_be_told && has_depth(options));
  is_volume ? check_volume_options(options) : check_seed_options(options, false);
  return is_volume;
}

/// A size says that there is a volume, and nothing of voxels, but of seeds in pixels.
SeedOptions without_voxels(SeedOptions options) {
  if (options.random == 0) options.size.reset();
  return options;
}

/// `repeats` is what does along the periodic axes, with a tilt: bounds that are given must be the same there.
Grid grid_of(const SeedOptions& options, const Bounds& repeats, Axes periodic, const char* name,
             double tilt = 0) {
  const Bounds& shown = options.bounds ? *options.bounds : repeats;
  const bool parts_x = has_x(periodic) && (shown.x0 != repeats.x0 || shown.x1 != repeats.x1);
  const bool parts_y = has_y(periodic) && (shown.y0 != repeats.y0 || shown.y1 != repeats.y1);
  if (parts_x || parts_y) {
    throw Error(fmt::format("--exact cuts whole periods: along a periodic axis --bounds {} must be {}, {}",
                            to_string(shown), name, to_string(repeats)));
  }
  check_bounds(shown, periodic);
  const bool closed =
      (!options.bounds && !options.domain) || options.outside.value_or(Outside::count) == Outside::refuse;
  return Grid(data_axis(1, shown.x0, shown.x1, has_x(periodic), closed),
              data_axis(1, shown.y0, shown.y1, has_y(periodic), closed))
      .tilted(tilt);
}

Input input_of(const SeedOptions& options, const std::string& file, const Grid& grid,
               std::vector<Point> points, std::vector<std::uint32_t> ids, const ColumnValues& values) {
  const Outside outside = grid.is_volume() ? Outside::refuse : options.outside.value_or(Outside::count);
  return {{Size(1, 1), grid},
          [file, grid, points = std::move(points), weights = weights_of(options, values, ids),
           outside](const Device& device) {
            try {
              return Seeds(device, grid, weighted(points, weights), {outside});
            } catch (const BadPoint& error) {
              throw Error(file + ": " + error.what());
            }
          },
          std::move(ids)};
}

void note_points(const SeedOptions& options, const Grid& grid, const std::vector<Point>& points) {
  if (options.outside == Outside::refuse) return;
  const auto is_outside = [&](const Point& point) {
    return !grid.x().covers(point.x) || !grid.y().covers(point.y);
  };
  note_outside(static_cast<std::size_t>(std::count_if(points.begin(), points.end(), is_outside)),
               points.size(), {grid.x().from(), grid.y().from(), grid.x().to(), grid.y().to()});
}

Input exact_input_from_points(const SeedOptions& options) {
  CsvPoints read = read_points(options);
  std::vector<Point>& points = read.points;
  try {
    const Bounds repeats = options.domain   ? *options.domain
                           : options.bounds ? *options.bounds
                                            : widened(bounding_box(points), options.margin);
    const Grid grid = grid_of(options, repeats, options.periodic.value_or(Axes::none), "the domain");
    note_points(options, grid, points);
    Input input =
        input_of(options, options.points, grid, std::move(points), std::move(read.ids), read.values);
    input.kept = {std::move(read.kept_names), std::move(read.kept)};
    input.values = std::move(read.values);
    return input;
  } catch (const Error& error) {
    throw Error(options.points + ": " + error.what());
  }
}

Grid grid_of_plane(const SeedOptions& options, const Frame& frame) {
  const std::optional<Bounds> filled = bounds_of(frame);
  if (!filled && !options.bounds) throw Error("it has neither a box nor particles: give --bounds");
  const Axes periodic = options.periodic.value_or(frame.box ? periodic_axes(*frame.box, false) : Axes::none);
  const double tilt = frame.box ? frame.box->tilt : 0;
  if (tilt != 0 && periodic != Axes::xy) {
    throw Error(
        "the box is tilted: --exact cuts it as periodic in x and y, so leave --periodic out, or give "
        "--periodic xy");
  }
  return grid_of(options, filled ? *filled : *options.bounds, periodic, "the box", tilt);
}

Input exact_input_from_trajectory(const SeedOptions& options) {
  ExactFrames frames(options);
  frames.go_to(options.frame);
  return frames.take();
}

}  // namespace

ExactFrames::ExactFrames(const SeedOptions& options)
    : options_(without_voxels(options)),
      is_volume_(command::is_volume(options)),
      reader_(options_, is_volume_) {}

std::optional<Input> ExactFrames::next() {
  if (!skip()) return std::nullopt;
  reader_.read_ahead();
  return take();
}

Input ExactFrames::take() {
  Frame& frame = reader_.frame();
  std::vector<Point> points = is_volume_ ? points_of(frame) : frame.positions;
  try {
    const Grid grid = is_volume_ ? grid_of_frame(options_, frame, points) : grid_of_plane(options_, frame);
    if (std::exchange(is_first_, false)) {
      note_of_frame(frame, reader_.number(), options_.periodic, is_volume_);
      if (!is_volume_) note_points(options_, grid, points);
    }
    Input input =
        input_of(options_, options_.trajectory, grid, std::move(points), std::move(frame.ids), frame.values);
    input.timestep = frame.timestep;
    input.values = std::move(frame.values);
    return input;
  } catch (const Error& error) {
    throw reader_.error(error);
  }
}

Input read_exact_input(const SeedOptions& options) {
  if (!options.trajectory.empty()) return exact_input_from_trajectory(options);
  if (is_volume(options)) return read_volume_input(without_voxels(options));
  if (!options.points.empty()) return exact_input_from_points(options);
  Input input = read_input(options);
  input.place = [place = std::move(input.place)](const Device& device) {
    const Seeds pixels = place(device);
    return Seeds(device, pixels.grid(), pixels.read_pixels());
  };
  return input;
}

}  // namespace vorocl::command
