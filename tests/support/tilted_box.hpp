// Diagrams of volumes whose boxes are tilted, by their definition: a voxel's distances to all images of all
// seeds in 128-bit integers, on the host.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "volume_points.hpp"

namespace vorocl {

inline std::int64_t floor_of(std::int64_t a, std::int64_t b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

/// A box, by its definition: seeds repeat by (sides[0], 0, 0), (xy, sides[1], 0) and (xz, yz, sides[2]),
/// along the axes that are periodic.
struct TiltedBox {
  std::array<std::int64_t, 3> sides;  // in voxels
  Axes periodic;
  std::int64_t xy = 0, xz = 0, yz = 0;  // in parts
  std::array<int, 3> spacing = {1, 1, 1};

  Grid grid() const {
    const auto in_voxels = [](std::int64_t tilt) { return static_cast<double>(tilt) / parts; };
    const Grid of = Grid(sides[0], sides[1], sides[2], periodic);
    return Grid(of.x().spaced(spacing[0]), of.y().spaced(spacing[1]), of.z().spaced(spacing[2]))
        .tilted(in_voxels(xy), in_voxels(xz), in_voxels(yz));
  }

  Wide squared(const Spot& way) const {
    Wide sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += Wide{way[i] * spacing[i]} * (way[i] * spacing[i]);
    return sum;
  }

  /// Calls a function with all images of a way that may be the shortest: no image is nearer along an axis
  /// than half the sum of the periods, which one in the nearest row of the nearest slice is at most away.
  template <typename Use>
  void each_image(const Spot& way, Use use) const {
    const std::array<bool, 3> repeats = {has_x(periodic), has_y(periodic), has_z(periodic)};
    std::int64_t farthest = parts;
    for (std::size_t i = 0; i < 3; ++i) farthest += repeats[i] ? sides[i] * spacing[i] * parts / 2 : 0;
    const auto turns = [&](std::size_t axis, std::int64_t at) {
      const std::int64_t period = sides[axis] * parts, reach = farthest / spacing[axis];
      if (!repeats[axis]) return std::make_pair(std::int64_t{0}, std::int64_t{0});
      return std::make_pair(floor_of(-reach - at, period), floor_of(reach - at, period) + 1);
    };
    const auto [first_z, last_z] = turns(2, way[2]);
    for (std::int64_t k = first_z; k <= last_z; ++k) {
      const std::int64_t along_y = way[1] + k * yz, z = way[2] + k * sides[2] * parts;
      const auto [first_y, last_y] = turns(1, along_y);
      for (std::int64_t j = first_y; j <= last_y; ++j) {
        const std::int64_t along_x = way[0] + k * xz + j * xy, y = along_y + j * sides[1] * parts;
        const auto [first_x, last_x] = turns(0, along_x);
        for (std::int64_t i = first_x; i <= last_x; ++i)
          use(Spot{along_x + i * sides[0] * parts, y, z}, k, j, i);
      }
    }
  }

  struct Way {
    Spot way = {};
    std::array<std::int64_t, 3> turns = {};  // whole periods of x, y and z that it goes round
  };

  /// The shortest way from a seed to a place. Of equally short ones that which is shorter along z, then y,
  /// then x, and of two the one along the axis.
  Way shortest(const Spot& seed, const Spot& to) const {
    using Order = std::tuple<Wide, std::int64_t, bool, std::int64_t, bool, std::int64_t, bool>;
    std::optional<std::pair<Order, Way>> best;
    each_image({to[0] - seed[0], to[1] - seed[1], to[2] - seed[2]},
               [&](const Spot& way, std::int64_t k, std::int64_t j, std::int64_t i) {
                 const Order order = {squared(way), std::abs(way[2]), way[2] < 0, std::abs(way[1]),
                                      way[1] < 0,   std::abs(way[0]), way[0] < 0};
                 if (!best || order < best->first) best = {order, {way, {i, j, k}}};
               });
    return best->second;
  }
};

inline Spot centre_of(std::int64_t x, std::int64_t y, std::int64_t z) {
  return {x * parts + parts / 2, y * parts + parts / 2, z * parts + parts / 2};
}

template <typename Use>
void each_voxel(const TiltedBox& box, Use use) {
  for (std::int64_t z = 0; z < box.sides[2]; ++z) {
    for (std::int64_t y = 0; y < box.sides[1]; ++y) {
      for (std::int64_t x = 0; x < box.sides[0]; ++x) use(x, y, z);
    }
  }
}

/// `lags`, which are added to distances: none, or by id.
inline Labels labels_by_definition(const TiltedBox& box, const std::vector<Spot>& seeds,
                                   const std::vector<std::int64_t>& lags = {}) {
  const auto rank = [](const Spot& seed) { return std::make_tuple(seed[2], seed[1], seed[0]); };
  Labels labels;
  each_voxel(box, [&](std::int64_t x, std::int64_t y, std::int64_t z) {
    std::uint32_t best = no_label;
    Wide least = 0;
    for (std::uint32_t id = 0; id < seeds.size(); ++id) {
      const Wide distance =
          box.squared(box.shortest(seeds[id], centre_of(x, y, z)).way) + (lags.empty() ? 0 : lags[id]);
      if (best != no_label && distance > least) continue;
      if (best == no_label || distance < least || rank(seeds[id]) < rank(seeds[best]))
        best = id, least = distance;
    }
    labels.push_back(best);
  });
  return labels;
}

}  // namespace vorocl
