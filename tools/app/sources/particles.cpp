#include "app/sources/particles.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <tuple>
#include <utility>

namespace vorocl::command {

namespace {

/// Sorts particles, which ascend, by rows of 16 pixels, and in these from left to right.
void sort_in_plane(std::vector<std::uint32_t>& particles, const std::vector<Point>& places) {
  constexpr double height = 16;
  struct Place {
    double row, x;
    std::uint32_t particle;
  };
  std::vector<Place> sorted;
  sorted.reserve(particles.size());
  for (const std::uint32_t particle : particles) {
    const Point& at = places[particle];
    sorted.push_back({std::floor(at.y / height), at.x, particle});
  }
  std::sort(sorted.begin(), sorted.end(), [](const Place& a, const Place& b) {
    return std::tie(a.row, a.x, a.particle) < std::tie(b.row, b.x, b.particle);
  });
  std::transform(sorted.begin(), sorted.end(), particles.begin(),
                 [](const Place& place) { return place.particle; });
}

}  // namespace

void ParticleSlots::update(const std::vector<std::uint32_t>& ids, const std::vector<Point>& places) {
  std::vector<std::uint32_t> slots(ids.size()), vanished, newcomers;
  std::size_t last = 0;  // the first of the last ids that is not below the present one
  for (std::uint32_t i = 0; i < ids.size(); ++i) {
    for (; last < ids_.size() && ids_[last] < ids[i]; ++last) vanished.push_back(of_ids_[last]);
    if (last < ids_.size() && ids_[last] == ids[i]) {
      slots[i] = of_ids_[last++];
    } else {
      newcomers.push_back(i);
    }
  }
  for (; last < ids_.size(); ++last) vanished.push_back(of_ids_[last]);
  sort_in_plane(newcomers, places);
  for (const std::uint32_t i : newcomers) {
    if (!free_.empty()) {
      slots[i] = *free_.begin();
      free_.erase(free_.begin());
    } else {
      slots[i] = static_cast<std::uint32_t>(size_++);
    }
  }
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
  if (periods.y <= 0 || periods.tilt == 0) return std::max(shortest(dx, periods.x), shortest(dy, periods.y));
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
