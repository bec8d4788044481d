// The ground truth of volumes: every voxel against every seed, on the host.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <tuple>
#include <vector>

#include "vorocl/diagram.hpp"

namespace vorocl {

struct At {
  int x, y, z;
};

/// From one coordinate to another, as long as distances have it: the shorter way round along a periodic axis.
inline std::int64_t way(const Axis& axis, std::int64_t from, std::int64_t to) {
  const std::int64_t inside = std::abs(from - to);
  return axis.spacing() * (axis.is_periodic() ? std::min(inside, axis.pixels() - inside) : inside);
}

inline std::int64_t squared_distance(const Grid& grid, const At& a, const At& b) {
  const std::int64_t x = way(grid.x(), a.x, b.x), y = way(grid.y(), a.y, b.y), z = way(grid.z(), a.z, b.z);
  return x * x + y * y + z * z;
}

/// The exact labels. Seeds come in the order of the tie rule, and only what is nearer takes a voxel.
inline std::vector<std::uint32_t> brute_force(const Grid& grid, const std::vector<At>& seeds) {
  std::vector<std::uint32_t> order(seeds.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const At &one = seeds[a], &other = seeds[b];
    return std::tie(one.z, one.y, one.x) < std::tie(other.z, other.y, other.x);
  });
  std::vector<std::uint32_t> labels(grid.pixels(), no_label);
  std::vector<std::int64_t> least(labels.size(), INT64_MAX);
  for (const std::uint32_t id : order) {
    std::size_t at = 0;
    for (int z = 0; z < grid.depth(); ++z) {
      for (int y = 0; y < grid.height(); ++y) {
        for (int x = 0; x < grid.width(); ++x, ++at) {
          const std::int64_t distance = squared_distance(grid, {x, y, z}, seeds[id]);
          if (distance >= least[at]) continue;
          least[at] = distance;
          labels[at] = id;
        }
      }
    }
  }
  return labels;
}

}  // namespace vorocl
