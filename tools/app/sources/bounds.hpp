// The bounds of the data: read, written, and chosen where none are given.
#pragma once

#include <string>
#include <vector>

#include "vorocl/bounds.hpp"

namespace vorocl::command {

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

/// The centres of the pixels that hold the points: see to_pixel(). Throws Error that names the first point
/// that is not finite or outside the bounds, and for bounds that check_bounds() refuses.
std::vector<Point> to_pixels(const std::vector<Point>& points, const Bounds& bounds, const Grid& grid,
                             bool y_up);

}  // namespace vorocl::command
