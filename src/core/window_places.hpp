// The seeds and images that a window of a grid may have to know: which of them can own its pixels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "core/place.hpp"
#include "vorocl/grid.hpp"

namespace vorocl {

/// A rectangle of pixels, both ends included.
struct Region {
  std::int64_t left, top, right, bottom;
  bool empty() const { return right < left || bottom < top; }
};

/// What repeats: the periods, 0 along an axis that is not periodic.
struct Periods {
  explicit Periods(const Grid& grid)
      : x(along(grid.x())), y(along(grid.y())), z(grid.is_volume() ? along(grid.z()) : 0) {}

  std::int64_t x, y, z;

 private:
  static std::int64_t along(const Axis& axis) { return axis.is_periodic() ? axis.pixels() : 0; }
};

/// Gauss's reduction of a lattice: two vectors that span it, such that no sum of them is shorter.
inline std::pair<Place, Place> reduced(Place u, Place v) {
  const auto dot = [](const Place& a, const Place& b) { return Int128{a.x} * b.x + Int128{a.y} * b.y; };
  if (dot(v, v) < dot(u, u)) std::swap(u, v);
  while (true) {
    const auto times = static_cast<std::int64_t>(
        std::nearbyint(static_cast<double>(dot(u, v)) / static_cast<double>(dot(u, u))));
    v = v - Place{times * u.x, times * u.y};
    if (dot(v, v) >= dot(u, u)) return {u, v};
    std::swap(u, v);
  }
}

/// Where the images of a seed lie: in rows a period of y apart. Each row is shifted along x from the one
/// before.
struct Images {
  explicit Images(const Grid& grid)
      : x(in_fractions(Periods(grid).x)),
        y(in_fractions(Periods(grid).y)),
        shift(grid.is_tilted() ? grid.shifts().xy : 0),
        reach_x(x == 0 ? any_way : x / 2),
        reach_y(y == 0       ? any_way
                : shift == 0 ? y / 2
                             : reach_of_lattice()) {}

  /// Those alone that are no farther than this from the region, along either axis.
  Images within(std::int64_t reach) const {
    Images near = *this;
    near.reach_x = std::min(reach_x, reach);
    near.reach_y = std::min(reach_y, reach);
    return near;
  }

  std::int64_t x, y;  // the periods, 0 along an axis that is not periodic
  std::int64_t shift;
  std::int64_t reach_x, reach_y;  // how far along the axes the image that is nearest to a place is at most

 private:
  static constexpr std::int64_t any_way = std::int64_t{1} << 61;

  /// Every place is at most half of either of two vectors that span the lattice away from an image, and so,
  /// along y, at most half the sum of what they are long by the Manhattan metric, which no distance along y
  /// exceeds. Short vectors reach less far.
  std::int64_t reach_of_lattice() const {
    const auto [u, v] = reduced({x, 0}, {shift, y});
    return (std::abs(u.x) + std::abs(u.y) + std::abs(v.x) + std::abs(v.y)) / 2;
  }
};

/// The pixels of a window that get labels: of an axis that it shows more than a period of, those in the
/// grid's own period.
inline Region labelled_region(const Window& window) {
  Region region = {0, 0, window.width() - 1, window.height() - 1};
  const Periods periods(window.grid());
  if (periods.x > 0 && window.width() > periods.x) {
    region.left = std::max<std::int64_t>(region.left, -window.x());
    region.right = std::min(region.right, periods.x - 1 - window.x());
  }
  if (periods.y > 0 && window.height() > periods.y) {
    region.top = std::max<std::int64_t>(region.top, -window.y());
    region.bottom = std::min(region.bottom, periods.y - 1 - window.y());
  }
  return region;
}

/// Whole periods, from the first to the last: those that bring a coordinate between two others.
struct Turns {
  Turns(std::int64_t at, std::int64_t period, std::int64_t low, std::int64_t high) {
    if (period == 0) {
      last = at >= low && at <= high ? 0 : -1;
      return;
    }
    const auto floor_of = [period](std::int64_t way) -> std::int64_t {
      if (way >= 0 && way < period) return 0;  // most often, and a division takes long
      return way >= 0 ? way / period : -((period - 1 - way) / period);
    };
    first = -floor_of(at - low);
    last = floor_of(high - at);
  }

