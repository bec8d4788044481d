// The ground_truth that diagrams are judged by: every pixel against every seed, in 64-bit integers, on the
// host.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "transformed.hpp"
#include "vorocl/grid.hpp"

namespace vorocl {

using Labels = std::vector<std::uint32_t>;

/// A pixel of a grid or beside it, counted from the grid's first one. A plane's lie in the slice 0.
struct Pixel {
  std::int64_t x, y, z = 0;
  friend bool operator<(const Pixel& a, const Pixel& b) {
    return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
  }
};

inline Point centre(const Pixel& pixel) {
  return {static_cast<double>(pixel.x) + 0.5, static_cast<double>(pixel.y) + 0.5,
          static_cast<double>(pixel.z) + 0.5};
}

inline std::vector<Point> centres(const std::vector<Pixel>& pixels) {
  return transformed(pixels, [](const Pixel& pixel) { return centre(pixel); });
}

inline std::vector<Pixel> pixels_of(const std::vector<Point>& points) {
  const auto along = [](double at) { return static_cast<std::int64_t>(std::floor(at)); };
  return transformed(points, [&](const Point& point) {
    return Pixel{along(point.x), along(point.y), along(point.z)};
  });
}

/// The pixel of an index of a grid's labels, and that index.
inline Pixel pixel_at(const Grid& grid, std::size_t index) {
  const auto at = static_cast<std::int64_t>(index);
  return {at % grid.width(), at / grid.width() % grid.height(), at / grid.width() / grid.height()};
}

inline std::size_t index_of(const Grid& grid, const Pixel& pixel) {
  return static_cast<std::size_t>((pixel.z * grid.height() + pixel.y) * grid.width() + pixel.x);
}

/// Squared by the Euclidean metric.
inline std::int64_t distance(const Pixel& a, const Pixel& b, Metric metric) {
  const std::int64_t x = std::abs(a.x - b.x), y = std::abs(a.y - b.y), z = std::abs(a.z - b.z);
  return metric == Metric::euclidean ? x * x + y * y + z * z : x + y + z;
}

/// The length of a distance.
inline double length_of(std::int64_t distance, Metric metric) {
  const auto compared = static_cast<double>(distance);
  return metric == Metric::euclidean ? std::sqrt(compared) : compared;
}

/// Of the images of a coordinate in a period the one nearest to another one there; of two the one behind it.
inline std::int64_t nearest_image(std::int64_t at, std::int64_t to, const Axis& axis) {
  std::int64_t nearest = at;
  if (axis.is_periodic()) {
    for (const std::int64_t image : {at - axis.pixels(), at + axis.pixels()}) {
      const std::int64_t nearer = std::abs(nearest - to) - std::abs(image - to);
      if (nearer > 0 || (nearer == 0 && image > nearest)) nearest = image;
    }
  }
  return nearest;
}

inline Pixel nearest_image(const Grid& grid, const Pixel& pixel, const Pixel& to) {
  return {nearest_image(pixel.x, to.x, grid.x()), nearest_image(pixel.y, to.y, grid.y()),
          nearest_image(pixel.z, to.z, grid.z())};
}

/// Distances in a grid in its spacing, the shorter way round its periods: in these both pixels lie.
class DistanceIn {
 public:
  DistanceIn(const Grid& grid, Metric metric) : x_(grid.x()), y_(grid.y()), z_(grid.z()), metric_(metric) {}

  std::int64_t operator()(const Pixel& a, const Pixel& b) const {
    return distance({0, 0}, {x_.way(a.x, b.x), y_.way(a.y, b.y), z_.way(a.z, b.z)}, metric_);
  }

 private:
  struct Along {
    explicit Along(const Axis& axis)
        : period(axis.is_periodic() ? axis.pixels() : 0), spacing(axis.spacing()) {}
    std::int64_t way(std::int64_t a, std::int64_t b) const {
      const std::int64_t direct = std::abs(a - b);
      return spacing * (period > 0 ? std::min(direct, period - direct) : direct);
    }
    std::int64_t period, spacing;
  };

