// The paper's experiment for one grid size and one number of seeds: how near dJFA comes to JFA and to the
// exact diagram, and how long each method takes.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "trials/samples.hpp"
#include "vorocl/device.hpp"
#include "vorocl/grid.hpp"
#include "vorocl/simulation.hpp"

namespace vorocl::command {

/// What all configurations have in common.
struct EvaluationSettings {
  std::uint64_t rng_seed = 1;
  int step_length = 5;    ///< seeds move by up to this many pixels along x and y in a frame
  int frames = 100;       ///< over which similarities and errors are measured, after frame 0
  int timed_frames = 10;  ///< over which a timed run adds up the diagrams' times, after frame 0
  int repeats = 3;        ///< timed runs of each method
};

/// Seeds that move at random on side x side pixels.
struct Configuration {
  int side = 0;
  std::size_t seeds = 0;

  std::size_t pixels() const { return static_cast<std::size_t>(side) * static_cast<std::size_t>(side); }
  friend bool operator<(const Configuration& a, const Configuration& b) {
    return a.side != b.side ? a.side < b.side : a.seeds < b.seeds;
  }
  friend bool operator==(const Configuration& a, const Configuration& b) {
    return a.side == b.side && a.seeds == b.seeds;
  }
};

struct RunTimes {
  double milliseconds = 0;       ///< the device's
  double host_milliseconds = 0;  ///< the host's, to enqueue the same
};

/// Makes the diagrams of some frames after frame 0 and adds up their times. `made` is told the number of
/// diagrams after each frame, and may throw to stop.
RunTimes timed_run(Simulation simulation, const Simulation::Engine& engine, int frames,
                   const std::function<void(int)>& made);

/// A method in a metric, and all that is measured of it.
struct MethodResult {
  std::string method;  ///< "jfa", "djfa" or "exact"
  Metric metric = Metric::euclidean;
  int waves = 0;                        ///< of the last frame
  Samples milliseconds;                 ///< the device's, of the diagrams of a timed run; one value per run
  Samples host_milliseconds;            ///< the host's, to enqueue the same
  Samples similarity_to_euclidean_jfa;  ///< in percent, as the two that follow; one value per frame
  Samples similarity_to_jfa;            ///< of the same metric
  Samples similarity_to_exact;          ///< of the same metric
  ErrorSamples errors;
};

struct ConfigurationResult {
  std::size_t coincident_seeds = 0;   ///< that share their pixel in frame 0 with one of a lower id
  std::vector<MethodResult> methods;  ///< each method in each metric

  /// Throws Error if there is none.
  const MethodResult& of(const std::string& method, Metric metric) const;
};

/// The names of methods that evaluate() measures, each in both metrics.
const std::vector<std::string>& evaluated_methods();

/// Runs all methods side by side over all frames for their similarities and errors, which warms them up too;
/// then the methods take turns in timed runs. `made` is told the number of diagrams after each frame, and may
/// throw to stop.
ConfigurationResult evaluate(const Device& device, const Configuration& configuration,
                             const EvaluationSettings& settings, const std::function<void(int)>& made);

/// The diagrams that evaluate() makes of a configuration.
int diagrams_of(const EvaluationSettings& settings);

}  // namespace vorocl::command
