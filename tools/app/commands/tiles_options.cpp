#include "app/commands/tiles_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/options/option_groups.hpp"
#include "app/terminal/console.hpp"
#include "formats/files.hpp"
#include "formats/values.hpp"
#include "vorocl/version.hpp"

namespace vorocl::command {

namespace {

constexpr double million = 1e6;

/// "X0,Y0,X1,Y1" to the pixels from (X0, Y0) up to, and without, (X1, Y1).
std::optional<PlanePart> parse_part(const std::string& text) {
  const Error error("\"" + text + "\" must be X0,Y0,X1,Y1: four whole numbers with X0 < X1 and Y0 < Y1");
  std::vector<std::int64_t> values;
  for (const std::string_view part : parts_of(text, ',')) {
    const auto value = parse_number<std::int64_t>(part);
    if (!value || *value < 0) throw error;
    values.push_back(*value);
  }
  if (values.size() != 4 || values[0] >= values[2] || values[1] >= values[3]) throw error;
  return PlanePart{values[0], values[1], values[2] - values[0], values[3] - values[1]};
}

/// A plane that repeats has its parts in one period too.
void check_part(const char* axis, std::int64_t first, std::int64_t count, std::int64_t pixels) {
  if (count <= pixels && first <= pixels - count) return;
  throw Error(
      fmt::format("the part of the plane has {} pixels from {} = {} on; the plane has {} along that axis",
                  count, axis, first, pixels));
}

Window window_of(const TilesOptions& options) {
  const Grid plane = plane_of(options.seeds);
  if (!options.part) return plane;
  const PlanePart& part = *options.part;
  check_part("x", part.x, part.width, plane.width());
  check_part("y", part.y, part.height, plane.height());
  return {plane, part.x, part.y, part.width, part.height};
}

void check_options(const TilesOptions& options) {
  const PlaneWriterOptions& output = options.output;
  const std::vector<RequestedFile> files = requested_files(output);
  check_outputs(files, options.seeds);
  if (std::all_of(files.begin(), files.end(), [](const RequestedFile& file) { return file.path.empty(); })) {
    throw UsageError(
        "nothing to write: give at least one of --labels, --distance, -o, --cells and --adjacency");
  }
  check_plane_options(options.seeds);
  if (!options.seeds.keep.empty() && output.cells.empty()) throw UsageError("--keep is for --cells");
  const bool has_tiff = is_tiff_name(output.labels) || is_tiff_name(output.distances);
  if (options.crs && !(has_tiff && options.seeds.bounds)) {
    throw UsageError("--crs is for --labels or --distance FILE.tif, with --bounds in its coordinates");
  }
}

}  // namespace

void add_tiles(CommandLine& line, const std::function<void(const TilesOptions&)>& run) {
  const auto options = std::make_shared<TilesOptions>();
  Command command =
      line.add("tiles", "Make the diagram of a plane that is larger than a device, tile by tile");
  add_seed_options(command, options->seeds, 1, false, Makes::tiles);
  add_snap_option(command, options->seeds);
  add_units_option(command, options->seeds, "points");
  command.begin_section("Tiles");
  add_metric_option(command, options->metric);
  command.add("--tile", options->side, "Side of the tiles in pixels; of a .tif file a multiple of 16")
      .value_name("N")
      .in_range(1, Size::max_side)
      .default_text("what a quarter of the device's memory holds, 4096 at most, 2048 of a mask");
  command
      .add_parsed("--only", options->part, parse_part,
                  "Make a part of the plane: the pixels from (X0, Y0) up to, and without, (X1, Y1)")
      .value_name("X0,Y0,X1,Y1");
  command.begin_section(files_to_write);
  command
      .add("--labels", options->output.labels,
           "Labels: .npy (uint32), .zarr (version 2, a chunk per tile) or .tif (BigTIFF, GeoTIFF)")
      .value_name("FILE");
  command
      .add("--distance", options->output.distances,
           "Distances to the nearest seed, in files as labels: float32")
      .value_name("FILE");
  add_keep_option(command, options->seeds);
  add_crs_option(command, options->crs, "a .tif file says");
  command
      .add("-o", options->output.picture,
           "Picture to write, of at most 4096 pixels a side: .png, .jpg, .bmp or .tif")
      .value_name("PICTURE");
  command.add("--cells", options->output.cells, "Tables of cells that have pixels, one row per cell: .csv")
      .value_name("FILE");
  command.add("--adjacency", options->output.adjacency, "Tables of cells that touch, one row per pair: .csv")
      .value_name("FILE");
  command.add("--resume", options->output.resume,
              "Keep a journal, and go on from the one that an interrupted run has left");
  add_device_option(command, options->device);
  add_json_option(command, options->json);
  command.set_work([command, options, run] {
    options->run =
        "version " VOROCL_VERSION "\n" + command.given({"--resume", "--device", "--json", "--tile"});
    for (std::string* const path : {&options->output.labels, &options->output.distances})
      *path = plane_path(*path);
    check_options(*options);
    run(*options);
  });
}

bool is_tiff_name(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".tif" || extension == ".tiff";
}

Tiling tiling_of(const TilesOptions& options, const Device& device) {
  constexpr int most_of_masks = 2048;  // which may have a seed on each pixel
  const bool has_mask = !options.seeds.mask.empty();
  const int usual = std::min(default_tile_side(device), has_mask ? most_of_masks : Size::max_side);
  const int side = options.side > 0 ? options.side : usual;
  const Tiling tiling(window_of(options), side);
  constexpr std::uint64_t most = std::uint64_t{1} << 24;
  if (tiling.count() > most) {
    throw Error(
        fmt::format("there are {} tiles of {} x {}, and one run can make {}; give --only, or a larger --tile",
                    tiling.count(), side, side, most));
  }
  return tiling;
}

std::string run_of(const TilesOptions& options, const Tiling& tiling) {
  return options.run + fmt::format("tiles of {}\n", tiling.side());
}

std::optional<Georeference> georeference(const TilesOptions& options, const Tiling& tiling,
                                         const MaskRows* mask) {
  const std::optional<Bounds>& bounds = options.seeds.bounds;
  const Window& window = tiling.window();
  if (mask != nullptr) return georeference_of(mask->geotags(), window.x(), window.y());
  if (!bounds) return std::nullopt;
  const Grid& plane = window.grid();
  const bool y_up = points_up(options.seeds);
  const auto between = [](double low, double high, std::int64_t pixel, std::int64_t pixels) {
    return pixel == pixels ? high
                           : low + (high - low) * (static_cast<double>(pixel) / static_cast<double>(pixels));
  };
  const std::int64_t bottom = window.y() + window.height(), height = plane.height();
  return Georeference{{between(bounds->x0, bounds->x1, window.x(), plane.width()),
                       between(bounds->y0, bounds->y1, y_up ? height - bottom : window.y(), height),
                       between(bounds->x0, bounds->x1, window.x() + window.width(), plane.width()),
                       between(bounds->y0, bounds->y1, y_up ? height - window.y() : bottom, height)},
                      y_up,
                      options.crs};
}

void make_tiles(const TilesOptions& options, const Device& device, const SeedSource& seeds,
                const Tiling& tiling, const NextTile& next, const Units& units, PlaneCells* cells,
                const std::function<void(const TileLabels&)>& write) {
  std::vector<float> distances;
  const auto in_units = [&](TileLabels tile) {
    if (tile.distances != nullptr) {
      distances = units.lengths({tile.distances, tile.distances + tile.tile.pixels()});
      tile.distances = distances.data();
    }
    write(tile);
  };
  exact_tiles(device, seeds, tiling, next, in_units,
              {options.metric, cells, !options.output.distances.empty()});
}

void print_result(const TilesOptions& options, const Device& device, const PlaneFacts& seeds,
                  const Tiling& tiling, const TilesCourse& course) {
  const Window& window = tiling.window();
  const Grid& plane = window.grid();
  const double rate =
      course.milliseconds > 0 ? 1e3 * static_cast<double>(course.pixels) / course.milliseconds : 0;
  if (options.json) {
    Json result = {
        {"method", "exact"},
        {"metric", to_string(options.metric)},
        {"device", device.name()},
        {"width", plane.width()},
        {"height", plane.height()},
        {"periodic", to_string(plane.periodic())},
        {"part",
         Json{{"x", window.x()}, {"y", window.y()}, {"width", window.width()}, {"height", window.height()}}},
        {"area_unit", seeds.units.of_area()},
        {"length_unit", seeds.units.of_length()},
        {"seeds", seeds.seeds},
        {"tile", tiling.side()},
        {"tiles", course.tiles}};
    if (options.output.resume) result["made_before"] = course.made_before;
    if (course.processes > 1) result["processes"] = course.processes;
    result["milliseconds"] = course.milliseconds;
    result["writing_milliseconds"] = course.writing;
    result["pixels_per_second"] = rate;
    print_json(result);
    return;
  }
  const TileShape tile = tile_shape(tiling);
  print("exact: {} on {} x {} pixels, {} of {} x {}, on {}\n", counted(seeds.seeds, "seed"), plane.width(),
        plane.height(), counted(course.tiles, "tile"), tile.width, tile.height, device.name());
  if (options.part) {
    print("of these pixels {} x {}, from ({}, {}) on\n", window.width(), window.height(), window.x(),
          window.y());
  }
  if (course.made_before > 0) print("made before: {}\n", counted(course.made_before, "tile"));
  if (course.processes > 1) print("processes: {}\n", course.processes);
  print("{:.3g} million pixels per second, {:.0f} % of the time for writing\n", rate / million,
        course.milliseconds > 0 ? 100 * course.writing / course.milliseconds : 0);
  print_written(requested_files(options.output));
}

}  // namespace vorocl::command
