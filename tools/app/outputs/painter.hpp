// Draws diagrams.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/outputs/measures.hpp"
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

/// Makes one picture, or those of a film: then they share scale and contours, and have one size.
class Painter {
 public:
  /// Of many, later ones may have values beyond the scale of the first: the colour bar says so.
  explicit Painter(const PictureOptions& options, bool many = false);

  /// `values` are those of the value column, by label; NaN: absent. Throws Error if the options ask for
  /// a scale or colours that the values do not allow.
  cv::Mat draw(Measures& measures, const std::vector<double>& values);

  /// Whether the next picture would be the same without those that were drawn before.
  bool is_independent() const;

 private:
  cv::Mat color(Measures& measures, const std::vector<double>& values);
  cv::Mat color_by_values(const LabelImage& image, const std::vector<double>& values);
  /// The scale of all pictures: the option's, or else the range of the first that has one.
  Scale scale(const std::optional<Scale>& range);
  void draw_contour_lines(cv::Mat& picture, const std::vector<float>& distances, Periodic axes);

  PictureOptions options_;
  bool many_;
  Palette palette_;
  std::optional<Scale> scale_;
  std::optional<bool> whole_values_;  // whether those of the first picture are
  std::optional<double> contour_interval_;
};

}  // namespace vorocl::command
