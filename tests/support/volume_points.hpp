// Exact diagrams of points within their voxels by their definition: a voxel's distances to all seeds in
// 128-bit integers, on the host.
#pragma once

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include "true_positions.hpp"

namespace vorocl {

/// Whole numbers of 1/4096 voxel.
using Spot = std::array<std::int64_t, 3>;

inline std::array<Axis, 3> axes_of(const Grid& grid) { return {grid.x(), grid.y(), grid.z()}; }

/// From a seed to a voxel's centre, the shorter way round, in 1/4096 unit of the spacing.
inline std::int64_t way_in_parts(const Axis& axis, std::int64_t seed, std::int64_t voxel) {
  const std::int64_t inside = std::abs(voxel * parts + parts / 2 - seed), period = axis.pixels() * parts;
  return axis.spacing() * (axis.is_periodic() ? std::min(inside, period - inside) : inside);
}

inline Wide squared_distance(const Grid& grid, const Spot& seed, const Spot& voxel) {
  Wide sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Wide along = way_in_parts(axes_of(grid)[axis], seed[axis], voxel[axis]);
    sum += along * along;
  }
  return sum;
}

inline bool comes_first(const Spot& a, const Spot& b) {
  return std::tie(a[2], a[1], a[0]) < std::tie(b[2], b[1], b[0]);
}

/// `lags`, which are added to distances: none, or by id.
inline std::uint32_t label_by_definition(const Grid& grid, const std::vector<Spot>& seeds, const Spot& voxel,
                                         const std::vector<std::int64_t>& lags = {}) {
  std::uint32_t best = no_label;
  Wide least = 0;
  for (std::uint32_t id = 0; id < seeds.size(); ++id) {
    const Wide distance = squared_distance(grid, seeds[id], voxel) + (lags.empty() ? 0 : lags[id]);
    if (best != no_label && distance > least) continue;
    if (best != no_label && distance == least && !comes_first(seeds[id], seeds[best])) continue;
    best = id;
    least = distance;
  }
  return best;
}

inline std::vector<Point> points_at(const std::vector<Spot>& seeds) {
  std::vector<Point> points;
  const auto along = [](std::int64_t at) { return static_cast<double>(at) / parts; };
  for (const Spot& seed : seeds) points.push_back({along(seed[0]), along(seed[1]), along(seed[2])});
  return points;
}

}  // namespace vorocl
