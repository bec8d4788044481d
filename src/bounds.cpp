#include "vorocl/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "vorocl/error.hpp"

namespace vorocl {

namespace {

[[noreturn]] void refuse(const Bounds& bounds, const std::string& why) {
  std::ostringstream text;
  text << "the bounds " << bounds.x0 << "," << bounds.y0 << "," << bounds.x1 << "," << bounds.y1 << " "
       << why;
  throw Error(text.str());
}

/// A scale in pixels per unit and in units per grid; an axis without extent needs none.
bool has_scale(double extent) {
  return extent == 0 || (std::isfinite(extent * Grid::max_side) && std::isfinite(Grid::max_side / extent));
}

/// Written in the order of operations that is documented, so that rounding is the same everywhere.
int pixel(double value, double low, double high, int count, bool periodic) {
  const double extent = high - low;
  if (extent == 0) return count / 2;
  double offset = value - low;
  if (periodic) {
    offset = std::fmod(offset, extent);
    if (offset < 0) offset += extent;
  }
  const double position = std::floor(offset * count / extent);
  return static_cast<int>(std::min(std::max(0.0, position), count - 1.0));
}

bool is_outside(double value, double low, double high, bool periodic) {
  return !periodic && (value < low || value > high);
}

}  // namespace

void check_bounds(const Bounds& bounds, const Grid& grid) {
  const double width = bounds.x1 - bounds.x0, height = bounds.y1 - bounds.y0;
  // Written so that a NaN fails.
  if (!(width >= 0 && height >= 0)) refuse(bounds, "must be numbers x0 <= x1 and y0 <= y1");
  if (!has_scale(width) || !has_scale(height))
    refuse(bounds, "are too far apart, or too near, to compute with");
  if (grid.periodic_x() && width == 0) refuse(bounds, "have no extent in x, which is to be periodic");
  if (grid.periodic_y() && height == 0) refuse(bounds, "have no extent in y, which is to be periodic");
}

std::optional<Point> to_pixel(const Point& point, const Bounds& bounds, const Grid& grid, bool y_up) {
  if (is_outside(point.x, bounds.x0, bounds.x1, grid.periodic_x()) ||
      is_outside(point.y, bounds.y0, bounds.y1, grid.periodic_y())) {
    return std::nullopt;
  }
  const int column = pixel(point.x, bounds.x0, bounds.x1, grid.width(), grid.periodic_x());
  const int row = pixel(point.y, bounds.y0, bounds.y1, grid.height(), grid.periodic_y());
  return Point{column + 0.5, (y_up ? grid.height() - 1 - row : row) + 0.5};
}

}  // namespace vorocl
