// The options that subcommands share, in groups: seeds, methods, pictures, files, the device and JSON.
#pragma once

#include <string>
#include <vector>

#include "app/options/command_line.hpp"
#include "app/outputs/diagram_files.hpp"
#include "app/outputs/frame_writer.hpp"
#include "app/outputs/painter.hpp"
#include "app/sources/moving_seeds.hpp"
#include "app/sources/seed_input.hpp"
#include "vorocl/device.hpp"
#include "vorocl/grid.hpp"
#include "vorocl/method.hpp"

namespace vorocl::command {

/// What subcommands that make diagrams are told.
struct DiagramOptions {
  SeedOptions seeds;
  Method method = vorocl::method("exact");
  MethodOptions method_options;
  std::string device;
  bool json = false;

  bool is_volume() const { return seeds.is_volume(); }
};

/// Whether the command takes great circles.
enum class Globe { no, yes };
Option add_metric_option(Command& command, Metric& metric, Globe globe = Globe::no);
Option add_device_option(Command& command, std::string& request);
/// As Device::select(). On a terminal, a run that waits for the driver's compiler says so.
Device select_device(const std::string& request);
Option add_json_option(Command& command, bool& json);

/// What a subcommand makes of seeds.
enum class Makes { planes, volumes_too, tiles };

/// Adds --random, --points, --mask, --trajectory, of which at least so many and at most one must be given,
/// and what goes with them. Where seeds `move` at random, all of them have a use for the rng seed.
void add_seed_options(Command& command, SeedOptions& options, std::size_t least = 1, bool move = false,
                      Makes makes = Makes::planes);

/// Adds --snap and --no-snap, for the subcommands that make exact diagrams of points.
void add_snap_option(Command& command, SeedOptions& options, const std::string& judges = "");

/// Adds --crs, for the subcommands that have files of where points lie in the world.
Option add_crs_option(Command& command, std::optional<Crs>& crs, const std::string& about);

/// Throws UsageError if there is a --crs and no file that says it (.tif, or GeoJSON), or for one without
/// degrees on the globe.
void check_crs(const SeedOptions& options, const std::vector<std::string>& paths);

/// Adds --keep, for the subcommands that have tables of cells of points.
void add_keep_option(Command& command, SeedOptions& options);

/// Adds --max-distance, for the subcommands that may leave pixels without a label.
void add_max_distance_option(Command& command, std::optional<double>& distance);

/// Adds --weights and --radius, for the subcommands that make exact diagrams or cut exact cells.
void add_weight_options(Command& command, SeedOptions& options);

/// Adds --frame, for the subcommands that show one frame.
void add_frame_option(Command& command, SeedOptions& options);

/// Adds --units, for the subcommands that measure.
/// The help says which input has units of its own.
void add_units_option(Command& command, SeedOptions& options,
                      const std::string& with_data = "points and trajectories");

/// Adds --frames, --step-length, --fit and --border.
void add_motion_options(Command& command, MotionOptions& options);

/// "WxH" to a grid of pixels, or "WxHxD" where there are volumes. Throws Error if it is not that, or not
/// possible.
Grid parse_grid(const std::string& text, Makes makes = Makes::planes);

/// The methods as choices of an option.
Choices<Method> method_choices();

/// Adds --method: what `method` is, unless it is given.
void add_method_option(Command& command, Method& method, const std::string& about);

/// Adds --metric, --neighbourhood and the waves of djfa.
void add_method_options(Command& command, MethodOptions& options, Globe globe = Globe::no);

/// Throws UsageError for a method that knows planes alone, or no such metric in volumes.
void check_volume_method(const Method& method, Metric metric);

/// Throws UsageError for options that only djfa has, if none of the methods is djfa.
void check_method_options(const Command& command, const std::vector<Method>& methods,
                          const MethodOptions& options);

/// Adds --color, --palette, --scale, --log, --color-bar, --edges, --contours, --points-overlay, --stamp and
/// --enlarge.
void add_picture_options(Command& command, PictureOptions& options);

/// For a command line that asks for no picture. Throws UsageError if one of the options above was given, and
/// says that it is of use with `files`.
void refuse_picture_options(const Command& command, const std::string& files);

/// Adds --slice, for the subcommands that draw volumes.
void add_slice_option(Command& command, PictureOptions& options);

/// Throws UsageError unless there is a slice of a volume of these sides where there is a picture, and none
/// where there is none, and for options of pictures that slices do not have.
void check_slice(const PictureOptions& options, const std::string& picture_path, const Grid& volume);

/// Throws UsageError for options that contradict each other.
void check_picture_options(const PictureOptions& options);

/// Throws UsageError if pictures of diagrams of this size would be too large.
void check_picture_size(const PictureOptions& options, const Size& size);

/// "LOW,HIGH" or "LOW%,HIGH%" to the ends of a scale. Throws Error unless these are two finite numbers, LOW <
/// HIGH, and percentages from 0 to 100.
ScaleEnds parse_scale(const std::string& text);

/// Adds the option of a file, which must stay where it is. If `numbered`, its path is a pattern for one file
/// per frame.
Option add_file_option(Command& command, FileRequest& request, bool numbered = false);

/// Adds --cell-columns, for the request of a table of cells, which --cells has been added for.
void add_cell_columns_option(Command& command, FileRequest& cells);

/// Adds -o, with a help text and the name of its value, --fps and how pictures are drawn.
void add_film_options(Command& command, FrameWriterOptions& options, const std::string& value_name,
                      const std::string& about);
/// Throws UsageError for options of pictures without one, and for --fps without a film.
void check_film_options(const Command& command, const FrameWriterOptions& options);

/// Adds all that, the numbered files, --similarity, --statistics and --every.
void add_frame_writer_options(Command& command, FrameWriterOptions& options);

}  // namespace vorocl::command
