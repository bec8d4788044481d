// The seeds of a plane in the order of a Z-curve, and boxes around them: what tiles find their seeds with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/box_tree.hpp"
#include "core/z_order.hpp"
#include "tiles/plane_distance.hpp"
#include "vorocl/grid.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

/// 13 bytes a seed, 17 where seeds are not snapped.
class SeedTree : public SeedBoxes {
 public:
  explicit SeedTree(Snap snap) : has_parts_(snap == Snap::none) {}

  void reserve(std::size_t count);
  void add(const PlaneSeed& seed);
  void shorten(std::size_t count);  // takes back the last ones
  std::size_t size() const { return places_.size(); }

  /// Puts the seeds in order, with one at each place, that of the lowest id, and makes the boxes. Cost: some
  /// passes over the seeds, with as much memory again.
  void sort();

  PlaneSeed seed(std::size_t index) const {
    PlaneSeed seed = {x_of(index), y_of(index), ids_[index]};
    if (has_parts_) {
      seed.part_x = static_cast<std::uint16_t>(parts_[index]);
      seed.part_y = static_cast<std::uint16_t>(parts_[index] >> 16);
    }
    return seed;
  }

  /// Appends the seeds in a rectangle.
  void find_inside(const PlaneRectangle& rectangle, std::vector<PlaneSeed>& found) const;

 private:
  void sort_places();
  void sort_within_pixels();

  // Of seeds in order.
  std::int32_t x_of(std::size_t index) const { return static_cast<std::int32_t>(places_[index] ^ z_bias); }
  std::int32_t y_of(std::size_t index) const {
    return static_cast<std::int32_t>(places_[index] >> 32 ^ z_bias);
  }

  bool has_parts_;
  std::vector<std::uint64_t> places_;  // on the Z-curve; once they are in order, y and x
  std::vector<std::uint32_t> ids_;
  std::vector<std::uint32_t> parts_;  // within the pixels, those of y above those of x; none: the centres
};

}  // namespace vorocl
