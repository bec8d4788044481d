// vorocl tiles: the exact diagram of a plane that may be far larger than a device, tile by tile.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/commands/finish_at_end.hpp"
#include "app/options/common_options.hpp"
#include "app/options/seed_options.hpp"
#include "app/outputs/plane_writer.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/interruption.hpp"
#include "app/terminal/json.hpp"
#include "app/terminal/progress.hpp"
#include "app/terminal/usage_error.hpp"
#include "formats/files.hpp"
#include "formats/numbers.hpp"
#include "studies/metric_name.hpp"
#include "vorocl/version.hpp"

namespace vorocl::command {

namespace {

constexpr double million = 1e6;

struct TilesOptions {
  PlaneInputOptions input;
  int side = 0;  // of tiles; 0: the device's
  std::optional<PlaneRectangle> part;
  Metric metric = Metric::euclidean;
  PlaneWriterOptions output;
  std::optional<Crs> crs;
  std::string device;
  bool json = false;
  std::string run;  // in lines, what a run must share with the one that it goes on with
};

/// "X0,Y0,X1,Y1" to the pixels from (X0, Y0) up to, and without, (X1, Y1).
std::optional<PlaneRectangle> parse_part(const std::string& text) {
  const Error error("\"" + text + "\" must be X0,Y0,X1,Y1: four whole numbers with X0 < X1 and Y0 < Y1");
  std::vector<std::int64_t> values;
  for (std::size_t begin = 0; begin <= text.size();) {
    const auto comma = std::min(text.find(',', begin), text.size());
    const auto value = parse_number<std::int64_t>(std::string_view(text).substr(begin, comma - begin));
    if (!value || *value < 0) throw error;
    values.push_back(*value);
    begin = comma + 1;
  }
  if (values.size() != 4 || values[0] >= values[2] || values[1] >= values[3]) throw error;
  return PlaneRectangle{values[0], values[1], values[2] - values[0], values[3] - values[1]};
}

/// Where the part lies; none without bounds.
std::optional<Georeference> georeference(const TilesOptions& options, const Tiling& tiling) {
  const std::optional<Bounds>& bounds = options.input.seeds.bounds;
  if (!bounds) return std::nullopt;
  const Plane& plane = tiling.plane();
  const PlaneRectangle& part = tiling.part();
  const bool y_up = points_up(options.input.seeds);
  const auto between = [](double low, double high, std::int64_t pixel, std::int64_t pixels) {
    return pixel == pixels ? high
                           : low + (high - low) * (static_cast<double>(pixel) / static_cast<double>(pixels));
  };
  const std::int64_t bottom = part.y + part.height, height = plane.height();
  return Georeference{{between(bounds->x0, bounds->x1, part.x, plane.width()),
                       between(bounds->y0, bounds->y1, y_up ? height - bottom : part.y, height),
                       between(bounds->x0, bounds->x1, part.x + part.width, plane.width()),
                       between(bounds->y0, bounds->y1, y_up ? height - part.y : bottom, height)},
                      y_up,
                      options.crs};
}

void check_options(const TilesOptions& options) {
  const PlaneWriterOptions& output = options.output;
  const std::vector<RequestedFile> files = requested_files(output);
  check_outputs(files);
  if (std::all_of(files.begin(), files.end(), [](const RequestedFile& file) { return file.path.empty(); })) {
    throw UsageError("nothing to write: give at least one of --labels, -o, --cells and --adjacency");
  }
  check_plane_options(options.input);
  const std::string extension = extension_of(output.labels);
  const bool is_tiff = extension == ".tif" || extension == ".tiff";
  if (options.crs && !(is_tiff && options.input.seeds.bounds)) {
    throw UsageError("--crs is for --labels FILE.tif, with --bounds in its coordinates");
  }
}

/// How far a run has come.
struct Course {
  std::uint64_t tiles = 0;   // that are complete
  std::uint64_t pixels = 0;  // of those that this run has made
  double milliseconds = 0;   // of the tiles that this run has made, with the time to write them ...
  double writing = 0;        // ... which is this
};

/// Makes the tiles that are still to be made. Throws Error if a signal comes before all are.
Course make_tiles(const TilesOptions& options, const Device& device, const PlaneSeeds& seeds,
                  const Tiling& tiling, PlaneWriter& writer, const Interruption& interruption) {
  Course course;
  course.tiles = writer.made_before();
  const auto share = [&] { return static_cast<double>(course.tiles) / static_cast<double>(tiling.count()); };
  const double done_before = share();
  Progress progress({"tiles", "megapixels"});
  const Stopwatch stopwatch;
  const auto write = [&](const TileLabels& tile) {
    const Stopwatch writing;
    writer.add(tile);
    course.writing += writing.milliseconds();
    course.pixels +=
        static_cast<std::uint64_t>(tile.tile.width) * static_cast<std::uint64_t>(tile.tile.height);
    ++course.tiles;
    progress.show({course.tiles, share(), done_before, static_cast<double>(course.pixels) / million});
    if (!interruption.came()) return;
    writer.checkpoint();
    throw Error("interrupted");
  };
  try {
    exact_tiles(device, seeds, tiling, [&] { return writer.next(); }, write,
                {options.metric, writer.cells()});
  } catch (const std::exception& error) {  // ours, or out of memory
    throw Error(message_of(error) + "; " + writer.kept());
  }
  course.milliseconds = stopwatch.milliseconds();
  return course;
}

void print_result(const TilesOptions& options, const Device& device, const PlaneInput& input,
                  const Tiling& tiling, const PlaneWriter& writer, const Course& course) {
  const Plane& plane = tiling.plane();
  const PlaneRectangle& part = tiling.part();
  const double rate =
      course.milliseconds > 0 ? 1e3 * static_cast<double>(course.pixels) / course.milliseconds : 0;
  if (options.json) {
    Json::Members result = {
        {"method", "exact"},
        {"metric", to_string(options.metric)},
        {"device", device.name()},
        {"width", plane.width()},
        {"height", plane.height()},
        {"periodic", to_string(plane.periodic())},
        {"part", Json::Members{{"x", part.x}, {"y", part.y}, {"width", part.width}, {"height", part.height}}},
        {"area_unit", input.units.of_area()},
        {"length_unit", input.units.of_length()},
        {"seeds", input.seeds.size()},
        {"tile", tiling.side()},
        {"tiles", course.tiles}};
    if (options.output.resume) result.emplace_back("made_before", writer.made_before());
    result.emplace_back("milliseconds", course.milliseconds);
    result.emplace_back("writing_milliseconds", course.writing);
    result.emplace_back("pixels_per_second", rate);
    print_json(result);
    return;
  }
  print("exact: {} seeds on {} x {} pixels, {} tiles of {} x {}, on {}\n", input.seeds.size(), plane.width(),
        plane.height(), course.tiles, tiling.side(), tiling.side(), device.name());
  if (options.part) {
    print("of these pixels {} x {}, from ({}, {}) on\n", part.width, part.height, part.x, part.y);
  }
  if (writer.made_before() > 0) print("made before: {} tiles\n", writer.made_before());
  print("{:.1f} million pixels per second, {:.0f} % of the time for writing\n", rate / million,
        course.milliseconds > 0 ? 100 * course.writing / course.milliseconds : 0);
  print_written(requested_files(options.output));
}

void run(const TilesOptions& options) {
  const Interruption interruption;  // before there are files
  check_options(options);
  const Plane plane = options.input.plane();
  const Device device = Device::select(options.device);
  const FinishAtEnd finish(device);
  const int side = options.side > 0 ? options.side : default_tile_side(device);
  const Tiling tiling = options.part ? Tiling(plane, side, *options.part) : Tiling(plane, side);
  PlaneWriter writer(options.output, tiling, georeference(options, tiling),
                     options.run + fmt::format("tiles of {}\n", side));
  const PlaneInput input = read_plane_input(options.input, [&] { return interruption.came(); });
  input.seeds.sort();
  writer.begin(input.name);
  const Course course = make_tiles(options, device, input.seeds, tiling, writer, interruption);
  writer.finish(input.units);
  print_result(options, device, input, tiling, writer, course);
}

}  // namespace

void add_tiles(CommandLine& line) {
  const auto options = std::make_shared<TilesOptions>();
  Command command =
      line.add("tiles", "Make the diagram of a plane that is larger than a device, tile by tile");
  add_plane_options(command, options->input);
  add_units_option(command, options->input.seeds);
  add_metric_option(command, options->metric);
  command.add("--tile", options->side, "Side of the tiles in pixels; of a .tif file a multiple of 16")
      .value_name("N")
      .in_range(1, Grid::max_side)
      .default_text("what a quarter of the device's memory holds, 4096 at most");
  command
      .add_parsed("--only", options->part, parse_part,
                  "Make a part of the plane alone: the pixels from (X0, Y0) up to, and without, (X1, Y1)")
      .value_name("X0,Y0,X1,Y1");
  command
      .add("--labels", options->output.labels,
           "Labels: a .npy file (uint32), a .zarr folder (Zarr version 2, a chunk per tile) or a .tif file "
           "(tiled BigTIFF; with --bounds a GeoTIFF)")
      .value_name("FILE");
  command
      .add_parsed("--crs", options->crs, parse_crs,
                  "Coordinate reference system of the bounds, which a .tif file says, such as EPSG:32632")
      .value_name("EPSG:N");
  command
      .add("-o", options->output.picture,
           "Picture of the whole to write, of 4096 pixels a side at most: .png, .jpg, .bmp or .tif")
      .value_name("PICTURE");
  command
      .add("--cells", options->output.cells,
           "A .csv file with one row per cell that has pixels: its area, centroid, extent, perimeter, "
           "neighbours")
      .value_name("FILE");
  command
      .add("--adjacency", options->output.adjacency,
           "A .csv file with one row per pair of cells that touch: their ids and the pixel edges they share")
      .value_name("FILE");
  command.add(
      "--resume", options->output.resume,
      "Go on where the same command, which was ended, has stopped: with the tiles that its outputs do "
      "not have yet. It needs --resume too");
  add_device_option(command, options->device);
  add_json_option(command, options->json);
  command.set_work([command, options] {
    options->run =
        "version " VOROCL_VERSION "\n" + command.given({"--resume", "--device", "--json", "--tile"});
    run(*options);
  });
}

}  // namespace vorocl::command
