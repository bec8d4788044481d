// vorocl simulate: the diagrams of moving seeds, frame by frame, as a film, pictures, labels or times alone.
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/commands/finish_at_end.hpp"
#include "app/options/common_options.hpp"
#include "app/options/method_options.hpp"
#include "app/options/output_options.hpp"
#include "app/options/picture_options.hpp"
#include "app/options/seed_options.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/interruption.hpp"
#include "app/terminal/json.hpp"
#include "app/terminal/progress.hpp"
#include "formats/hash.hpp"
#include "formats/numbers.hpp"
#include "studies/error_samples.hpp"
#include "studies/metric_name.hpp"
#include "vorocl/similarity.hpp"
#include "vorocl/simulation.hpp"
#include "vorocl/version.hpp"

namespace vorocl::command {

namespace {

/// How many frames may be on their way to the device where nothing is read from it.
constexpr int most_frames_ahead = 16;

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
  std::string
      run;  // in lines, what is to be written: what a run must share with the one that it goes on with

  Metric other_metric() const { return compare_metric.value_or(method_options.metric); }
  bool other_is_exact() const {
    return compare_with && compare_with->exact && other_metric() == method_options.metric;
  }
};

std::optional<double> parse_tolerance(const std::string& text) {
  const auto pixels = parse_number<double>(text);
  if (!pixels || !std::isfinite(*pixels) || *pixels < 0) {
    throw Error("\"" + text + "\" must be a number of pixels, at least 0");
  }
  return pixels;
}

/// What dJFA's plans were, of the frames after frame 0.
struct PlanSamples {
  Samples first_steps, waves, displacements;
  int from_seeds = 0;  // frames that did not start from the last labels
  int jfa = 0;         // those of them in which all of JFA's waves ran

