// Distances in a plane, which may be periodic, in integers; and which of two seeds wins.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "core/box_tree.hpp"
#include "core/snapping.hpp"
#include "core/z_order.hpp"
#include "runtime/metric.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

/// Boxes around seeds, or around blocks of them, in an index for NearSeeds.
class SeedBoxes {
 public:
  /// See NearSeeds.
  template <typename Enters, typename Use>
  bool visit(Enters enters, Use use) const {
    const auto judge = [&](const Box& box) {
      return enters(box) ? Boxes::Verdict::enter : Boxes::Verdict::pass;
    };
    return boxes_.visit(judge, [&](std::size_t first, std::size_t end, bool) {
      for (std::size_t i = first; i < end; ++i) {
        if (!use(i)) return false;
      }
      return true;
    });
  }
  template <typename Distance, typename Counts, typename Use>
  void visit_nearest_first(Distance distance, Counts counts, Use use) const {
    boxes_.visit_nearest_first(distance, counts, [&](std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < end; ++i) use(i);
    });
  }

 protected:
  using Boxes = BoxTree<4>;
  Boxes boxes_;
};

/// A squared distance in fractions of a pixel does not fit 64 bits.
using PlaneLength = Int128;
constexpr PlaneLength too_far = PlaneLength{1} << 126;

/// A seed, or one of its images where the plane is periodic, at a distance from a point.
struct SeedImage {
  std::size_t index = 0;  // of the seed
  Place offset;           // of the image from the seed
  PlaneLength distance = too_far;
  Place seed = {INT64_MAX, INT64_MAX};  // where the seed lies itself, for the tie rule

  /// Whether it is the nearer one, by the tie rule if both are as far. (A seed's images are equal in that.)
  bool wins(const SeedImage& other) const {
    if (distance != other.distance) return distance < other.distance;
    return seed.y != other.seed.y ? seed.y < other.seed.y : seed.x < other.seed.x;
  }

  friend bool operator==(const SeedImage& a, const SeedImage& b) {
    return a.index == b.index && a.offset == b.offset;
  }
};

/// What no seed of a box is before, in the order of winning: as near as the box, and first in it.
inline SeedImage first_in(const Box& box, PlaneLength away) {
  SeedImage image;
  image.distance = away;
  image.seed = {in_fractions(box.left), in_fractions(box.top)};
  return image;
}

/// Distances between a point and images, squared if Euclidean. What is farther than half a period along an
/// axis, and `slack` more, is too_far: another image is nearer.
class PlaneDistance {
 public:
  PlaneDistance(const Grid& grid, Metric metric, std::int64_t slack = 0)
      : twice_most_x_(has_x(grid.periodic()) ? in_fractions(grid.width()) + 2 * slack : INT64_MAX),
        twice_most_y_(has_y(grid.periodic()) ? in_fractions(grid.height()) + 2 * slack : INT64_MAX),
        metric_(metric) {}

  PlaneLength operator()(const Place& from, const Place& to) const {
    return of(std::abs(to.x - from.x), std::abs(to.y - from.y));
  }

  /// To the nearest place in the pixels of a box.
  PlaneLength operator()(const Place& from, const Box& to) const {
    return of(gap(from.x, to.left, to.right), gap(from.y, to.top, to.bottom));
  }

 private:
  static std::int64_t gap(std::int64_t at, std::int64_t low, std::int64_t high) {
    return std::max<std::int64_t>(std::max(in_fractions(low) - at, at - in_fractions(high + 1) + 1), 0);
  }

  PlaneLength of(std::int64_t dx, std::int64_t dy) const {
    if (2 * dx > twice_most_x_ || 2 * dy > twice_most_y_) return too_far;
    return compared_distance(metric_, PlaneLength{dx}, PlaneLength{dy});
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
      use(Place{periods[i] * in_fractions(grid.width()), periods[j] * in_fractions(grid.height())});
    }
  }
}

/// The centres of a rectangle's pixels at its corners, as its rim runs through them.
inline std::array<Place, 4> corners_of(const PlaneRectangle& rectangle) {
  const std::int64_t left = centre_of(rectangle.x), right = centre_of(rectangle.x + rectangle.width - 1);
  const std::int64_t top = centre_of(rectangle.y), bottom = centre_of(rectangle.y + rectangle.height - 1);
  return {{{left, top}, {right, top}, {right, bottom}, {left, bottom}}};
}

/// The length of an axis-parallel line.
inline std::int64_t length_of(const Place& a, const Place& b) {
  return std::abs(a.x - b.x) + std::abs(a.y - b.y);
}

}  // namespace vorocl
