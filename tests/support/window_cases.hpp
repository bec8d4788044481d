// What the tests of windows share: the shapes of the exact engine, and random seeds, and how a case is named.
#pragma once

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
};

inline Device tuned(int vector_width, Shape shape, ListLength lists = ListLength::full) {
  Tuning tuning = test_device().tuning();
  tuning.vector_width = vector_width;
  tuning.shape = shape;
  return with_lists(test_device().with_tuning(tuning), lists);
}

inline const std::vector<Engine>& engines() {
  static const std::vector<Engine> all = {
      {"vector shape", tuned(16, Shape::vector)},
      {"vectors of 4", tuned(4, Shape::vector)},
      {"group shape", tuned(1, Shape::group)},
      {"short lists", tuned(8, Shape::vector, ListLength::two_entries)},
      {"group shape, short lists", tuned(1, Shape::group, ListLength::two_entries)},
  };
  return all;
}

inline std::string text_of(const Window& window, std::size_t seeds) {
  const Grid& grid = window.grid();
  std::ostringstream text;
  text << window.width() << " x " << window.height() << " from " << window.x() << ", " << window.y() << " of "
       << grid.width() << " x " << grid.height() << ", periodic " << static_cast<int>(grid.periodic()) << ", "
       << seeds << " seeds";
  return text.str();
}

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
