// A tree of boxes around items of the plane that are in the order of a Z-curve.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "vorocl/tiles.hpp"

namespace vorocl {

/// A rectangle of a grid's pixels, in its one period.
struct PlaneRectangle {
  std::int64_t x = 0, y = 0;  // the first pixel
  std::int64_t width = 1, height = 1;
};

/// The parts of a window that lie in its grid's one period: one, unless it crosses the end of a period.
inline std::vector<PlaneRectangle> parts_of(const Window& window) {
  using Stretch = std::pair<std::int64_t, std::int64_t>;
  const auto stretches = [](const Axis& axis, std::int64_t begin, std::int64_t length) {
    const std::int64_t rest = axis.pixels() - begin;
    return length <= rest ? std::vector<Stretch>{{begin, length}}
                          : std::vector<Stretch>{{begin, rest}, {0, length - rest}};
  };
  std::vector<PlaneRectangle> parts;
  for (const auto& [y, height] : stretches(window.grid().y(), window.y(), window.height())) {
    for (const auto& [x, width] : stretches(window.grid().x(), window.x(), window.width()))
      parts.push_back({x, y, width, height});
  }
  return parts;
}

/// A rectangle of pixels, both ends included.
struct Box {
  std::int32_t left = INT32_MAX, top = INT32_MAX, right = INT32_MIN, bottom = INT32_MIN;

  void add(const Box& other) {
    left = std::min(left, other.left);
    top = std::min(top, other.top);
    right = std::max(right, other.right);
    bottom = std::max(bottom, other.bottom);
  }
};

inline bool holds(const PlaneRectangle& rectangle, std::int64_t x, std::int64_t y) {
  return x >= rectangle.x && x - rectangle.x < rectangle.width && y >= rectangle.y &&
         y - rectangle.y < rectangle.height;
}

inline bool holds(const PlaneRectangle& rectangle, const Box& box) {
  return holds(rectangle, box.left, box.top) && holds(rectangle, box.right, box.bottom);
}

inline bool meets(const PlaneRectangle& rectangle, const Box& box) {
  return box.right >= rectangle.x && box.left - rectangle.x < rectangle.width && box.bottom >= rectangle.y &&
         box.top - rectangle.y < rectangle.height;
}

/// Boxes around each 2^fan_bits items, around as many of those boxes, and so on up to one.
template <int fan_bits>
class BoxTree {
 public:
  /// Of so many items, with a function that gives the box of each.
  template <typename BoxOf>
  void make(std::size_t items, BoxOf box_of) {
    items_ = items;
    levels_.clear();
    if (items == 0) return;
    add_level(items, box_of);
    while (levels_.back().size() > 1) {
      const std::vector<Box> below = levels_.back();
      add_level(below.size(), [&](std::size_t i) { return below[i]; });
    }
  }

  /// The boxes by level, the finest ones first. None of no items.
  const std::vector<std::vector<Box>>& levels() const { return levels_; }

  enum class Verdict { pass, enter, take };

  /// Shows a function the boxes from the top, in order: it passes a box, enters it, or takes all in it. Gives
  /// a second function the items that were come to, as a range, with whether it was taken. Ends early, and
  /// returns false, if that one returns false.
  template <typename Judge, typename Use>
  bool visit(Judge judge, Use use) const {
    return levels_.empty() || visit(levels_.size() - 1, 0, judge, use);
  }

  /// Gives a function ranges of items that may be in a rectangle, with whether all of them are.
  template <typename Use>
  void visit_inside(const PlaneRectangle& rectangle, Use use) const {
    const auto judge = [&](const Box& box) {
      if (!meets(rectangle, box)) return Verdict::pass;
      return holds(rectangle, box) ? Verdict::take : Verdict::enter;
    };
    visit(judge, [&](std::size_t first, std::size_t end, bool all) {
      use(first, end, all);
      return true;
    });
  }

  /// Calls `use` with ranges of items, the nearest boxes first. `counts` is asked of a box and its distance
  /// whether its items count.
  template <typename Distance, typename Counts, typename Use>
  void visit_nearest_first(Distance distance, Counts counts, Use use) const {
    if (!levels_.empty()) visit_nearest_first(levels_.size() - 1, 0, distance, counts, use);
  }

 private:
  static constexpr std::size_t fan = std::size_t{1} << fan_bits;

  template <typename BoxOf>
  void add_level(std::size_t count, BoxOf box_of) {
    std::vector<Box> boxes((count - 1) / fan + 1);
    for (std::size_t i = 0; i < count; ++i) boxes[i / fan].add(box_of(i));
    levels_.push_back(std::move(boxes));
  }

  /// The items of a node of a level.
  std::size_t first_item(std::size_t level, std::size_t node) const { return node << fan_bits * (level + 1); }
  std::size_t end_item(std::size_t level, std::size_t node) const {
    return std::min(first_item(level, node + 1), items_);
  }
  std::size_t end_child(std::size_t level, std::size_t node) const {
    return std::min((node + 1) * fan, levels_[level - 1].size());
  }

  template <typename Judge, typename Use>
  bool visit(std::size_t level, std::size_t node, const Judge& judge, const Use& use) const {
    const Verdict verdict = judge(levels_[level][node]);
    if (verdict == Verdict::pass) return true;
    if (verdict == Verdict::take || level == 0) {
      return use(first_item(level, node), end_item(level, node), verdict == Verdict::take);
    }
    for (std::size_t child = node * fan; child < end_child(level, node); ++child) {
      if (!visit(level - 1, child, judge, use)) return false;
    }
    return true;
  }

  template <typename Distance, typename Counts, typename Use>
  void visit_nearest_first(std::size_t level, std::size_t node, const Distance& distance,
                           const Counts& counts, const Use& use) const {
    if (level == 0) {
      use(first_item(level, node), end_item(level, node));
      return;
    }
    using Length = decltype(distance(Box()));
    std::array<std::pair<Length, std::size_t>, fan> order;
    std::size_t count = 0;
    for (std::size_t child = node * fan; child < end_child(level, node); ++child) {
      const Box& box = levels_[level - 1][child];
      const Length away = distance(box);
      if (!counts(box, away)) continue;
      std::size_t place = count++;
      for (; place > 0 && order[place - 1].first > away; --place) order[place] = order[place - 1];
      order[place] = {away, child};
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [away, child] = order[i];
      if (counts(levels_[level - 1][child], away)) {
        visit_nearest_first(level - 1, child, distance, counts, use);
      }
    }
  }

  std::size_t items_ = 0;
  std::vector<std::vector<Box>> levels_;
};

}  // namespace vorocl
