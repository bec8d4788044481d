// The map from the data's plane to pixels.
#pragma once

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

/// The centre of the pixel that holds a point, which must be finite: column floor((x - x0) * W / (x1 - x0)),
/// the last one for x1 itself, the middle one where x1 = x0; rows likewise, or counted from the bottom if
/// `y_up`. Along an axis of the grid that is periodic the bounds are the period, and points wrap: x1 is x0
/// again. None for a point outside the bounds. The bounds must have passed check_bounds().
VOROCL_API std::optional<Point> to_pixel(const Point& point, const Bounds& bounds, const Grid& grid,
                                         bool y_up);

}  // namespace vorocl
