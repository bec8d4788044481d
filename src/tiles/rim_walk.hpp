// A walk along the rim of a tile.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tiles/plane_distance.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

/// Appends what may win on a rectangle's rim, which is walked along in steps of the length that the last ones
/// needed. `winner_at` gives what wins at a point, and is told what won at the last one. `find_between`
/// appends what may win on the line between two points, given the winners at both; it returns false if that
/// is more than `few`, which costs about as much as to halve the step.
template <typename WinnerAt, typename FindBetween>
void walk_rim(const PlaneRectangle& rectangle, std::size_t few, WinnerAt winner_at, FindBetween find_between,
              std::vector<std::size_t>& found) {
  constexpr std::array<Place, 4> directions = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  const std::array<Place, 4> corners = corners_of(rectangle);
  std::vector<std::size_t> between;
  std::int64_t usual_step = 64;  // pixels
  Place a = corners[0];
  SeedImage at_a = winner_at(a, SeedImage());
  for (std::size_t side = 0; side < corners.size(); ++side) {
    std::int64_t left = length_of(a, corners[(side + 1) % corners.size()]) / fractions_of_pixel;
    do {  // once where a side has no length
      const std::int64_t step = std::min(usual_step, left);
      const Place b = {a.x + in_fractions(step) * directions[side].x,
                       a.y + in_fractions(step) * directions[side].y};
      const SeedImage at_b = winner_at(b, at_a);
      between.clear();
      if (!find_between(a, at_a, b, at_b, step > 1 ? few : SIZE_MAX, between)) {
        usual_step = step / 2;
        continue;
      }
      found.insert(found.end(), between.begin(), between.end());
      left -= step;
      a = b;
      at_a = at_b;
      if (between.size() < few / 4) usual_step *= 2;
    } while (left > 0);
  }
}

}  // namespace vorocl