  Along x_, y_, z_;
  Metric metric_;
};

inline std::int64_t distance(const Grid& grid, const Pixel& a, const Pixel& b, Metric metric) {
  return DistanceIn(grid, metric)(a, b);
}

/// The pixel that one is an image of along the periodic axes.
inline Pixel in_period(const Grid& grid, const Pixel& pixel) {
  const auto along = [](std::int64_t at, const Axis& axis) {
    return axis.is_periodic() ? (at % axis.pixels() + axis.pixels()) % axis.pixels() : at;
  };
  return {along(pixel.x, grid.x()), along(pixel.y, grid.y()), along(pixel.z, grid.z())};
}

/// The pixel of the grid that one outside is an image of, if there is one.
inline std::optional<Pixel> in_grid(const Grid& grid, const Pixel& pixel) {
  const Pixel own = in_period(grid, pixel);
  const bool inside = own.x >= 0 && own.x < grid.width() && own.y >= 0 && own.y < grid.height() &&
                      own.z >= 0 && own.z < grid.depth();
  return inside ? std::optional<Pixel>(own) : std::nullopt;
}

/// The grid's pixel that a window shows in a column, row and slice of its own: none beside the period, if the
/// window is longer than it.
inline std::optional<Pixel> shown_pixel(const Window& window, std::int64_t column, std::int64_t row,
                                        std::int64_t slice = 0) {
  const Grid& grid = window.grid();
  const Pixel at = {window.x() + column, window.y() + row, window.z() + slice};
  const auto beside = [](std::int64_t length, std::int64_t pixel, const Axis& axis) {
    return axis.is_periodic() && length > axis.pixels() && (pixel < 0 || pixel >= axis.pixels());
  };
  if (beside(window.width(), at.x, grid.x()) || beside(window.height(), at.y, grid.y())) return std::nullopt;
  return in_grid(grid, at);
}

/// The labels of a window of the exact diagram with the tie rule: the least distance, then the first seed in
/// row-major order of position in the grid, then the lowest id. Along periodic axes seeds may lie outside the
/// period.
inline Labels brute_force(const Window& window, std::vector<Pixel> seeds, Metric metric) {
  const Grid& grid = window.grid();
  const DistanceIn distance(grid, metric);
  for (Pixel& seed : seeds) seed = in_period(grid, seed);
  Labels labels;
  labels.reserve(window.pixels());
  for (std::size_t i = 0; i < window.pixels(); ++i) {
    std::uint32_t best = no_label;
    std::int64_t least = 0;
    const Pixel at = pixel_at(Grid(window.width(), window.height(), window.depth()), i);
    const std::optional<Pixel> pixel = shown_pixel(window, at.x, at.y, at.z);
    for (std::uint32_t id = 0; pixel && id < seeds.size(); ++id) {
      const std::int64_t d = distance(*pixel, seeds[id]);
      if (best == no_label || d < least || (d == least && seeds[id] < seeds[best])) {
        best = id;
        least = d;
      }
    }
    labels.push_back(best);
  }
  return labels;
}

/// In how many pixels two label images differ: in all, if their sizes do.
inline std::size_t count_differences(const Labels& a, const Labels& b) {
  std::size_t differences = a.size() == b.size() ? 0 : std::max(a.size(), b.size());
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) differences += a[i] != b[i] ? 1 : 0;
  return differences;
}

/// How labels stand to the true ones.
struct Verdict {
  std::size_t unlabelled = 0;  // pixels without a label where the ground truth has one
  std::size_t invalid = 0;     // labels that name no seed
  std::size_t wrong = 0;       // labels of seeds that are farther than the nearest one
  std::size_t too_near =
      0;  // labels of seeds nearer than the ground truth's: the ground truth would be wrong
};

inline Verdict judge(const Grid& grid, const std::vector<Pixel>& seeds, Metric metric, const Labels& labels,
                     const Labels& ground_truth) {
  Verdict verdict;
  for (std::size_t i = 0; i < grid.pixels(); ++i) {
    const Pixel pixel = pixel_at(grid, i);
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
    const auto x = static_cast<std::int64_t>(rng() % static_cast<unsigned>(grid.width()));
    const auto y = static_cast<std::int64_t>(rng() % static_cast<unsigned>(grid.height()));
    pixels.push_back(
        {x, y,
         grid.is_volume() ? static_cast<std::int64_t>(rng() % static_cast<unsigned>(grid.depth())) : 0});
  }
  return pixels;
}

inline std::vector<Pixel> every_pixel(const Grid& grid) {
  std::vector<Pixel> pixels;
  for (std::int64_t y = 0; y < grid.height(); ++y) {
    for (std::int64_t x = 0; x < grid.width(); ++x) pixels.push_back({x, y});
  }
  return pixels;
}

struct Case {
  std::string name;
  Grid grid;
  std::vector<Pixel> seeds;
  Labels labels = {};             // of the caller's; empty: an engine's
  std::vector<bool> absent = {};  // by seed; empty: none is
};

/// All kinds of seeds on each of the grids.
inline std::vector<Case> cases_on(const std::vector<Grid>& grids) {
  std::vector<Case> cases;
  for (const Grid& grid : grids) {
    const std::int64_t right = grid.width() - 1, bottom = grid.height() - 1;
    constexpr const char* periodic[] = {" ", " periodic in x ", " periodic in y ", " periodic "};
    const std::string size = std::to_string(grid.width()) + "x" + std::to_string(grid.height()) +
                             periodic[static_cast<int>(grid.periodic())];
    const Pixel middle = {grid.width() / 2, grid.height() / 2};
    std::vector<Pixel> row, diagonal;
    for (std::int64_t x = 0; x <= right; x += 2) row.push_back({x, bottom / 2});
    for (std::int64_t i = 0; i <= right && i <= bottom; ++i) diagonal.push_back({i, i});
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
  constexpr Axes x = Axes::x, y = Axes::y, xy = Axes::xy;
  return cases_on(
      {{1, 17, xy}, {31, 1, xy}, {130, 5, xy}, {64, 64, xy}, {101, 97, xy}, {67, 65, x}, {16, 80, y}});
}

inline std::vector<Case> all_edge_cases() {
  std::vector<Case> cases = edge_cases(), periodic = periodic_cases();
  cases.insert(cases.end(), periodic.begin(), periodic.end());
  return cases;
}

/// Grids whose rows are shorter than the longest vector: kernels are built anew for the vectors that they
/// take.
inline bool is_narrow(const Grid& grid) { return grid.width() < 16; }

/// Those for a metric: narrow grids with one of both. (In wide grids tests take all vectors with both.)
inline std::vector<Case> all_edge_cases(Metric metric) {
  std::vector<Case> cases = all_edge_cases();
  if (metric == Metric::euclidean) return cases;
  const auto narrow =
      std::remove_if(cases.begin(), cases.end(), [](const Case& c) { return is_narrow(c.grid); });
  cases.erase(narrow, cases.end());
  return cases;
}

}  // namespace vorocl
