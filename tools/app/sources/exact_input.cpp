#include "app/sources/exact_input.hpp"

#include <fmt/format.h>

#include <algorithm>
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

/// Whether a file has places of a volume. What can be read once alone has none.
bool has_depth(const SeedOptions& options) {
  std::error_code code;
  const std::string& path = options.points + options.trajectory;  // one of these
  if (!std::filesystem::is_regular_file(path, code)) return false;
  Frame frame;
  if (!options.trajectory.empty()) return open_trajectory(path)->next(frame) && frame.z_span > 0;
  return extension_of(path) == ".npy" && holds_points_of_volume(path);
}

/// See read_exact_input(). Checks the options.
bool is_volume(const SeedOptions& options) {
  const bool is_told = options.depth > 1 || options.z_bounds ||
                       (options.periodic && has_z(*options.periodic)) ||
                       (options.columns && !options.columns->z.empty());
  const bool may_be_told = !options.bounds && !options.columns && !options.domain && options.mask.empty();
  const bool is_volume = is_told || (may_be_told && has_depth(options));
  is_volume ? check_volume_options(options) : check_seed_options(options, false);
  return is_volume;
}

/// The ends of an axis: those of `shown`, or of what repeats.
Axis axis_of(double low, double high, bool is_periodic, bool is_closed) {
  const Axis axis(1, low, high);
  if (is_periodic) return axis.periodic();
  return is_closed ? axis.closed() : axis;
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
  return Grid(axis_of(shown.x0, shown.x1, has_x(periodic), closed),
              axis_of(shown.y0, shown.y1, has_y(periodic), closed))
      .tilted(tilt);
}

ExactInput input_of(const SeedOptions& options, const std::string& file, const Grid& grid,
                    std::vector<Point> points, std::vector<std::uint32_t> ids) {
  const Outside outside = grid.is_volume() ? Outside::refuse : options.outside.value_or(Outside::count);
  return {grid,
          [file, grid, points = std::move(points), outside](const Device& device) {
            try {
              return Seeds(device, grid, points, {outside});
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

ExactInput exact_input_from_points(const SeedOptions& options) {
  CsvPoints read = read_points(options);
  std::vector<Point>& points = read.points;
  try {
    const Bounds repeats = options.domain   ? *options.domain
                           : options.bounds ? *options.bounds
                                            : widened(bounding_box(points), options.margin);
    const Grid grid = grid_of(options, repeats, options.periodic.value_or(Axes::none), "the domain");
    note_points(options, grid, points);
    ExactInput input = input_of(options, options.points, grid, std::move(points), std::move(read.ids));
    input.kept = {std::move(read.kept_names), std::move(read.kept)};
    input.crs = options.crs;
    return input;
  } catch (const Error& error) {
    throw Error(options.points + ": " + error.what());
  }
}

ExactInput input_of_frame(const SeedOptions& options, Frame frame, int number, bool is_first) {
  const std::optional<Bounds> filled = bounds_of(frame);
  if (!filled && !options.bounds) {
    throw Error(fmt::format("frame {} has neither a box nor particles: give --bounds", number));
  }
  Axes periodic = options.periodic.value_or(Axes::none);
  if (frame.box && !options.periodic) periodic = axes_of(frame.box->periodic_x, frame.box->periodic_y);
  const double tilt = frame.box ? frame.box->tilt : 0;
  if (tilt != 0 && periodic != Axes::xy) {
    throw Error(
        fmt::format("the box of frame {} is tilted: --exact cuts it as periodic in x and y, so leave "
                    "--periodic out, or give --periodic xy",
                    number));
  }
  const Bounds repeats = filled ? *filled : *options.bounds;
  const Grid grid = grid_of(options, repeats, periodic, "the box", tilt);
  if (is_first) {
    note_of_frame(frame, number, options.periodic);
    note_points(options, grid, frame.positions);
  }
  ExactInput input =
      input_of(options, options.trajectory, grid, std::move(frame.positions), std::move(frame.ids));
  input.timestep = frame.timestep;
  return input;
}

ExactInput volume_of_frame(const SeedOptions& options, Frame frame, int number, bool is_first) {
  std::vector<Point> points = points_of(frame);
  try {
    const Grid grid = grid_of_frame(options, frame, points);
    if (is_first) note_of_volume(options, frame);
    ExactInput input = input_of(options, options.trajectory, grid, std::move(points), std::move(frame.ids));
    input.timestep = frame.timestep;
    return input;
  } catch (const Error& error) {
    throw Error(fmt::format("frame {}: {}", number, error.what()));
  }
}

ExactInput volume_without_voxels(SeedOptions options) {
  if (options.random == 0) options.size.reset();
  Input input = read_volume_input(options);
  return {input.view.window.grid(), std::move(input.place), std::move(input.ids), {}, std::move(input.kept)};
}

ExactInput exact_input_from_trajectory(const SeedOptions& options) {
  ExactFrames frames(options);
  for (int number = 0; number < options.frame && frames.skip();) ++number;
  if (std::optional<ExactInput> input = frames.next()) return std::move(*input);
  throw Error(fmt::format("{}: there is no frame {}; the last one of the file is {}, counted from 0",
                          options.trajectory, options.frame, frames.count() - 1));
}

}  // namespace

ExactFrames::ExactFrames(const SeedOptions& options)
    : options_(options),
      is_volume_(command::is_volume(options)),
      reader_(open_trajectory(options.trajectory, "", is_volume_ ? Wanted::volume : Wanted::all)) {}

bool ExactFrames::skip() {
  const bool is_there = reader_->next(frame_);
  count_ += is_there ? 1 : 0;
  return is_there;
}

std::optional<ExactInput> ExactFrames::next() {
  if (!skip()) return {};
  try {
    const auto input = is_volume_ ? volume_of_frame : input_of_frame;
    return input(options_, std::move(frame_), count_ - 1, std::exchange(is_first_, false));
  } catch (const Error& error) {
    throw Error(options_.trajectory + ": " + error.what());
  }
}

ExactInput read_exact_input(const SeedOptions& options) {
  if (!options.trajectory.empty()) return exact_input_from_trajectory(options);
  if (is_volume(options)) return volume_without_voxels(options);
  if (!options.points.empty()) return exact_input_from_points(options);
  const Input input = read_input(options);
  return {input.view.window.grid(),
          [place = input.place](const Device& device) {
            const Seeds pixels = place(device);
            return Seeds(device, pixels.grid(), pixels.read_pixels());
          },
          {}};
}

}  // namespace vorocl::command
