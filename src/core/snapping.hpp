// Which pixel of a grid a point's seed lies in.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "core/outer_seeds.hpp"
#include "core/point_placement.hpp"
#include "vorocl/error.hpp"
#include "vorocl/seeds.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

/// A point that is present, in the grid's slice if it has no z.
inline Point point_on(const Grid& grid, const Points& points, std::size_t i) {
  Point point = points[i];
  if (!points.have_z()) point.z = grid.z().from();
  return point;
}

/// Snaps points to the pixels of a grid, by its axes.
class Snapping {
 public:
  Snapping(const Grid& grid, Outside outside)
      : grid_(grid),
        outside_(outside),
        width_(static_cast<cl_uint>(grid.width())),
        height_(static_cast<cl_uint>(grid.height())) {}

  /// Whether a pixel is one of the grid's.
  bool is_inside(const PlanePosition& at) const {
    // What is negative is too large without its sign.
    return static_cast<cl_uint>(at.s[0]) < width_ && static_cast<cl_uint>(at.s[1]) < height_;
  }

  /// The pixel of a point, counted from the first one of a grid of one slice; absent_coordinate if it is
  /// outside and such seeds are absent. Throws BadPoint for a point that is not finite, too far away, beside
  /// the slice, or outside where that is refused.
  PlanePosition operator()(std::size_t id, const Point& point) const {
    const Point in_box = grid_.in_box(point);
    const double x = grid_.x().pixel(in_box.x), y = grid_.y().pixel(in_box.y);
    if (!is_near(grid_.x(), x) || !is_near(grid_.y(), y) || !is_in_slice(point)) return beyond(id, point);
    const PlanePosition at = {{static_cast<cl_int>(x), static_cast<cl_int>(y)}};
    if (outside_ == Outside::count || is_inside(at)) return at;
    if (outside_ == Outside::refuse) throw outside_the_grid(id, point, grid_);
    return {{absent_coordinate, 0}};
  }

  /// Where in its pixel a point lies that has one: rounded to the nearest fraction, and never out of the
  /// pixel.
  Fraction fraction(const Point& point, const PlanePosition& at) const {
    const Point in_box = grid_.in_box(point);
    return {fraction_of(grid_.x(), in_box.x, at.s[0]), fraction_of(grid_.y(), in_box.y, at.s[1])};
  }

  /// "point 7 (nan, 3) is outside the grid; x must be in [0, 8) and y in [0, 6)", or not finite.
  static BadPoint outside_the_grid(std::size_t id, const Point& point, const Grid& grid) {
    std::vector<std::string> ranges;
    const auto add = [&ranges](const char* name, const Axis& axis) {
      if (axis.is_periodic()) return;  // it has all
      ranges.push_back(range_text(axis, std::string(name) + (ranges.empty() ? " must be in " : " in ")));
    };
    add("x", grid.x());
    add("y", grid.y());
    if (grid.depth() > 1 || grid.z().pixel(point.z) != 0) add("z", grid.z());
    std::string text = complaint(point, "outside the grid");
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      text += (i == 0 ? "; " : i + 1 < ranges.size() ? ", " : " and ") + ranges[i];
    }
    return {id, point, text};
  }

  static bool is_finite(const Point& point) {
    return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
  }

 private:
  static std::uint16_t fraction_of(const Axis& axis, double coordinate, cl_int pixel) {
    return static_cast<std::uint16_t>(axis.fraction_in(pixel, coordinate));
  }

  /// Whether a pixel is less than 2^31 away from all pixels of its axis; false for a NaN.
  static bool is_near(const Axis& axis, double pixel) {
    return pixel >= static_cast<double>(axis.pixels()) - 2147483648.0 && pixel < 2147483648.0;
  }

  /// Whether a point lies in the one slice of the grid, along z.
  bool is_in_slice(const Point& point) const { return grid_.z().pixel(point.z) == 0; }

  /// What becomes of a point that is not finite, too far away or beside the slice.
  PlanePosition beyond(std::size_t id, const Point& point) const {
    if (is_finite(point) && outside_ == Outside::absent) return {{absent_coordinate, 0}};
    if (is_finite(point) && !is_in_slice(point)) throw outside_the_grid(id, point, grid_);
    throw BadPoint(id, point,
                   complaint(point, "too far away") +
                       "; x and y must be less than 2^31 pixels from all pixels of the grid");
  }

  /// What is bad about a point that is not finite, or else.
  static std::string complaint(const Point& point, const char* otherwise) {
    return std::string("is ") + (is_finite(point) ? otherwise : "not finite");
  }

  static std::string range_text(const Axis& axis, const std::string& start) {
    std::ostringstream text;
    text << start << '[' << axis.from() << ", " << axis.to() << (axis.is_closed() ? "]" : ")");
    return text.str();
  }

  Grid grid_;
  Outside outside_;
  cl_uint width_, height_;
};

/// A seed where a diagram has it: in the middle of its pixel, or where it lies.
inline PlaneSeed placed(PlaneSeed seed, Snap snap) {
  if (snap == Snap::to_pixels) seed.part_x = seed.part_y = fractions_of_pixel / 2;
  return seed;
}

/// The seed of a point that lies in this pixel.
inline PlaneSeed seed_of_point(const Snapping& snapping, const Point& point, const PlanePosition& at,
                               std::uint32_t id, Snap snap) {
  PlaneSeed seed = {at.s[0], at.s[1], id};
  if (snap == Snap::to_pixels) return seed;
  const Fraction in = snapping.fraction(point, at);
  seed.part_x = in.x;
  seed.part_y = in.y;
  return seed;
}

/// Throws Error unless a seed with an id of the caller's may have this pixel of a grid and this id.
inline void check(const PlaneSeed& seed, const Grid& grid) {
  if (seed.id == no_label) throw Error("a seed has the id 2^32 - 1, which says that there is none");
  const auto holds = [](const Axis& axis, std::int64_t pixel) {
    return axis.is_periodic() ? pixel >= 0 && pixel < axis.pixels()
                              : pixel >= axis.pixels() - (std::int64_t{1} << 31);
  };
  if (!holds(grid.x(), seed.x) || !holds(grid.y(), seed.y)) {
    throw Error("seed " + std::to_string(seed.id) + " at pixel (" + std::to_string(seed.x) + ", " +
                std::to_string(seed.y) + ") is too far away, or outside the grid's period");
  }
  if (seed.part_x >= fractions_of_pixel || seed.part_y >= fractions_of_pixel) {
    throw Error("seed " + std::to_string(seed.id) + " lies " + std::to_string(seed.part_x) + " and " +
                std::to_string(seed.part_y) + " parts within its pixel, which has 4096 along an axis");
  }
}

}  // namespace vorocl
