// What a PlaneSeeds object holds.
#pragma once

#include <cstdint>
#include <vector>

#include "tiles/plane_axes.hpp"
#include "tiles/seed_tree.hpp"
#include "vorocl/error.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

struct PlaneSeedsState {
  explicit PlaneSeedsState(const Plane& plane_of_seeds) : plane(plane_of_seeds), axes(plane) {}

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

  /// Replaces what a list has by the seeds near a rectangle: PlaneSeeds::find_near().
  void find_near(const PlaneRectangle& rectangle, Metric metric, std::vector<PlaneSeed>& seeds);

  Plane plane;
  PlaneAxes axes;
  SeedTree tree;
  std::size_t size = 0;
  std::uint64_t ids = 0;
  bool sorted = false;
};

}  // namespace vorocl
