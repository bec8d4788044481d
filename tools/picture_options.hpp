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
};

/// Adds --color, --palette, --scale, --color-bar, --edges, --contours and --points-overlay, which are of use
/// only with the option for the file.
void add_picture_options(CLI::App& app, PictureOptions& options, CLI::Option* file);

/// The extensions of files that a picture can go into.
const std::vector<std::string>& picture_extensions();

/// Throws UsageError for options that contradict each other.
void check_picture_options(const PictureOptions& options);

/// "LOW,HIGH" to a scale. Throws Error unless these are two finite numbers, LOW < HIGH.
Scale parse_scale(const std::string& text);

/// Throws Error if the file cannot be written.
void write_picture(const std::string& path, const cv::Mat& picture);

}  // namespace vorocl::command
