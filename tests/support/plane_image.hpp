// The labels of a grid's tiles as one image.
#pragma once

#include <algorithm>
#include <vector>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

/// The labels of all tiles, as one image of the tiling's window.
class Image {
 public:
  explicit Image(const Tiling& tiling)
      : window_(tiling.window()),
        labels(window_.pixels(), no_label - 1),
        times_(static_cast<std::size_t>(tiling.count()), 0) {}

  void add(const TileLabels& tile) {
    ++times_[static_cast<std::size_t>(tile.number)];
    const Grid& grid = window_.grid();
    const Pixel first = in_period(grid, {tile.tile.x() - window_.x(), tile.tile.y() - window_.y()});
    for (std::int64_t y = 0; y < tile.tile.height(); ++y) {
      const std::int64_t to = (first.y + y) * window_.width() + first.x;
      std::copy_n(tile.labels + y * tile.tile.width(), tile.tile.width(), labels.begin() + to);
    }
  }

  bool each_tile_once() const {
    return std::all_of(times_.begin(), times_.end(), [](int times) { return times == 1; });
  }

 private:
  Window window_;

 public:
  Labels labels;

 private:
  std::vector<int> times_;
};

inline Labels labels_of(const SeedSource& seeds, const Tiling& tiling, const TileOptions& options = {}) {
  Image image(tiling);
  exact_tiles(
      test_device(), seeds, tiling, [&](const TileLabels& tile) { image.add(tile); }, options);
  BOOST_TEST(image.each_tile_once());
  return image.labels;
}

}  // namespace vorocl
