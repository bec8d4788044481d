#include "app/sources/particles.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace vorocl::command {

void ParticleSlots::update(const std::vector<std::uint32_t>& ids) {
  std::vector<std::uint32_t> slots, vanished;
  slots.reserve(ids.size());
  std::size_t last = 0;  // the first of the last ids that is not below the present one
  for (const std::uint32_t id : ids) {
    for (; last < ids_.size() && ids_[last] < id; ++last) vanished.push_back(of_ids_[last]);
    if (last < ids_.size() && ids_[last] == id) {
      slots.push_back(of_ids_[last++]);
    } else if (!free_.empty()) {
      slots.push_back(*free_.begin());
      free_.erase(free_.begin());
    } else {
      slots.push_back(static_cast<std::uint32_t>(size_++));
    }
  }
  for (; last < ids_.size(); ++last) vanished.push_back(of_ids_[last]);
  free_.insert(vanished.begin(), vanished.end());
  ids_ = ids;
  of_ids_ = std::move(slots);
}

namespace {

/// The shorter way round; distances are of less than a few periods.
double shortest(double distance, double period) {
  if (std::abs(distance) <= period / 2) return std::abs(distance);  // most are; a remainder takes far longer
  return period > 0 ? std::abs(std::remainder(distance, period)) : std::abs(distance);
}

}  // namespace

Periods periods_in_pixels(const Box& box, const Bounds& bounds, const Size& picture, bool y_up) {
  const double x_extent = bounds.x1 - bounds.x0, y_extent = bounds.y1 - bounds.y0;
  const double x_scale = x_extent > 0 ? picture.width() / x_extent : 0;
  const double y_scale = y_extent > 0 ? picture.height() / y_extent : 0;
  return {box.periodic_x ? (box.x1 - box.x0) * x_scale : 0, box.periodic_y ? (box.y1 - box.y0) * y_scale : 0,
          (y_up ? -box.tilt : box.tilt) * x_scale};
}

double displacement(const Point& from, const Point& to, const Periods& periods) {
  const double dx = to.x - from.x, dy = to.y - from.y;
  if (periods.y <= 0) return std::max(shortest(dx, periods.x), std::abs(dy));
  // Once round in y shifts x by the tilt.
  const double turns = std::round(dy / periods.y);
  double least = INFINITY;
  for (const double t : {turns, turns - 1, turns + 1}) {
    const double y = std::abs(dy - t * periods.y);
    if (y < least) least = std::min(least, std::max(shortest(dx - t * periods.tilt, periods.x), y));
  }
  return least;
}

}  // namespace vorocl::command
