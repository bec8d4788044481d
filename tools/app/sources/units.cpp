#include "app/sources/units.hpp"

#include <cmath>

namespace vorocl::command {

Units::Units(double pixel_width, double pixel_height, bool square) {
  if (pixel_width == 0 || pixel_height == 0) return;
  area_ = pixel_width * pixel_height;
  area_in_data_ = true;
  if (!square) return;
  length_ = std::sqrt(area_);  // the sides differ by the rounding of the picture's height alone
  length_in_data_ = true;
}

std::vector<float> Units::lengths(std::vector<float> pixels) const {
  if (!length_in_data_) return pixels;
  for (float& length : pixels) length = static_cast<float>(this->length(static_cast<double>(length)));
  return pixels;
}

}  // namespace vorocl::command
