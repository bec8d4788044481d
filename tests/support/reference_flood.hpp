// Flooding as the paper words it, pixel by pixel on the host: what the device's waves must equal, label for
// label.
#pragma once

#include <algorithm>
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

/// The labels of pixels after a wave. `better` says whether a label is to be preferred to another one at a
/// pixel.
template <typename Better>
Labels after_wave(const Grid& pixels, const Wave& wave, const Labels& before, const Better& better) {
  const int slices = pixels.is_volume() ? 1 : 0;
  Labels labels = before;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const Pixel at = pixel_at(pixels, i);
    for (int dz = -slices; dz <= slices; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if (wave.neighbourhood == Neighbourhood::von_neumann && dx * dx + dy * dy + dz * dz > 1) continue;
          const auto from =
              in_grid(pixels, {at.x + dx * wave.step, at.y + dy * wave.step, at.z + dz * wave.step});
          if (!from) continue;
          const std::uint32_t candidate = before[index_of(pixels, *from)];
          if (better(candidate, labels[i], at)) labels[i] = candidate;
        }
      }
    }
  }
  return labels;
}

/// Stamps the seeds on the labels, then runs the plan's waves.
inline Labels reference_flood(const Grid& grid, const std::vector<Pixel>& seeds, const Plan& plan,
                              Metric metric, Labels labels = {}) {
  const auto better = [&](std::uint32_t a, std::uint32_t b, const Pixel& pixel) {
    return preferred(grid, a, b, pixel, seeds, metric);
  };
  labels.resize(grid.pixels(), no_label);
  for (std::uint32_t id = 0; id < seeds.size(); ++id) {
    std::uint32_t& label = labels[index_of(grid, seeds[id])];
    if (better(id, label, seeds[id])) label = id;
  }
  for (const Wave& wave : plan) labels = after_wave(grid, wave, labels, better);
  return labels;
}

/// Low resolution with reconstruction, from pixels of 4 x 4.
inline Labels reference_low_resolution(const Grid& grid, const std::vector<Pixel>& seeds) {
  constexpr Metric metric = Metric::euclidean;
  const auto pixels_of_level = [&](int level) {
    const int side = 1 << level;
    return Grid((grid.width() + side - 1) / side, (grid.height() + side - 1) / side, grid.periodic());
  };
  // Whether a label is to be preferred at the middle of a level's pixel.
  const auto better_at = [&](int level) {
    return [&grid, &seeds, level](std::uint32_t a, std::uint32_t b, const Pixel& pixel) {
      const std::int64_t side = std::int64_t{1} << level;
      const Pixel middle = {std::min<std::int64_t>(pixel.x * side + side / 2, grid.width() - 1),
                            std::min<std::int64_t>(pixel.y * side + side / 2, grid.height() - 1)};
      return preferred(grid, a, b, middle, seeds, metric);
    };
  };
  // The seed that each of a level's pixels keeps: the best of those of its four parts.
  std::vector<Labels> kept = {reference_flood(grid, seeds, {}, metric)};
  const auto take_parts = [&](int level, const Pixel& whole, const Pixel& at, std::uint32_t& label) {
    const Grid parts = pixels_of_level(level);
    for (const Pixel& part : {Pixel{0, 0}, Pixel{1, 0}, Pixel{0, 1}, Pixel{1, 1}}) {
      const std::int64_t x = 2 * whole.x + part.x, y = 2 * whole.y + part.y;
      if (x >= parts.width() || y >= parts.height()) continue;
      const std::uint32_t candidate = kept[static_cast<std::size_t>(level)][index_of(parts, {x, y})];
      if (better_at(level)(candidate, label, at)) label = candidate;
    }
  };
  for (int level = 1; level <= 2; ++level) {
    const Grid pixels = pixels_of_level(level), parts = pixels_of_level(level - 1);
    Labels best(pixels.pixels(), no_label);
    for (std::size_t i = 0; i < parts.pixels(); ++i) {
      const Pixel part = pixel_at(parts, i), whole = {part.x / 2, part.y / 2};
      std::uint32_t& label = best[index_of(pixels, whole)];
      if (better_at(level)(kept.back()[i], label, whole)) label = kept.back()[i];
    }
    kept.push_back(best);
  }
  Labels labels = kept.back();
  for (const Wave& wave : jump_flooding_plan(pixels_of_level(2)))
    labels = after_wave(pixels_of_level(2), wave, labels, better_at(2));
  for (int level = 1; level >= 0; --level) {
    const Grid pixels = pixels_of_level(level);
    const Labels coarse = labels;
    labels = kept[static_cast<std::size_t>(level)];
    for (std::size_t i = 0; i < pixels.pixels(); ++i) {
      const Pixel at = pixel_at(pixels, i);
      const std::uint32_t above = coarse[index_of(pixels_of_level(level + 1), {at.x / 2, at.y / 2})];
      if (above == no_label) continue;
      const std::int64_t side = std::int64_t{2} << level;
      take_parts(level, {seeds[above].x / side, seeds[above].y / side}, at, labels[i]);
    }
    for (int step = level == 0 ? 2 : 4; step >= 1; step /= 2)
      labels = after_wave(pixels, {step, Neighbourhood::moore}, labels, better_at(level));
  }
  return labels;
}

}  // namespace vorocl
