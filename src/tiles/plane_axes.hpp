// Where the seeds of a plane may lie.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "vorocl/error.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

/// An axis of a plane: where seeds may lie along it.
struct PlaneAxis {
  static constexpr std::int64_t reach = std::int64_t{1} << 31;

  std::int64_t pixels;
  bool periodic;

  /// Whether it is less than 2^31 pixels away from all pixels.
  bool reaches(double at) const {
    // Written so that a NaN fails.
    return at >= static_cast<double>(pixels - reach) && at < static_cast<double>(reach);
  }

  std::int32_t pixel(double at) const {
    auto pixel = static_cast<std::int64_t>(std::floor(at));
    if (periodic) pixel = (pixel % pixels + pixels) % pixels;
    return static_cast<std::int32_t>(pixel);
  }

  bool holds(std::int32_t pixel) const {
    return periodic ? pixel >= 0 && pixel < pixels : pixel >= pixels - reach;
  }
};

/// Both of them.
struct PlaneAxes {
  explicit PlaneAxes(const Plane& plane)
      : x{plane.width(), has_x(plane.periodic())}, y{plane.height(), has_y(plane.periodic())} {}

  /// Throws Error unless a seed may have this place and this id.
  void check(const PlaneSeed& seed) const {
    if (seed.id == no_label) throw Error("a seed has the id 2^32 - 1, which says that there is none");
    if (!x.holds(seed.x) || !y.holds(seed.y)) {
      throw Error("seed " + std::to_string(seed.id) + " at pixel (" + std::to_string(seed.x) + ", " +
                  std::to_string(seed.y) + ") is too far away, or outside the plane's period");
    }
  }

  PlaneAxis x, y;
};

}  // namespace vorocl
