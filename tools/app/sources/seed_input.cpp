#include "app/sources/seed_input.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>
#include <vector>

#include "app/options/options.hpp"
#include "app/sources/trajectory_seeds.hpp"
#include "app/terminal/usage_error.hpp"
#include "formats/files.hpp"
#include "formats/mask.hpp"
#include "formats/npy.hpp"
#include "formats/numbers.hpp"

namespace vorocl::command {

namespace {

CsvPoints read_points(const SeedOptions& options) {
  check_extension(options.points, {".csv", ".npy"});
  if (extension_of(options.points) == ".csv") {
    return read_csv(options.points, options.columns, options.value_column);
  }
  if (options.columns) throw UsageError("--columns is for .csv files");
  if (!options.value_column.empty())
    throw UsageError("--color column:NAME is for .csv files and trajectories");
  return {read_npy_points(options.points), {}};
}

Input input_from_points(const SeedOptions& options) {
  if (!options.size && options.width == 0)
    throw UsageError("--size WxH or --width W is required with --points");
  const auto [points, values] = read_points(options);
  try {
    const Bounds bounds = options.bounds ? *options.bounds : bounding_box(points);
    const Grid grid = options.size ? *options.size : grid_of_width(bounds, options.width);
    const std::vector<Point> pixels = to_pixels(points, bounds, grid, options.y_up);
    warn_of_scales(bounds, grid);
    return {grid, [grid, pixels](const Device& device) { return Seeds(device, grid, pixels); }, {}, values};
  } catch (const Error& error) {
    throw Error(options.points + ": " + error.what());
  }
}

Input input_from_mask(const SeedOptions& options) {
  const Mask mask = read_mask(options.mask);
  const Grid grid = mask.grid;
  if (options.size && *options.size != grid) {
    throw Error(fmt::format("{} is {} x {} pixels and --size says {} x {}; the mask alone is enough",
                            options.mask, grid.width(), grid.height(), options.size->width(),
                            options.size->height()));
  }
  return {grid,
          [mask](const Device& device) { return Seeds::from_mask(device, mask.grid, mask.pixels); },
          {},
          {}};
}

Input input_at_random(const SeedOptions& options) {
  if (!options.size) throw UsageError("--size WxH is required with --random");
  return {*options.size,
          [options](const Device& device) {
            return Seeds::random(device, *options.size, options.random, options.rng_seed);
          },
          {},
          {}};
}

Input input_from_trajectory(const SeedOptions& options) {
  const TrajectorySeeds particles(options, options.frame);
  const Grid grid = particles.grid();
  return {grid,
          [grid, points = particles.points()](const Device& device) { return Seeds(device, grid, points); },
          particles.ids(), particles.values()};
}

/// What no parser can say: an option that goes with either of two others.
void check_needs(const SeedOptions& options) {
  if (!options.points.empty() || !options.trajectory.empty()) return;
  const char* const given = options.bounds                  ? "--bounds"
                            : options.width != 0            ? "--width"
                            : options.y_up                  ? "--y-up"
                            : !options.value_column.empty() ? "--color column:NAME"
                                                            : nullptr;
  if (given != nullptr) throw UsageError(std::string(given) + " needs --points or --trajectory");
}

}  // namespace

void add_seed_options(CLI::App& app, SeedOptions& options, bool move) {
  CLI::App* const source = app.add_option_group("Seeds", "Where the seeds come from (one of these)");
  source->require_option(1);
  constexpr std::size_t most_seeds = Grid::max_pixels;
  CLI::Option* const random =
      source->add_option("--random", options.random, "N uniformly random pixels")->type_name("N");
  random->check(CLI::Range(std::size_t{1}, most_seeds));
  CLI::Option* const points =
      source->add_option("--points", options.points, "Points of a .csv or .npy file, in data units");
  points->type_name("FILE");
  CLI::Option* const mask =
      source->add_option("--mask", options.mask, "Non-zero pixels of an image, numbered in row-major order");
  mask->type_name("FILE");
  CLI::Option* const trajectory = source->add_option("--trajectory", options.trajectory,
                                                     "Particles of a LAMMPS text dump or an XYZ file");
  trajectory->type_name("FILE");

  CLI::Option* const rng_seed = app.add_option("--rng-seed", options.rng_seed, "Seed of the random numbers");
  rng_seed->type_name("R")->capture_default_str();
  move ? rng_seed->excludes(trajectory) : rng_seed->needs(random);
  add_parsed(app, "--columns", options.columns, parse_columns,
             "Columns of the CSV file, by name or by index from 0; else x and y, or the first two")
      ->type_name("X,Y")
      ->needs(points);
  CLI::Option* const size =
      add_parsed(app, "--size", options.size, parse_size, "Pixels of the grid; with --mask the image's");
  size->type_name("WxH");
  app.add_option("--width", options.width,
                 "Instead of --size: the height follows from the bounds, pixels are square")
      ->type_name("W")
      ->check(CLI::Range(1, Grid::max_side))
      ->excludes(size);
  add_parsed(
      app, "--bounds", options.bounds, parse_bounds,
      "Rectangle in data units that the grid shows; else each frame's own box, or the bounding box of the "
      "points (of the first frame)")
      ->type_name("X0,Y0,X1,Y1");
  app.add_flag("--y-up", options.y_up, "The data's y axis points up");
}

void add_frame_option(CLI::App& app, SeedOptions& options) {
  app.add_option("--frame", options.frame, "Frame of the trajectory, from 0")
      ->type_name("K")
      ->check(CLI::Range(0, std::numeric_limits<int>::max() - 1))
      ->capture_default_str()
      ->needs("--trajectory");
}

Grid parse_size(const std::string& text) {
  const auto x = text.find('x');
  const auto width = parse_number<std::int64_t>(text.substr(0, x));
  const auto height = x == std::string::npos ? std::nullopt : parse_number<std::int64_t>(text.substr(x + 1));
  if (!width || !height) throw Error("\"" + text + "\" must be WxH, such as 1440x720");
  return Grid(*width, *height);
}

Input read_input(const SeedOptions& options) {
  check_needs(options);
  if (!options.trajectory.empty()) return input_from_trajectory(options);
  if (options.random > 0) return input_at_random(options);
  return options.mask.empty() ? input_from_points(options) : input_from_mask(options);
}

}  // namespace vorocl::command
