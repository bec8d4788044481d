// What vorocl simulate is told, and how far a run of it has come.
#pragma once

#include <optional>
#include <string>

#include "app/outputs/frame_writer.hpp"
#include "app/sources/moving_seeds.hpp"
#include "app/terminal/samples.hpp"
#include "vorocl/method.hpp"
#include "vorocl/simulation.hpp"

namespace vorocl::command {

/// The numbers of the engines of a simulation.
constexpr std::size_t main_engine = 0, other_engine = 1;

struct SimulateOptions {
  SeedOptions seeds;
  MotionOptions motion;
  Method method = vorocl::method("exact");
  MethodOptions method_options;
  std::optional<Method> compare_with;
  std::optional<Metric> compare_metric;
  std::optional<double> tolerance;  // of distances in pixels; none: labels are compared
  FrameWriterOptions output;
  std::string device;
  bool json = false;
  bool exact = false;                            // cells as polygons, and no diagrams
  FileRequest polygons = {polygons_kind(), ""};  // of these

  Metric other_metric() const { return compare_metric.value_or(method_options.metric); }
  bool other_is_exact() const {
    return compare_with && compare_with->exact && other_metric() == method_options.metric;
  }
};

/// What dJFA's plans were, of the frames after frame 0.
struct PlanSamples {
  Samples first_steps, waves;
  Samples displacements;  // of the frames that have one
  int from_seeds = 0;     // frames that did not start from the last labels
  int jfa = 0;            // those of them in which all of JFA's waves ran

  void add(const Report& report, const std::optional<double>& max_displacement, const Window& window) {
    const FloodStart& start = report.start();
    first_steps.add(start.first_step);
    waves.add(report.waves());
    if (max_displacement) displacements.add(*max_displacement);
    if (start.from_seeds) ++from_seeds;
    if (start.from_seeds && start.first_step == first_step(window)) ++jfa;
  }
};

/// How far a run has come.
struct Course {
  int frames = 0;        // that are complete, with all that is written of them
  int timed = 0;         // whose diagrams were made, without frame 0
  Samples similarities;  // of the frames after frame 0, where all methods start from nothing
  ErrorSamples errors;   // the same, where the other method is exact
  PlanSamples plans;     // where the method is djfa
  Trouble trouble;
};

/// On standard output, as text or JSON. Of what changes from frame to frame, the last one's, and so are the
/// measures.
void print_result(const SimulateOptions& options, const MovingSeeds& source, Simulation& simulation,
                  const Course& course, Measures& measures);

}  // namespace vorocl::command
