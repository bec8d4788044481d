// The seeds that a command line asks for, and the grid that they are on.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/sources/bounds.hpp"
#include "app/sources/mapping.hpp"
#include "formats/csv.hpp"
#include "vorocl/method.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl::command {

/// The units of what is measured.
enum class MeasureUnits { data, pixels };

struct SeedOptions {
  std::size_t random = 0;  // 0: not given, as are empty names
  std::uint64_t rng_seed = 1;
  std::string points;
  std::string mask;
  std::optional<double> threshold;  // of the mask: see MaskRows
  std::string trajectory;
  int frame = 0;             // of the trajectory
  std::optional<Grid> size;  // without periodic axes; some commands make volumes
  int width = 0;
  std::optional<Bounds> bounds;    // a box of a volume
  double margin = 0;               // without them, in percent of the longer side of the points' box
  std::optional<Crs> crs;          // of points
  std::optional<Bounds> domain;    // of points: what repeats along the periodic axes; else the bounds
  std::optional<Outside> outside;  // the bounds; else they count
  std::optional<Axes> periodic;    // else none, or what the trajectory says
  std::optional<Snap> snap;        // of points and particles, as given; else ...
  Snap usual_snap = Snap::none;
  Snap of_pixels = Snap::to_pixels;   // of masks and random seeds
  bool y_up = false, y_down = false;  // as given; see points_up()
  std::optional<Columns> columns;
  bool decimal_comma = false;
  std::vector<std::string> keep;      // columns of points that tables of cells have too: see CsvOptions
  std::string value_column;           // whose values are read with the points
  std::string weight_column;          // ""; none
  bool are_radii = false;             // weights are squares of that column
  bool is_exact = false;              // of cells without pixels, which lie where the data have them
  Metric metric = Metric::euclidean;  // great circles: points are longitudes and latitudes
  std::optional<MeasureUnits> units;  // else those of the data, where there are bounds
  std::string keeps_inside;           // see note_outside()

  bool is_volume() const { return size && size->is_volume(); }
  bool on_globe() const { return metric == Metric::great_circle; }

  /// The grid of this size in pixels, which is told.
  Grid grid() const { return {size->width(), size->height(), size->depth(), periodic.value_or(Axes::none)}; }

  const std::string& read_column() const { return value_column.empty() ? weight_column : value_column; }
  CsvOptions csv() const { return {columns, read_column(), decimal_comma, keep, true, on_globe()}; }

  /// What becomes of seeds within their pixels.
  Snap snapping() const {
    return points.empty() && trajectory.empty() ? of_pixels : snap.value_or(usual_snap);
  }
};

/// Has the points snapped for something ("the method jfa") that knows whole pixels alone. Throws UsageError
/// if they must not be.
void snap_for(const std::string& what, SeedOptions& options);

/// As above, if it is a method that floods.
void snap_for(const Method& method, SeedOptions& options);

constexpr const char* keeps_flooding_inside = "flooding cannot take, only exact diagrams can";

/// The first option that was given of those that points and particles alone have; null: none.
const char* option_of_data(const SeedOptions& options);

/// What no parser can say: options that go with either of two others, of planes and of volumes. Throw
/// UsageError.
void check_seed_options(const SeedOptions& options);
void check_volume_options(const SeedOptions& options);

/// Throws UsageError: volumes do not have this option.
[[noreturn]] void refuse_in_volumes(const std::string& option);

/// Throws UsageError for options of weights where there can be none.
void check_weight_options(const SeedOptions& options);

/// Of seeds, in squared units of their grid; null: none.
using Weights = std::shared_ptr<const std::vector<double>>;

/// Points with them.
template <typename Point>
Points weighted(const std::vector<Point>& points, const Weights& weights) {
  return Points(points).weighted(weights ? weights->data() : nullptr);
}

/// The weights that the values of the column are, where a square of the data's unit has so many of the
/// grid's. Throws Error for a value that is none.
Weights weights_of(const SeedOptions& options, const ColumnValues& values,
                   const std::vector<std::uint32_t>& ids, double squares = 1);

