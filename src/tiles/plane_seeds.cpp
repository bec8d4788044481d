#include "tiles/plane_seeds.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "runtime/pixel_grid.hpp"
#include "tiles/rim_walk.hpp"

namespace vorocl {

namespace {

constexpr std::uint64_t most_ids = no_label;  // 0 to no_label - 1

}  // namespace

SeedSource::~SeedSource() = default;

PlaneSeeds::PlaneSeeds(const Grid& grid, const SeedsOptions& options)
    : state_(std::make_unique<PlaneSeedsState>(grid, options)) {
  refuse_volume(grid, "a plane of tiles");
  refuse_tilted(grid, "a plane of tiles");
}
PlaneSeeds::PlaneSeeds(const Grid& grid, const Points& points, const SeedsOptions& options)
    : PlaneSeeds(grid, options) {
  reserve(points.size());
  add(points);
}
PlaneSeeds::~PlaneSeeds() = default;
PlaneSeeds::PlaneSeeds(PlaneSeeds&& other) noexcept = default;
PlaneSeeds& PlaneSeeds::operator=(PlaneSeeds&& other) noexcept = default;

PlaneSeedsState& PlaneSeeds::state() const {
  if (!state_)
    throw Error("these seeds were moved from, and have no points; use the ones they were moved to");
  return *state_;
}

void PlaneSeeds::reserve(std::size_t count) { state().tree.reserve(count); }

void PlaneSeeds::add(const Points& points) {
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

void PlaneSeedsState::find_near(const PlaneRectangle& rectangle, Metric metric,
                                std::vector<PlaneSeed>& seeds) {
  if (tree.size() == 0) return;
  tree.find_inside(rectangle, seeds);
  // A seed outside that owns a pixel inside owns every point of the plane between them: so one of the rim
  // too. Ties are decided the same at both.
  std::vector<std::size_t> on_rim;
  const auto owner_at = [&](const Place& point, const SeedImage& guess) {
    SeedImage owner = guess;
    if (owner.distance != too_far) owner = tree.seen_from(point, grid, metric, guess);
    tree.find_nearest(point, grid, metric, owner);
    on_rim.push_back(owner.index);
    return owner;
  };
  const auto find_between = [&](const Place& a, const SeedImage& at_a, const Place& b, const SeedImage& at_b,
                                std::size_t most, std::vector<std::size_t>& found) {
    if (at_a == at_b) return true;  // what wins at both ends wins between them
    return tree.find_between(a, at_a, b, at_b, grid, metric, rectangle, most, found);
  };
  walk_rim(rectangle, 32, owner_at, find_between, on_rim);
  std::sort(on_rim.begin(), on_rim.end());
  on_rim.erase(std::unique(on_rim.begin(), on_rim.end()), on_rim.end());
  for (const std::size_t index : on_rim) {
    const PlaneSeed seed = tree.seed(index);
    if (!holds(rectangle, seed.x, seed.y)) seeds.push_back(seed);
  }
}

void PlaneSeeds::find_near(const Window& window, Metric metric, std::vector<PlaneSeed>& seeds) const {
  if (window.longest_side() > Window::max_side) {
    throw Error("the window has " + std::to_string(window.width()) + " x " + std::to_string(window.height()) +
                " pixels; " + std::to_string(Window::max_side) + " along a side are possible");
  }
  PlaneSeedsState& all = state();
  all.sort();
  seeds.clear();
  const std::vector<PlaneRectangle> parts = parts_of(window);
  for (const PlaneRectangle& part : parts) all.find_near(part, metric, seeds);
  if (parts.size() == 1) return;
  // What owns pixels of several parts was found several times.
  const auto by_id = [](const PlaneSeed& a, const PlaneSeed& b) { return a.id < b.id; };
  const auto same = [](const PlaneSeed& a, const PlaneSeed& b) { return a.id == b.id; };
  std::sort(seeds.begin(), seeds.end(), by_id);
  seeds.erase(std::unique(seeds.begin(), seeds.end(), same), seeds.end());
}

}  // namespace vorocl
