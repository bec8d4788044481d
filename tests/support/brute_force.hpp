// The ground_truth that diagrams are judged by: every pixel against every seed, in 64-bit integers, on the
// host.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "transformed.hpp"
#include "vorocl/grid.hpp"

namespace vorocl {

struct Pixel {
  int x, y;
  friend bool operator<(const Pixel& a, const Pixel& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }
};

inline Point centre(const Pixel& pixel) { return {pixel.x + 0.5, pixel.y + 0.5}; }

inline std::vector<Point> centres(const std::vector<Pixel>& pixels) {
  return transformed(pixels, [](const Pixel& pixel) { return centre(pixel); });
}

inline std::vector<Pixel> pixels_of(const std::vector<Point>& points) {
  return transformed(points, [](const Point& point) {
    return Pixel{static_cast<int>(std::floor(point.x)), static_cast<int>(std::floor(point.y))};
  });
}

inline std::int64_t distance(const Pixel& a, const Pixel& b, Metric metric) {
  const std::int64_t dx = std::abs(a.x - b.x), dy = std::abs(a.y - b.y);
  return metric == Metric::euclidean ? dx * dx + dy * dy : dx + dy;
}

/// Of the images of a coordinate along an axis the one nearest to another one; of two the one behind it.
inline int nearest_image(int at, int to, int size, bool periodic) {
  int nearest = at;
  if (periodic) {
    for (const int image : {at - size, at + size}) {
      const int nearer = std::abs(nearest - to) - std::abs(image - to);
      if (nearer > 0 || (nearer == 0 && image > nearest)) nearest = image;
    }
  }
  return nearest;
}

inline Pixel nearest_image(const Grid& grid, const Pixel& pixel, const Pixel& to) {
  return {nearest_image(pixel.x, to.x, grid.width(), grid.periodic_x()),
          nearest_image(pixel.y, to.y, grid.height(), grid.periodic_y())};
}

/// The distance in a grid, which may be periodic.
inline std::int64_t distance(const Grid& grid, const Pixel& a, const Pixel& b, Metric metric) {
  return distance(nearest_image(grid, a, b), b, metric);
}

/// The pixel of the grid that one outside is an image of, if there is one.
inline std::optional<Pixel> in_grid(const Grid& grid, const Pixel& pixel) {
  const auto along = [](int at, int size, bool periodic) {
    return periodic ? (at % size + size) % size : at;
  };
  const Pixel own = {along(pixel.x, grid.width(), grid.periodic_x()),
                     along(pixel.y, grid.height(), grid.periodic_y())};
  const bool inside = own.x >= 0 && own.x < grid.width() && own.y >= 0 && own.y < grid.height();
  return inside ? std::optional<Pixel>(own) : std::nullopt;
}

/// The labels of the exact diagram with the tie rule: the least distance, then the first seed in row-major
/// order of position, then the lowest id.
inline std::vector<std::uint32_t> brute_force(const Grid& grid, const std::vector<Pixel>& seeds,
                                              Metric metric) {
  std::vector<std::uint32_t> labels;
  labels.reserve(grid.pixels());
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      std::uint32_t best = no_label;
      std::int64_t least = 0;
      for (std::uint32_t id = 0; id < seeds.size(); ++id) {
        const std::int64_t d = distance(grid, {x, y}, seeds[id], metric);
        if (best == no_label || d < least || (d == least && seeds[id] < seeds[best])) {
          best = id;
          least = d;
        }
      }
      labels.push_back(best);
    }
  }
  return labels;
}

/// How labels stand to the true ones.
struct Verdict {
  std::size_t unlabelled = 0;  // pixels without a label where the ground truth has one
  std::size_t invalid = 0;     // labels that name no seed
  std::size_t wrong = 0;       // labels of seeds that are farther than the nearest one
  std::size_t too_near =
      0;  // labels of seeds nearer than the ground truth's: the ground truth would be wrong
};

