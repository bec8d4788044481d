// The labels of a plane's tiles as one image.
#pragma once

#include <algorithm>
#include <vector>

#include "fixture.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

using Labels = std::vector<std::uint32_t>;

/// The labels of all tiles, as one image of the tiling's part.
class Image {
 public:
  explicit Image(const Tiling& tiling)
      : part_(tiling.part()),
        labels(static_cast<std::size_t>(part_.width * part_.height), no_label - 1),
        times_(static_cast<std::size_t>(tiling.count()), 0) {}

  void add(const TileLabels& tile) {
    ++times_[static_cast<std::size_t>(tile.number)];
    for (int y = 0; y < tile.tile.height; ++y) {
      const std::int64_t to = (tile.tile.y + y - part_.y) * part_.width + tile.tile.x - part_.x;
      std::copy_n(tile.labels + std::ptrdiff_t{y} * tile.tile.width, tile.tile.width, labels.begin() + to);
    }
  }

  bool each_tile_once() const {
    return std::all_of(times_.begin(), times_.end(), [](int times) { return times == 1; });
  }

 private:
  PlaneRectangle part_;

 public:
  Labels labels;

 private:
  std::vector<int> times_;
};

inline Labels labels_of(const PlaneSeeds& seeds, const Tiling& tiling, const TileOptions& options = {}) {
  Image image(tiling);
  exact_tiles(
      test_device(), seeds, tiling, [&](const TileLabels& tile) { image.add(tile); }, options);
  BOOST_TEST(image.each_tile_once());
  return image.labels;
}

inline std::size_t count_differences(const Labels& a, const Labels& b) {
  BOOST_REQUIRE(a.size() == b.size());
  std::size_t differences = 0;
  for (std::size_t i = 0; i < a.size(); ++i) differences += a[i] != b[i] ? 1 : 0;
  return differences;
}

/// Seeds in a disc.

}  // namespace vorocl
