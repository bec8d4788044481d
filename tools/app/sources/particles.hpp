// What is known of particles from frame to frame: which seed stands for which, and how far they have moved.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "app/sources/bounds.hpp"
#include "formats/trajectory/trajectory.hpp"

namespace vorocl::command {

/// A seed's number must stay small and stay the same from frame to frame; a particle's id may be any, vanish
/// and come back. So each particle has a slot, the number of its seed, as long as it is there. A slot that
/// one frame has seen empty is given away again: no label names it any more, and the number of slots does not
/// grow with that of the frames.
class ParticleSlots {
 public:
  /// Goes on to a frame of particles with these ids, ascending, at these places. Newcomers get the lowest
  /// slots that are free, in the order of the plane: what goes through the pixels of a diagram then finds the
  /// seeds of one part of it together in memory, also where ids say nothing of places.
  void update(const std::vector<std::uint32_t>& ids, const std::vector<Point>& places);

  /// The slots of the ids of the last update, in their order.
  const std::vector<std::uint32_t>& of_ids() const { return of_ids_; }

  /// The number of slots, those that are empty included.
  std::size_t size() const { return size_; }

 private:
  std::vector<std::uint32_t> ids_, of_ids_;
  std::set<std::uint32_t> free_;
  std::size_t size_ = 0;
};

/// A box's periods in pixels; 0 along an axis that is not periodic.
struct Periods {
  double x = 0;
  double y = 0;
  double tilt = 0;  ///< how far the copy of the box below (at a greater row) is shifted in x
};

Periods periods_in_pixels(const Box& box, const Bounds& bounds, const Size& picture, bool y_up);

/// How far apart two positions are along the axis where they are farther apart, by the shortest way round.
double displacement(const Point& from, const Point& to, const Periods& periods);

}  // namespace vorocl::command
