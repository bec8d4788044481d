// What the tests of windows share: the shapes of the exact engine, and how a case is named.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "fixture.hpp"
#include "list_length.hpp"
#include "plane_brute_force.hpp"

namespace vorocl {

using Labels = std::vector<std::uint32_t>;

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

inline std::string text_of(const Grid& grid, const Domain& domain, std::size_t seeds) {
  std::ostringstream text;
  text << grid.width() << " x " << grid.height() << " in " << domain.width << " x " << domain.height
       << " from " << domain.x << ", " << domain.y << ", periodic " << static_cast<int>(domain.periodic)
       << ", " << seeds << " seeds";
  return text.str();
}

}  // namespace vorocl
