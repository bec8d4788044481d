#include "studies/random_motion.hpp"

#include <utility>

#include "vorocl/motion.hpp"

namespace vorocl::command {

namespace {

/// How many frames of a timed run may be on their way to the device.
constexpr int most_frames_ahead = 16;

}  // namespace

Simulation random_walk(Seeds seeds, int step_length, std::uint64_t rng_seed) {
  return {std::move(seeds), [step_length, rng_seed](Seeds& moving, int frame) {
            random_step(moving, step_length, Border::reflect, rng_seed, static_cast<std::uint32_t>(frame));
            return step_length;
          }};
}

RunTimes timed_run(Simulation simulation, const Simulation::Engine& engine, int frames,
                   const std::function<void(int)>& made) {
  simulation.add_engine(engine);
  for (int frame = 0; frame <= frames; ++frame) {
    simulation.step();
    if (frame % most_frames_ahead == 0) simulation.milliseconds();  // waits
    made(1);
  }
  return {simulation.milliseconds(), simulation.host_milliseconds()};
}

}  // namespace vorocl::command