  void add(const Report& report, double max_displacement, const Grid& grid) {
    const FloodStart& start = report.start();
    first_steps.add(start.first_step);
    waves.add(report.waves());
    displacements.add(max_displacement);
    if (start.from_seeds) ++from_seeds;
    if (start.from_seeds && start.first_step == first_step(grid)) ++jfa;
  }
};

/// How far a run has come.
struct Course {
  int frames = 0;        // that are complete, with all that is written of them
  int made_before = 0;   // of these, by the run that this one goes on with
  int timed = 0;         // whose diagrams this run has made, without frame 0
  Hash seeds;            // of all frames, if the run can be resumed
  Samples similarities;  // of the frames after frame 0, where all methods start from nothing
  ErrorSamples errors;   // the same, where the other method is exact
  PlanSamples plans;     // where the method is djfa
  std::string trouble;   // what ended it too early; empty: nothing
};

/// `displacement` will hold the last motion's.
Simulation make_simulation(const SimulateOptions& options, const MovingSeeds& source, const Device& device,
                           double& displacement) {
  Seeds seeds = source.place(device);
  const Grid grid = seeds.grid();
  const std::size_t count = seeds.size();
  Simulation simulation(std::move(seeds),
                        [&](Seeds& moving, int) { return displacement = source.move(moving); });
  // Kernels are built before: this must not count as time of the first frames.
  const auto add = [&](const Method& method, const MethodOptions& method_options) {
    prepare(method, device, grid, count, method_options);
    simulation.add_engine(engine(method, method_options));
  };
  add(options.method, options.method_options);
  if (options.compare_with) {
    // The reference: it runs with its own waves, whatever those of the first method are.
    MethodOptions other;
    other.metric = options.other_metric();
    add(*options.compare_with, other);
  }
  return simulation;
}

/// Makes the diagrams of the next frame.
void make_frame(const SimulateOptions& options, Simulation& simulation, const double& displacement,
                Course& course) {
  simulation.step();
  if (simulation.frame() == 0) return;
  ++course.timed;
  if (options.method.continues) {
    course.plans.add(simulation.report(main_engine), displacement, simulation.seeds().grid());
  }
}

/// Adds what the frame's files follow from, besides the options.
void add_seeds(const MovingSeeds& source, const Seeds& seeds, Hash& hash) {
  const auto add = [&hash](double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    hash.add(bits);
  };
  for (const std::optional<Point>& point : seeds.read()) {
    add(point ? point->x : -1);
    add(point ? point->y : -1);
  }
  const View& view = source.view();
  for (const int value : {view.picture.grid.width(), view.picture.grid.height(), view.x, view.y}) add(value);
  for (const Point& place : {view.picture.corner, view.picture.pixel}) {
    add(place.x);
    add(place.y);
  }
  for (const std::uint32_t id : source.ids()) hash.add(id);
  for (const double value : source.values()) add(value);
  hash.add(static_cast<std::uint64_t>(source.timestep().value_or(0)));
}

void compare(const SimulateOptions& options, const Simulation& simulation, Course& course,
             FrameWriter& writer) {
  const Diagram& diagram = simulation.diagram(main_engine);
  const Diagram& other = simulation.diagram(other_engine);
  const double percent = options.tolerance ? similarity(simulation.seeds(), diagram, other,
                                                        *options.tolerance, options.method_options.metric)
                                           : similarity(diagram, other);
  std::optional<DistanceErrors> errors;
  if (options.other_is_exact()) {
    errors = distance_errors(simulation.seeds(), diagram, other, options.method_options.metric);
    course.errors.add(*errors);
  }
  course.similarities.add(percent);
  writer.add_similarity(simulation.frame(), percent, errors);
}

Measures measures_of(const SimulateOptions& options, const MovingSeeds& source, const Simulation& simulation,
                     MeasureBuffers& buffers) {
  return {simulation.seeds(), simulation.diagram(main_engine), source.ids(),
          source.view(),      options.method_options.metric,   buffers};
}

FrameFacts facts_of(const MovingSeeds& source, int frame, double milliseconds = 0) {
  return {frame, source.timestep().value_or(frame), stamp_of(frame, source.timestep()), milliseconds,
          source.box()};
}

/// Goes through the frames that an earlier run has completed. A method that goes on from the last labels
/// makes them anew, because what it knows of them besides the labels is in no file. Throws Error if they are
/// of other seeds.
void pass_complete_frames(const SimulateOptions& options, MovingSeeds& source, Simulation& simulation,
                          const double& displacement, const Interruption& interruption, FrameWriter& writer,
                          Course& course) {
  const Journal& journal = *writer.journal();
  const bool makes_all =
      options.method.continues || (options.compare_with && options.compare_with->continues);
  const auto refuse_seeds = [&] {
    throw Error(
        fmt::format("the seeds of frames 0 to {} are others than those that {} is of; give those, or "
                    "remove it and the .part files to start again",
                    journal.last_frame(), journal.path()));
  };
  Progress progress;
  MeasureBuffers buffers;
  for (int frame = 0; frame <= journal.last_frame(); ++frame) {
    if (frame > 0 && !source.next()) refuse_seeds();
    const bool needs_diagram = writer.needs_diagram(frame);
    makes_all || needs_diagram ? make_frame(options, simulation, displacement, course) : simulation.skip();
    add_seeds(source, simulation.seeds(), course.seeds);
    if (frame == journal.last_frame() && course.seeds.value() != journal.seeds()) refuse_seeds();
    const FrameFacts facts = facts_of(source, frame);
    if (needs_diagram) {
      Measures measures = measures_of(options, source, simulation, buffers);
      writer.go_on_from(facts, &measures, source.values());
    } else {
      writer.go_on_from(facts, nullptr, source.values());
    }
    progress.show(frame + 1, source.done());
    if (interruption.came()) throw Error("interrupted, before there was a new frame");
  }
  course.frames = course.made_before = journal.last_frame() + 1;
}

/// Makes and writes the next frame.
void add_frame(const SimulateOptions& options, const MovingSeeds& source, Simulation& simulation,
               const double& displacement, MeasureBuffers& buffers, FrameWriter& writer, Course& course) {
  make_frame(options, simulation, displacement, course);
  const int frame = simulation.frame();
  if (options.compare_with && frame > 0) compare(options, simulation, course, writer);
  if (writer.wants(frame)) {
    Measures measures = measures_of(options, source, simulation, buffers);
    writer.add(facts_of(source, frame, simulation.report(main_engine).milliseconds()), measures,
               source.values());
  }
  if (writer.journal() != nullptr) {
    add_seeds(source, simulation.seeds(), course.seeds);
    writer.journal()->complete(frame, course.seeds.value());
  }
  if (frame % most_frames_ahead == 0) {
    simulation.milliseconds(main_engine);  // waits, and forgets the events of these frames
    if (options.compare_with) simulation.milliseconds(other_engine);
  }
  ++course.frames;
}

/// The frames behind those that are complete: all, or those before a signal or an error.
void make_frames(const SimulateOptions& options, MovingSeeds& source, Simulation& simulation,
                 const double& displacement, const Interruption& interruption, FrameWriter& writer,
                 Course& course) {
  Progress progress;
  MeasureBuffers buffers;
  try {
    for (bool more = course.frames == 0 || source.next(); more; more = source.next()) {
      add_frame(options, source, simulation, displacement, buffers, writer, course);
      progress.show(course.frames, source.done());
      if (interruption.came()) {
        course.trouble = "interrupted";
        break;
      }
    }
  } catch (const std::exception& error) {  // ours, or out of memory, or OpenCV's: the frames so far are kept
    course.trouble = message_of(error);
  }
}

/// A value of the frames after frame 0: null if there are none.
Json value(const Samples& samples, double (Samples::*of)() const) {
  return samples.empty() ? Json() : Json((samples.*of)());
}

Json range(const Samples& samples) {
  return Json::Members{{"least", value(samples, &Samples::least)},
                       {"greatest", value(samples, &Samples::greatest)}};
}

/// Of the last frame.
std::size_t empty_cells(const Simulation& simulation) {
  return cell_statistics(simulation.seeds(), simulation.diagram(main_engine)).empty_cells;
}

Json::Members json_of(const SimulateOptions& options, const MovingSeeds& source, Simulation& simulation,
                      const Course& course) {
  const Seeds& seeds = simulation.seeds();
  const View& view = source.view();
  Json::Members result = {{"method", options.method.name},
                          {"metric", to_string(options.method_options.metric)},
                          {"device", seeds.device().name()},
                          {"width", view.picture.grid.width()},
                          {"height", view.picture.grid.height()},
                          {"periodic", to_string(seeds.periodic())},
                          {"area_unit", view.units.of_area()},
                          {"length_unit", view.units.of_length()},
                          {"seeds", seeds.alive()},
                          {"empty_cells", empty_cells(simulation)},
                          {"frames", simulation.frame()},
                          {"waves", simulation.report(main_engine).waves()},
                          {"milliseconds", simulation.milliseconds(main_engine)},
                          {"host_milliseconds", simulation.host_milliseconds(main_engine)}};
  if (options.output.resume) result.emplace_back("made_before", course.made_before);
  if (options.method.continues) {
    const PlanSamples& plans = course.plans;
    result.emplace_back("plans", Json::Members{{"first_step", range(plans.first_steps)},
                                               {"waves", range(plans.waves)},
                                               {"max_displacement", range(plans.displacements)},
                                               {"frames_from_seeds", plans.from_seeds},
                                               {"jfa_frames", plans.jfa}});
  }
  if (!options.compare_with) return result;
  const Samples& similarities = course.similarities;
  result.emplace_back("similarity", Json::Members{{"mean", value(similarities, &Samples::mean)},
                                                  {"least", value(similarities, &Samples::least)}});
  if (options.other_is_exact()) {
    const ErrorSamples& errors = course.errors;
    result.emplace_back(
        "errors", Json::Members{{"wrong_percent_mean", value(errors.wrong_percent, &Samples::mean)},
                                {"wrong_percent_greatest", value(errors.wrong_percent, &Samples::greatest)},
                                {"largest_excess", value(errors.largest_excess, &Samples::greatest)},
                                {"mean_excess", value(errors.mean_excess, &Samples::mean)}});
  }
  result.emplace_back("compare_with",
                      Json::Members{{"method", options.compare_with->name},
                                    {"metric", to_string(options.other_metric())},
                                    {"tolerance", options.tolerance ? Json(*options.tolerance) : Json()},
                                    {"waves", simulation.report(other_engine).waves()},
                                    {"milliseconds", simulation.milliseconds(other_engine)},
                                    {"host_milliseconds", simulation.host_milliseconds(other_engine)}});
  return result;
}

void print_times(const std::string& method, Simulation& simulation, std::size_t engine, int frames) {
  print("{}: {:.3f} ms per frame, {} waves in the last\n", method,
        frames > 0 ? simulation.milliseconds(engine) / frames : 0, simulation.report(engine).waves());
}

void print_text(const SimulateOptions& options, const MovingSeeds& source, Simulation& simulation,
                const Course& course) {
  const Seeds& seeds = simulation.seeds();
  const Grid& picture = source.view().picture.grid;
  print("{} frames after frame 0, {} seeds on {} x {} pixels, on {}\n", simulation.frame(), seeds.alive(),
        picture.width(), picture.height(), seeds.device().name());
  if (course.made_before > 0) print("made before: {} frames, from frame 0 on\n", course.made_before);
  print_empty_cells(empty_cells(simulation), seeds.alive());
  print_times(options.method.name, simulation, main_engine, course.timed);
  if (const PlanSamples& plans = course.plans; !plans.waves.empty()) {
    print("plans: first steps {} to {}, {} to {} waves, d_max {:.4g} to {:.4g} pixels\n",
          plans.first_steps.least(), plans.first_steps.greatest(), plans.waves.least(),
          plans.waves.greatest(), plans.displacements.least(), plans.displacements.greatest());
    print("frames from the seeds instead of the last labels: {}, of which {} with all waves of JFA\n",
          plans.from_seeds, plans.jfa);
  }
  if (options.compare_with) print_times(options.compare_with->name, simulation, other_engine, course.timed);
  if (const Samples& similarities = course.similarities; !similarities.empty()) {
    print("similarity: mean {:.4f} %, least {:.4f} %\n", similarities.mean(), similarities.least());
  }
  if (const ErrorSamples& errors = course.errors; !errors.wrong_percent.empty()) {
    print(
        "wrong pixels: mean {:.4f} %, greatest {:.4f} %; excess distance: mean {:.3g} pixels, largest "
        "{:.3f}\n",
        errors.wrong_percent.mean(), errors.wrong_percent.greatest(), errors.mean_excess.mean(),
        errors.largest_excess.greatest());
  }
  print_written(requested_files(options.output));
}

void run(const SimulateOptions& options) {
  const Interruption interruption;  // before there are files
  check_picture_options(options.output.picture);
  FrameWriter writer(options.output, options.other_is_exact(), options.run);
  const std::unique_ptr<MovingSeeds> source = read_moving_seeds(options.seeds, options.motion, interruption);
  check_picture_size(options.output.picture, source->view().picture.grid);
  const Device device = Device::select(options.device);
  const FinishAtEnd finish(device);
  double displacement = 0;
  Simulation simulation = make_simulation(options, *source, device, displacement);
  Course course;
  if (writer.journal() != nullptr) {
    pass_complete_frames(options, *source, simulation, displacement, interruption, writer, course);
  }
  make_frames(options, *source, simulation, displacement, interruption, writer, course);
  if (writer.journal() != nullptr && !course.trouble.empty()) {
    throw Error(
        fmt::format("{}; frames complete before that: {}; the same command goes on behind them, with {}",
                    course.trouble, course.frames, writer.journal()->path()));
  }
  if (course.frames > 0) writer.finish();
  if (!course.trouble.empty()) {
    throw Error(fmt::format("{}; frames complete before that: {}, written of them: {}", course.trouble,
                            course.frames, writer.frames()));
  }
  if (options.json) {
    print_json(json_of(options, *source, simulation, course));
  } else {
    print_text(options, *source, simulation, course);
  }
}

}  // namespace

