#include "app/sources/particles.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace vorocl::command {

void ParticleSlots::update(const std::vector<std::uint32_t>& ids) {
  std::unordered_map<std::uint32_t, std::uint32_t> before = std::move(slots_);
  slots_.clear();
  slots_.reserve(ids.size());
  of_ids_.clear();
  for (const std::uint32_t id : ids) {
    std::uint32_t slot = 0;
    if (const auto found = before.find(id); found != before.end()) {
      slot = found->second;
      before.erase(found);
    } else if (!free_.empty()) {
      slot = *free_.begin();
      free_.erase(free_.begin());
    } else {
      slot = static_cast<std::uint32_t>(size_++);
    }
    slots_.emplace(id, slot);
    of_ids_.push_back(slot);
  }
  for (const auto& vanished : before) free_.insert(vanished.second);
}

namespace {

/// The shorter way round; distances are of less than a few periods.
double shortest(double distance, double period) {
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
  for (const double t : {turns - 1, turns, turns + 1}) {
    const double x = shortest(dx - t * periods.tilt, periods.x), y = std::abs(dy - t * periods.y);
    least = std::min(least, std::max(x, y));
  }
  return least;
}

}  // namespace vorocl::command