/// Where bounds have no extent along an axis, says that all measures stay in pixels, and returns true. Throws
/// Error if the options say something of units.
bool note_no_extent(const SeedOptions& options, const Bounds& bounds, bool of_volume = false);

/// How many pixels there are in a square of the data's unit. Throws Error if they are no squares.
double pixels_of_square(const Bounds& bounds, const Size& picture);

/// The points of --points, as the file has them; says on standard error what may not be expected of it.
/// Throws UsageError for an extension that is none of points, Error if the file is bad.
CsvPoints read_points(const SeedOptions& options, bool has_z = false);

/// Throws UsageError for options of .csv files, if the points are no such file.
void refuse_csv_options(const SeedOptions& options);

/// The size of the picture of these bounds, as it is told or by its width. Throws Error as size_of_width().
Size picture_size(const SeedOptions& options, const Bounds& bounds);

/// Throws Error if a mask is not of the size that was asked for.
void check_mask_size(const std::string& path, const Grid& mask, const std::optional<Grid>& asked_for);

/// Columns of the input, by seed.
struct KeptColumns {
  std::vector<std::string> names;
  std::vector<CsvFields> fields;
};

/// What a command that makes planes alone says of a volume, behind "--size".
constexpr const char* volumes_are_for =
    "WxHxD asks for a volume, which vorocl render, cells, simulate, compare and bench make";

/// Whether the data's y axis points up: that of a trajectory does unless the options say otherwise.
bool points_up(const SeedOptions& options);

/// Whether what is measured stays in pixels although there may be bounds.
bool in_pixels(const SeedOptions& options);

/// Seeds that were read and checked, and that a device can now be given.
struct Input {
  View view;
  std::function<Seeds(const Device&)> place = nullptr;
  std::vector<std::uint32_t> ids = {};  // that labels carry, by seed; empty: the seeds' own
  ColumnValues values = {};             // of the value column, by seed; NaN: absent
  bool is_window = false;               // see MappedPoints
  KeptColumns kept = {};                // of --keep

  // Of a trajectory's frame.
  std::optional<std::int64_t> timestep = std::nullopt;  // where the file has one
  std::optional<Box> box = std::nullopt;                // none in an XYZ without a lattice
  std::shared_ptr<const std::vector<std::optional<Point>>> points = nullptr;  // that place() places ...
  Weights weights = nullptr;                                                  // ... with these

  // The greatest displacement along an axis to this frame of a particle that was there before, in pixels of
  // the diagram's grid, and none if that is another one; the shorter way round where the box is periodic.
  std::optional<double> displacement = std::nullopt;
  std::optional<std::uintmax_t> bytes_left = std::nullopt;  // of the file behind the frame
};

/// Throws Error for a window, or a diagram that is a part of the picture; `what` ("bench") takes none.
void refuse_window(const Input& input, const std::string& what);

/// How points become seeds where the picture shows these bounds.
Mapping mapping_of(const SeedOptions& options, const Bounds& bounds);

/// Has these points placed on the view's grid, where the options have them snapped or not.
void place_points(Input& input, const SeedOptions& options, std::vector<std::optional<Point>> points,
                  const Weights& weights, Outside outside = Outside::count);

/// Checks the options, and returns whether they ask for a volume. Exact cells are one if an option says so
/// that planes do not have (bounds of six numbers, z among the columns or the periodic axes, a depth), or if
/// neither bounds nor columns say that it is a plane, and the points are an array of three columns, or the
/// particles of the first frame do not lie in a plane, or its box is tilted in z. Nothing
/// else is taken of the size of exact cells, which is reset. Throws UsageError.
bool check_seeds(SeedOptions& options);

/// Checks the options, and reads and checks the files, of a plane, a volume or exact cells. Throws
/// UsageError, Error if a file is bad; warns on standard error where the axes get different scales.
Input read_input(SeedOptions options);

}  // namespace vorocl::command
