// What a PlaneSeeds object holds.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "tiles/seed_tree.hpp"
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

struct PlaneSeedsState {
  explicit PlaneSeedsState(const Plane& plane_of_seeds)
      : plane(plane_of_seeds),
        x{plane.width(), has_x(plane.periodic())},
        y{plane.height(), has_y(plane.periodic())} {}

  /// Calls a function that adds seeds. If it throws, none is there.
  template <typename Add>
  void add(Add add_seeds) {
    if (sorted) throw Error("these seeds were asked for already; add all of them before");
    const std::size_t size_before = tree.size();
    const std::uint64_t ids_before = ids;
    try {
      add_seeds();
    } catch (...) {
      tree.shorten(size_before);
      ids = ids_before;
      throw;
    }
    size += tree.size() - size_before;
  }

  void sort() {
    if (!sorted) tree.sort();
    sorted = true;
  }

  /// Replaces what a list has by the seeds near a rectangle: PlaneSeeds::near().
  void find_near(const PlaneRectangle& rectangle, Metric metric, std::vector<PlaneSeed>& seeds);

  Plane plane;
  PlaneAxis x, y;
  SeedTree tree;
  std::size_t size = 0;
  std::uint64_t ids = 0;
  bool sorted = false;
};

}  // namespace vorocl
