// The words that every part of the library uses: point, grid, label, metric, neighbourhood.
#pragma once

#include <cstddef>
#include <cstdint>

#include "vorocl/export.h"

namespace vorocl {

/// The label of a pixel that has no nearest seed (there are no seeds, or no wave reached it).
constexpr std::uint32_t no_label = 0xffffffffu;

/// A position in pixel units: pixel i of an axis covers [i, i + 1), its centre is i + 0.5; y points down.
/// A seed is snapped to the pixel that contains it, which limits its accuracy to half a pixel.
struct Point {
  double x = 0;
  double y = 0;
};

/// How far apart two pixel centres are, computed in integers on every device.
enum class Metric {
  euclidean,  ///< L2 (compared as dx * dx + dy * dy)
  manhattan,  ///< L1: |dx| + |dy|
};

/// Which pixels a wave looks at besides the pixel itself.
enum class Neighbourhood {
  moore,        ///< the 8 neighbours at the step
  von_neumann,  ///< the 4 neighbours at the step that share a row or a column with it
};

/// Which axes of a grid are periodic. The grid is then one period of a plane that repeats along them:
/// distances go the shorter way round, and cells reach across the border.
enum class Periodic { none, x, y, xy };

/// Whether x, or y, is among the periodic axes.
constexpr bool has_x(Periodic axes) { return axes == Periodic::x || axes == Periodic::xy; }
constexpr bool has_y(Periodic axes) { return axes == Periodic::y || axes == Periodic::xy; }

/// The size of a diagram in pixels, row-major, (0, 0) at the top left, and which of its axes are periodic.
class VOROCL_API Grid {
 public:
  static constexpr int max_side = 32768;    ///< past it a squared distance leaves 31 bits
  static constexpr int max_period = 32000;  ///< the longest side along a periodic axis
  static constexpr std::size_t max_pixels = 1u << 30;

  /// Throws Error unless both sides are in [1, max_side], those along periodic axes in [1, max_period], and
  /// width * height is at most max_pixels.
  Grid(std::int64_t width, std::int64_t height, Periodic periodic = Periodic::none);

  int width() const { return width_; }
  int height() const { return height_; }
  Periodic periodic() const { return periodic_; }
  bool periodic_x() const { return has_x(periodic_); }
  bool periodic_y() const { return has_y(periodic_); }
  int longest_side() const { return width_ > height_ ? width_ : height_; }
  bool holds(const Point& point) const {
    return point.x >= 0 && point.x < width_ && point.y >= 0 && point.y < height_;
  }
  std::size_t pixels() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }

  friend bool operator==(const Grid& a, const Grid& b) {
    return a.width_ == b.width_ && a.height_ == b.height_ && a.periodic_ == b.periodic_;
  }
  friend bool operator!=(const Grid& a, const Grid& b) { return !(a == b); }

 private:
  int width_;
  int height_;
  Periodic periodic_;
};

/// The size of a plane in pixels, (0, 0) at the top left, and which of its axes are periodic. It may be far
/// larger than a Grid, for nothing ever holds all of it.
class VOROCL_API Plane {
 public:
  static constexpr std::int64_t max_side = 2147483647;  ///< past it a squared distance leaves 63 bits

  /// Throws Error unless both sides are in [1, max_side].
  Plane(std::int64_t width, std::int64_t height, Periodic periodic = Periodic::none);

  /// That of a grid.
  Plane(const Grid& grid) : width_(grid.width()), height_(grid.height()), periodic_(grid.periodic()) {}

  std::int64_t width() const { return width_; }
  std::int64_t height() const { return height_; }
  Periodic periodic() const { return periodic_; }
  std::uint64_t pixels() const {
    return static_cast<std::uint64_t>(width_) * static_cast<std::uint64_t>(height_);
  }

 private:
  std::int64_t width_, height_;
  Periodic periodic_;
};

/// The rectangle in which the plane repeats along its periodic axes, where the grid is not one period itself:
/// the box of a simulation of which the grid is a part, or that lies in a larger grid. In whole pixels from
/// the grid's first one; x and y may be negative. An axis that is not periodic has no end.
struct Domain {
  std::int64_t x = 0, y = 0;           ///< the first pixel
  std::int64_t width = 1, height = 1;  ///< the periods, 1 to 2^31
  Periodic periodic = Periodic::none;
};

}  // namespace vorocl
