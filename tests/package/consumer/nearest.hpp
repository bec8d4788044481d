// The ground_truth that the programs hold their labels against: every pixel searched by itself.
#pragma once

#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

/// Whether each label of a width x height image names a seed at the least distance from its pixel, on seeds
/// of which no two share a pixel. Says what is wrong on stderr.
inline bool all_nearest(const std::vector<std::uint32_t>& labels, int width, int height,
                        const std::vector<int>& seeds_x, const std::vector<int>& seeds_y) {
  const auto distance = [&](std::size_t seed, int x, int y) {
    return (seeds_x[seed] - x) * (seeds_x[seed] - x) + (seeds_y[seed] - y) * (seeds_y[seed] - y);
  };
  std::size_t i = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, ++i) {
      if (i >= labels.size() || labels[i] >= seeds_x.size()) {
        std::cerr << "no label at " << x << ", " << y << '\n';
        return false;
      }
      for (std::size_t seed = 0; seed < seeds_x.size(); ++seed) {
        if (distance(seed, x, y) >= distance(labels[i], x, y)) continue;
        std::cerr << "seed " << seed << " is nearer to " << x << ", " << y << " than seed " << labels[i]
                  << '\n';
        return false;
      }
    }
  }
  return labels.size() == i;
}
