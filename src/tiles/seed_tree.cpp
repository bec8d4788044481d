#include "tiles/seed_tree.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

namespace vorocl {

namespace {

std::int64_t distance_of(std::int64_t dx, std::int64_t dy, Metric metric) {
  return metric == Metric::euclidean ? dx * dx + dy * dy : dx + dy;
}

/// From a coordinate to the nearest one of a range.
std::int64_t gap(std::int64_t at, std::int64_t low, std::int64_t high) {
  return std::max<std::int64_t>(std::max(low - at, at - high), 0);
}

/// Offsets along both axes that matter: where nothing is farther away than half a period. No product of
/// them overflows.
class HalfPeriods {
 public:
  HalfPeriods(const Plane& plane, std::int64_t slack)
      : x_(has_x(plane.periodic()) ? plane.width() + 2 * slack : INT64_MAX),
        y_(has_y(plane.periodic()) ? plane.height() + 2 * slack : INT64_MAX) {}

  bool hold(std::int64_t dx, std::int64_t dy) const { return 2 * dx <= x_ && 2 * dy <= y_; }

 private:
  std::int64_t x_, y_;
};

/// Calls a function with the offset of each image of the plane around it, the plane's own first.
template <typename Use>
void each_image(const Plane& plane, Use use) {
  const int along_x = has_x(plane.periodic()) ? 3 : 1, along_y = has_y(plane.periodic()) ? 3 : 1;
  constexpr std::int64_t periods[] = {0, -1, 1};
  for (int j = 0; j < along_y; ++j) {
    for (int i = 0; i < along_x; ++i) {
      use(PlanePoint{periods[i] * plane.width(), periods[j] * plane.height()});
    }
  }
}

}  // namespace

void SeedTree::reserve(std::size_t count) {
  places_.reserve(count);
  ids_.reserve(count);
}

void SeedTree::add(std::int32_t x, std::int32_t y, std::uint32_t id) {
  places_.push_back(z_order(x, y));
  ids_.push_back(id);
}

void SeedTree::shorten(std::size_t count) {
  places_.resize(count);
  ids_.resize(count);
}

void SeedTree::sort() {
  // By the digits of the order, the lowest first; those that all seeds share are left out.
  constexpr int digit_bits = 11;
  constexpr std::uint64_t digit_mask = (1u << digit_bits) - 1;
  std::uint64_t varying = 0;
  for (const std::uint64_t place : places_) varying |= place ^ places_.front();
  {
    std::vector<std::uint64_t> next_places(places_.size());
    std::vector<std::uint32_t> next_ids(ids_.size());
    for (int shift = 0; shift < 64; shift += digit_bits) {
      if ((varying >> shift & digit_mask) == 0) continue;
      std::array<std::size_t, digit_mask + 2> starts = {};
      for (const std::uint64_t place : places_) ++starts[(place >> shift & digit_mask) + 1];
      for (std::size_t digit = 1; digit < starts.size(); ++digit) starts[digit] += starts[digit - 1];
      for (std::size_t i = 0; i < places_.size(); ++i) {
        const std::size_t to = starts[places_[i] >> shift & digit_mask]++;
        next_places[to] = places_[i];
        next_ids[to] = ids_[i];
      }
      places_.swap(next_places);
      ids_.swap(next_ids);
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (kept > 0 && places_[kept - 1] == places_[i]) {
      ids_[kept - 1] = std::min(ids_[kept - 1], ids_[i]);
    } else {
      places_[kept] = places_[i];
      ids_[kept++] = ids_[i];
    }
  }
  shorten(kept);
  for (std::uint64_t& place : places_) {
    place = static_cast<std::uint64_t>(gather_bits(place >> 1)) << 32 | gather_bits(place);
  }

  levels_.clear();
  if (places_.empty()) return;
  std::vector<Box> boxes((places_.size() - 1) / fan + 1, {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN});
  const auto join = [](Box& box, const Box& other) {
    box = {std::min(box.left, other.left), std::min(box.top, other.top), std::max(box.right, other.right),
           std::max(box.bottom, other.bottom)};
  };
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const std::int32_t x = x_of(i), y = y_of(i);
    join(boxes[i / fan], {x, y, x, y});
  }
  levels_.push_back(std::move(boxes));
  while (levels_.back().size() > 1) {
    const std::vector<Box>& below = levels_.back();
    std::vector<Box> above((below.size() - 1) / fan + 1, {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN});
    for (std::size_t i = 0; i < below.size(); ++i) join(above[i / fan], below[i]);
    levels_.push_back(std::move(above));
  }
}

/// The children of a node are seeds at level 0, else nodes of the level below.
std::size_t SeedTree::children_end(std::size_t level, std::size_t node) const {
  return std::min((node + 1) * fan, level == 0 ? places_.size() : levels_[level - 1].size());
}

void SeedTree::find_inside(const PlaneRectangle& rectangle, std::vector<PlaneSeed>& found) const {
  if (!levels_.empty()) find_inside(levels_.size() - 1, 0, rectangle, found);
}

void SeedTree::find_inside(std::size_t level, std::size_t node, const PlaneRectangle& rectangle,
                           std::vector<PlaneSeed>& found) const {
  const Box& box = levels_[level][node];
  const std::int64_t right = rectangle.x + rectangle.width - 1, bottom = rectangle.y + rectangle.height - 1;
  if (box.right < rectangle.x || box.left > right || box.bottom < rectangle.y || box.top > bottom) return;
  if (holds(rectangle, box)) {
    const std::size_t shift = fan_bits * (level + 1);
    const std::size_t first = node << shift, end = std::min((node + 1) << shift, places_.size());
    const std::size_t before = found.size();
    found.resize(before + end - first);
    for (std::size_t i = first; i < end; ++i) found[before + i - first] = seed(i);
    return;
  }
  for (std::size_t child = node * fan; child < children_end(level, node); ++child) {
    if (level > 0) {
      find_inside(level - 1, child, rectangle, found);
    } else {
      if (holds(rectangle, x_of(child), y_of(child))) found.push_back(seed(child));
    }
  }
}

// --- the nearest one ---

struct SeedTree::Nearest {
  PlanePoint point, offset;
  Metric metric;
  HalfPeriods half;
  SeedImage& best;
};

void SeedTree::find_nearest(const PlanePoint& point, const Plane& plane, Metric metric,
                            SeedImage& best) const {
  if (levels_.empty()) return;
  const HalfPeriods half(plane, 0);
  each_image(plane, [&](const PlanePoint& offset) {
    Nearest search = {{point.x - offset.x, point.y - offset.y}, offset, metric, half, best};
    find_nearest(levels_.size() - 1, 0, search);
  });
}

void SeedTree::find_nearest(std::size_t level, std::size_t node, Nearest& search) const {
  const std::size_t first = node * fan, end = children_end(level, node);
  if (level == 0) {
    for (std::size_t i = first; i < end; ++i) {
      const std::int64_t dx = std::abs(x_of(i) - search.point.x);
      const std::int64_t dy = std::abs(y_of(i) - search.point.y);
      if (!search.half.hold(dx, dy)) continue;
      const std::int64_t distance = distance_of(dx, dy, search.metric);
      if (distance > search.best.distance) continue;
      const SeedImage image = {i, search.offset, distance, rank_of(i)};
      if (image.wins(search.best)) search.best = image;
    }
    return;
  }
  // The nearest box first.
  std::array<std::pair<std::int64_t, std::size_t>, fan> order;
  std::size_t count = 0;
  for (std::size_t child = first; child < end; ++child) {
    const Box& box = levels_[level - 1][child];
    const std::int64_t dx = gap(search.point.x, box.left, box.right);
    const std::int64_t dy = gap(search.point.y, box.top, box.bottom);
    if (!search.half.hold(dx, dy)) continue;
    const std::int64_t distance = distance_of(dx, dy, search.metric);
    if (distance > search.best.distance) continue;
    std::size_t place = count++;
    for (; place > 0 && order[place - 1].first > distance; --place) order[place] = order[place - 1];
    order[place] = {distance, child};
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (order[i].first <= search.best.distance) find_nearest(level - 1, order[i].second, search);
  }
}

SeedImage SeedTree::seen_from(const PlanePoint& point, const SeedImage& image, Metric metric) const {
  const std::int64_t x = x_of(image.index) + image.offset.x;
  const std::int64_t y = y_of(image.index) + image.offset.y;
  return {image.index, image.offset, distance_of(std::abs(x - point.x), std::abs(y - point.y), metric),
          image.rank};
}

// --- between two points ---

struct SeedTree::Between {
  PlanePoint a, b, offset;
  SeedImage of_b_at_a, of_a_at_b;  // what wins at one end, seen from the other one
  Metric metric;
  PlaneRectangle rectangle;
  HalfPeriods half;
  std::size_t most;
  std::vector<SeedImage>& found;
};

bool SeedTree::find_between(const PlanePoint& a, const SeedImage& at_a, const PlanePoint& b,
                            const SeedImage& at_b, const Plane& plane, Metric metric,
                            const PlaneRectangle& rectangle, std::size_t most,
                            std::vector<SeedImage>& found) const {
  // What wins at a is nearer there than another image: if it wins against that one at b too, it does between
  // them. So only images count that are as near at b as what wins at a, and the other way round.
  const SeedImage of_b_at_a = seen_from(a, at_b, metric), of_a_at_b = seen_from(b, at_a, metric);
  const HalfPeriods half(plane, std::abs(a.x - b.x) + std::abs(a.y - b.y));
  bool all = true;
  each_image(plane, [&](const PlanePoint& offset) {
    Between search = {{a.x - offset.x, a.y - offset.y},
                      {b.x - offset.x, b.y - offset.y},
                      offset,
                      of_b_at_a,
                      of_a_at_b,
                      metric,
                      rectangle,
                      half,
                      most,
                      found};
    all = all && find_between(levels_.size() - 1, 0, search);
  });
  return all;
}

bool SeedTree::find_between(std::size_t level, std::size_t node, Between& search) const {
  for (std::size_t child = node * fan; child < children_end(level, node); ++child) {
    if (level > 0) {
      const Box& box = levels_[level - 1][child];
      if (holds(search.rectangle, box)) continue;
      const std::int64_t ax = gap(search.a.x, box.left, box.right), ay = gap(search.a.y, box.top, box.bottom);
      const std::int64_t bx = gap(search.b.x, box.left, box.right), by = gap(search.b.y, box.top, box.bottom);
      if (!search.half.hold(ax, ay) || !search.half.hold(bx, by)) continue;
      if (distance_of(ax, ay, search.metric) > search.of_b_at_a.distance) continue;
      if (distance_of(bx, by, search.metric) > search.of_a_at_b.distance) continue;
      if (!find_between(level - 1, child, search)) return false;
    } else {
      const std::int64_t x = x_of(child), y = y_of(child);
      if (holds(search.rectangle, x, y)) continue;
      const std::int64_t ax = std::abs(x - search.a.x), ay = std::abs(y - search.a.y);
      const std::int64_t bx = std::abs(x - search.b.x), by = std::abs(y - search.b.y);
      if (!search.half.hold(ax, ay) || !search.half.hold(bx, by)) continue;
      const std::int64_t from_a = distance_of(ax, ay, search.metric);
      const std::int64_t from_b = distance_of(bx, by, search.metric);
      if (from_a > search.of_b_at_a.distance || from_b > search.of_a_at_b.distance) continue;
      const std::uint64_t rank = rank_of(child);
      if (search.of_b_at_a.wins({child, search.offset, from_a, rank})) continue;
      const SeedImage image = {child, search.offset, from_b, rank};
      if (search.of_a_at_b.wins(image)) continue;
      if (search.found.size() == search.most) return false;
      search.found.push_back(image);
    }
  }
  return true;
}

}  // namespace vorocl
