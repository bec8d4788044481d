#include "core/snapping.hpp"

#include <cmath>
#include <sstream>

namespace vorocl {

namespace {

/// What is bad about a point that is not finite, or else.
std::string complaint(const Point& point, const char* otherwise) {
  return std::string("is ") + (std::isfinite(point.x) && std::isfinite(point.y) ? otherwise : "not finite");
}

std::string range_text(const Axis& axis, const char* name) {
  std::ostringstream text;
  text << name << "[" << axis.from() << ", " << axis.to() << (axis.is_closed() ? "]" : ")");
  return text.str();
}

}  // namespace

BadPoint Snapping::outside_the_grid(std::size_t id, const Point& point, const Grid& grid) {
  return {id, point,
          complaint(point, "outside the grid") + "; " + range_text(grid.x(), "x must be in ") + " and " +
              range_text(grid.y(), "y in ")};
}

void Snapping::fail(std::size_t id, const Point& point) {
  throw BadPoint(id, point,
                 complaint(point, "too far away") +
                     "; x and y must be less than 2^31 pixels from all pixels of the grid");
}

}  // namespace vorocl
