// The bounds of the data: read, written, and chosen where none are given.
#pragma once

#include <string>
#include <vector>

#include "vorocl/bounds.hpp"

namespace vorocl::command {

/// "X0,Y0,X1,Y1" to bounds. Throws Error unless these are four finite numbers with X0 < X1 and Y0 < Y1.
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

/// Says on standard error how many points lie outside the bounds, if some do.
void note_outside(std::size_t outside, std::size_t points, const Bounds& bounds);

/// What becomes of points outside the bounds.
enum class Outside {
  count,  ///< they are seeds as others, and own the pixels that are nearest to them
  refuse
};

/// How points of the data become seeds.
struct Mapping {
  Bounds bounds;
  bool closed = true;  ///< a point at x1 or y1 falls in the last pixel: for bounds that the points made
  bool y_up = false;
  Outside outside = Outside::count;
  Periodic periodic = Periodic::none;
  std::optional<Bounds> period;  ///< the rectangle that repeats along the periodic axes; else the bounds
};

/// Points in pixels, and where the plane repeats if the grid does not say it.
struct MappedPoints {
  std::vector<Point> pixels;
  std::optional<Domain> domain;
  std::size_t outside = 0;  ///< points in no pixel of the grid
};

/// Whether the bounds are a whole period, to whole pixels: then a grid of this size may have the periodic
/// axes itself.
bool is_whole_period(const Mapping& mapping, const Grid& grid);

/// The centres of the pixels that hold the points: column floor((x - x0) * W / (x1 - x0)); rows likewise, or
/// counted from the bottom if `y_up`. Along a periodic axis points wrap, and a period is a whole number of
/// pixels. The grid is periodic itself, or has a domain. Throws Error that names the first point that is not
/// finite, is 2^31 pixels away or is outside where that is refused, for a period of less than a pixel or than
/// the bounds, and for bounds that check_bounds() refuses.
MappedPoints map_points(const std::vector<Point>& points, const Mapping& mapping, const Grid& grid);

}  // namespace vorocl::command
