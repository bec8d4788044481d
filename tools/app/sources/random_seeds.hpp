// Random seeds: the pixels of a plane that no device has to hold, points that are drawn by a density, and the
// paper's model of motion.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vorocl/grid.hpp"
#include "vorocl/motion.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl::command {

/// The pixel of the seed with this id: on a grid the same as Seeds::random() gives it.
Point random_pixel(const Grid& grid, std::uint32_t id, std::uint64_t rng_seed);

/// Points as dense as the square root of a density, as which Lloyd relaxation spreads them
/// (docs/relaxation.md), anywhere in their pixels, of which each has a density of at least 0, and some have
/// more.
std::vector<Point> random_points(const Grid& grid, const std::vector<float>& density, std::size_t count,
                                 std::uint64_t rng_seed);

/// Uniform steps: in each frame every seed moves by up to `step_length` pixels along x and y.
struct RandomMotion {
  int step_length = 0;
  std::uint64_t rng_seed = 1;
  Border border = Border::reflect;

  /// Moves the seeds to the frame, as a simulation's motion. The window stays.
  void operator()(Seeds& seeds, Window& window, int frame) const;
};

}  // namespace vorocl::command
