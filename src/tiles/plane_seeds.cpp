#include "tiles/plane_seeds.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace vorocl {

namespace {

constexpr std::uint64_t most_ids = no_label;  // 0 to no_label - 1

/// Finds the seeds outside a rectangle of which images own points of its rim. A seed outside that owns a
/// pixel inside owns every point of the plane between them: so one of the rim too. Ties are decided the same
/// at both.
class RimOwners {
 public:
  RimOwners(const SeedTree& tree, const Plane& plane, const PlaneRectangle& rectangle, Metric metric)
      : tree_(tree), plane_(plane), rectangle_(rectangle), metric_(metric) {
    const std::array<PlanePoint, 4> corners = corners_of(rectangle);
    SeedImage owners[4];
    for (int i = 0; i < 4; ++i) owners[i] = owner_of(corners[i], i > 0 ? &owners[i - 1] : nullptr);
    for (int i = 0; i < 4; ++i) trace(corners[i], owners[i], corners[(i + 1) % 4], owners[(i + 1) % 4]);
  }

  std::vector<std::size_t> take() { return std::move(found_); }

 private:
  static constexpr std::size_t few = 32;  // so many at once cost about as much as to halve the line

  SeedImage owner_of(const PlanePoint& point, const SeedImage* guess) {
    SeedImage owner;
    if (guess) owner = tree_.seen_from(point, plane_, metric_, *guess);
    tree_.find_nearest(point, plane_, metric_, owner);
    found_.push_back(owner.index);
    return owner;
  }

  /// Goes from one point to another in steps, which have the length that the last ones needed.
  void trace(PlanePoint a, SeedImage at_a, const PlanePoint& end, const SeedImage& at_end) {
    const std::int64_t along_x = end.x > a.x ? 1 : end.x < a.x ? -1 : 0;
    const std::int64_t along_y = end.y > a.y ? 1 : end.y < a.y ? -1 : 0;
    std::int64_t left = length_of(a, end);
    while (left > 0) {
      step_ = std::min(step_, left);
      const PlanePoint b = {a.x + step_ * along_x, a.y + step_ * along_y};
      const SeedImage at_b = step_ == left ? at_end : owner_of(b, &at_a);
      between_.clear();
      // What wins at both ends wins between them.
      if (!(at_a == at_b) && !tree_.find_between(a, at_a, b, at_b, plane_, metric_, rectangle_,
                                                 step_ > 1 ? few : SIZE_MAX, between_)) {
        step_ /= 2;
        continue;
      }
      for (const SeedImage& image : between_) found_.push_back(image.index);
      left -= step_;
      a = b;
      at_a = at_b;
      if (between_.size() < few / 4) step_ *= 2;
    }
  }

  const SeedTree& tree_;
  const Plane& plane_;
  PlaneRectangle rectangle_;
  Metric metric_;
  std::int64_t step_ = 64;  // pixels
  std::vector<SeedImage> between_;
  std::vector<std::size_t> found_;
};

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
      if (!seeds.axes.x.reaches(point.x) || !seeds.axes.y.reaches(point.y)) throw BadPoint(seeds.ids, point);
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
  std::vector<std::size_t> on_rim = RimOwners(tree, plane, rectangle, metric).take();
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
