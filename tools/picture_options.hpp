// How a diagram is drawn: the options, the picture they ask for, and its file.
#pragma once

#include <CLI/CLI.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "label_image.hpp"
#include "vorocl/picture.hpp"

namespace vorocl::command {

enum class Coloring { id, distance };

struct PictureOptions {
  Coloring color = Coloring::id;
  std::optional<Palette> palette;
  bool edges = false;
  bool points_overlay = false;
};

/// Adds --color, --palette, --edges and --points-overlay, which are of use only with the option for the file.
void add_picture_options(CLI::App& app, PictureOptions& options, CLI::Option* file);

/// The extensions of files that a picture can go into.
const std::vector<std::string>& picture_extensions();

/// Throws UsageError for options that contradict each other.
void check_picture_options(const PictureOptions& options);

/// `seeds` holds the points by label, as Seeds::read() gives them; `named` is the image with the ids that
/// colours go by.
cv::Mat draw(const LabelImage& image, const LabelImage& named, const std::vector<Point>& seeds, Metric metric,
             const PictureOptions& options);

/// Throws Error if the file cannot be written.
void write_picture(const std::string& path, const cv::Mat& picture);

}  // namespace vorocl::command
