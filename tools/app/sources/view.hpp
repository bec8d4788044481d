// How the diagram of a frame stands in the picture and in the data.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "app/sources/units.hpp"
#include "formats/raster.hpp"

namespace vorocl::command {

/// A diagram has the pixels of the picture in which there are labels: all of them, or those of a simulation
/// box.
struct View {
  Raster picture;    ///< what files and pictures show
  Grid grid;         ///< of the diagram
  int x = 0, y = 0;  ///< its first pixel in the picture
  Units units = {};

  bool fills_picture() const {
    return grid.width() == picture.grid.width() && grid.height() == picture.grid.height();
  }

  /// The picture of values by pixel of the diagram, with another value beyond them.
  template <typename T>
  std::vector<T> in_picture(const std::vector<T>& values, T beyond) const {
    if (fills_picture()) return values;
    const std::ptrdiff_t width = picture.grid.width();
    std::vector<T> result(picture.grid.pixels(), beyond);
    for (std::ptrdiff_t row = 0; row < grid.height(); ++row) {
      const auto first = values.begin() + row * grid.width();
      std::copy(first, first + grid.width(), result.begin() + (y + row) * width + x);
    }
    return result;
  }

  /// The diagram's part of values by pixel of the picture.
  template <typename T>
  std::vector<T> in_diagram(const std::vector<T>& values) const {
    if (fills_picture()) return values;
    const std::ptrdiff_t width = picture.grid.width();
    std::vector<T> result;
    result.reserve(grid.pixels());
    for (std::ptrdiff_t row = y; row < y + grid.height(); ++row) {
      const auto first = values.begin() + row * width + x;
      result.insert(result.end(), first, first + grid.width());
    }
    return result;
  }
};

}  // namespace vorocl::command
