// What the tests of windows share: the shapes of the exact engine, and seeds, and how a case is named.
#pragma once

#include <algorithm>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "list_length.hpp"

namespace vorocl {

/// The ways in which the engine and the pass after it work.
struct Engine {
  std::string name;
  Device device;
  std::vector<Metric> metrics;  // that tests of both take it for: each pair has kernels of its own to build

  bool is_for(Metric metric) const {
    return takes(device.tuning().shape) && std::find(metrics.begin(), metrics.end(), metric) != metrics.end();
  }
};

inline Device tuned(int vector_width, Shape shape, ListLength lists = ListLength::full) {
  Tuning tuning = test_device().tuning();
  tuning.vector_width = vector_width;
  tuning.shape = shape;
  return with_lists(test_device().with_tuning(tuning), lists);
}

inline const std::vector<Engine>& engines() {
  static const std::vector<Engine> all = {
      {"vector shape", tuned(16, Shape::vector), {Metric::euclidean, Metric::manhattan}},
      {"vectors of 4", tuned(4, Shape::vector), {Metric::euclidean}},
      {"group shape", tuned(1, Shape::group), {Metric::euclidean, Metric::manhattan}},
      {"short lists", tuned(8, Shape::vector, ListLength::two_entries), {Metric::euclidean}},
      {"group shape, short lists", tuned(1, Shape::group, ListLength::two_entries), {Metric::manhattan}},
  };
  return all;
}

inline std::vector<Engine> engines_of(Metric metric) {
  std::vector<Engine> some;
  for (const Engine& engine : engines()) {
    if (engine.is_for(metric)) some.push_back(engine);
  }
  return some;
}

/// One of those for the metric whose vectors fit in the window's rows: for others kernels would be built
/// anew.
inline const Engine& engine_for(const Window& window, Metric metric, std::size_t number) {
  for (;; ++number) {
    const Engine& engine = engines()[number % engines().size()];
    if (engine.is_for(metric) && engine.device.tuning().vector_width <= window.width()) return engine;
  }
}

inline std::string text_of(const Window& window, std::size_t seeds) {
  const Grid& grid = window.grid();
  std::ostringstream text;
  text << window.width() << " x " << window.height() << " from " << window.x() << ", " << window.y() << " of "
       << grid.width() << " x " << grid.height() << ", periodic " << static_cast<int>(grid.periodic()) << ", "
       << seeds << " seeds";
  return text.str();
}

/// All kinds of planes.
inline std::vector<Pixel> seeds_of_plane(const Grid& plane, unsigned kind, unsigned rng_seed) {
  const auto pixels = plane.pixels();
  std::mt19937 rng(rng_seed);
  std::vector<Pixel> seeds;
  switch (kind) {
    case 0:
      return {};
    case 1:
      return random_pixels(plane, 1, rng_seed);
    case 2:
      return random_pixels(plane, 2 + rng_seed % 7, rng_seed);
    case 3:
      return random_pixels(plane, pixels / 1000, rng_seed);
    case 4:
      return random_pixels(plane, pixels / 20, rng_seed);
    case 5: {  // clusters
      std::normal_distribution<double> spread(0, static_cast<double>(plane.width()) / 40.0);
      for (const Pixel& middle : random_pixels(plane, 4, rng_seed)) {
        for (int i = 0; i < 100; ++i) {
          const Pixel at =
              pixels_of({{centre(middle).x + spread(rng), centre(middle).y + spread(rng)}}).front();
          if (at.x >= 0 && at.x < plane.width() && at.y >= 0 && at.y < plane.height()) seeds.push_back(at);
        }
      }
      return seeds;
    }
    case 6:  // several on each pixel
      for (int copy = 0; copy < 3; ++copy) {
        for (const Pixel& pixel : random_pixels(plane, 30, rng_seed)) seeds.push_back(pixel);
      }
      return seeds;
    case 7:  // in rows and columns, with many ties
      for (int y = 0; y < plane.height(); y += 10) {
        for (int x = 0; x < plane.width(); x += 10) seeds.push_back({x, y});
      }
      return seeds;
    case 8:  // on the plane's border
      for (int x = 0; x < plane.width(); x += 3) seeds.push_back({x, x % 2 == 0 ? 0 : plane.height() - 1});
      return seeds;
    default:  // on every pixel of a part
      return every_pixel({plane.width() / 3, plane.height() / 3});
  }
}
constexpr unsigned kinds_of_planes = 10;

/// Random pixels of a rectangle of the plane.
inline std::vector<Pixel> random_pixels_between(const Pixel& first, const Pixel& last, std::size_t count,
                                                std::mt19937_64& rng) {
  std::uniform_int_distribution<std::int64_t> x(first.x, last.x), y(first.y, last.y);
  std::vector<Pixel> pixels;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t column = x(rng);
    pixels.push_back({column, y(rng)});
  }
  return pixels;
}

}  // namespace vorocl
