// The seeds that a window of a plane needs, found by an index of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/snapping.hpp"
#include "runtime/metric.hpp"
#include "tiles/plane_distance.hpp"
#include "tiles/rim_walk.hpp"
#include "vorocl/error.hpp"
#include "vorocl/grid.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

/// Searches an index of seeds, which numbers them and has
/// - size(), and seed(number);
/// - find_inside(rectangle, seeds): appends those in a rectangle;
/// - visit(enters, use): shows the first function boxes around seeds, and gives the second one the numbers of
///   those in the boxes that it enters, until that one returns false; returns whether it never did;
/// - visit_nearest_first(distance, counts, use): gives the numbers of the seeds in boxes that count, by their
///   distance and themselves, those of the nearest box first.
template <typename Index>
class NearSeeds {
 public:
  NearSeeds(const Index& index, const Grid& grid, Metric metric)
      : index_(index), grid_(grid), metric_(metric) {}

  /// Replaces what a list has by the seeds of SeedSource::find_near().
  void find(const Window& window, std::vector<PlaneSeed>& seeds) const {
    if (window.longest_side() > Window::max_side) {
      throw Error("the window has " + std::to_string(window.width()) + " x " +
                  std::to_string(window.height()) + " pixels; " + std::to_string(Window::max_side) +
                  " along a side are possible");
    }
    seeds.clear();
    if (index_.size() == 0) return;
    const std::vector<PlaneRectangle> parts = parts_of(window);
    for (const PlaneRectangle& part : parts) find(part, seeds);
    if (parts.size() == 1) return;
    // What owns pixels of several parts was found several times.
    const auto by_id = [](const PlaneSeed& a, const PlaneSeed& b) { return a.id < b.id; };
    const auto same = [](const PlaneSeed& a, const PlaneSeed& b) { return a.id == b.id; };
    std::sort(seeds.begin(), seeds.end(), by_id);
    seeds.erase(std::unique(seeds.begin(), seeds.end(), same), seeds.end());
  }

  /// Makes `best` the image that wins at a point, if it does not yet.
  void find_nearest(const Place& point, SeedImage& best) const {
    const PlaneDistance distance(grid_, metric_);
    each_image(grid_, [&](const Place& offset) {
      const Place from = point - offset;
      const auto to_box = [&](const Box& box) { return distance(from, box); };
      const auto counts = [&](const Box& box, PlaneLength away) {
        return away != too_far && first_in(box, away).wins(best);
      };
      index_.visit_nearest_first(to_box, counts, [&](std::size_t number) {
        const Place place = place_of(index_.seed(number));
        const SeedImage image = {number, offset, distance(from, place), place};
        if (image.distance != too_far && image.wins(best)) best = image;
      });
    });
  }

  /// The image as it is seen from another point.
  SeedImage seen_from(const Place& point, SeedImage image) const {
    // It may be farther away than half a period, though not far.
    const PlaneDistance distance(grid_, metric_, in_fractions(grid_.width() + grid_.height()));
    image.distance = distance(point, image.seed + image.offset);
    return image;
  }

 private:
  void find(const PlaneRectangle& rectangle, std::vector<PlaneSeed>& seeds) const {
    index_.find_inside(rectangle, seeds);
    // A seed outside that owns a pixel inside owns every point of the plane between them: so one of the rim
    // too. Ties are decided the same at both.
    std::vector<std::size_t> on_rim;
    const auto owner_at = [&](const Place& point, const SeedImage& guess) {
      SeedImage owner = guess;
      if (owner.distance != too_far) owner = seen_from(point, guess);
      find_nearest(point, owner);
      on_rim.push_back(owner.index);
      return owner;
    };
    const auto find_between = [&](const Place& a, const SeedImage& at_a, const Place& b,
                                  const SeedImage& at_b, std::size_t most, std::vector<std::size_t>& found) {
      if (at_a == at_b) return true;  // what wins at both ends wins between them
      return this->find_between(a, at_a, b, at_b, rectangle, most, found);
    };
    walk_rim(rectangle, 32, owner_at, find_between, on_rim);
    std::sort(on_rim.begin(), on_rim.end());
    on_rim.erase(std::unique(on_rim.begin(), on_rim.end()), on_rim.end());
    for (const std::size_t number : on_rim) {
      const PlaneSeed seed = index_.seed(number);
      if (!holds(rectangle, seed.x, seed.y)) seeds.push_back(seed);
    }
  }

  /// Appends the seeds outside a rectangle that win somewhere on an axis-parallel line from a to b, and some
  /// that do not, given the images that win at both ends. Returns false if they are more than `most`.
  bool find_between(const Place& a, const SeedImage& at_a, const Place& b, const SeedImage& at_b,
                    const PlaneRectangle& rectangle, std::size_t most,
                    std::vector<std::size_t>& found) const {
    // What wins at a is nearer there than another image: if it wins against that one at b too, it does
    // between them. So only images count that are as near at b as what wins at a, and the other way round.
    const SeedImage of_b_at_a = seen_from(a, at_b), of_a_at_b = seen_from(b, at_a);
    const PlaneDistance distance(grid_, metric_, length_of(a, b));
    bool all = true;
    each_image(grid_, [&](const Place& offset) {
      const Place from_a = a - offset, from_b = b - offset;
      const auto enters = [&](const Box& box) {
        return !holds(rectangle, box) && !of_b_at_a.wins(first_in(box, distance(from_a, box))) &&
               !of_a_at_b.wins(first_in(box, distance(from_b, box)));
      };
      all = all && index_.visit(enters, [&](std::size_t number) {
        const PlaneSeed seed = index_.seed(number);
        if (holds(rectangle, seed.x, seed.y)) return true;
        const Place place = place_of(seed);
        SeedImage image = {number, offset, distance(from_a, place), place};
        if (of_b_at_a.wins(image)) return true;
        image.distance = distance(from_b, place);
        if (of_a_at_b.wins(image)) return true;
        if (found.size() == most) return false;
        found.push_back(number);
        return true;
      });
    });
    return all;
  }

  const Index& index_;
  const Grid& grid_;
  Metric metric_;
};

}  // namespace vorocl
