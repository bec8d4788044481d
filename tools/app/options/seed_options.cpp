#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "app/options/option_groups.hpp"
#include "formats/files.hpp"
#include "formats/planes/geotiff.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

namespace {

/// Whose option a file is that stands alone: of all sources of seeds, or of those that a plane can have.
enum class Sources { all, of_planes };

/// What to write instead of the name of a file alone.
std::string option_for(const std::string& file, Sources sources) {
  const std::string extension = extension_of(file);
  const auto is_one_of = [&extension](const std::vector<std::string>& extensions) {
    return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
  };
  const char* const option = is_one_of({".csv", ".npy"})                                     ? "--points "
                             : is_one_of({".xyz", ".extxyz", ".lammpstrj", ".dump"})         ? "--trajectory "
                             : is_one_of({".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"}) ? "--mask "
                                                                                             : nullptr;
  if (option == nullptr || (sources == Sources::of_planes && option == std::string_view("--trajectory "))) {
    return "\"" + file + "\" is neither an option nor the value of one";
  }
  return "\"" + file + "\" is no option; for its seeds write " + option + file;
}

Option add_random_option(Command& source, SeedOptions& options, std::size_t most) {
  return source.add("--random", options.random, "N uniformly random pixels")
      .value_name("N")
      .in_range(std::size_t{1}, most);
}

Option add_points_option(Command& source, SeedOptions& options) {
  return source.add("--points", options.points, "Points of a .csv or .npy file, in data units")
      .value_name("FILE");
}

Option add_rng_seed_option(Command& command, SeedOptions& options) {
  return command.add("--rng-seed", options.rng_seed, "Seed of the random numbers")
      .value_name("R")
      .default_is_value();
}

Option add_columns_option(Command& command, SeedOptions& options, bool volumes) {
  return command
      .add_parsed(
          "--columns", options.columns, volumes ? parse_columns_and_z : parse_columns,
          std::string("Columns of the CSV file, by name or by index from 0; else those that the header "
                      "names x and y, or lon and lat") +
              (volumes ? " (and z)" : "") + ", or the only " + (volumes ? "ones" : "two") +
              " where there is no header")
      .value_name(volumes ? "X,Y[,Z]" : "X,Y");
}

Option add_decimal_option(Command& command, SeedOptions& options) {
  const auto parse = [](const std::string& mark) {
    if (mark == "." || mark == ",") return mark == ",";
    throw Error("\"" + mark + "\" must be a point or a comma");
  };
  return command
      .add_parsed("--decimal", options.decimal_comma, parse,
                  "Decimal mark of the CSV file; with a comma, fields are separated by semicolons or tabs")
      .value_name("MARK")
      .default_text(".");
}

void add_margin_option(Command& command, SeedOptions& options) {
  command
      .add("--margin", options.margin,
           "Without --bounds: how much farther than the points' bounding box the picture goes all round, in "
           "percent "
           "of its longer side")
      .value_name("P")
      .default_is_value()
      .in_range(0.0, 1000.0)
      .needs("--points")
      .excludes(command.option("--bounds"));
}

void add_bounds_option(Command& command, SeedOptions& options, const std::string& about,
                       bool volumes = false) {
  const auto parse = [volumes](const std::string& text) { return parse_bounds(text, volumes); };
  command.add_parsed("--bounds", options.bounds, parse, about).value_name("X0,Y0,X1,Y1");
}

Bounds parse_domain(const std::string& text) {
  if (std::count(text.begin(), text.end(), ',') == 5) {
    throw Error("\"" + text + "\" are six numbers; the periods of a volume are its --bounds");
  }
  return parse_bounds(text);
}

void add_outside_option(Command& command, SeedOptions& options) {
  const Choices<std::optional<Outside>> outside = {{"count", Outside::count}, {"refuse", Outside::refuse}};
  command
      .add_choice(
          "--outside", options.outside, outside,
          "Points outside the bounds: they own the pixels that are nearest to them, or they are an error")
      .default_text("count");
}

/// Of some of the axes x and y or, where there are volumes, of all three.
Option add_periodic_option(Command& command, SeedOptions& options, bool volumes, const std::string& about) {
  Choices<std::optional<Axes>> axes;
  for (int some = 0; some <= static_cast<int>(volumes ? Axes::xyz : Axes::xy); ++some) {
    axes.emplace_back(to_string(static_cast<Axes>(some)), static_cast<Axes>(some));
  }
  return command.add_choice("--periodic", options.periodic, axes, about);
}

void add_y_options(Command& command, SeedOptions& options, const std::string& about_up) {
  const Option up = command.add("--y-up", options.y_up, about_up);
  command.add("--y-down", options.y_down, "The data's y axis points down (the default for points)")
      .excludes(up);
}

using Sides = std::pair<std::int64_t, std::int64_t>;

/// Both numbers of "WxH"; none of another text.
std::optional<Sides> sides_in(const std::string& text) {
  const auto x = text.find('x');
  const auto width = parse_number<std::int64_t>(text.substr(0, x));
  const auto height = x == std::string::npos ? std::nullopt : parse_number<std::int64_t>(text.substr(x + 1));
  if (!width || !height) return std::nullopt;
  return Sides{*width, *height};
}

Sides parse_sides(const std::string& text) {
  const std::optional<Sides> sides = sides_in(text);
  if (!sides) throw Error("\"" + text + "\" must be WxH, such as 1440x720");
  return *sides;
}

/// "WxH", or "WxHxD" of a volume, whose depth is set apart.
Size parse_size_and_depth(const std::string& text, std::int64_t& depth) {
  const auto x = text.find('x'), second = x == std::string::npos ? x : text.find('x', x + 1);
  const bool has_depth = second != std::string::npos;
  const std::optional<Sides> sides = sides_in(text.substr(0, second));
  const auto slices = has_depth ? parse_number<std::int64_t>(text.substr(second + 1)) : 1;
  if (!sides || !slices) {
    throw Error("\"" + text + "\" must be WxH, such as 1440x720, or WxHxD, such as 256x256x256");
  }
  if (has_depth && (*slices < 2 || *slices > Window::max_side_of_volume)) {
    throw Error(fmt::format("the depth is {}; it must be from 2 to {} voxels; --size WxH makes a plane",
                            *slices, Window::max_side_of_volume));
  }
  depth = *slices;
  return parse_size(text.substr(0, second));
}

Size size_of_sides(std::int64_t width, std::int64_t height) {
  if (std::max(width, height) <= Size::max_side) return {width, height};
  throw Error(
      fmt::format("{} pixels are more than the {} that a side of a diagram has at most; vorocl tiles makes "
                  "larger ones",
                  std::max(width, height), Size::max_side));
}

std::optional<double> parse_threshold(const std::string& text) {
  const auto threshold = parse_number<double>(text);
  if (!threshold || !std::isfinite(*threshold)) throw Error("\"" + text + "\" is no number");
  return threshold;
}

int parse_width(const std::string& text) {
  const auto width = parse_number<std::int64_t>(text);
  if (!width) throw Error("\"" + text + "\" is no whole number");
  return size_of_sides(*width, 1).width();
}

std::optional<Grid> parse_plane(const std::string& text) {
  if (std::count(text.begin(), text.end(), 'x') == 2) throw Error(volumes_are_for);
  const auto [width, height] = parse_sides(text);
  const auto check = [](const char* name, std::int64_t side) {
    if (side >= 1 && side <= Axis::max_pixels) return;
    throw Error(
        fmt::format("the plane's {} is {}; it must be from 1 to {} pixels", name, side, Axis::max_pixels));
  };
  check("width", width);
  check("height", height);
  return Grid(width, height);
}

void add_mask_option(Command& command, Command& source, SeedOptions& options) {
  const Option mask =
      source
          .add("--mask", options.mask,
               "Pixels of an image or a .npy array that are not 0, numbered in row-major order")
          .value_name("FILE");
  command
      .add_parsed("--threshold", options.threshold, parse_threshold,
                  "Pixels of the mask that are greater than T, instead of those that are not 0")
      .value_name("T")
      .needs(mask);
}

}  // namespace