inline Verdict judge(const Grid& grid, const std::vector<Pixel>& seeds, Metric metric,
                     const std::vector<std::uint32_t>& labels,
                     const std::vector<std::uint32_t>& ground_truth) {
  Verdict verdict;
  for (std::size_t i = 0; i < grid.pixels(); ++i) {
    const Pixel pixel = {static_cast<int>(i % static_cast<std::size_t>(grid.width())),
                         static_cast<int>(i / static_cast<std::size_t>(grid.width()))};
    if (labels[i] == no_label) {
      verdict.unlabelled += ground_truth[i] != no_label ? 1 : 0;
    } else if (labels[i] >= seeds.size()) {
      ++verdict.invalid;
    } else {
      const std::int64_t d = distance(grid, pixel, seeds[labels[i]], metric);
      const std::int64_t least = distance(grid, pixel, seeds[ground_truth[i]], metric);
      verdict.wrong += d > least ? 1 : 0;
      verdict.too_near += d < least ? 1 : 0;
    }
  }
  return verdict;
}

inline std::vector<Pixel> random_pixels(const Grid& grid, std::size_t count, unsigned rng_seed) {
  std::mt19937 rng(rng_seed);
  std::vector<Pixel> pixels;
  for (std::size_t i = 0; i < count; ++i) {
    const int x = static_cast<int>(rng() % static_cast<unsigned>(grid.width()));
    const int y = static_cast<int>(rng() % static_cast<unsigned>(grid.height()));
    pixels.push_back({x, y});
  }
  return pixels;
}

inline std::vector<Pixel> every_pixel(const Grid& grid) {
  std::vector<Pixel> pixels;
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) pixels.push_back({x, y});
  }
  return pixels;
}

struct Case {
  std::string name;
  Grid grid;
  std::vector<Pixel> seeds;
};

/// All kinds of seeds on each of the grids.
inline std::vector<Case> cases_on(const std::vector<Grid>& grids) {
  std::vector<Case> cases;
  for (const Grid& grid : grids) {
    const int right = grid.width() - 1, bottom = grid.height() - 1;
    constexpr const char* periodic[] = {" ", " periodic in x ", " periodic in y ", " periodic "};
    const std::string size = std::to_string(grid.width()) + "x" + std::to_string(grid.height()) +
                             periodic[static_cast<int>(grid.periodic())];
    const Pixel middle = {grid.width() / 2, grid.height() / 2};
    std::vector<Pixel> row, diagonal;
    for (int x = 0; x <= right; x += 2) row.push_back({x, bottom / 2});
    for (int i = 0; i <= right && i <= bottom; ++i) diagonal.push_back({i, i});
    cases.push_back({size + "no seeds", grid, {}});
    cases.push_back({size + "one seed", grid, {middle}});
    cases.push_back({size + "two seeds", grid, {{right, 0}, {0, bottom}}});
    cases.push_back({size + "coincident", grid, {middle, {0, 0}, middle, middle, {0, 0}}});
    cases.push_back({size + "every pixel", grid, every_pixel(grid)});
    cases.push_back({size + "row", grid, row});
    cases.push_back({size + "diagonal", grid, diagonal});
    cases.push_back({size + "corners", grid, {{right, bottom}, {0, bottom}, {right, 0}, {0, 0}}});
    cases.push_back({size + "random sparse", grid, random_pixels(grid, 1 + grid.pixels() / 100, 1)});
    cases.push_back({size + "random dense", grid, random_pixels(grid, 1 + grid.pixels() / 4, 2)});
  }
  return cases;
}

/// Grids at the edges of what is possible: single pixels and lines, primes, powers of two and their
/// neighbours, wide, tall.
inline std::vector<Case> edge_cases() {
  return cases_on({{1, 1},
                   {1, 17},
                   {31, 1},
                   {2, 2},
                   {3, 5},
                   {7, 13},
                   {16, 16},
                   {15, 17},
                   {17, 15},
                   {31, 33},
                   {64, 64},
                   {63, 65},
                   {67, 29},
                   {128, 9},
                   {5, 130},
                   {101, 97}});
}

/// The same with periodic axes, not all of them: kernels are built anew for these.
inline std::vector<Case> periodic_cases() {
  constexpr Periodic x = Periodic::x, y = Periodic::y, xy = Periodic::xy;
  return cases_on(
      {{1, 17, xy}, {31, 1, xy}, {130, 5, xy}, {64, 64, xy}, {101, 97, xy}, {67, 65, x}, {16, 80, y}});
}

inline std::vector<Case> all_edge_cases() {
  std::vector<Case> cases = edge_cases(), periodic = periodic_cases();
  cases.insert(cases.end(), periodic.begin(), periodic.end());
  return cases;
}

}  // namespace vorocl
