// The map from the data's plane to pixels.
#pragma once

#include <cstdint>
#include <optional>

#include "vorocl/export.h"
#include "vorocl/grid.hpp"

namespace vorocl {

/// The rectangle of the data's plane that the grid shows; x1 and y1 belong to it.
struct Bounds {
  double x0 = 0;
  double y0 = 0;
  double x1 = 0;
  double y1 = 0;
};

/// Throws Error unless the bounds are finite, with x0 <= x1 and y0 <= y1, have an extent along the grid's
/// periodic axes, and are neither so far apart nor so near that double has no scale for them.
VOROCL_API void check_bounds(const Bounds& bounds, const Grid& grid);

/// The map of one axis from data to pixels: the column (or row) of x is floor((x - low) * count / (high -
/// low)), in this order of operations, so that rounding is the same everywhere. It may lie outside the grid.
class VOROCL_API AxisMap {
 public:
  /// The bounds along the axis, low <= high, and the pixels. If `closed`, a point at `high` falls in the last
  /// pixel. Without an extent, points at `low` fall in the middle one.
  AxisMap(double low, double high, int count, bool closed);

  /// Makes the axis periodic: coordinates wrap. A period may begin anywhere: where it covers as many pixels
  /// as the bounds and does not hold them, or holds nothing of them, it begins with them. Throws Error, which
  /// names the axis so, if it is shorter than half a pixel.
  void repeat(double period_low, double period_high, const char* name);

  /// Whether a coordinate is outside the bounds; never along a periodic axis.
  bool is_outside(double at) const;

  /// The pixel of a finite coordinate, a whole number.
  double pixel(double at) const;

  /// The period's first pixel and how many it has, rounded to whole ones; those of the grid without a period.
  std::int64_t period_begin() const;
  std::int64_t period_length() const;

 private:
  double scale() const;

  double low_, high_;
  int count_;
  bool closed_;
  double period_low_ = 0;
  std::optional<double> period_;
};

/// The centre of the pixel that holds a point, which must be finite: column floor((x - x0) * W / (x1 - x0)),
/// the last one for x1 itself, the middle one where x1 = x0; rows likewise, or counted from the bottom if
/// `y_up`. Along an axis of the grid that is periodic the bounds are the period, and points wrap: x1 is x0
/// again. None for a point outside the bounds. The bounds must have passed check_bounds().
VOROCL_API std::optional<Point> to_pixel(const Point& point, const Bounds& bounds, const Grid& grid,
                                         bool y_up);

}  // namespace vorocl
