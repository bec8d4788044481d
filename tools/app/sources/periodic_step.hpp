// How far a particle has moved where the box is periodic.
#pragma once

#include "app/sources/bounds.hpp"
#include "formats/trajectory/trajectory.hpp"

namespace vorocl::command {

/// A box's periods in pixels; 0 along an axis that is not periodic.
struct Periods {
  double x = 0;
  double y = 0;
  double tilt = 0;  ///< how far the copy of the box below (at a greater row) is shifted in x
};

Periods periods_in_pixels(const Box& box, const Bounds& bounds, const Grid& grid, bool y_up);

/// How far apart two positions are along the axis where they are farther apart, by the shortest way round.
double displacement(const Point& from, const Point& to, const Periods& periods);

}  // namespace vorocl::command
