// The map from data units to pixels.
#pragma once

#include <string>
#include <vector>

#include "vorocl/grid.hpp"

namespace vorocl::command {

/// The rectangle of the data plane that the grid shows; x1 and y1 belong to it.
struct Bounds {
  double x0 = 0;
  double y0 = 0;
  double x1 = 0;
  double y1 = 0;
};

/// "X0,Y0,X1,Y1" to bounds. Throws Error unless these are four finite numbers with X0 <= X1 and Y0 <= Y1.
Bounds parse_bounds(const std::string& text);

std::string to_string(const Bounds& bounds);

/// The least bounds that hold all points (at least one). Throws Error if one is not finite.
Bounds bounding_box(const std::vector<Point>& points);

/// The grid of this width whose pixels are square in data units, to the nearest whole height. Throws Error if
/// the bounds have no width or the grid is not possible.
Grid grid_of_width(const Bounds& bounds, int width, Periodic periodic = Periodic::none);

/// True if a pixel is a square in data units, to the nearest whole number of pixels. If not, the seed that is
/// nearest in pixels need not be the nearest in the data. An axis without extent has no scale.
bool has_square_pixels(const Bounds& bounds, const Grid& grid);

/// Warns on standard error unless pixels are square.
void warn_of_scales(const Bounds& bounds, const Grid& grid);

/// The centres of the pixels that hold the points: column floor((x - x0) * W / (x1 - x0)), the last one for
/// x1 itself, the middle one where x1 = x0; rows likewise, or counted from the bottom if `y_up`. Along an
/// axis of the grid that is periodic the bounds are the period, and points wrap: x1 is x0 again. Throws Error
/// that names the first point that is not finite or outside the bounds, if a period is 0, and for bounds so
/// far apart, or so near, that double has no scale for them.
std::vector<Point> to_pixels(const std::vector<Point>& points, const Bounds& bounds, const Grid& grid,
                             bool y_up);

}  // namespace vorocl::command
