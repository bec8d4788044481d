#include "mpi/block_tree.hpp"

#include <algorithm>

#include "tiles/rim_walk.hpp"

namespace vorocl {

void BlockTree::make(const std::vector<SeedBlock>& blocks) {
  blocks_ = blocks;
  tree_.make(blocks.size(), [&](std::size_t i) { return blocks[i].box; });
}

std::vector<std::size_t> BlockTree::find_near(const PlaneRectangle& rectangle, Metric metric) const {
  std::vector<std::size_t> found;
  if (blocks_.empty()) return found;
  tree_.visit_inside(rectangle, [&](std::size_t first, std::size_t end, bool all) {
    for (std::size_t i = first; i < end; ++i) {
      if (all || meets(rectangle, blocks_[i].box)) found.push_back(i);
    }
  });
  // As PlaneSeedsState::find_near() does, with the samples in place of the seeds that win: those are at least
  // as near.
  const auto nearest = [&](const Place& point, const SeedImage&) { return nearest_sample(point, metric); };
  const auto find_in_blocks = [&](const Place& a, const SeedImage& at_a, const Place& b,
                                  const SeedImage& at_b, std::size_t most,
                                  std::vector<std::size_t>& between) {
    return find_between(a, at_a, b, at_b, metric, most, between);
  };
  walk_rim(rectangle, 16, nearest, find_in_blocks, found);
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
    return meets(rectangle, box) ? SeedBoxes::Verdict::enter : SeedBoxes::Verdict::pass;
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

SeedImage BlockTree::sample(std::size_t block, const Place& offset, const Place& from,
                            const PlaneDistance& distance) const {
  const Place place = place_of(blocks_[block].sample);
  return {block, offset, distance(from, place + offset), place};
}

/// The sample that wins at a point. Its block's box is at least as near, by which blocks are left out.
SeedImage BlockTree::nearest_sample(const Place& point, Metric metric) const {
  const PlaneDistance distance(grid_, metric);
  SeedImage best;
  each_image(grid_, [&](const Place& offset) {
    const auto to_box = [&](const Box& box) { return distance(point - offset, box); };
    const auto counts = [&](const Box& box, PlaneLength away) {
      return away != too_far && first_in(box, away).wins(best);
    };
    tree_.visit_nearest_first(to_box, counts, [&](std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < end; ++i) {
        const SeedImage image = sample(i, offset, point, distance);
        if (image.distance != too_far && image.wins(best)) best = image;
      }
    });
  });
  return best;
}

/// Appends the blocks that may hold a winner on the line from a to b, given the samples that are nearest to
/// both ends. Returns false if they are more than `most`.
bool BlockTree::find_between(const Place& a, const SeedImage& at_a, const Place& b, const SeedImage& at_b,
                             Metric metric, std::size_t most, std::vector<std::size_t>& found) const {
  // An image may be farther away than half a period, though not far.
  const PlaneDistance slack(grid_, metric, in_fractions(grid_.width() + grid_.height()));
  const PlaneLength of_b_at_a = sample(at_b.index, at_b.offset, a, slack).distance;
  const PlaneLength of_a_at_b = sample(at_a.index, at_a.offset, b, slack).distance;
  const PlaneDistance distance(grid_, metric, length_of(a, b));
  bool all = true;
  each_image(grid_, [&](const Place& offset) {
    const Place from_a = a - offset, from_b = b - offset;
    // Unless a sample is nearer than the whole box at both ends, and so between them.
    const auto may_win = [&](const Box& box) {
      const PlaneLength to_a = distance(from_a, box), to_b = distance(from_b, box);
      return (to_a <= at_a.distance || to_b <= of_a_at_b) && (to_a <= of_b_at_a || to_b <= at_b.distance);
    };
    const auto judge = [&](const Box& box) {
      return may_win(box) ? SeedBoxes::Verdict::enter : SeedBoxes::Verdict::pass;
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
