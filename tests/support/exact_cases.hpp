// What the tests of the exact engine share: its shapes and lists, and the sets made to hurt it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "list_length.hpp"

namespace vorocl {

/// Many more and larger cases, for minutes instead of seconds.
inline const bool long_tests = std::getenv("VOROCL_LONG_TESTS") != nullptr;

/// The test device with another shape of the engine, and lists of some length inside.
inline Device shaped(Shape shape, ListLength lists, std::size_t patch_items = 64) {
  Tuning tuning = test_device().tuning();
  tuning.shape = shape;
  tuning.patch_items = patch_items;
  return with_lists(test_device().with_tuning(tuning), lists);
}

inline Labels exact_labels(const Device& device, const Grid& grid, const std::vector<Pixel>& seeds,
                           Metric metric = Metric::euclidean) {
  Diagram diagram(device, grid);
  exact_diagram(Seeds(device, grid, centres(seeds), to_centres), diagram, {metric});
  return diagram.read();
}

/// Sets that starve some bins of seeds and flood others.
inline std::vector<Case> hurtful_cases(const Grid& grid) {
  const int w = static_cast<int>(grid.width()), h = static_cast<int>(grid.height());
  std::vector<Pixel> clusters, corner, row, column, diagonal, ring, checkers, blocks, stacked, patches;
  std::mt19937 rng(11);
  std::normal_distribution<double> spread(0, w / 100.0);
  const auto inside = [](double at, int side) {
    return std::min(std::max(static_cast<int>(at), 0), side - 1);
  };
  const auto middles = random_pixels(grid, 5, 12);
  for (std::size_t i = 0; i < grid.pixels() / 256; ++i) {
    const Pixel& middle = middles[i % middles.size()];
    clusters.push_back(
        {inside(centre(middle).x + spread(rng), w), inside(centre(middle).y + spread(rng), h)});
  }
  corner = random_pixels({w / 16, h / 16}, grid.pixels() / 256, 13);
  for (int x = 0; x < w; ++x) row.push_back({x, h / 3});
  for (int y = 0; y < h; ++y) column.push_back({w - 1, y});
  for (int i = 0; i < std::min(w, h); ++i) diagonal.push_back({i, i});
  for (int i = 0; i < 8 * w; ++i) {
    const double angle = i * 0.25 * 3.14159265358979 / w, radius = 0.49 * std::min(w, h);
    ring.push_back(
        {inside(w / 2.0 + radius * std::cos(angle), w), inside(h / 2.0 + radius * std::sin(angle), h)});
  }
  for (const Pixel& pixel : every_pixel(grid)) {
    if ((pixel.x + pixel.y) % 2 == 0) checkers.push_back(pixel);
    if ((pixel.x < w / 4 && pixel.y < h / 4) || (pixel.x >= w - w / 4 && pixel.y >= h - h / 4)) {
      blocks.push_back(pixel);
    }
    if ((pixel.x / 32 + pixel.y / 32) % 2 == 0 && rng() % 2 == 0) patches.push_back(pixel);
  }
  for (int i = 0; i < 5000; ++i) stacked.push_back(middles[static_cast<std::size_t>(i) % 3]);
  return {{"clusters", grid, clusters}, {"corner", grid, corner},     {"row", grid, row},
          {"column", grid, column},     {"diagonal", grid, diagonal}, {"ring", grid, ring},
          {"checkers", grid, checkers}, {"blocks", grid, blocks},     {"stacked", grid, stacked},
          {"patches", grid, patches}};
}

}  // namespace vorocl
