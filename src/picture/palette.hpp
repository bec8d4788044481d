// What all pictures share: their colours, those of values too, and their type.
#pragma once

#include <opencv2/core.hpp>

#include "vorocl/picture.hpp"

namespace vorocl {

const cv::Vec3b black(0, 0, 0);  // no_label
const cv::Vec3b dark(32, 28, 26);
const cv::Vec3b light(250, 250, 250);
const cv::Vec3b absent_grey(214, 214, 214);

/// Throws Error unless low <= high, these and their difference are finite, and the low end of a logarithmic
/// scale is above 0.
void check_scale(const Scale& scale);

/// Throws Error unless the picture is CV_8UC3.
void check_picture(const cv::Mat& picture);

/// Where a value lies on a scale: 0 at its low end, 1 at its high one, and 0.5 on a scale without extent.
double part_of(double value, const Scale& scale);

/// The value at a part of a scale.
double value_at(double part, const Scale& scale);

/// A palette laid over a scale.
class Colors {
 public:
  /// Throws Error for a bad scale, and for a logarithmic one with a categorical palette.
  Colors(const Scale& scale, Palette palette);

  /// Values beyond the scale have the colours of its ends; NaN, and what has no logarithm on a logarithmic
  /// scale, is light grey.
  cv::Vec3b operator()(double value) const;

 private:
  Scale scale_;
  bool categorical_;
  cv::Mat_<cv::Vec3b> table_;
};

/// One of the palette's colours, by the remainder.
cv::Vec3b categorical_color(std::uint32_t number);

}  // namespace vorocl
