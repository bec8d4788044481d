// What a pixel is in the units of the data: the one place that knows the scale of what is measured.
#pragma once

#include <vector>

namespace vorocl::command {

/// Areas and lengths of pixels, in data units where there are bounds. A length has a scale only where pixels
/// are squares: elsewhere lengths stay in pixels.
class Units {
 public:
  /// Pixels.
  Units() = default;

  /// The sides of a pixel in data units; one of 0, of an axis without an extent, has no scale.
  Units(double pixel_width, double pixel_height, bool square);

  double area(double pixels) const { return pixels * area_; }
  double length(double pixels) const { return pixels * length_; }
  std::vector<float> lengths(std::vector<float> pixels) const;

  /// "data" or "px".
  const char* of_area() const { return area_in_data_ ? "data" : "px"; }
  const char* of_length() const { return length_in_data_ ? "data" : "px"; }

  /// The same as titles have them: "data units^2", "px".
  const char* area_title() const { return area_in_data_ ? "data units^2" : "px"; }
  const char* length_title() const { return length_in_data_ ? "data units" : "px"; }

 private:
  double area_ = 1, length_ = 1;
  bool area_in_data_ = false, length_in_data_ = false;
};

}  // namespace vorocl::command