void add_simulate(CommandLine& line) {
  const auto options = std::make_shared<SimulateOptions>();
  Command command =
      line.add("simulate", "Make the diagrams of moving seeds: a film, pictures, labels, times");
  add_seed_options(command, options->seeds, 1, true);
  add_motion_options(command, options->motion);
  add_units_option(command, options->seeds);
  add_method_option(command, options->method, "How to make the diagrams");
  add_method_options(command, options->method_options);
  const auto set_other = [](const std::string& name) { return choose(method_choices(), name); };
  const Option compare_with =
      command
          .add_parsed("--compare-with", options->compare_with, set_other,
                      "Another method to run on the same seeds, with its default waves, and to compare with")
          .value_name("NAME");
  const Choices<std::optional<Metric>> metrics = {{"euclidean", Metric::euclidean},
                                                  {"manhattan", Metric::manhattan}};
  command.add_choice("--compare-metric", options->compare_metric, metrics, "The other method's distance")
      .default_text("that of --metric")
      .needs(compare_with);
  command
      .add_parsed("--tolerance", options->tolerance, parse_tolerance,
                  "Compare distances instead of labels: pixels are equal if their two seeds are equally far, "
                  "to within this many pixels, by --metric")
      .value_name("PIXELS")
      .needs(compare_with);
  add_frame_writer_options(command, options->output);
  add_device_option(command, options->device);
  add_json_option(command, options->json);
  command.set_work([command, options] {
    if (options->output.picture_path.empty()) refuse_picture_options(command, "-o");
    check_method_options(command, {options->method}, options->method_options);
    options->seeds.value_column = options->output.picture.color.column;
    options->run = "version " VOROCL_VERSION "\n" + command.given({"--resume", "--device", "--json"});
    run(*options);
  });
}

}  // namespace vorocl::command
