// What vorocl simulate is told, and how far a run of it has come.
#pragma once

#include <exception>
#include <optional>

#include "app/options/option_groups.hpp"
#include "app/outputs/frame_writer.hpp"
#include "app/sources/moving_seeds.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "app/terminal/progress.hpp"
#include "app/terminal/samples.hpp"
#include "vorocl/method.hpp"
#include "vorocl/simulation.hpp"

namespace vorocl::command {

/// The numbers of the engines of a simulation.
constexpr std::size_t main_engine = 0, other_engine = 1;

struct SimulateOptions : DiagramOptions {
  MotionOptions motion;
  std::optional<Method> compare_with;
  std::optional<Metric> compare_metric;
  std::optional<double> tolerance;  // of distances in pixels; none: labels are compared
  FrameWriterOptions output;
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

/// Goes through the frames before the first one of a run by pass(frame). Throws Error if there are fewer.
template <typename Pass>
void pass_frames(const SimulateOptions& options, MovingSeeds& source, const Interruption& interruption,
                 const Pass& pass) {
  const int first = options.motion.frames.first;
  const auto require_next = [&](int frame) {
    if (!source.next())
      throw Error(fmt::format("{}: there is no frame {}, only {}", options.seeds.trajectory, first,
                              counted(static_cast<std::uint64_t>(frame), "frame")));
  };
  Progress progress;
  for (int frame = 0; frame < first; ++frame) {
    if (frame > 0) require_next(frame);
    pass(frame);
    progress.show(frame + 1, source.done());
    if (interruption.came()) throw Error("interrupted, before the first frame was made");
  }
  if (first > 0) require_next(first);
}

/// Makes the frames of the run by make(frame): all, or those before a signal or an error, and waits until
/// they are written. Returns what ended it.
template <typename Make>
Trouble make_frames(const SimulateOptions& options, MovingSeeds& source, const Interruption& interruption,
                    FrameWriter& writer, const Make& make) {
  Trouble trouble;
  Progress progress;
  try {
    int frame = options.motion.frames.first;
    for (bool more = true; more; more = source.next()) {
      make(frame++);
      progress.show(frame, source.done());
      if (interruption.came()) {
        trouble.text = "interrupted";
        break;
      }
    }
  } catch (const std::exception& error) {  // ours, or out of memory, or OpenCV's: the frames so far are kept
    trouble = Trouble(error);
  }
  try {
    writer.wait();
  } catch (const std::exception& error) {  // of a frame before
    trouble = Trouble(error);
  }
  return trouble;
}

/// The cells of a trajectory's frames, as polygons or polyhedra. Throws UsageError if nothing is to be
/// written. Frames that are complete are kept where a later one is bad, or a signal comes.
void run_exact_frames(SimulateOptions options);

/// How far a run has come.
struct Course {
  int timed = 0;         // whose diagrams were made, without frame 0
  Samples similarities;  // of the frames after frame 0, where all methods start from nothing
  ErrorSamples errors;   // the same, where the other method is exact
  PlanSamples plans;     // where the method is djfa
};

/// On standard output, as text or JSON. Of what changes from frame to frame, the last one's, and so are the
/// measures.
void print_result(const SimulateOptions& options, const MovingSeeds& source, Simulation& simulation,
                  const Course& course, Measures& measures);

}  // namespace vorocl::command
