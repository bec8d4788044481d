// The diagrams whose measurements are tested, and straight host code to hold them against.
#pragma once

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "samples.hpp"

namespace vorocl {

/// Seeds in a few dense heaps, which leave most of the grid to cells on their rims.
inline std::vector<Pixel> clusters(const Grid& grid, std::size_t count) {
  std::mt19937 rng(3);
  const std::vector<Pixel> middles = random_pixels(grid, 5, 4);
  std::vector<Pixel> pixels;
  while (pixels.size() < count) {
    const Pixel& middle = middles[rng() % middles.size()];
    std::int64_t x = middle.x, y = middle.y;
    for (int i = 0; i < 4; ++i) x += static_cast<int>(rng() % 13) - 6, y += static_cast<int>(rng() % 13) - 6;
    if (x >= 0 && x < grid.width() && y >= 0 && y < grid.height()) pixels.push_back({x, y});
  }
  return pixels;
}

/// The device in the shapes that measurements differ for: large blocks with whole and cut vectors, small
/// blocks.
inline std::vector<Device> shapes() {
  const Device& device = test_device();
  return {device.with_tuning({16, 64, 1}), device.with_tuning({4, 8, 1}), device.with_tuning({1, 32, 8})};
}

/// Whether a shape is for a grid. Kernels are built anew for grids that are narrower than their vectors: the
/// second shape alone takes these.
inline bool is_for(const Device& shape, const Grid& grid) {
  return shape.tuning().vector_width == 4 || grid.width() >= shape.tuning().vector_width;
}

/// Floods a diagram without vectors, whatever its device has: one engine's kernels serve all shapes and
/// widths.
inline Report fill(const Seeds& seeds, Diagram& diagram, Metric metric = Metric::euclidean) {
  Diagram flooded(test_device().with_tuning({1, 64, 1}), diagram.window());
  Report report = jump_flooding(seeds, flooded, {metric});
  diagram.write(flooded.labels(), seeds, metric);
  return report;
}

inline std::vector<Case> measured_cases(const Device& shape) {
  std::vector<Case> cases = edge_cases();
  const Grid wide(700, 300), tall(130, 1000);
  cases.push_back({"few seeds", wide, random_pixels(wide, 7, 5)});
  cases.push_back({"random seeds", wide, random_pixels(wide, 1000, 6)});
  cases.push_back({"dense seeds", wide, random_pixels(wide, 30000, 7)});
  const Grid torus(700, 300, Axes::xy), cylinder(700, 300, Axes::x);
  for (const Case& small : cases_on({{1, 17, Axes::xy}, {67, 29, Axes::xy}})) cases.push_back(small);
  cases.push_back({"one seed on a torus", torus, random_pixels(torus, 1, 5)});
  cases.push_back({"few seeds on a torus", torus, random_pixels(torus, 7, 5)});
  cases.push_back({"random seeds on a torus", torus, random_pixels(torus, 1000, 6)});
  cases.push_back({"clusters on a cylinder", cylinder, clusters(cylinder, 2000)});
  cases.push_back({"tall", tall, random_pixels(tall, 500, 8)});
  cases.push_back({"clusters", wide, clusters(wide, 2000)});
  cases.push_back({"cities", Grid(1440, 720), cities(Grid(1440, 720))});
  const auto others =
      std::remove_if(cases.begin(), cases.end(), [&](const Case& c) { return !is_for(shape, c.grid); });
  cases.erase(others, cases.end());
  return cases;
}

/// Labels at random, some of which name no seed: cells in many pieces.
inline std::vector<std::uint32_t> random_labels(const Grid& grid, std::uint32_t cells, unsigned rng_seed) {
  std::mt19937 rng(rng_seed);
  std::vector<std::uint32_t> labels(grid.pixels());
  for (std::uint32_t& label : labels) {
    const std::uint32_t drawn = static_cast<std::uint32_t>(rng()) % (cells + cells / 8 + 1);
    label = drawn < cells ? drawn : no_label;
  }
  return labels;
}

/// Calls visit(label, x, y) for each pixel that has a label.
template <typename Visit>
void each_pixel(const Grid& grid, const std::vector<std::uint32_t>& labels, Visit visit) {
  std::size_t i = 0;
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x, ++i) {
      if (labels[i] != no_label) visit(labels[i], x, y);
    }
  }
}

inline std::uint32_t label_at(const Grid& grid, const std::vector<std::uint32_t>& labels, std::int64_t x,
                              std::int64_t y) {
  return labels[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width()) +
                static_cast<std::size_t>(x)];
}

}  // namespace vorocl
