#include "app/sources/mapping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "app/sources/bounds.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

constexpr double plane_side = 2147483648.0;  // 2^31

/// Where a domain ends along an axis, in pixels of the picture: beyond [begin, end) there is nothing.
struct Walls {
  double begin = -std::numeric_limits<double>::infinity(), end = std::numeric_limits<double>::infinity();
};

/// In the direction of the data. There is at least a pixel between them.
Walls walls_between(double low, double high, bool at_low, bool at_high, double first,
                    double pixels_per_unit) {
  Walls walls;
  if (at_low) walls.begin = std::round((low - first) * pixels_per_unit);
  if (at_high) walls.end = std::max(std::round((high - first) * pixels_per_unit), walls.begin + 1);
  return walls;
}

Walls walls_x(const Mapping& mapping, const Grid& picture) {
  const Bounds& bounds = mapping.bounds;
  if (!mapping.domain || has_x(mapping.periodic) || bounds.x0 == bounds.x1) return {};
  return walls_between(mapping.domain->x0, mapping.domain->x1, mapping.ends.x0, mapping.ends.x1, bounds.x0,
                       picture.width() / (bounds.x1 - bounds.x0));
}

Walls walls_y(const Mapping& mapping, const Grid& picture) {
  const Bounds& bounds = mapping.bounds;
  if (!mapping.domain || has_y(mapping.periodic) || bounds.y0 == bounds.y1) return {};
  const Walls walls = walls_between(mapping.domain->y0, mapping.domain->y1, mapping.ends.y0, mapping.ends.y1,
                                    bounds.y0, picture.height() / (bounds.y1 - bounds.y0));
  return mapping.y_up ? Walls{picture.height() - walls.end, picture.height() - walls.begin} : walls;
}

/// Rounding must not move a point on a wall beyond it.
double held(double at, const Walls& walls) { return std::clamp(at, walls.begin + 0.5, walls.end - 0.5); }

/// Pixels of the picture along an axis.
struct Stretch {
  std::int64_t begin, length;
};

Stretch between(const Walls& walls, int pixels) {
  const double begin = std::max(walls.begin, 0.0), end = std::min(walls.end, static_cast<double>(pixels));
  if (begin >= end) return {0, 0};
  return {static_cast<std::int64_t>(begin), static_cast<std::int64_t>(end - begin)};
}

bool is_within(const Stretch& period, int pixels) {
  return period.begin >= 0 && period.begin + period.length <= pixels;
}

double side_of_pixel(double extent, std::int64_t pixels) { return extent / static_cast<double>(pixels); }

/// The picture in the data; where y points down, at negative y.
Raster raster_of(const Mapping& mapping, const Grid& picture) {
  const Bounds& bounds = mapping.bounds;
  const Point pixel = {side_of_pixel(bounds.x1 - bounds.x0, picture.width()),
                       side_of_pixel(bounds.y1 - bounds.y0, picture.height())};
  if (mapping.in_pixels || pixel.x == 0 || pixel.y == 0) return picture;
  return {picture, {bounds.x0, mapping.y_up ? bounds.y0 : 0 - bounds.y1}, pixel};
}

/// A period is rounded to whole pixels, whose sides are a little longer or shorter then than elsewhere.
Units units_of(const Mapping& mapping, const std::optional<Domain>& period, const Grid& picture) {
  if (mapping.in_pixels) return {};
  const Bounds &bounds = mapping.bounds, repeated = mapping.domain.value_or(bounds);
  return {has_x(mapping.periodic) ? side_of_pixel(repeated.x1 - repeated.x0, period->width)
                                  : side_of_pixel(bounds.x1 - bounds.x0, picture.width()),
          has_y(mapping.periodic) ? side_of_pixel(repeated.y1 - repeated.y0, period->height)
                                  : side_of_pixel(bounds.y1 - bounds.y0, picture.height()),
          mapping.has_one_scale && has_square_pixels(bounds, picture)};
}

}  // namespace

MappedPoints map_points(const std::vector<Point>& points, const Mapping& mapping, const Grid& picture,
                        const std::vector<std::uint32_t>& ids) {
  const Bounds& bounds = mapping.bounds;
  PixelMap map(bounds, picture, mapping.y_up, mapping.closed);
  map.repeat(mapping.periodic, mapping.domain.value_or(bounds));
  const Walls along_x = walls_x(mapping, picture), along_y = walls_y(mapping, picture);
  std::vector<Point> pixels;
  pixels.reserve(points.size());
  std::size_t outside = 0;
  for (const Point& point : points) {
    const auto refuse = [&](const std::string& why) {
      const std::string name = ids.empty() ? fmt::format("point {}", pixels.size())
                                           : fmt::format("particle {}", ids.at(pixels.size()));
      throw Error(fmt::format("{} at ({}, {}) is {}", name, point.x, point.y, why));
    };
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) refuse("not finite");
    Point pixel = map.pixel(point);
    if (std::max(std::abs(pixel.x), std::abs(pixel.y)) >= plane_side - Grid::max_side) {
      refuse("2^31 pixels or more away from the bounds " + to_string(bounds));
    }
    pixel = {held(pixel.x, along_x), held(pixel.y, along_y)};
    const bool inside = picture.holds(pixel);
    if (mapping.outside == Outside::refuse && (!inside || map.is_outside(point))) {
      refuse("outside the bounds " + to_string(bounds) + "; give --bounds that hold it");
    }
    outside += inside ? 0 : 1;
    pixels.push_back(pixel);
  }

  Stretch x = between(along_x, picture.width()), y = between(along_y, picture.height());
  if (x.length == 0 || y.length == 0) {
    throw Error("the box " + to_string(*mapping.domain) + " lies outside the bounds " + to_string(bounds) +
                "; give --bounds that hold a part of it");
  }
  std::optional<Domain> domain = map.domain();
  const Units units = units_of(mapping, domain, picture);
  Periodic axes = Periodic::none;
  if (domain && outside == 0) {
    const Stretch period_x = has_x(domain->periodic) ? Stretch{domain->x, domain->width} : x;
    const Stretch period_y = has_y(domain->periodic) ? Stretch{domain->y, domain->height} : y;
    if (is_within(period_x, picture.width()) && is_within(period_y, picture.height())) {
      x = period_x;
      y = period_y;
      axes = domain->periodic;
      domain.reset();
    }
  }
  for (Point& pixel : pixels) {
    pixel.x -= static_cast<double>(x.begin);
    pixel.y -= static_cast<double>(y.begin);
  }
  if (domain) {
    domain->x -= x.begin;
    domain->y -= y.begin;
  }
  return {{raster_of(mapping, picture), Grid(x.length, y.length, axes), static_cast<int>(x.begin),
           static_cast<int>(y.begin), units},
          std::move(pixels),
          domain,
          outside};
}

}  // namespace vorocl::command
