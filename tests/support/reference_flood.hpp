// Flooding as the paper words it, pixel by pixel on the host: what the device's waves must equal, label for
// label.
#pragma once

#include <cstdint>
#include <vector>

#include "brute_force.hpp"
#include "vorocl/plan.hpp"

namespace vorocl {

/// Whether seed a is to be preferred to seed b at a pixel (any seed is preferred to no_label).
inline bool preferred(const Grid& grid, std::uint32_t a, std::uint32_t b, const Pixel& at,
                      const std::vector<Pixel>& seeds, Metric metric) {
  if (a == no_label || b == no_label) return a != no_label;
  const std::int64_t da = distance(grid, at, seeds[a], metric), db = distance(grid, at, seeds[b], metric);
  if (da != db) return da < db;
  if (seeds[a] < seeds[b] || seeds[b] < seeds[a]) return seeds[a] < seeds[b];
  return a < b;
}

/// Stamps the seeds on the labels, then runs the plan's waves.
inline std::vector<std::uint32_t> reference_flood(const Grid& grid, const std::vector<Pixel>& seeds,
                                                  const Plan& plan, Metric metric,
                                                  std::vector<std::uint32_t> labels = {}) {
  const auto at = [&](std::int64_t x, std::int64_t y) {
    return static_cast<std::size_t>(y * grid.width() + x);
  };
  labels.resize(grid.pixels(), no_label);
  for (std::uint32_t id = 0; id < seeds.size(); ++id) {
    std::uint32_t& label = labels[at(seeds[id].x, seeds[id].y)];
    if (preferred(grid, id, label, seeds[id], seeds, metric)) label = id;
  }
  for (const Wave& wave : plan) {
    const std::vector<std::uint32_t> before = labels;
    for (std::int64_t y = 0; y < grid.height(); ++y) {
      for (std::int64_t x = 0; x < grid.width(); ++x) {
        std::uint32_t& label = labels[at(x, y)];
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            if (wave.neighbourhood == Neighbourhood::von_neumann && dx != 0 && dy != 0) continue;
            const auto from = in_grid(grid, {x + dx * wave.step, y + dy * wave.step});
            if (!from) continue;
            const std::uint32_t candidate = before[at(from->x, from->y)];
            if (preferred(grid, candidate, label, {x, y}, seeds, metric)) label = candidate;
          }
        }
      }
    }
  }
  return labels;
}

}  // namespace vorocl
