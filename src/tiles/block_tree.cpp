#include "tiles/block_tree.hpp"

#include <algorithm>
#include <array>

namespace vorocl {

void BlockTree::make(const std::vector<SeedBlock>& blocks) {
  blocks_ = blocks;
  samples_ = SeedTree();
  samples_.reserve(blocks.size());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    samples_.add(blocks[i].x, blocks[i].y, static_cast<std::uint32_t>(i));
  }
  samples_.sort();
  tree_.make(blocks.size(), [&](std::size_t i) { return blocks[i].box; });
}

std::vector<std::size_t> BlockTree::find_near(const PlaneRectangle& rectangle, Metric metric) const {
  std::vector<std::size_t> found;
  if (blocks_.empty()) return found;
  using Verdict = BoxTree::Verdict;
  const auto judge = [&](const Box& box) {
    if (!meets(rectangle, box)) return Verdict::pass;
    return holds(rectangle, box) ? Verdict::take : Verdict::enter;
  };
  tree_.visit(judge, [&](std::size_t first, std::size_t end, bool all) {
    for (std::size_t i = first; i < end; ++i) {
      if (all || meets(rectangle, blocks_[i].box)) found.push_back(i);
    }
    return true;
  });
  find_at_rim(rectangle, metric, found);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

double BlockTree::expected(const PlaneRectangle& rectangle) const {
  const auto shared = [](std::int64_t low, std::int64_t high, std::int64_t first, std::int64_t count) {
    const std::int64_t both = std::min(high + 1, first + count) - std::max(low, first);
    return static_cast<double>(both) / static_cast<double>(high + 1 - low);
  };
  double seeds = 0;
  const auto judge = [&](const Box& box) {
    return meets(rectangle, box) ? BoxTree::Verdict::enter : BoxTree::Verdict::pass;
  };
  tree_.visit(judge, [&](std::size_t first, std::size_t end, bool) {
    for (std::size_t i = first; i < end; ++i) {
      const Box& box = blocks_[i].box;
      if (!meets(rectangle, box)) continue;
      seeds += blocks_[i].count * shared(box.left, box.right, rectangle.x, rectangle.width) *
               shared(box.top, box.bottom, rectangle.y, rectangle.height);
    }
    return true;
  });
  return seeds;
}

// As PlaneSeeds::find_near() walks the rim, with the samples in place of the seeds that win: what wins is at
// least as near.
void BlockTree::find_at_rim(const PlaneRectangle& rectangle, Metric metric,
                            std::vector<std::size_t>& found) const {
  constexpr std::size_t few = 16;
  const auto nearest_sample = [&](const PlanePoint& point) {
    SeedImage nearest;
    samples_.find_nearest(point, plane_, metric, nearest);
    return nearest;
  };
  std::vector<std::size_t> between;
  std::int64_t step = 64;
  const std::array<PlanePoint, 4> corners = corners_of(rectangle);
  for (std::size_t side = 0; side < corners.size(); ++side) {
    PlanePoint a = corners[side];
    const PlanePoint& end = corners[(side + 1) % corners.size()];
    SeedImage at_a = nearest_sample(a);
    for (bool done = false; !done;) {  // once where a side has no length
      const std::int64_t left = length_of(a, end);
      step = std::min(std::max<std::int64_t>(step, 1), left);
      const PlanePoint b =
          left == 0 ? end : PlanePoint{a.x + (end.x - a.x) / left * step, a.y + (end.y - a.y) / left * step};
      const SeedImage at_b = nearest_sample(b);
      between.clear();
      if (!find_between(a, at_a, b, at_b, metric, step > 1 ? few : SIZE_MAX, between)) {
        step /= 2;
        continue;
      }
      found.insert(found.end(), between.begin(), between.end());
      done = step == left;
      a = b;
      at_a = at_b;
      if (between.size() < few / 4) step *= 2;
    }
  }
}

/// Appends the blocks that may hold a winner on the line from a to b, given the samples that are nearest to
/// both ends. Returns false if they are more than `most`.
bool BlockTree::find_between(const PlanePoint& a, const SeedImage& at_a, const PlanePoint& b,
                             const SeedImage& at_b, Metric metric, std::size_t most,
                             std::vector<std::size_t>& found) const {
  const std::int64_t of_b_at_a = samples_.seen_from(a, plane_, metric, at_b).distance;
  const std::int64_t of_a_at_b = samples_.seen_from(b, plane_, metric, at_a).distance;
  const PlaneDistance distance(plane_, metric, length_of(a, b));
  bool all = true;
  each_image(plane_, [&](const PlanePoint& offset) {
    const PlanePoint from_a = a - offset, from_b = b - offset;
    // Unless a sample is nearer than the whole box at both ends, and so between them.
    const auto may_win = [&](const Box& box) {
      const std::int64_t to_a = distance(from_a, box), to_b = distance(from_b, box);
      return (to_a <= at_a.distance || to_b <= of_a_at_b) && (to_a <= of_b_at_a || to_b <= at_b.distance);
    };
    const auto judge = [&](const Box& box) {
      return may_win(box) ? BoxTree::Verdict::enter : BoxTree::Verdict::pass;
    };
    all = all && tree_.visit(judge, [&](std::size_t first, std::size_t end, bool) {
      for (std::size_t i = first; i < end; ++i) {
        if (!may_win(blocks_[i].box)) continue;
        if (found.size() == most) return false;
        found.push_back(i);
      }
      return true;
    });
  });
  return all;
}

}  // namespace vorocl