  std::int64_t first = 0, last = 0;
};

/// Calls a function with each place of a seed that may be the nearest one of a pixel of the region.
template <typename Use>
void each_place(const Region& region, const Images& images, const Place& seed, Use use) {
  const Turns rows(seed.y, images.y, region.top - images.reach_y, region.bottom + images.reach_y);
  for (std::int64_t j = rows.first; j <= rows.last; ++j) {
    const std::int64_t at = seed.x + j * images.shift;
    const Turns turns(at, images.x, region.left - images.reach_x, region.right + images.reach_x);
    for (std::int64_t i = turns.first; i <= turns.last; ++i)
      use(Place{at + i * images.x, seed.y + j * images.y});
  }
}

/// Rules out places that own no pixel of the region. Whatever is nearer at the region's four corners is
/// nearer at all its pixels (docs/exact.md says why). Along the region's rim stand witnesses:
/// the places nearest to each stretch of it, and one more in the middle, which is known first. A place is
/// held against that and the witness of the stretch that it is nearest to. Lags, in the squares of the
/// places' unit, are for the Euclidean metric.
class Rim {
 public:
  explicit Rim(const Region& region) : region_(region) {
    while (std::max(region.right - region.left, region.bottom - region.top) >> shift_ >= stretches_of_side)
      ++shift_;
    witnesses_.resize(4 * stretches_of_side);
  }

  void add_to_middle(const Place& place, double lag) {
    const std::int64_t away = distance_to_middle(place);
    if (!middle_ || away < middle_->away) middle_ = Witness{place, away, lag};
  }

  /// The place in the middle rules out what is farther than this from the region along an axis.
  std::int64_t reach() const {
    if (!middle_) return 0;
    const Place& place = middle_->place;
    const std::int64_t along_x = std::max(region_.right - place.x, place.x - region_.left),
                       along_y = std::max(region_.bottom - place.y, place.y - region_.top);
    return along_x + along_y + static_cast<std::int64_t>(std::sqrt(middle_->lag)) + 1;
  }

  void add(const Place& place, double lag) {
    std::optional<Witness>& witness = witnesses_[stretch_of(place)];
    const std::int64_t away = distance_to_rim(place);
    if (!witness || away < witness->away) witness = Witness{place, away, lag};
  }

  bool rules_out(const Place& place, double lag) const {
    const std::optional<Witness>& witness = witnesses_[stretch_of(place)];
    return (witness && is_nearer(*witness, place, lag)) || (middle_ && is_nearer(*middle_, place, lag));
  }

 private:
  static constexpr std::int64_t stretches_of_side = 1024;  // at most
  struct Witness {
    Place place;
    std::int64_t away;
    double lag;
  };

  /// The distances to the four sides, negative inside the region.
  std::array<std::int64_t, 4> to_sides(const Place& place) const {
    return {region_.top - place.y, place.y - region_.bottom, region_.left - place.x, place.x - region_.right};
  }

  /// Along the axis where it is greater.
  std::int64_t distance_to_middle(const Place& place) const {
    return std::max(std::abs(place.x - (region_.left + region_.right) / 2),
                    std::abs(place.y - (region_.top + region_.bottom) / 2));
  }

  std::int64_t distance_to_rim(const Place& place) const {
    const auto sides = to_sides(place);
    return std::abs(*std::max_element(sides.begin(), sides.end()));
  }

  std::size_t stretch_of(const Place& place) const {
    const auto sides = to_sides(place);
    const auto side = std::max_element(sides.begin(), sides.end()) - sides.begin();
    const bool along_x = side < 2;
    const std::int64_t low = along_x ? region_.left : region_.top;
    const std::int64_t high = along_x ? region_.right : region_.bottom;
    const std::int64_t at = std::min(std::max(along_x ? place.x : place.y, low), high) - low;
    return static_cast<std::size_t>(side * stretches_of_side + (at >> shift_));
  }

  /// Whether a witness is nearer than a place at all corners, by both metrics.
  bool is_nearer(const Witness& witness, const Place& other, double lag) const {
    const Place& place = witness.place;
    for (const std::int64_t x : {region_.left, region_.right}) {
      for (const std::int64_t y : {region_.top, region_.bottom}) {
        const std::int64_t dx = std::abs(place.x - x), dy = std::abs(place.y - y);
        const std::int64_t other_dx = std::abs(other.x - x), other_dy = std::abs(other.y - y);
        if (dx + dy >= other_dx + other_dy) return false;
        if (squares(dx, dy) + witness.lag >= (squares(other_dx, other_dy) + lag) * below_one) return false;
      }
    }
    return true;
  }

  // A squared distance leaves 64 bits where a unit is a part of a pixel. What is lost to rounding rules out
  // less.
  static constexpr double below_one = 1 - 0x1p-48;
  static double squares(std::int64_t dx, std::int64_t dy) {
    const auto x = static_cast<double>(dx), y = static_cast<double>(dy);
    return x * x + y * y;
  }

  Region region_;
  int shift_ = 0;  // a stretch has 2^shift pixels
  std::vector<std::optional<Witness>> witnesses_;
  std::optional<Witness> middle_;
};

}  // namespace vorocl
