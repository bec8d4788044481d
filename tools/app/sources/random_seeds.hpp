// Random seeds: the pixels of a plane that no device has to hold, and the paper's model of motion.
#pragma once

#include <cstdint>

#include "vorocl/grid.hpp"
#include "vorocl/motion.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl::command {

/// The pixel of the seed with this id: on a grid the same as Seeds::random() gives it.
Point random_pixel(const Grid& grid, std::uint32_t id, std::uint64_t rng_seed);

/// Uniform steps: in each frame every seed moves by up to `step_length` pixels along x and y.
struct RandomMotion {
  int step_length = 0;
  std::uint64_t rng_seed = 1;
  Border border = Border::reflect;

  /// Moves the seeds to the frame, as a simulation's motion. The window stays.
  void operator()(Seeds& seeds, Window& window, int frame) const;
};

}  // namespace vorocl::command