void add_seed_options(Command& command, SeedOptions& options, std::size_t least, bool move, Makes makes) {
  const bool volumes = makes == Makes::volumes_too;
  Command source = command.add_group("Seeds", "Seeds, from one of these", least, 1);
  command.begin_section(seed_files);
  if (least > 0) command.refuse_words([](const std::string& word) { return option_for(word, Sources::all); });
  constexpr std::size_t most_seeds = Window::max_pixels;
  const Option random = add_random_option(source, options, most_seeds);
  const Option points = add_points_option(source, options);
  add_mask_option(command, source, options);
  const Option trajectory =
      source.add("--trajectory", options.trajectory, "Particles of a LAMMPS text dump or an XYZ file")
          .value_name("FILE");

  Option rng_seed = add_rng_seed_option(command, options);
  move ? rng_seed.excludes(trajectory) : rng_seed.needs(random);
  add_columns_option(command, options, volumes).needs(points);
  add_decimal_option(command, options).needs(points);
  command.begin_section(grid_section);
  const std::string about_size =
      std::string("Width and height of the grid in pixels; with --mask those of the image") +
      (volumes
           ? "; with a depth, those of a volume, which takes no --mask, --width, --outside, --domain, --y-up "
             "or --y-down, and pictures of its slices by id alone"
           : "");
  const Option size = command
                          .add(
                              "--size",
                              [&options](const std::string& text) {
                                options.size = parse_size_and_depth(text, options.depth);
                              },
                              about_size)
                          .value_name(volumes ? "WxH[xD]" : "WxH");
  command
      .add_parsed(
          "--width", options.width, parse_width,
          "Width of the grid in pixels, instead of --size: the height follows from the bounds, so that "
          "pixels are square")
      .value_name("W")
      .excludes(size);
  const std::string fitted = move ? "what --fit says of a trajectory" : "the box of a trajectory's frame";
  const std::string about_bounds = "Rectangle in data units that the grid shows; else " + fitted +
                                   ", or the domain or the bounding box of the points";
  add_bounds_option(command, options, about_bounds + (volumes ? "; of a volume X0,Y0,Z0,X1,Y1,Z1" : ""),
                    volumes);
  add_margin_option(command, options);
  add_outside_option(command, options);
  command
      .add_parsed(
          "--domain", options.domain, parse_domain,
          "Rectangle in data units that repeats along the periodic axes of points; the bounds may be a part "
          "of it")
      .value_name("X0,Y0,X1,Y1")
      .default_text("the bounds")
      .excludes(command.option("--margin"));
  add_periodic_option(command, options, volumes,
                      "Axes along which the plane repeats: distances go the shorter way round, cells reach "
                      "across the border, and points outside the domain wrap")
      .default_text("what a trajectory's file says, else none");
  add_y_options(command, options, "The data's y axis points up (the default for trajectories)");
}

