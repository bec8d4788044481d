#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "app/options/option_groups.hpp"
#include "formats/files.hpp"
#include "formats/planes/geotiff.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

namespace {

/// What to write instead of the name of a file alone.
std::string option_for(const std::string& file, Makes makes) {
  const std::string extension = extension_of(file);
  const auto is_one_of = [&extension](const std::vector<std::string>& extensions) {
    return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
  };
  const char* const option = is_one_of({".csv", ".npy"})                                     ? "--points "
                             : is_one_of({".xyz", ".extxyz", ".lammpstrj", ".dump"})         ? "--trajectory "
                             : is_one_of({".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"}) ? "--mask "
                                                                                             : nullptr;
  if (option == nullptr || (makes == Makes::tiles && option == std::string_view("--trajectory "))) {
    return "\"" + file + "\" is neither an option nor the value of one";
  }
  return "\"" + file + "\" is no option; for its seeds write " + option + file;
}

Bounds parse_domain(const std::string& text) {
  if (std::count(text.begin(), text.end(), ',') == 5) {
    throw Error("\"" + text + "\" are six numbers; the periods of a volume are its --bounds");
  }
  return parse_bounds(text);
}

/// Throws Error if a diagram cannot have these sides.
void check_sides(std::int64_t width, std::int64_t height) {
  if (std::max(width, height) > Size::max_side) {
    throw Error(fmt::format(
        "{} pixels are more than the {} that a side of a diagram has at most; vorocl tiles makes larger ones",
        std::max(width, height), Size::max_side));
  }
  Size(width, height);
}

std::optional<double> parse_threshold(const std::string& text) {
  const auto threshold = parse_number<double>(text);
  if (!threshold || !std::isfinite(*threshold)) throw Error("\"" + text + "\" is no number");
  return threshold;
}

int parse_width(const std::string& text) {
  const auto width = parse_number<std::int64_t>(text);
  if (!width) throw Error("\"" + text + "\" is no whole number");
  check_sides(*width, 1);
  return static_cast<int>(*width);
}

void add_mask_option(Command& command, Command& source, SeedOptions& options) {
  const Option mask = source.add("--mask", options.mask, "Pixels of an image or a .npy array that are not 0")
                          .value_name("FILE");
  command
      .add_parsed("--threshold", options.threshold, parse_threshold,
                  "Pixels of the mask that are greater than T, instead of those that are not 0")
      .value_name("T")
      .needs(mask);
}

}  // namespace

Grid parse_grid(const std::string& text, Makes makes) {
  std::vector<std::int64_t> sides;
  bool is_good = true;
  for (const std::string_view part : parts_of(text, 'x')) {
    const auto side = parse_number<std::int64_t>(part);
    is_good = is_good && side;
    sides.push_back(side.value_or(0));
  }
  const bool volumes = makes == Makes::volumes_too, has_depth = sides.size() == 3;
  if (has_depth && !volumes) throw Error(volumes_are_for);
  if (!is_good || (sides.size() != 2 && !has_depth)) {
    throw Error("\"" + text + "\" must be WxH, such as 1440x720" +
                (volumes ? ", or WxHxD, such as 256x256x256" : ""));
  }
  if (has_depth && (sides[2] < 2 || sides[2] > Window::max_side_of_volume)) {
    throw Error(fmt::format("the depth is {}; it must be from 2 to {} voxels; --size WxH makes a plane",
                            sides[2], Window::max_side_of_volume));
  }
  const char* const names[] = {"width", "height"};
  for (std::size_t axis = 0; axis < 2 && makes == Makes::tiles; ++axis) {
    if (sides[axis] >= 1 && sides[axis] <= Axis::max_pixels) continue;
    throw Error(fmt::format("the plane's {} is {}; it must be from 1 to {} pixels", names[axis], sides[axis],
                            Axis::max_pixels));
  }
  if (makes != Makes::tiles) check_sides(sides[0], sides[1]);
  return {sides[0], sides[1], has_depth ? sides[2] : 1};
}

