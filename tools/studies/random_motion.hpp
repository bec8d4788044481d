// The paper's model of motion, seeds that move at random, and the time of the diagrams.
#pragma once

#include <cstdint>
#include <functional>

#include "vorocl/motion.hpp"
#include "vorocl/simulation.hpp"

namespace vorocl::command {

/// Uniform steps: in each frame every seed moves by up to `step_length` pixels along x and y.
struct RandomMotion {
  int step_length = 0;
  std::uint64_t rng_seed = 1;
  Border border = Border::reflect;

  /// Moves the seeds to the frame, and returns the greatest displacement along an axis, in pixels.
  double operator()(Seeds& seeds, int frame) const;
};

struct RunTimes {
  double milliseconds = 0;       ///< the device's
  double host_milliseconds = 0;  ///< the host's, to enqueue the same
};

/// Makes the diagrams of some frames after frame 0 and adds up their times. `made` is told the number of
/// diagrams after each frame, and may throw to stop.
RunTimes timed_run(Simulation simulation, const Simulation::Engine& engine, int frames,
                   const std::function<void(int)>& made);

}  // namespace vorocl::command
