#include "app/sources/mapping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/sources/bounds.hpp"
#include "app/sources/placed_axis.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

constexpr double plane_side = 2147483648.0;  // 2^31

/// Both axes of the data, in the picture.
struct PlacedAxes {
  PlacedAxis x, y;
};

std::optional<double> if_is(bool is_end, double at) { return is_end ? std::optional(at) : std::nullopt; }

PlacedAxes place_axes(const Mapping& mapping, const Size& picture) {
  const Bounds& bounds = mapping.bounds;
  check_bounds(bounds);
  PlacedAxes axes = {{bounds.x0, bounds.x1, picture.width(), mapping.closed, false},
                     {bounds.y0, bounds.y1, picture.height(), mapping.closed, mapping.y_up}};
  const Bounds domain = mapping.domain.value_or(bounds);
  const Ends& ends = mapping.ends;
  if (has_x(mapping.periodic)) {
    axes.x.repeat(domain.x0, domain.x1, "x");
  } else if (mapping.domain) {
    axes.x.end_at(if_is(ends.x0, domain.x0), if_is(ends.x1, domain.x1));
  }
  if (has_y(mapping.periodic)) {
    axes.y.repeat(domain.y0, domain.y1, "y");
  } else if (mapping.domain) {
    axes.y.end_at(if_is(ends.y0, domain.y0), if_is(ends.y1, domain.y1));
  }
  return axes;
}

/// The picture in the data; where y points down, at negative y.
Raster raster_of(const Mapping& mapping, const Size& picture) {
  const Bounds& bounds = mapping.bounds;
  if (mapping.in_pixels || bounds.x0 == bounds.x1 || bounds.y0 == bounds.y1) return picture;
  return {picture, {bounds, mapping.y_up, mapping.crs}};
}

Units units_of(const Mapping& mapping, const PlacedAxes& axes, const Size& picture) {
  if (mapping.in_pixels) return {};
  return {axes.x.scale(), axes.y.scale(),
          mapping.has_one_scale && has_square_pixels(mapping.bounds, picture.grid())};
}

/// The diagram is all of its grid where the picture shows that, with all points, else what the picture shows.
View view_of(const Mapping& mapping, const PlacedAxes& axes, const Size& picture, bool holds_all) {
  Stretch x = axes.x.shown(), y = axes.y.shown();
  if (x.length == 0 || y.length == 0) {
    throw Error("the box " + to_string(*mapping.domain) + " lies outside the bounds " +
                to_string(mapping.bounds) + "; give --bounds that hold a part of it");
  }
  const Stretch grid_x = axes.x.grid(), grid_y = axes.y.grid();
  if (holds_all && grid_x.is_within(picture.width()) && grid_y.is_within(picture.height())) {
    x = grid_x;
    y = grid_y;
  }
  const double tilt = mapping.tilt == 0 ? 0 : mapping.tilt / axes.x.scale().side_of_pixel();
  const Grid grid = Grid(grid_x.length, grid_y.length, mapping.periodic).tilted(mapping.y_up ? -tilt : tilt);
  const std::int64_t first_x = grid_x.begin - x.begin, first_y = grid_y.begin - y.begin;
  return {raster_of(mapping, picture),
          Window(grid, -first_x, -first_y, x.length, y.length),
          static_cast<int>(x.begin),
          static_cast<int>(y.begin),
          first_x,
          first_y,
          units_of(mapping, axes, picture)};
}

}  // namespace

MappedPoints map_points(const std::vector<Point>& points, const Mapping& mapping, const Size& picture,
                        const std::vector<std::uint32_t>& ids) {
  const Bounds& bounds = mapping.bounds;
  const PlacedAxes axes = place_axes(mapping, picture);
  std::vector<Point> places;
  places.reserve(points.size());
  std::size_t outside = 0;
  for (const Point& point : points) {
    const auto refuse = [&](const std::string& why) {
      const std::string name = ids.empty() ? fmt::format("point {}", places.size())
                                           : fmt::format("particle {}", ids.at(places.size()));
      throw Error(fmt::format("{} at ({}, {}) is {}", name, point.x, point.y, why));
    };
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) refuse("not finite");
    const double x = point.x - (mapping.tilt == 0 ? 0 : mapping.tilt * axes.y.periods_beyond(point.y));
    Point place = {axes.x.place(x, mapping.snap), axes.y.place(point.y, mapping.snap)};
    if (std::max(std::abs(place.x), std::abs(place.y)) >= plane_side - Size::max_side) {
      refuse("2^31 pixels or more away from the bounds " + to_string(bounds));
    }
    place = {axes.x.held(place.x, mapping.snap), axes.y.held(place.y, mapping.snap)};
    const bool inside = picture.holds(place);
    if (mapping.outside == Outside::refuse &&
        (!inside || axes.x.is_outside(point.x) || axes.y.is_outside(point.y))) {
      refuse("outside the bounds " + to_string(bounds) + "; give --bounds that hold it");
    }
    outside += inside ? 0 : 1;
    places.push_back(place);
  }
  const Stretch x = axes.x.grid(), y = axes.y.grid();
  for (Point& place : places) {
    place.x -= static_cast<double>(x.begin);
    place.y -= static_cast<double>(y.begin);
  }
  return {view_of(mapping, axes, picture, outside == 0), std::move(places), outside};
}

}  // namespace vorocl::command
