#include "mpi/block_tree.hpp"

#include <algorithm>

#include "tiles/near_seeds.hpp"

namespace vorocl {

void BlockTree::make(const std::vector<SeedBlock>& blocks) {
  blocks_ = blocks;
  boxes_.make(blocks.size(), [&](std::size_t i) { return blocks[i].box; });
}

std::vector<std::size_t> BlockTree::find_near(const PlaneRectangle& rectangle, Metric metric) const {
  std::vector<std::size_t> found;
  if (blocks_.empty()) return found;
  boxes_.visit_inside(rectangle, [&](std::size_t first, std::size_t end, bool all) {
    for (std::size_t i = first; i < end; ++i) {
      if (all || meets(rectangle, blocks_[i].box)) found.push_back(i);
    }
  });
  // As NearSeeds::find() does, with the samples in place of the seeds that win: those are at least as near.
  // The box of a sample's block is at least as near as the sample, by which blocks are left out.
  const auto nearest = [&](const Place& point, const SeedImage&) {
    SeedImage sample;
    NearSeeds(*this, grid_, metric).find_nearest(point, sample);
    return sample;
  };
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
  const auto meets_rectangle = [&](const Box& box) { return meets(rectangle, box); };
  visit(meets_rectangle, [&](std::size_t i) {
    const Box& box = blocks_[i].box;
    if (!meets_rectangle(box)) return true;
    seeds += blocks_[i].count * shared(box.left, box.right, rectangle.x, rectangle.width) *
             shared(box.top, box.bottom, rectangle.y, rectangle.height);
    return true;
  });
  return seeds;
}

/// Appends the blocks that may hold a winner on the line from a to b, given the samples that are nearest to
/// both ends. Returns false if they are more than `most`.
bool BlockTree::find_between(const Place& a, const SeedImage& at_a, const Place& b, const SeedImage& at_b,
                             Metric metric, std::size_t most, std::vector<std::size_t>& found) const {
  const NearSeeds samples(*this, grid_, metric);
  const PlaneLength of_b_at_a = samples.seen_from(a, at_b).distance;
  const PlaneLength of_a_at_b = samples.seen_from(b, at_a).distance;
  const PlaneDistance distance(grid_, metric, length_of(a, b));
  bool all = true;
  each_image(grid_, [&](const Place& offset) {
    const Place from_a = a - offset, from_b = b - offset;
    // Unless a sample is nearer than the whole box at both ends, and so between them.
    const auto may_win = [&](const Box& box) {
      const PlaneLength to_a = distance(from_a, box), to_b = distance(from_b, box);
      return (to_a <= at_a.distance || to_b <= of_a_at_b) && (to_a <= of_b_at_a || to_b <= at_b.distance);
    };
    all = all && this->visit(may_win, [&](std::size_t block) {
      if (!may_win(blocks_[block].box)) return true;
      if (found.size() == most) return false;
      found.push_back(block);
      return true;
    });
  });
  return all;
}

}  // namespace vorocl
