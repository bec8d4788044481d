#include "app/sources/mapping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "app/sources/bounds.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

constexpr double plane_side = 2147483648.0;  // 2^31

/// Pixels of the picture along an axis. They may lie outside it.
struct Stretch {
  std::int64_t begin = 0, length = 0;

  bool is_within(std::int64_t pixels) const { return begin >= 0 && begin + length <= pixels; }
};

/// What is told of an axis of the data.
struct ToldAxis {
  const char* name;
  double low, high;            // of the bounds
  double first, last;          // of the domain
  bool ends_first, ends_last;  // without a period: there is nothing beyond
  bool is_periodic, is_reversed;
};

/// An axis of the data in a picture: the library's, of a period or all of the picture, and where it begins
/// and where there is nothing beyond, in pixels of the picture.
class PlacedAxis {
 public:
  PlacedAxis(const ToldAxis& told, int pixels, bool closed)
      : pixels_(pixels), axis_(Axis(pixels, told.low, told.high)) {
    if (closed) axis_ = axis_.closed();
    if (told.is_periodic) {
      repeat(told);
    } else if (told.low != told.high) {
      const double scale = static_cast<double>(pixels_) / (told.high - told.low);
      if (told.ends_first) first_end_ = std::round((told.first - told.low) * scale);
      if (told.ends_last)  // a pixel at least
        last_end_ = std::max(std::round((told.last - told.low) * scale), first_end_ + 1);
    }
    if (!told.is_reversed) return;
    axis_ = axis_.reversed();
    begin_ = pixels_ - begin_ - axis_.pixels();
    std::swap(first_end_, last_end_);
    for (double* const end : {&first_end_, &last_end_}) *end = static_cast<double>(pixels_) - *end;
  }

  const Axis& axis() const { return axis_; }

  /// Where a point lies in the picture: at the centre of its pixel, or at a whole number of 1/4096 pixel. It
  /// is not beyond an end, to which rounding may move it.
  double place(double at, Snap snap) const {
    const bool snaps = snap == Snap::to_pixels;
    const double place =
        static_cast<double>(begin_) + (snaps ? axis_.pixel(at) + 0.5 : axis_.rounded_position(at));
    if (!(std::abs(place) < plane_side - Size::max_side)) return place;  // which is refused
    return std::clamp(place, first_end_ + (snaps ? 0.5 : 0), last_end_ - (snaps ? 0.5 : 0x1p-12));
  }

  /// The picture's pixels that there are; none if the ends lie outside.
  Stretch shown() const {
    const double begin = std::max(first_end_, 0.0), end = std::min(last_end_, static_cast<double>(pixels_));
    if (begin >= end) return {};
    return {static_cast<std::int64_t>(begin), static_cast<std::int64_t>(end - begin)};
  }

  /// All pixels that there are: one period, or what is shown of an axis that does not repeat.
  Stretch grid() const { return axis_.is_periodic() ? Stretch{begin_, axis_.pixels()} : shown(); }

  /// The picture's pixels in data units: along a period, which is a whole number of pixels, their sides are a
  /// little more or less than elsewhere.
  AxisScale scale() const { return {axis_, static_cast<double>(begin_)}; }

 private:
  /// A period is rounded to whole pixels, and positions along it are scaled to them about its middle. It may
  /// begin anywhere: unless it holds all pixels of the picture, or the picture holds it, it begins with the
  /// picture, so that this shows as much of it as there is room for.
  void repeat(const ToldAxis& told) {
    const double period = told.last - told.first;
    const double scale = static_cast<double>(pixels_) / (told.high - told.low);
    constexpr double rounding = 1e-9;
    if (!(period * scale >= 1 - rounding)) {
      throw Error(
          fmt::format("the period in {} is {:g}, less than a pixel: take more pixels", told.name, period));
    }
    const std::int64_t length = std::llround(period * scale);
    const bool holds = told.first <= told.low && told.high <= told.last;
    const bool is_held = told.low <= told.first && told.last <= told.high && length < pixels_;
    const bool moves = !holds && !is_held;
    const double low = moves ? told.low : told.first, first = (low - told.low) * scale;
    begin_ = std::llround(first);
    if (is_held) begin_ = std::min(begin_, pixels_ - length);  // rounding may move it beyond the picture
    // The middle of the period, less that of these pixels.
    const double shift =
        first - static_cast<double>(begin_) + (period * scale - static_cast<double>(length)) / 2;
    const bool is_shifted = std::abs(shift) >= rounding;
    const double from = low - (is_shifted ? shift * period / static_cast<double>(length) : 0);
    axis_ = Axis(length, from, moves || is_shifted ? from + period : told.last).periodic();
  }

  std::int64_t pixels_;
  Axis axis_;
  std::int64_t begin_ = 0;
  double first_end_ = -std::numeric_limits<double>::infinity(),
         last_end_ = std::numeric_limits<double>::infinity();
};

/// Both axes of the data, in the picture.
struct PlacedAxes {
  PlacedAxis x, y;
};

PlacedAxes place_axes(const Mapping& mapping, const Size& picture) {
  const Bounds& bounds = mapping.bounds;
  check_bounds(bounds);
  const Bounds domain = mapping.domain.value_or(bounds);
  const Ends& ends = mapping.ends;
  const ToldAxis x = {"x",       bounds.x0, bounds.x1, domain.x0,
                      domain.x1, ends.x0,   ends.x1,   has_x(mapping.periodic),
                      false},
                 y = {"y",         bounds.y0, bounds.y1, domain.y0,
                      domain.y1,   ends.y0,   ends.y1,   has_y(mapping.periodic),
                      mapping.y_up};
  return {{x, picture.width(), mapping.closed}, {y, picture.height(), mapping.closed}};
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

/// Along an axis the diagram is all of its grid where the picture shows that, else what the picture shows.
View view_of(const Mapping& mapping, const PlacedAxes& axes, const Size& picture) {
  Stretch x = axes.x.shown(), y = axes.y.shown();
  if (x.length == 0 || y.length == 0) {
    throw Error("the box " + to_string(*mapping.domain) + " lies outside the bounds " +
                to_string(mapping.bounds) + "; give --bounds that hold a part of it");
  }
  const Stretch grid_x = axes.x.grid(), grid_y = axes.y.grid();
  if (grid_x.is_within(picture.width())) x = grid_x;
  if (grid_y.is_within(picture.height())) y = grid_y;
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
    const double x = point.x - (mapping.tilt == 0 ? 0 : mapping.tilt * axes.y.axis().periods_beyond(point.y));
    const Point place = {axes.x.place(x, mapping.snap), axes.y.place(point.y, mapping.snap)};
    if (std::max(std::abs(place.x), std::abs(place.y)) >= plane_side - Size::max_side) {
      refuse("2^31 pixels or more away from the bounds " + to_string(bounds));
    }
    const bool inside = picture.holds(place);
    if (mapping.outside == Outside::refuse &&
        (!inside || !axes.x.axis().covers(point.x) || !axes.y.axis().covers(point.y))) {
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
  return {view_of(mapping, axes, picture), std::move(places), outside};
}

}  // namespace vorocl::command
