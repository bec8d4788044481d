// Distances in a plane, which may be periodic, in 64-bit integers; and which of two seeds wins.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "core/box_tree.hpp"
#include "core/z_order.hpp"
#include "runtime/metric.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

/// Boxes around seeds, or around blocks of them.
using SeedBoxes = BoxTree<4>;

/// A point of the plane in pixels, or an offset.
struct PlanePoint {
  std::int64_t x = 0, y = 0;

  friend bool operator==(const PlanePoint& a, const PlanePoint& b) { return a.x == b.x && a.y == b.y; }
  friend PlanePoint operator+(const PlanePoint& a, const PlanePoint& b) { return {a.x + b.x, a.y + b.y}; }
  friend PlanePoint operator-(const PlanePoint& a, const PlanePoint& b) { return {a.x - b.x, a.y - b.y}; }
};

constexpr std::int64_t too_far = INT64_MAX;

/// The rank of a position in row-major order, which is that of the tie rule.
inline std::uint64_t rank_of(std::int32_t x, std::int32_t y) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(y) ^ z_bias) << 32 |
         (static_cast<std::uint32_t>(x) ^ z_bias);
}

/// A seed, or one of its images where the plane is periodic, at a distance from a point.
struct SeedImage {
  std::size_t index = 0;  // of the seed
  PlanePoint offset;      // of the image from the seed
  std::int64_t distance = too_far;
  std::uint64_t rank = UINT64_MAX;  // of the seed in the tie rule

  /// Whether it is the nearer one, by the tie rule if both are as far. (A seed's images are of one rank.)
  bool wins(const SeedImage& other) const {
    return distance != other.distance ? distance < other.distance : rank < other.rank;
  }

  friend bool operator==(const SeedImage& a, const SeedImage& b) {
    return a.index == b.index && a.offset == b.offset;
  }
};

/// What no seed of a box is before, in the order of winning: as near as the box, and first in it.
inline SeedImage first_in(const Box& box, std::int64_t away) {
  SeedImage image;
  image.distance = away;
  image.rank = rank_of(box.left, box.top);
  return image;
}

/// Distances between a point and images, squared if Euclidean. What is farther than half a period along an
/// axis, and `slack` more, is too_far: another image is nearer. So no square overflows.
class PlaneDistance {
 public:
  PlaneDistance(const Grid& grid, Metric metric, std::int64_t slack = 0)
      : twice_most_x_(has_x(grid.periodic()) ? grid.width() + 2 * slack : INT64_MAX),
        twice_most_y_(has_y(grid.periodic()) ? grid.height() + 2 * slack : INT64_MAX),
        metric_(metric) {}

  std::int64_t operator()(const PlanePoint& from, const PlanePoint& to) const {
    return of(std::abs(to.x - from.x), std::abs(to.y - from.y));
  }

  /// To the nearest point of a box.
  std::int64_t operator()(const PlanePoint& from, const Box& to) const {
    return of(gap(from.x, to.left, to.right), gap(from.y, to.top, to.bottom));
  }

 private:
  static std::int64_t gap(std::int64_t at, std::int64_t low, std::int64_t high) {
    return std::max<std::int64_t>(std::max(low - at, at - high), 0);
  }

  std::int64_t of(std::int64_t dx, std::int64_t dy) const {
    if (2 * dx > twice_most_x_ || 2 * dy > twice_most_y_) return too_far;
    return compared_distance(metric_, dx, dy);
  }

  std::int64_t twice_most_x_, twice_most_y_;
  Metric metric_;
};

/// Calls a function with the offset of each image of the plane around it, the plane's own first.
template <typename Use>
void each_image(const Grid& grid, Use use) {
  const int along_x = has_x(grid.periodic()) ? 3 : 1, along_y = has_y(grid.periodic()) ? 3 : 1;
  constexpr std::int64_t periods[] = {0, -1, 1};
  for (int j = 0; j < along_y; ++j) {
    for (int i = 0; i < along_x; ++i) {
      use(PlanePoint{periods[i] * grid.width(), periods[j] * grid.height()});
    }
  }
}

/// The corners of a rectangle, as its rim runs through them.
inline std::array<PlanePoint, 4> corners_of(const PlaneRectangle& rectangle) {
  const std::int64_t right = rectangle.x + rectangle.width - 1, bottom = rectangle.y + rectangle.height - 1;
  return {{{rectangle.x, rectangle.y}, {right, rectangle.y}, {right, bottom}, {rectangle.x, bottom}}};
}

/// The length of an axis-parallel line.
inline std::int64_t length_of(const PlanePoint& a, const PlanePoint& b) {
  return std::abs(a.x - b.x) + std::abs(a.y - b.y);
}

}  // namespace vorocl
