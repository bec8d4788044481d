// What a PlaneSeeds object holds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/snapping.hpp"
#include "tiles/seed_tree.hpp"
#include "vorocl/error.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

struct PlaneSeedsState {
  PlaneSeedsState(const Grid& grid_of_seeds, const SeedsOptions& options)
      : grid(grid_of_seeds), snapping(grid, options.outside), snap(options.snap), tree(snap) {}

  /// Calls a function that adds seeds. If it throws, none is there.
  template <typename Add>
  void add(Add add_seeds) {
    if (sorted) throw Error("these seeds were asked for already; add all of them before");
    const std::size_t size_before = tree.size(), outside_before = outside;
    const std::uint64_t ids_before = id_end;
    try {
      add_seeds();
    } catch (...) {
      tree.shorten(size_before);
      id_end = ids_before;
      outside = outside_before;
      throw;
    }
    alive += tree.size() - size_before;
  }

  void sort() {
    if (sorted) return;
    tree.sort();
    sorted = true;
  }

  /// Adds a seed.
  void add(const PlaneSeed& seed) {
    tree.add(seed);
    outside += snapping.is_inside(place_of(seed)) ? 0 : 1;
    id_end = std::max<std::uint64_t>(id_end, seed.id + std::uint64_t{1});
  }

  Grid grid;
  Snapping snapping;
  Snap snap;
  SeedTree tree;
  std::size_t alive = 0, outside = 0;
  std::uint64_t id_end = 0;
  bool sorted = false;
};

}  // namespace vorocl
