// Which pixel of a grid a point's seed lies in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/outer_seeds.hpp"
#include "vorocl/error.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

/// Snaps points to the pixels of a grid, by its axes.
class Snapping {
 public:
  Snapping(const Grid& grid, Outside outside) : grid_(grid), outside_(outside) {}

  /// Whether a pixel is one of the grid's.
  bool is_inside(const PlanePosition& at) const {
    return at.s[0] >= 0 && at.s[0] < grid_.width() && at.s[1] >= 0 && at.s[1] < grid_.height();
  }

  /// The pixel of a point, counted from the grid's first one; absent_coordinate if it is outside and such
  /// seeds are absent. Throws BadPoint for a point that is not finite, too far away, or outside where that is
  /// refused.
  PlanePosition operator()(std::size_t id, const Point& point) const {
    const PlanePosition at = {{along(grid_.x(), id, point, point.x), along(grid_.y(), id, point, point.y)}};
    if (outside_ == Outside::count || is_inside(at)) return at;
    if (outside_ == Outside::refuse) throw outside_the_grid(id, point, grid_);
    return {{absent_coordinate, 0}};
  }

  /// "point 7 (nan, 3) is outside the grid; ...", or not finite.
  static BadPoint outside_the_grid(std::size_t id, const Point& point, const Grid& grid);

 private:
  cl_int along(const Axis& axis, std::size_t id, const Point& point, double coordinate) const {
    const double pixel = axis.pixel(coordinate);
    // Written so that a NaN fails.
    if (!(pixel >= static_cast<double>(axis.pixels()) - 2147483648.0 && pixel < 2147483648.0))
      fail(id, point);
    return static_cast<cl_int>(pixel);
  }

  /// Throws BadPoint for a point that is not finite or too far away.
  [[noreturn]] static void fail(std::size_t id, const Point& point);

  Grid grid_;
  Outside outside_;
};

}  // namespace vorocl
