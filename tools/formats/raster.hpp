// Images on the host, as files hold them: labels, and where the pixels lie in the data.
#pragma once

#include <cstdint>
#include <vector>

#include "vorocl/grid.hpp"

namespace vorocl::command {

/// An image of labels.
struct LabelImage {
  Grid grid;
  std::vector<std::uint32_t> labels;  // row-major
};

/// The image with ids[label] for each label; without ids as it is. no_label stays.
inline LabelImage with_ids(LabelImage image, const std::vector<std::uint32_t>& ids) {
  if (ids.empty()) return image;
  for (std::uint32_t& label : image.labels) {
    if (label != no_label) label = ids.at(label);
  }
  return image;
}

/// The pixels of an image file, and where they lie in the data.
struct Raster {
  /// Of data in pixels, where y = 0 is at the bottom.
  Raster(const Grid& pixels) : grid(pixels) {}
  Raster(const Grid& pixels, const Point& lower_left, const Point& sides_of_pixel)
      : grid(pixels), corner(lower_left), pixel(sides_of_pixel) {}

  Grid grid;
  Point corner = {0, 0};  ///< the lower left one, where y points up
  Point pixel = {1, 1};   ///< the sides of a pixel
};

}  // namespace vorocl::command
