// Which blocks of a plane's seeds a tile needs, where only the boxes around the blocks are known.
#pragma once

#include <cstddef>
#include <vector>

#include "tiles/plane_distance.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

/// Some seeds that follow each other on the Z-curve: the box around them, and one of them.
struct SeedBlock {
  Box box;
  PlaneSeed sample;         // the one
  std::uint32_t count = 0;  // of the seeds
};

/// An index for find_nearest() of NearSeeds, of the samples.
class BlockTree : public SeedBoxes {
 public:
  explicit BlockTree(const Grid& grid) : grid_(grid) {}

  /// Of blocks in the order of the Z-curve. None is empty.
  void make(const std::vector<SeedBlock>& blocks);

  /// The numbers of the blocks that may hold a seed that owns a pixel of a rectangle, in order. Cost: as
  /// PlaneSeeds::find_near(), for blocks instead of seeds.
  std::vector<std::size_t> find_near(const PlaneRectangle& rectangle, Metric metric) const;

  /// About how many seeds lie in a rectangle: as if they were spread evenly in each box.
  double expected(const PlaneRectangle& rectangle) const;

  /// The one that is known of a block.
  const PlaneSeed& seed(std::size_t block) const { return blocks_[block].sample; }

 private:
  bool find_between(const Place& a, const SeedImage& at_a, const Place& b, const SeedImage& at_b,
                    Metric metric, std::size_t most, std::vector<std::size_t>& found) const;

  Grid grid_;
  std::vector<SeedBlock> blocks_;
};

}  // namespace vorocl
