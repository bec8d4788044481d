// The pixels of an image file, and where they lie in the data.
#pragma once

#include "vorocl/grid.hpp"

namespace vorocl::command {

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
