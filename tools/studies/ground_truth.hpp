// The ground truth of bench: the least distances, by an exact method that shares nothing with the engines (a
// k-d tree).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "formats/label_image.hpp"

namespace vorocl::command {

class GroundTruth {
 public:
  /// `seeds` holds the points by id, as Seeds::read() gives them. Finds the least distance of every pixel:
  /// about a microsecond per pixel and core, and 4 bytes per pixel.
  GroundTruth(const Grid& grid, const std::vector<std::optional<Point>>& seeds, Metric metric);

  /// Pixels without a label, or with the label of a seed that is not there or not at the least distance.
  std::size_t wrong_pixels(const std::vector<std::uint32_t>& labels) const;

 private:
  struct Position {
    int x;
    int y;
  };
  std::uint32_t distance(const Position& seed, int x, int y) const;

  Grid grid_;
  Metric metric_;
  std::vector<std::optional<Position>> seeds_;  // by id
  std::vector<std::uint32_t> least_;            // row-major; squared if euclidean
};

}  // namespace vorocl::command
