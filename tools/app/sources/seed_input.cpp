#include "app/sources/seed_input.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "app/sources/bounds.hpp"
#include "app/sources/data_grid.hpp"
#include "app/sources/moving_seeds.hpp"
#include "app/sources/random_seeds.hpp"
#include "app/terminal/console.hpp"
#include "formats/files.hpp"
#include "formats/images/pictures.hpp"
#include "formats/npy.hpp"

namespace vorocl::command {

void place_points(Input& input, const SeedOptions& options, std::vector<std::optional<Point>> points,
                  const Weights& weights, Outside outside) {
  input.points = std::make_shared<const std::vector<std::optional<Point>>>(std::move(points));
  input.weights = weights;
  input.place = [grid = input.view.window.grid(), points = input.points, weights, outside,
                 snap = options.snapping(),
                 file = options.points + options.trajectory](const Device& device) {
    try {
      return Seeds(device, grid, weighted(*points, weights), {outside, snap});
    } catch (const BadPoint& error) {
      throw Error(file + ": " + error.what());
    }
  };
}

Mapping mapping_of(const SeedOptions& options, const Bounds& bounds) {
  Mapping mapping;
  mapping.bounds = bounds;
  mapping.y_up = points_up(options);
  mapping.crs = options.crs;
  mapping.outside = options.outside.value_or(Outside::count);
  mapping.closed = (!options.bounds && !options.domain) || mapping.outside == Outside::refuse;
  mapping.periodic = options.periodic.value_or(Axes::none);
  mapping.domain = options.domain;
  mapping.in_pixels = in_pixels(options);
  mapping.snap = options.snapping();
  return mapping;
}

namespace {

Axes periodic_axes(const SeedOptions& options) { return options.periodic.value_or(Axes::none); }

/// Of a plane, in pixels of its picture.
Input map_input(const SeedOptions& options, const CsvPoints& read) {
  const Bounds bounds = options.bounds   ? *options.bounds
                        : options.domain ? *options.domain
                                         : widened(bounding_box(read.points), options.margin);
  const Mapping mapping = mapping_of(options, bounds);
  note_no_extent(options, bounds);
  const Size picture = picture_size(options, bounds);
  const Weights weights = weights_of(options, read.values, read.ids,
                                     options.weight_column.empty() ? 1 : pixels_of_square(bounds, picture));
  const MappedPoints mapped = map_points(read.points, mapping, picture, read.ids);
  warn_of_scales(bounds, picture.grid());
  if (mapping.periodic != Axes::none && !options.bounds && !options.domain) {
    print_note(fmt::format("the period is the bounding box of the points{}, {}; {} says another one",
                           options.margin > 0 ? " and its margin" : "", to_string(bounds),
                           options.margin > 0 ? "--bounds" : "--domain"));
  }
  note_outside(mapped.outside, read.points.size(), bounds, options.keeps_inside);
  Input input = {mapped.view};
  input.is_window = mapped.is_window();
  place_points(input, options, {mapped.places.begin(), mapped.places.end()}, weights);
  return input;
}

/// Points as they are, on a grid of degrees.
Input globe_input(const SeedOptions& options, std::vector<Point>& points) {
  const Bounds bounds = options.bounds.value_or(Bounds{-180, -90, 180, 90});
  const bool is_whole = bounds.x1 - bounds.x0 == 360;
  const Size picture = picture_size(options, bounds);
  const Grid grid = with_bounds(picture.grid(is_whole ? Axes::x : Axes::none), bounds, true, !options.y_down);
  for (Point& point : points) {  // so that those beyond 180 degrees are drawn where they are
    if (std::abs(point.y) > 90)
      throw BadPoint(static_cast<std::size_t>(&point - points.data()), point,
                     "is no place on the globe: y is its latitude, from -90 to 90 degrees");
    const double shown = point.x - 360 * std::floor((point.x - bounds.x0) / 360);
    if (shown <= bounds.x1) point.x = shown;
  }
  Input input = {
      {{picture, {bounds, !options.y_down, options.crs}}, grid, 0, 0, 0, 0, Units::of_globe(grid)}};
  place_points(input, options, {points.begin(), points.end()}, nullptr);
  return input;
}

/// In the units of the data.
Input data_input(const SeedOptions& options, const CsvPoints& read, bool is_volume) {
  const Grid grid =
      is_volume ? box_of_points(options, read.points, read.ids) : rectangle_of_points(options, read.points);
  Input input = {view_of_grid(grid, in_pixels(options))};
  place_points(input, options, {read.points.begin(), read.points.end()},
               weights_of(options, read.values, read.ids),
               is_volume ? Outside::refuse : options.outside.value_or(Outside::count));
  return input;
}

Input input_from_points(const SeedOptions& options, bool is_volume) {
  CsvPoints read = read_points(options, is_volume);
  try {
    Input input = is_volume || options.is_exact ? data_input(options, read, is_volume)
                  : options.on_globe()          ? globe_input(options, read.points)
                                                : map_input(options, read);
    input.ids = std::move(read.ids);
    input.values = std::move(read.values);
    input.kept = {std::move(read.kept_names), std::move(read.kept)};
    return input;
  } catch (const Error& error) {
    throw Error(options.points + ": " + error.what());
  }
}

Input input_from_mask(const SeedOptions& options) {
  const Mask mask = read_mask(options.mask, options.threshold);
  for (const std::string& note : mask.notes) print_note(note);
  check_mask_size(options.mask, mask.size.grid(), options.size);
  const Grid grid = mask.size.grid(periodic_axes(options));
  Input input = {view_of_grid(grid, true)};
  input.view.picture.georeference = georeference_of(mask.geotags);
  input.place = [grid, pixels = mask.pixels](const Device& device) {
    return Seeds::from_mask(device, grid, pixels);
  };
  return input;
}

/// The device makes more random seeds in less time than the host, but its program for it takes tens of
/// milliseconds to build.
constexpr std::size_t most_on_host = std::size_t{1} << 20;

Input input_at_random(const SeedOptions& options) {
  if (!options.size) throw UsageError("--size WxH is required with --random");
  const Grid grid = options.grid();
  Input input = {view_of_grid(grid, true)};
  input.place = [grid, options](const Device& device) {
    if (grid.is_volume() || options.random > most_on_host) {
      return Seeds::random(device, grid, options.random, options.rng_seed);
    }
    std::vector<Point> pixels;
    for (std::size_t id = 0; id < options.random; ++id) {
      pixels.push_back(random_pixel(grid, static_cast<std::uint32_t>(id), options.rng_seed));
    }
    return Seeds(device, grid, pixels, {Outside::count, options.snapping()});
  };
  return input;
}

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

}  // namespace

Size picture_size(const SeedOptions& options, const Bounds& bounds) {
  return options.size ? Size(*options.size) : size_of_width(bounds, options.width);
}

void check_mask_size(const std::string& path, const Grid& mask, const std::optional<Grid>& asked_for) {
  if (!asked_for || *asked_for == mask) return;
  throw Error(fmt::format("{} is {} x {} pixels and --size says {} x {}; the mask alone is enough", path,
                          mask.width(), mask.height(), asked_for->width(), asked_for->height()));
}

Weights weights_of(const SeedOptions& options, const ColumnValues& values,
                   const std::vector<std::uint32_t>& ids, double squares) {
  if (options.weight_column.empty()) return nullptr;
  const char* const what = options.are_radii ? "radius" : "weight";
  if (!values.texts.empty()) {
    throw Error(fmt::format("column {} has texts, such as \"{}\"; a {} is a number", options.weight_column,
                            values.texts.front(), what));
  }
  const auto weights = std::make_shared<std::vector<double>>();
  for (const double value : values.numbers) {
    if (!std::isfinite(value) || (options.are_radii && value < 0)) {
      const std::size_t seed = weights->size();
      throw Error(fmt::format("the {} of seed {} in column {} is {}; it must be {}", what,
                              ids.empty() ? seed : ids[seed], options.weight_column, value,
                              options.are_radii ? "a number that is not negative" : "a finite number"));
    }
    weights->push_back((options.are_radii ? value * value : value) * squares);
  }
  return weights;
}

bool note_no_extent(const SeedOptions& options, const Bounds& bounds, bool of_volume) {
  const char* const axis = !(bounds.x0 < bounds.x1)        ? "x"
                           : !(bounds.y0 < bounds.y1)      ? "y"
                           : of_volume && !bounds.is_box() ? "z"
                                                           : nullptr;
  if (axis == nullptr || in_pixels(options)) return false;
  const std::string text = fmt::format("the data have no extent in {}", axis);
  const char* const told = options.units ? "--units data" : options.crs ? "--crs" : nullptr;
  if (told != nullptr) throw Error(fmt::format("{}, so {} needs --bounds that have one", text, told));
  print_note(fmt::format("{}, so all measures stay in {}; --bounds can give one", text,
                         of_volume ? "voxels" : "pixels"));
  return true;
}

double pixels_of_square(const Bounds& bounds, const Size& picture) {
  constexpr double rounded = 1.01;  // as the number of pixels of a side is, which are whole
  const double x = (bounds.x1 - bounds.x0) / picture.width(), y = (bounds.y1 - bounds.y0) / picture.height();
  if (!(std::max(x, y) <= rounded * std::min(x, y))) {
    throw Error(
        fmt::format("weights need pixels that are squares in the data, and these are {:g} x {:g}; give "
                    "--width W, or bounds and a size of one shape",
                    x, y));
  }
  return 1 / (x * y);
}

CsvPoints read_points(const SeedOptions& options, bool has_z) {
  as_usage([&] { check_extension(options.points, {".csv", ".npy"}); });
  refuse_csv_options(options);
  if (extension_of(options.points) == ".csv") {
    CsvPoints read = read_csv(options.points, options.csv(), has_z);
    for (const std::string& note : read.notes) print_note(note);
    return read;
  }
  CsvPoints read;
  read.points = read_npy_points(options.points, has_z);
  return read;
}

void refuse_csv_options(const SeedOptions& options) {
  if (extension_of(options.points) == ".csv") return;
  const char* const given = options.columns         ? "--columns"
                            : options.decimal_comma ? "--decimal"
                            : !options.keep.empty() ? "--keep"
                                                    : nullptr;
  if (given != nullptr) throw UsageError(std::string(given) + " is for .csv files");
  const char* const column = !options.value_column.empty()   ? "--color column:NAME"
                             : options.weight_column.empty() ? nullptr
                             : options.are_radii             ? "--radius"
                                                             : "--weights";
  if (column != nullptr) throw UsageError(std::string(column) + " is for .csv files and trajectories");
}

const char* option_of_data(const SeedOptions& options) {
  return options.bounds                        ? "--bounds"
         : options.outside                     ? "--outside"
         : options.width != 0                  ? "--width"
         : options.snap == Snap::to_pixels     ? "--snap"
         : options.snap == Snap::none          ? "--no-snap"
         : options.y_up                        ? "--y-up"
         : options.y_down                      ? "--y-down"
         : !options.value_column.empty()       ? "--color column:NAME"
         : options.units == MeasureUnits::data ? "--units data"
                                               : nullptr;
}

void check_weight_options(const SeedOptions& options) {
  if (options.weight_column.empty()) return;
  if (options.points.empty() && options.trajectory.empty())
    throw UsageError("--weights and --radius need --points or --trajectory");
  const char* const other = options.on_globe()                    ? "--metric great-circle"
                            : options.metric == Metric::manhattan ? "--metric manhattan"
                            : options.snap == Snap::to_pixels     ? "--snap"
                                                                  : nullptr;
  if (other != nullptr) throw UsageError(std::string(other) + " knows no --weights and no --radius");
  if (!options.value_column.empty() && options.value_column != options.weight_column)
    throw UsageError("--color column:NAME and --weights or --radius take one column, and these are two");
}

void check_seed_options(const SeedOptions& options) {
  check_weight_options(options);
  const char* const of_volumes = options.bounds && options.bounds->is_box() ? "--bounds with six numbers"
                                 : has_z(periodic_axes(options))            ? "--periodic with z"
                                 : options.columns && !options.columns->z.empty() ? "--columns X,Y,Z"
                                                                                  : nullptr;
  if (of_volumes != nullptr) {
    throw UsageError(std::string(of_volumes) + " is for volumes: give --size WxHxD");
  }
  if (options.on_globe()) {
    const char* const given = options.domain           ? "--domain"
                              : options.periodic       ? "--periodic"
                              : options.outside        ? "--outside"
                              : options.margin > 0     ? "--margin"
                              : options.units          ? "--units"
                              : options.points.empty() ? "seeds without --points"
                                                       : nullptr;
    if (given != nullptr) {
      throw UsageError(
          std::string("--metric great-circle takes longitudes and latitudes of --points, which go round "
                      "the globe by themselves and all count: it knows no ") +
          given);
    }
  }
  if (options.domain && options.points.empty()) {
    throw UsageError("--domain is for --points; the domain of a trajectory is its box");
  }
  if (options.domain && periodic_axes(options) == Axes::none) {
    throw UsageError("--domain needs --periodic x, y or xy");
  }
  if (!options.points.empty() || !options.trajectory.empty()) {
    if (options.size || options.width != 0 || options.is_exact) return;
    throw UsageError(std::string("--size WxH or --width W is required with ") +
                     (options.points.empty() ? "--trajectory" : "--points"));
  }
  const char* const given = option_of_data(options);
  if (given != nullptr) throw UsageError(std::string(given) + " needs --points or --trajectory");
}

void refuse_in_volumes(const std::string& option) {
  throw UsageError(option + " is for planes, not for volumes");
}

void check_volume_options(const SeedOptions& options) {
  check_weight_options(options);
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
  const char* const of_data = option_of_data(options);
  if (of_data != nullptr && options.random > 0) {
    throw UsageError(std::string(of_data) + " needs --points or --trajectory");
  }
  if (options.bounds && !options.bounds->is_box()) {
    throw UsageError("the --bounds of a volume are six numbers: X0,Y0,Z0,X1,Y1,Z1");
  }
  if (options.columns && options.columns->z.empty()) {
    throw UsageError("the --columns of a volume are three: X,Y,Z");
  }
}

void snap_for(const std::string& what, SeedOptions& options) {
  if (options.snap == Snap::none) {
    throw UsageError("--no-snap is for exact diagrams; " + what + " takes the centres of the points' pixels");
  }
  options.usual_snap = Snap::to_pixels;
}

void snap_for(const Method& method, SeedOptions& options) {
  if (method.exact) return;
  if (!options.weight_column.empty())
    throw UsageError("the method " + method.name + " knows no --weights and no --radius; exact does");
  snap_for("the method " + method.name, options);
}

void refuse_window(const Input& input, const std::string& what) {
  if (!input.is_window && input.view.fills_picture()) return;
  throw Error("seeds lie outside the bounds, or these are a part of a period or more than the box, which " +
              what + " cannot take; give bounds that hold the seeds, or the whole period or box");
}

bool in_pixels(const SeedOptions& options) { return options.units == MeasureUnits::pixels; }

bool points_up(const SeedOptions& options) {
  return options.y_up || (!options.trajectory.empty() && !options.y_down);
}

bool check_seeds(SeedOptions& options) {
  const bool is_told = options.is_exact && ((options.bounds && options.bounds->is_box()) ||
                                            (options.periodic && has_z(*options.periodic)) ||
                                            (options.columns && !options.columns->z.empty()));
  const bool may_be_told =
      options.is_exact && !options.bounds && !options.columns && !options.domain && options.mask.empty();
  const bool is_volume = options.is_volume() || is_told || (may_be_told && has_depth(options));
  is_volume ? check_volume_options(options) : check_seed_options(options);
  if (options.is_exact && options.random == 0) options.size.reset();
  return is_volume;
}

Input read_input(SeedOptions options) {
  const bool is_volume = check_seeds(options);
  if (!options.trajectory.empty()) return frame_of_trajectory(options, is_volume);
  if (!options.points.empty()) return input_from_points(options, is_volume);
  Input input = options.mask.empty() ? input_at_random(options) : input_from_mask(options);
  if (!options.is_exact || is_volume) return input;
  input.place = [place = std::move(input.place)](const Device& device) {
    const Seeds pixels = place(device);
    return Seeds(device, pixels.grid(), pixels.read_pixels());
  };
  return input;
}

}  // namespace vorocl::command
