#include "app/sources/bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/terminal/console.hpp"
#include "formats/numbers.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

std::string describe(std::size_t index, const Point& point) {
  return fmt::format("point {} at ({}, {})", index, point.x, point.y);
}

}  // namespace

Bounds parse_bounds(const std::string& text) {
  const Error error("\"" + text + "\" must be X0,Y0,X1,Y1: four numbers with X0 < X1 and Y0 < Y1");
  std::vector<double> values;
  for (std::size_t begin = 0; begin <= text.size();) {
    const auto comma = std::min(text.find(',', begin), text.size());
    const auto value = parse_number<double>(std::string_view(text).substr(begin, comma - begin));
    if (!value || !std::isfinite(*value)) throw error;
    values.push_back(*value);
    begin = comma + 1;
  }
  if (values.size() != 4 || values[0] >= values[2] || values[1] >= values[3]) throw error;
  return {values[0], values[1], values[2], values[3]};
}

std::string to_string(const Bounds& bounds) {
  return fmt::format("{},{},{},{}", bounds.x0, bounds.y0, bounds.x1, bounds.y1);
}

Bounds bounding_box(const std::vector<Point>& points) {
  Bounds box{points.at(0).x, points[0].y, points[0].x, points[0].y};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& point = points[i];
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
      throw Error(describe(i, point) + " is not finite");
    }
    box = {std::min(box.x0, point.x), std::min(box.y0, point.y), std::max(box.x1, point.x),
           std::max(box.y1, point.y)};
  }
  return box;
}

Grid grid_of_width(const Bounds& bounds, int width, Periodic periodic) {
  check_bounds(bounds, Grid(1, 1));
  if (bounds.x0 == bounds.x1) {
    throw Error("the bounds " + to_string(bounds) +
                " have no width to scale by: give --size instead of --width");
  }
  const double height = std::round(width * (bounds.y1 - bounds.y0) / (bounds.x1 - bounds.x0));
  if (height > Grid::max_side) {
    throw Error(fmt::format(
        "a width of {} makes a height of {:.0f} pixels with the bounds {}; at most {} are possible", width,
        height, to_string(bounds), Grid::max_side));
  }
  return Grid(width, std::max(1, static_cast<int>(height)), periodic);
}

bool has_square_pixels(const Bounds& bounds, const Grid& grid) {
  const double x_extent = bounds.x1 - bounds.x0, y_extent = bounds.y1 - bounds.y0;
  if (x_extent == 0 || y_extent == 0) return true;
  const double wanted_height = std::max(1.0, grid.width() * y_extent / x_extent);
  const double wanted_width = std::max(1.0, grid.height() * x_extent / y_extent);
  return std::abs(grid.height() - wanted_height) <= 0.5 || std::abs(grid.width() - wanted_width) <= 0.5;
}

void warn_of_scales(const Bounds& bounds, const Grid& grid) {
  if (has_square_pixels(bounds, grid)) return;
  print_warning(
      fmt::format("the bounds {} get different scales in x and y on {} x {} pixels, so the cells are not "
                  "Voronoi cells in data units; --width {} keeps pixels square",
                  to_string(bounds), grid.width(), grid.height(), grid.width()));
}

void note_outside(std::size_t outside, std::size_t points, const Bounds& bounds) {
  if (outside == 0) return;
  print_note(
      fmt::format("{} of {} points lie outside the bounds {}; they count, and --outside refuse makes them "
                  "an error",
                  outside, points, to_string(bounds)));
}

namespace {

constexpr double plane_side = 2147483648.0;  // 2^31

}  // namespace

bool is_whole_period(const Mapping& mapping, const Grid& grid) {
  if (!mapping.period) return true;
  const Bounds &bounds = mapping.bounds, &period = *mapping.period;
  const double columns = (period.x1 - period.x0) * (grid.width() / (bounds.x1 - bounds.x0));
  const double rows = (period.y1 - period.y0) * (grid.height() / (bounds.y1 - bounds.y0));
  return (!has_x(mapping.periodic) || std::round(columns) == grid.width()) &&
         (!has_y(mapping.periodic) || std::round(rows) == grid.height());
}

MappedPoints map_points(const std::vector<Point>& points, const Mapping& mapping, const Grid& grid) {
  const Bounds& bounds = mapping.bounds;
  PixelMap map(bounds, grid, mapping.y_up, mapping.closed);
  map.repeat(mapping.periodic, mapping.period.value_or(bounds));
  MappedPoints mapped;
  mapped.pixels.reserve(points.size());
  for (const Point& point : points) {
    const auto refuse = [&](const std::string& why) {
      throw Error(describe(mapped.pixels.size(), point) + " is " + why);
    };
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) refuse("not finite");
    const Point pixel = map.pixel(point);
    if (std::max(std::abs(pixel.x), std::abs(pixel.y)) >= plane_side - Grid::max_side) {
      refuse("2^31 pixels or more away from the bounds " + to_string(bounds));
    }
    const bool inside = grid.holds(pixel);
    if (mapping.outside == Outside::refuse && (!inside || map.is_outside(point))) {
      refuse("outside the bounds " + to_string(bounds));
    }
    mapped.outside += inside ? 0 : 1;
    mapped.pixels.push_back(pixel);
  }
  if (grid.periodic() == Periodic::none) mapped.domain = map.domain();
  return mapped;
}

}  // namespace vorocl::command
