#include "studies/random_motion.hpp"

namespace vorocl::command {

namespace {

/// How many frames of a timed run may be on their way to the device.
constexpr int most_frames_ahead = 16;

}  // namespace

double RandomMotion::operator()(Seeds& seeds, int frame) const {
  random_step(seeds, step_length, border, rng_seed, static_cast<std::uint32_t>(frame));
  return step_length;
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
