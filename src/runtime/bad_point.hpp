// The usual complaints about a point. In a header, for libraries beside the core too.
#pragma once

#include <cmath>
#include <string>

#include "vorocl/error.hpp"
#include "vorocl/grid.hpp"

namespace vorocl {

/// "point 7 (nan, 3) is not finite" or else; and what it must be.
inline BadPoint point_that_is(std::size_t index, const Point& point, const char* otherwise,
                              const std::string& rule) {
  const bool finite = std::isfinite(point.x) && std::isfinite(point.y);
  return BadPoint(index, point, std::string("is ") + (finite ? otherwise : "not finite") + "; " + rule);
}

inline BadPoint point_too_far(std::size_t index, const Point& point) {
  return point_that_is(index, point, "too far away",
                       "x and y must be less than 2^31 pixels from all pixels of the grid");
}

inline BadPoint point_outside(const Grid& grid, std::size_t index, const Point& point) {
  return point_that_is(index, point, "outside the grid",
                       "x must be in [0, " + std::to_string(grid.width()) + ") and y in [0, " +
                           std::to_string(grid.height()) + ")");
}

}  // namespace vorocl
