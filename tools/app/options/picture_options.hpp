// How diagrams are drawn: the options, and a picture's file.
#pragma once

#include <CLI/CLI.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vorocl/picture.hpp"

namespace vorocl::command {

/// What the colour of a pixel shows.
enum class Quantity { id, distance, area, neighbours, column };

struct Coloring {
  Quantity quantity = Quantity::id;
  std::string column;  // its name; empty for the other quantities
};

struct PictureOptions {
  Coloring color;
  std::optional<Palette> palette;
  std::optional<Scale> scale;
  bool color_bar = false;
  int edge_width = 0;  // 0: no edges
  bool contours = false;
  std::optional<double> contour_interval;  // none: a round one
  bool points_overlay = false;
  int enlargement = 1;  // the sides of a pixel's square in the picture
};

/// Adds --color, --palette, --scale, --color-bar, --edges, --contours, --points-overlay and --enlarge.
void add_picture_options(CLI::App& app, PictureOptions& options);

/// For a command line that asks for no picture. Throws UsageError if one of the options above was given, and
/// says that it is of use with `files`.
void refuse_picture_options(const CLI::App& app, const std::string& files);

/// The extensions of files that a picture can go into.
const std::vector<std::string>& picture_extensions();

/// Throws UsageError for options that contradict each other.
void check_picture_options(const PictureOptions& options);

/// Throws UsageError if the pictures of a grid would be too large.
void check_picture_size(const PictureOptions& options, const Grid& grid);

/// "LOW,HIGH" to a scale. Throws Error unless these are two finite numbers, LOW < HIGH.
Scale parse_scale(const std::string& text);

/// Throws Error if the file cannot be written.
void write_picture(const std::string& path, const cv::Mat& picture);

}  // namespace vorocl::command
