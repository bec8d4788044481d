// The pixels that kernels run over: a diagram's, or a part of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

#include "vorocl/grid.hpp"

namespace vorocl {

/// Rows of pixels, and along which axes their ends meet. Kernels are built for the periodic axes, and for
/// vectors no longer than a row.
class PixelGrid {
 public:
  PixelGrid(int width, int height, Periodic periodic = Periodic::none)
      : width_(width), height_(height), periodic_(periodic) {}

  /// Those of a diagram's window. Throws Error if it is larger than a diagram can be.
  explicit PixelGrid(const Window& window);

  /// The same pixels, and no ends that meet.
  PixelGrid without_periods() const { return {width_, height_}; }

  int width() const { return width_; }
  int height() const { return height_; }
  Periodic periodic() const { return periodic_; }
  bool periodic_x() const { return has_x(periodic_); }
  bool periodic_y() const { return has_y(periodic_); }
  int longest_side() const { return std::max(width_, height_); }
  std::size_t pixels() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }

  friend bool operator==(const PixelGrid& a, const PixelGrid& b) {
    return a.width_ == b.width_ && a.height_ == b.height_ && a.periodic_ == b.periodic_;
  }
  friend bool operator!=(const PixelGrid& a, const PixelGrid& b) { return !(a == b); }

 private:
  int width_, height_;
  Periodic periodic_;
};

/// Whether a diagram can show all of a grid.
bool fits_in_a_diagram(const Grid& grid);

/// Throws Error if a grid is tilted, for something ("flooding") that does not know how such grids repeat.
void refuse_tilted(const Grid& grid, const char* what);

/// "640 x 480, periodic in x".
std::string size_text(const PixelGrid& pixels);

}  // namespace vorocl
