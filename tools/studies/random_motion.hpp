// The paper's experiment, seeds that move at random, and the time of its diagrams.
#pragma once

#include <cstdint>
#include <functional>

#include "vorocl/simulation.hpp"

namespace vorocl::command {

/// A simulation of seeds that move by up to `step_length` pixels along each axis in a frame, within the grid.
Simulation random_walk(Seeds seeds, int step_length, std::uint64_t rng_seed);

struct RunTimes {
  double milliseconds = 0;       ///< the device's
  double host_milliseconds = 0;  ///< the host's, to enqueue the same
};

/// Makes the diagrams of some frames after frame 0 and adds up their times. `made` is told the number of
/// diagrams after each frame, and may throw to stop.
RunTimes timed_run(Simulation simulation, const Simulation::Engine& engine, int frames,
                   const std::function<void(int)>& made);

}  // namespace vorocl::command
