#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/snapping.hpp"
#include "runtime/internal.hpp"
#include "runtime/pixel_grid.hpp"
#include "tiles/near_seeds.hpp"
#include "tiles/seed_tree.hpp"
#include "vorocl/error.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

namespace {

constexpr std::uint64_t most_ids = no_label;  // 0 to no_label - 1

}  // namespace

/// What a PlaneSeeds object holds.
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

SeedSource::~SeedSource() = default;

PlaneSeeds::PlaneSeeds(const Grid& grid, const SeedsOptions& options)
    : state_(make_state<PlaneSeedsState>(grid, options)) {
  refuse_volume(grid, "a plane of tiles");
  refuse_tilted(grid, "a plane of tiles");
}
PlaneSeeds::PlaneSeeds(const Grid& grid, const Points& points, const SeedsOptions& options)
    : PlaneSeeds(grid, options) {
  reserve(points.size());
  add(points);
}

PlaneSeedsState& PlaneSeeds::state() const {
  if (!state_)
    throw Error("these seeds were moved from, and have no points; use the ones they were moved to");
  return *state_;
}

void PlaneSeeds::reserve(std::size_t count) { state().tree.reserve(count); }

void PlaneSeeds::add(const Points& points) {
  if (points.weights() != nullptr) throw Error("tiles know no weights of points; diagrams of the whole do");
  PlaneSeedsState& seeds = state();
  seeds.add([&] {
    if (points.size() > most_ids - seeds.id_end)
      throw Error("there are more than 2^32 - 1 seeds; ids end there");
    const std::uint64_t first = seeds.id_end;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!points.is_present(i)) continue;
      const Place at = seeds.snapping(first + i, point_on(seeds.grid, points, i), seeds.snap);
      if (!is_absent(at)) seeds.add(seed_at(at, static_cast<std::uint32_t>(first + i)));
    }
    seeds.id_end = first + points.size();
  });
}

void PlaneSeeds::add(const PlaneSeed* added, std::size_t count) {
  PlaneSeedsState& seeds = state();
  seeds.add([&] {
    for (std::size_t i = 0; i < count; ++i) {
      check(added[i], seeds.grid);
      seeds.add(added[i]);
    }
  });
}

const Grid& PlaneSeeds::grid() const { return state().grid; }
std::size_t PlaneSeeds::alive() const { return state().alive; }
std::size_t PlaneSeeds::outside() const { return state().outside; }
std::uint64_t PlaneSeeds::id_end() const { return state().id_end; }
Snap PlaneSeeds::snap() const { return state().snap; }
void PlaneSeeds::sort() const { state().sort(); }

void PlaneSeeds::find_near(const Window& window, Metric metric, std::vector<PlaneSeed>& seeds) const {
  PlaneSeedsState& all = state();
  all.sort();
  NearSeeds(all.tree, all.grid, metric).find(window, seeds);
}

}  // namespace vorocl
