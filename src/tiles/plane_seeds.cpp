#include "tiles/plane_seeds.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "runtime/bad_point.hpp"
#include "tiles/rim_walk.hpp"

namespace vorocl {

namespace {

constexpr std::uint64_t most_ids = no_label;  // 0 to no_label - 1

}  // namespace

SeedSource::~SeedSource() = default;

PlaneSeeds::PlaneSeeds(const Plane& plane) : state_(std::make_unique<PlaneSeedsState>(plane)) {}
PlaneSeeds::PlaneSeeds(const Plane& plane, const std::vector<Point>& points) : PlaneSeeds(plane) {
  reserve(points.size());
  add(points.data(), points.size());
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

void PlaneSeeds::add(const Point* points, std::size_t count) {
  PlaneSeedsState& seeds = state();
  seeds.add([&] {
    if (count > most_ids - seeds.ids) throw Error("there are more than 2^32 - 1 seeds; ids end there");
    for (std::size_t i = 0; i < count; ++i) {
      const Point& point = points[i];
      if (!seeds.axes.x.reaches(point.x) || !seeds.axes.y.reaches(point.y))
        throw point_too_far(seeds.ids, point);
      seeds.tree.add(seeds.axes.x.pixel(point.x), seeds.axes.y.pixel(point.y),
                     static_cast<std::uint32_t>(seeds.ids));
      ++seeds.ids;
    }
  });
}

void PlaneSeeds::add(const PlaneSeed* added, std::size_t count) {
  PlaneSeedsState& seeds = state();
  seeds.add([&] {
    for (std::size_t i = 0; i < count; ++i) {
      const PlaneSeed& seed = added[i];
      seeds.axes.check(seed);
      seeds.tree.add(seed.x, seed.y, seed.id);
      seeds.ids = std::max<std::uint64_t>(seeds.ids, seed.id + std::uint64_t{1});
    }
  });
}

const Plane& PlaneSeeds::plane() const { return state().plane; }
std::size_t PlaneSeeds::size() const { return state().size; }
std::uint64_t PlaneSeeds::ids() const { return state().ids; }
void PlaneSeeds::sort() const { state().sort(); }

void PlaneSeedsState::find_near(const PlaneRectangle& rectangle, Metric metric,
                                std::vector<PlaneSeed>& seeds) {
  if (std::max(rectangle.width, rectangle.height) > Grid::max_side) {
    throw Error("the rectangle has " + std::to_string(rectangle.width) + " x " +
                std::to_string(rectangle.height) + " pixels; " + std::to_string(Grid::max_side) +
                " along a side are possible");
  }
  sort();
  seeds.clear();
  if (tree.size() == 0) return;
  tree.find_inside(rectangle, seeds);
  // A seed outside that owns a pixel inside owns every point of the plane between them: so one of the rim
  // too. Ties are decided the same at both.
  std::vector<std::size_t> on_rim;
  const auto owner_at = [&](const PlanePoint& point, const SeedImage& guess) {
    SeedImage owner = guess;
    if (owner.distance != too_far) owner = tree.seen_from(point, plane, metric, guess);
    tree.find_nearest(point, plane, metric, owner);
    on_rim.push_back(owner.index);
    return owner;
  };
  const auto find_between = [&](const PlanePoint& a, const SeedImage& at_a, const PlanePoint& b,
                                const SeedImage& at_b, std::size_t most, std::vector<std::size_t>& found) {
    if (at_a == at_b) return true;  // what wins at both ends wins between them
    return tree.find_between(a, at_a, b, at_b, plane, metric, rectangle, most, found);
  };
  walk_rim(rectangle, 32, owner_at, find_between, on_rim);
  std::sort(on_rim.begin(), on_rim.end());
  on_rim.erase(std::unique(on_rim.begin(), on_rim.end()), on_rim.end());
  for (const std::size_t index : on_rim) {
    const PlaneSeed seed = tree.seed(index);
    if (!holds(rectangle, seed.x, seed.y)) seeds.push_back(seed);
  }
}

void PlaneSeeds::find_near(const PlaneRectangle& rectangle, Metric metric,
                           std::vector<PlaneSeed>& seeds) const {
  state().find_near(rectangle, metric, seeds);
}

}  // namespace vorocl
