#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "internal.hpp"
#include "tiles/seed_tree.hpp"
#include "vorocl/error.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

namespace {

constexpr std::uint64_t most_ids = no_label;  // 0 to no_label - 1
constexpr std::int64_t plane_side = std::int64_t{1} << 31;

/// An axis of a plane: where seeds may lie along it.
struct PlaneAxis {
  std::int64_t pixels;
  bool periodic;

  /// Whether it is less than 2^31 pixels away from all pixels.
  bool reaches(double at) const {
    // Written so that a NaN fails.
    return at >= static_cast<double>(pixels - plane_side) && at < static_cast<double>(plane_side);
  }

  std::int32_t pixel(double at) const {
    auto pixel = static_cast<std::int64_t>(std::floor(at));
    if (periodic) pixel = (pixel % pixels + pixels) % pixels;
    return static_cast<std::int32_t>(pixel);
  }

  bool holds(std::int32_t pixel) const {
    return periodic ? pixel >= 0 && pixel < pixels : pixel >= pixels - plane_side;
  }
};

/// Finds the images that own points of a rectangle's rim. A seed outside that owns a pixel inside owns every
/// point of the plane between them: so one of the rim too. Ties are decided the same at both.
class RimOwners {
 public:
  RimOwners(const SeedTree& tree, const Plane& plane, const PlaneRectangle& rectangle, Metric metric)
      : tree_(tree), plane_(plane), metric_(metric) {
    const std::int64_t right = rectangle.x + rectangle.width - 1, bottom = rectangle.y + rectangle.height - 1;
    const PlanePoint corners[] = {
        {rectangle.x, rectangle.y}, {right, rectangle.y}, {right, bottom}, {rectangle.x, bottom}};
    SeedImage owners[4];
    for (int i = 0; i < 4; ++i) owners[i] = owner_of(corners[i], i > 0 ? &owners[i - 1] : nullptr);
    for (int i = 0; i < 4; ++i) trace(corners[i], owners[i], corners[(i + 1) % 4], owners[(i + 1) % 4]);
  }

  std::vector<std::size_t> take() { return std::move(found_); }

 private:
  static constexpr std::size_t few = 16;  // so many at once cost about as much as to halve the line

  SeedImage owner_of(const PlanePoint& point, const SeedImage* guess) {
    SeedImage owner;
    if (guess) owner = tree_.seen_from(point, *guess, metric_);
    tree_.find_nearest(point, plane_, metric_, owner);
    found_.push_back(owner.index);
    return owner;
  }

  void trace(const PlanePoint& a, const SeedImage& at_a, const PlanePoint& b, const SeedImage& at_b) {
    // What wins at both ends wins between them.
    if (at_a.index == at_b.index && at_a.offset == at_b.offset) return;
    const bool can_halve = std::abs(a.x - b.x) + std::abs(a.y - b.y) > 1;
    between_.clear();
    if (tree_.find_between(a, at_a, b, at_b, plane_, metric_, can_halve ? few : SIZE_MAX, between_)) {
      for (const SeedImage& image : between_) found_.push_back(image.index);
      return;
    }
    const PlanePoint middle = {(a.x + b.x) / 2, (a.y + b.y) / 2};
    const SeedImage at_middle = owner_of(middle, &at_a);
    trace(a, at_a, middle, at_middle);
    trace(middle, at_middle, b, at_b);
  }

  const SeedTree& tree_;
  const Plane& plane_;
  Metric metric_;
  std::vector<SeedImage> between_;
  std::vector<std::size_t> found_;
};

}  // namespace

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

  Plane plane;
  PlaneAxis x, y;
  SeedTree tree;
  std::size_t size = 0;
  std::uint64_t ids = 0;
  bool sorted = false;
};

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
      if (!seeds.x.reaches(point.x) || !seeds.y.reaches(point.y)) throw BadPoint(seeds.ids, point);
      seeds.tree.add(seeds.x.pixel(point.x), seeds.y.pixel(point.y), static_cast<std::uint32_t>(seeds.ids));
      ++seeds.ids;
    }
  });
}

void PlaneSeeds::add(const PlaneSeed* added, std::size_t count) {
  PlaneSeedsState& seeds = state();
  seeds.add([&] {
    for (std::size_t i = 0; i < count; ++i) {
      const PlaneSeed& seed = added[i];
      if (seed.id == no_label) throw Error("a seed has the id 2^32 - 1, which says that there is none");
      if (!seeds.x.holds(seed.x) || !seeds.y.holds(seed.y)) {
        throw Error("seed " + std::to_string(seed.id) + " at pixel (" + std::to_string(seed.x) + ", " +
                    std::to_string(seed.y) + ") is too far away, or outside the plane's period");
      }
      seeds.tree.add(seed.x, seed.y, seed.id);
      seeds.ids = std::max<std::uint64_t>(seeds.ids, seed.id + std::uint64_t{1});
    }
  });
}

const Plane& PlaneSeeds::plane() const { return state().plane; }
std::size_t PlaneSeeds::size() const { return state().size; }
std::uint64_t PlaneSeeds::ids() const { return state().ids; }
void PlaneSeeds::sort() const { state().sort(); }

std::vector<PlaneSeed> PlaneSeeds::near(const PlaneRectangle& rectangle, Metric metric) const {
  sort();
  const SeedTree& tree = state().tree;
  std::vector<PlaneSeed> seeds;
  if (tree.size() == 0) return seeds;
  std::vector<std::size_t> inside;
  tree.find_inside(rectangle, inside);
  seeds.reserve(inside.size());
  for (const std::size_t index : inside) seeds.push_back(tree.seed(index));

  std::vector<std::size_t> on_rim = RimOwners(tree, plane(), rectangle, metric).take();
  std::sort(on_rim.begin(), on_rim.end());
  on_rim.erase(std::unique(on_rim.begin(), on_rim.end()), on_rim.end());
  for (const std::size_t index : on_rim) {
    const PlaneSeed seed = tree.seed(index);
    const bool is_inside = seed.x >= rectangle.x && seed.x - rectangle.x < rectangle.width &&
                           seed.y >= rectangle.y && seed.y - rectangle.y < rectangle.height;
    if (!is_inside) seeds.push_back(seed);
  }
  return seeds;
}

}  // namespace vorocl