void add_plane_options(Command& command, PlaneInputOptions& options) {
  SeedOptions& seeds = options.seeds;
  Command source = command.add_group("Seeds", "Seeds, from one of these", 1, 1);
  command.begin_section(seed_files);
  command.refuse_words([](const std::string& word) { return option_for(word, Sources::of_planes); });
  const Option random = add_random_option(source, seeds, no_label - 1);
  const Option points = add_points_option(source, seeds);
  add_mask_option(command, source, seeds);
  add_rng_seed_option(command, seeds).needs(random);
  add_columns_option(command, seeds, false).needs(points);
  add_decimal_option(command, seeds).needs(points);
  command.begin_section(grid_section);
  command
      .add_parsed("--size", options.size, parse_plane,
                  "Width and height of the plane in pixels; with --mask those of the image")
      .value_name("WxH");
  add_bounds_option(command, seeds,
                    "Rectangle in data units that the plane shows; else the bounding box of the points");
  add_margin_option(command, seeds);
  add_outside_option(command, seeds);
  add_periodic_option(command, seeds, false,
                      "Axes along which the plane repeats: distances go the shorter way round, cells reach "
                      "across the border, and points outside the bounds wrap")
      .default_text("none");
  add_y_options(command, seeds, "The data's y axis points up");
  add_snap_option(command, seeds);
}

void add_snap_option(Command& command, SeedOptions& options, const std::string& judges) {
  const auto set = [&options](bool is_on) { options.snap = is_on ? Snap::to_pixels : Snap::none; };
  command.add_pair(
      "--snap,!--no-snap", set,
      judges.empty()
          ? "Move points to the centres of their pixels, as methods that flood always do; without it exact "
            "diagrams take the points themselves, rounded to 1/4096 of a pixel"
          : judges +
                " by diagrams of the centres of the points' pixels, as methods that flood make (the "
                "default), or of the points themselves, rounded to 1/4096 of a pixel");
}