void add_seed_options(Command& command, SeedOptions& options, std::size_t least, bool move, Makes makes) {
  const bool volumes = makes == Makes::volumes_too, tiles = makes == Makes::tiles;
  const std::string grid = tiles ? "plane" : "grid";
  Command source = command.add_group("Seeds", "Seeds, from one of these", least, 1);
  command.begin_section(seed_files);
  if (least > 0) command.refuse_words([makes](const std::string& word) { return option_for(word, makes); });
  const std::size_t most_seeds = tiles ? no_label - 1 : Window::max_pixels;
  const Option random = source.add("--random", options.random, "N uniformly random pixels")
                            .value_name("N")
                            .in_range(std::size_t{1}, most_seeds);
  const Option points = source.add("--points", options.points, "Points of a .csv or .npy file, in data units")
                            .value_name("FILE");
  add_mask_option(command, source, options);
  if (!tiles) {
    source.add("--trajectory", options.trajectory, "Particles of a LAMMPS text dump or an XYZ file")
        .value_name("FILE");
  }
  Option rng_seed = command.add("--rng-seed", options.rng_seed, "Seed of the random numbers")
                        .value_name("R")
                        .default_is_value();
  move ? rng_seed.excludes(command.option("--trajectory")) : rng_seed.needs(random);
  command
      .add_parsed(
          "--columns", options.columns,
          [volumes](const std::string& text) { return parse_columns(text, volumes); },
          "Columns of the CSV file, by name or by index from 0; else x and y, or lon and lat")
      .value_name(volumes ? "X,Y[,Z]" : "X,Y")
      .needs(points);
  const auto parse_mark = [](const std::string& mark) {
    if (mark == "." || mark == ",") return mark == ",";
    throw Error("\"" + mark + "\" must be a point or a comma");
  };
  command
      .add_parsed("--decimal", options.decimal_comma, parse_mark,
                  "Decimal mark of the CSV file; with a comma, fields have semicolons or tabs between them")
      .value_name("MARK")
      .default_text(".")
      .needs(points);
  command.begin_section(grid_section);
  const Option size =
      command
          .add_parsed(
              "--size", options.size,
              [makes](const std::string& text) { return std::optional(parse_grid(text, makes)); },
              "Width and height of the " + grid +
                  (volumes ? " in pixels; with a depth, of a volume" : " in pixels"))
          .value_name(volumes ? "WxH[xD]" : "WxH");
  if (!tiles) {
    command
        .add_parsed(
            "--width", options.width, parse_width,
            "Width of the grid in pixels: the height follows from the bounds, so that pixels are square")
        .value_name("W")
        .excludes(size);
  }
  const Option bounds =
      command
          .add_parsed(
              "--bounds", options.bounds,
              [volumes](const std::string& text) { return parse_bounds(text, volumes); },
              "Rectangle in data units that the " + grid + " shows; else what the points or the box fill" +
                  (volumes ? "; of a volume X0,Y0,Z0,X1,Y1,Z1" : ""))
          .value_name("X0,Y0,X1,Y1");
  const Option margin =
      command
          .add("--margin", options.margin,
               "How much farther than the points' box the picture goes, in percent of its longer side")
          .value_name("P")
          .default_is_value()
          .in_range(0.0, 1000.0)
          .needs(points)
          .excludes(bounds);
  const Choices<std::optional<Outside>> outside = {{"count", Outside::count}, {"refuse", Outside::refuse}};
  command
      .add_choice("--outside", options.outside, outside,
                  "Points outside the bounds own the pixels that are nearest to them, or are an error")
      .default_text("count");
  if (!tiles) {
    command
        .add_parsed("--domain", options.domain, parse_domain,
                    "Rectangle in data units that repeats along the periodic axes of points")
        .value_name("X0,Y0,X1,Y1")
        .default_text("the bounds")
        .excludes(margin);
  }
  Choices<std::optional<Axes>> axes;  // some of x and y or, where there are volumes, of all three
  for (int some = 0; some <= static_cast<int>(volumes ? Axes::xyz : Axes::xy); ++some)
    axes.emplace_back(to_string(static_cast<Axes>(some)), static_cast<Axes>(some));
  command
      .add_choice("--periodic", options.periodic, axes,
                  "Axes along which the plane repeats: distances go the shorter way round")
      .default_text(tiles ? "none" : "what a trajectory's file says, else none");
  const Option up = command.add(
      "--y-up", options.y_up,
      std::string("The data's y axis points up") + (tiles ? "" : " (the default for trajectories)"));
  command.add("--y-down", options.y_down, "The data's y axis points down (the default for points)")
      .excludes(up);
}

void add_snap_option(Command& command, SeedOptions& options, const std::string& judges) {
  const auto set = [&options](bool is_on) { options.snap = is_on ? Snap::to_pixels : Snap::none; };
  command.add_pair(
      "--snap,!--no-snap", set,
      judges.empty()
          ? "Move points to the centres of their pixels, as methods that flood always do"
          : judges + " by diagrams of the centres of the points' pixels (the default), or of the points");
}

Option add_crs_option(Command& command, std::optional<Crs>& crs, const std::string& about) {
  return command
      .add_parsed("--crs", crs, parse_crs,
                  "Coordinate reference system of the data, which " + about + ", such as EPSG:32632")
      .value_name("EPSG:N");
}

