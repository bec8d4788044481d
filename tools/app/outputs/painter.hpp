// Draws diagrams as the options say.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "app/options/picture_options.hpp"
#include "app/outputs/measures.hpp"

namespace vorocl::command {

/// Makes one picture, or those of a film: then they share scale and contours, and have one size.
class Painter {
 public:
  /// Of many, later ones may have values beyond the scale of the first: the colour bar says so.
  explicit Painter(const PictureOptions& options, bool many = false);

  /// `values` are those of the value column, by label; NaN: absent. Throws Error where the options ask for
  /// what there is not.
  cv::Mat draw(Analysis& analysis, const std::vector<double>& values);

 private:
  cv::Mat color(Analysis& analysis, const std::vector<double>& values);
  cv::Mat color_by_values(const LabelImage& image, const std::vector<double>& values);
  /// The scale of all pictures: the option's, or else the range of the first that has one.
  Scale scale(const std::optional<Scale>& range);
  void draw_contour_lines(cv::Mat& picture, const std::vector<float>& distances);

  PictureOptions options_;
  bool many_;
  Palette palette_;
  std::optional<Scale> scale_;
  std::optional<bool> whole_values_;  // whether those of the first picture are
  std::optional<double> contour_interval_;
};

}  // namespace vorocl::command
