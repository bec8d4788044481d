// Which pixel of a grid a point's seed lies in.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "core/place.hpp"
#include "runtime/pixel_grid.hpp"
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

/// Places points in a plane by its axes.
class Snapping {
 public:
  Snapping(const Grid& grid, Outside outside)
      : grid_(grid),
        outside_(outside),
        sure_{sure_part(grid.x()), sure_part(grid.y()), sure_part(grid.z())} {}

  const Grid& grid() const { return grid_; }

  /// Whether a place is one of the grid's.
  bool is_inside(const Place& at) const {
    return at.x >= 0 && at.x < in_fractions(grid_.width()) && at.y >= 0 &&
           at.y < in_fractions(grid_.height());
  }

  /// Where a point lies, from the first pixel of a grid of one slice on: in the middle of its pixel, or
  /// rounded to the nearest 1/4096 of it and never out of it. absent_place if it is outside and such seeds
  /// are absent. Throws BadPoint for a point that is not finite, too far away, beside the slice, or outside
  /// where that is refused.
  Place operator()(std::size_t id, const Point& point, Snap snap) const {
    const Point in_box = grid_.in_box(point);
    const double x = grid_.x().pixel(in_box.x), y = grid_.y().pixel(in_box.y);
    if (!is_near(grid_.x(), x) || !is_near(grid_.y(), y) || !is_in_slice(point)) {
      if (outside_ == Outside::absent && is_finite(point)) return absent_place;
      throw bad(id, point);
    }
    const Place at = {centre_of(static_cast<std::int64_t>(x)), centre_of(static_cast<std::int64_t>(y))};
    if (outside_ == Outside::refuse && !is_inside(at)) throw bad(id, point);
    if (outside_ == Outside::absent && !is_inside(at)) return absent_place;
    if (snap == Snap::to_pixels) return at;
    const auto off = [](const Axis& axis, double pixel, double coordinate) {
      return static_cast<std::int64_t>(axis.fraction_in(pixel, coordinate)) - fractions_of_pixel / 2;
    };
    return at + Place{off(grid_.x(), x, in_box.x), off(grid_.y(), y, in_box.y)};
  }

  /// What is bad about a point: "point 7 (nan, 3) is not finite; ..."
  BadPoint bad(std::size_t id, const Point& point) const {
    std::string text = is_finite(point) ? "is outside the grid" : "is not finite";
    if (outside_ != Outside::refuse && !has_voxels(grid_) && (!is_finite(point) || is_in_slice(point))) {
      if (is_finite(point)) text = "is too far away";
      return {id, point, text + "; x and y must be less than 2^31 pixels from all pixels of the grid"};
    }
    std::vector<std::string> ranges;
    const auto add = [&ranges](const char* name, const Axis& axis) {
      if (axis.is_periodic()) return;  // it has all
      ranges.push_back(range_text(axis, std::string(name) + (ranges.empty() ? " must be in " : " in ")));
    };
    add("x", grid_.x());
    add("y", grid_.y());
    if (grid_.depth() > 1 || !is_in_slice(point)) add("z", grid_.z());
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      text += (i == 0 ? "; " : i + 1 < ranges.size() ? ", " : " and ") + ranges[i];
    }
    return {id, point, text};
  }

  static bool is_finite(const Point& point) {
    return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
  }

  /// Whether find() would say of all these points, of so many numbers each, that they are inside. False does
  /// not say that one is not.
  bool are_surely_inside(const double* numbers, const double* end, int dimensions) const {
    bool all = true;
    for (; numbers != end; numbers += dimensions) {
      all &= sure_[0].holds(numbers[0]) & sure_[1].holds(numbers[1]);
      if (dimensions > 2) all &= sure_[2].holds(numbers[2]);
    }
    return all;
  }

  enum class Where { inside, outside, absent };

  /// Where a point lies, or what becomes of it. Throws BadPoint as above; in a volume for one outside that
  /// counts, too.
  Where find(std::size_t id, const Point& point) const {
    if (sure_[0].holds(point.x) && sure_[1].holds(point.y) && sure_[2].holds(point.z)) return Where::inside;
    if (!has_voxels(grid_)) {
      const Place at = (*this)(id, point, Snap::to_pixels);
      return is_absent(at) ? Where::absent : is_inside(at) ? Where::inside : Where::outside;
    }
    const auto is_on = [](const Axis& axis, double coordinate) {
      const double pixel = axis.pixel(coordinate);
      return pixel >= 0 && pixel < static_cast<double>(axis.pixels());
    };
    if (is_on(grid_.x(), point.x) && is_on(grid_.y(), point.y) && is_on(grid_.z(), point.z))
      return Where::inside;
    if (outside_ != Outside::absent || !is_finite(point)) throw bad(id, point);
    return Where::absent;
  }

 private:
  /// A stretch of an axis whose coordinates have pixels of its own.
  struct SurePart {
    double from, to;
    bool holds(double coordinate) const { return coordinate >= from && coordinate < to; }
  };

  /// All but the ends, where rounding decides, and of a periodic axis what is too far away for numbers.
  static SurePart sure_part(const Axis& axis) {
    const double many_periods = axis.is_periodic() ? 1e6 * (axis.to() - axis.from()) : 0;
    const SurePart part = {axis.from() - many_periods, axis.to() + many_periods};
    return std::isfinite(part.from) && std::isfinite(part.to) ? part : SurePart{axis.from(), axis.to()};
  }

  /// Whether a pixel is less than 2^31 away from all pixels of its axis; false for a NaN.
  static bool is_near(const Axis& axis, double pixel) {
    return pixel >= static_cast<double>(axis.pixels()) - 2147483648.0 && pixel < 2147483648.0;
  }

  /// Whether a point lies in the one slice of the grid, along z.
  bool is_in_slice(const Point& point) const { return grid_.z().pixel(point.z) == 0; }

  static std::string range_text(const Axis& axis, const std::string& start) {
    std::ostringstream text;
    text << start << '[' << axis.from() << ", " << axis.to() << (axis.is_closed() ? "]" : ")");
    return text.str();
  }

  Grid grid_;
  Outside outside_;
  std::array<SurePart, 3> sure_;
};

/// A seed where a diagram has it: in the middle of its pixel, or where it lies.
inline PlaneSeed placed(PlaneSeed seed, Snap snap) {
  if (snap == Snap::to_pixels) seed.part_x = seed.part_y = fractions_of_pixel / 2;
  return seed;
}

/// The seed at a place.
inline PlaneSeed seed_at(const Place& at, std::uint32_t id) {
  const auto part = [](std::int64_t along) {
    return static_cast<std::uint16_t>(along - in_fractions(pixel_of(along)));
  };
  return {static_cast<std::int32_t>(pixel_of(at.x)), static_cast<std::int32_t>(pixel_of(at.y)), id,
          part(at.x), part(at.y)};
}

inline Place place_of(const PlaneSeed& seed) {
  return {in_fractions(seed.x) + seed.part_x, in_fractions(seed.y) + seed.part_y};
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