void check_crs(const SeedOptions& options, const std::vector<std::string>& paths) {
  const std::optional<Crs>& crs = options.crs;
  const auto says_it = [](const std::string& path) {
    const std::string extension = extension_of(path);
    return extension == ".tif" || extension == ".tiff" || extension == ".geojson" || extension == ".json";
  };
  if (crs && std::none_of(paths.begin(), paths.end(), says_it))
    throw UsageError("--crs is for .tif files of labels and distances, and for polygons as .geojson");
  if (crs && options.on_globe() && !crs->is_geographic) {
    throw UsageError(
        fmt::format("--crs EPSG:{} ({}) has no degrees, which --metric great-circle takes; longitudes and "
                    "latitudes have one such as EPSG:4326",
                    crs->code, crs->name));
  }
}

void add_keep_option(Command& command, SeedOptions& options) {
  const auto parse = [](const std::string& text) { return text; };
  command
      .add_list("--keep", options.keep, parse,
                "Columns of the CSV file that tables of cells and polygons have too; all: every named one")
      .value_name("COLUMN,...")
      .needs(command.option("--points"))
      .in_section(seed_files);
}

void add_weight_options(Command& command, SeedOptions& options) {
  const Option weights =
      command
          .add("--weights", options.weight_column,
               "Column with the weights of power (Laguerre, radical) cells, in squared units of the data")
          .value_name("COLUMN")
          .in_section(seed_files);
  const auto set = [&options](const std::string& column) {
    options.weight_column = column;
    options.are_radii = true;
  };
  command.add_text("--radius", set, "The same of a column with radii, whose squares are the weights")
      .value_name("COLUMN")
      .in_section(seed_files)
      .excludes(weights);
}

void add_frame_option(Command& command, SeedOptions& options) {
  command.add("--frame", options.frame, "Frame of the trajectory, from 0")
      .value_name("K")
      .in_range(0, std::numeric_limits<int>::max() - 1)
      .default_is_value()
      .needs(command.option("--trajectory"))
      .in_section(seed_files);
}

void add_max_distance_option(Command& command, std::optional<double>& distance) {
  const auto parse = [](const std::string& text) {
    const auto number = parse_number<double>(text);
    if (!number || !(*number >= 0)) throw Error("\"" + text + "\" is no distance of 0 or more");
    return number;
  };
  command
      .add_parsed("--max-distance", distance, parse,
                  "Leave pixels without a label that are farther than D from their seed")
      .value_name("D");
}

void add_units_option(Command& command, SeedOptions& options, const std::string& with_data) {
  const Choices<std::optional<MeasureUnits>> units = {{"data", MeasureUnits::data},
                                                      {"px", MeasureUnits::pixels}};
  command.add_choice("--units", options.units, units, "Units of positions, areas, lengths and distances")
      .default_text("data for " + with_data + ", else px");
}

namespace {

FrameRange parse_frames(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto number = [](const std::string& of) {
    const auto parsed = parse_number<int>(of);
    return parsed && *parsed >= 0 && *parsed < std::numeric_limits<int>::max() ? parsed : std::nullopt;
  };
  const auto first = colon == std::string::npos ? 0 : number(text.substr(0, colon));
  const std::string after = colon == std::string::npos ? text : text.substr(colon + 1);
  const auto last = number(after);
  const bool has_last = last && *last >= std::max(first.value_or(0), colon == std::string::npos ? 1 : 0);
  if (!first || (!has_last && (colon == std::string::npos || !after.empty()))) {
    throw Error(
        "\"" + text +
        "\" must be the last frame, at least 1, or the first and the last one, such as 100:200 or 100:");
  }
  return {*first, last};
}

}  // namespace

void add_motion_options(Command& command, MotionOptions& options) {
  command.begin_section("Frames");
  command
      .add_parsed("--frames", options.frames, parse_frames,
                  "Frames to make: 0 to L, or K to L; of a trajectory without L, all from K on")
      .value_name("[K:]L");
  const Option trajectory = command.option("--trajectory");
  command
      .add("--step-length", options.step_length,
           "Each seed moves at random, by up to D pixels along x and y per frame")
      .value_name("D")
      .in_range(0, Size::max_side)
      .excludes(trajectory);
  const Choices<Fit> fits = {{"all", Fit::all}, {"frame", Fit::frame}};
  command
      .add_choice("--fit", options.fit, fits,
                  "What the picture shows without --bounds: the boxes of all frames, or each frame's own")
      .default_text("all")
      .needs(trajectory)
      .excludes(command.option("--bounds"));
  const Choices<Border> borders = {{"reflect", Border::reflect}, {"periodic", Border::periodic}};
  command
      .add_choice("--border", options.border, borders,
                  "What seeds that move at random do at the border of the grid")
      .default_text("reflect")
      .excludes(trajectory);
}

}  // namespace vorocl::command