Option add_crs_option(Command& command, std::optional<Crs>& crs, const std::string& about) {
  return command
      .add_parsed("--crs", crs, parse_crs,
                  "Coordinate reference system of the data, which " + about + ", such as EPSG:32632")
      .value_name("EPSG:N");
}

void check_crs(const std::optional<Crs>& crs, const std::vector<std::string>& paths) {
  const auto says_it = [](const std::string& path) {
    const std::string extension = extension_of(path);
    return extension == ".tif" || extension == ".tiff" || extension == ".geojson" || extension == ".json";
  };
  if (crs && std::none_of(paths.begin(), paths.end(), says_it))
    throw UsageError("--crs is for .tif files of labels and distances, and for polygons as .geojson");
}

void add_keep_option(Command& command, SeedOptions& options) {
  const auto parse = [](const std::string& text) { return text; };
  command
      .add_list(
          "--keep", options.keep, parse,
          "Columns of the CSV file, by name or by index, that tables of cells and polygons have too; all: "
          "every one that has a name")
      .value_name("COLUMN,...")
      .needs("--points")
      .in_section(seed_files);
}

void add_weight_options(Command& command, SeedOptions& options, const Option& exact) {
  const Option weights =
      command
          .add(
              "--weights", options.weight_column,
              "Column of the CSV file or the trajectory with the weights of --exact, in squared units of the "
              "data: a place belongs to the seed of the least squared distance less its weight (power, "
              "Laguerre or radical cells)")
          .value_name("COLUMN")
          .needs(exact);
  const auto set = [&options](const std::string& column) {
    options.weight_column = column;
    options.are_radii = true;
  };
  command.add("--radius", set, "The same of a column with radii, whose squares are the weights")
      .value_name("COLUMN")
      .needs(exact)
      .excludes(weights);
}

void add_frame_option(Command& command, SeedOptions& options) {
  command.add("--frame", options.frame, "Frame of the trajectory, from 0")
      .value_name("K")
      .in_range(0, std::numeric_limits<int>::max() - 1)
      .default_is_value()
      .needs("--trajectory")
      .in_section(seed_files);
}

void add_max_distance_option(Command& command, std::optional<double>& distance) {
  const auto parse = [](const std::string& text) {
    const auto number = parse_number<double>(text);
    if (!number || !(*number >= 0)) throw Error("\"" + text + "\" is no distance of 0 or more");
    return number;
  };
  command
      .add_parsed(
          "--max-distance", distance, parse,
          "Leave pixels without a label that are farther than D from their seed, in the unit of distances")
      .value_name("D");
}

void add_units_option(Command& command, SeedOptions& options, const std::string& with_data) {
  const Choices<std::optional<MeasureUnits>> units = {{"data", MeasureUnits::data},
                                                      {"px", MeasureUnits::pixels}};
  command
      .add_choice("--units", options.units, units,
                  "Units of positions, areas, lengths and distances: those of the data, or pixels")
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
                  "Frames to make: 0 to L, or K to L, which continues a run that was ended. Of a trajectory "
                  "without L, all from K on")
      .value_name("[K:]L");
  const Option trajectory = command.option("--trajectory");
  command
      .add("--step-length", options.step_length,
           "Each seed moves at random, by up to this many pixels along x and y per frame")
      .value_name("D")
      .in_range(0, Size::max_side)
      .excludes(trajectory);
  const Choices<Fit> fits = {{"all", Fit::all}, {"frame", Fit::frame}};
  command
      .add_choice(
          "--fit", options.fit, fits,
          "What the picture shows of a trajectory without --bounds: what the boxes of all frames fill, "
          "with one scale, or each frame's own box, stretched onto the grid")
      .default_text("all")
      .needs(trajectory)
      .excludes(command.option("--bounds"));
  const Choices<Border> borders = {{"reflect", Border::reflect}, {"periodic", Border::periodic}};
  command
      .add_choice("--border", options.border, borders,
                  "What seeds that move at random do at the border of the grid, along an axis that is not "
                  "periodic")
      .default_text("reflect")
      .excludes(trajectory);
}

Size parse_size(const std::string& text) {
  const auto [width, height] = parse_sides(text);
  return size_of_sides(width, height);
}

}  // namespace vorocl::command
