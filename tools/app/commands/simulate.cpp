// vorocl simulate: the diagrams of moving seeds, frame by frame, as a film, pictures, labels or times alone.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/commands/finish_at_end.hpp"
#include "app/options/method_options.hpp"
#include "app/outputs/frame_writer.hpp"
#include "app/sources/moving_seeds.hpp"
#include "app/terminal/interruption.hpp"
#include "app/terminal/progress.hpp"
#include "studies/error_samples.hpp"
#include "vorocl/similarity.hpp"
#include "vorocl/simulation.hpp"

namespace vorocl::command {

namespace {

/// How many frames may be on their way to the device where nothing is read from it.
constexpr int most_frames_ahead = 16;

constexpr std::size_t main_engine = 0, other_engine = 1;

struct SimulateOptions {
  SeedOptions seeds;
  MotionOptions motion;
  Method method = {};
  MethodOptions method_options;
  std::optional<Method> compare_with;
  std::optional<Metric> compare_metric;
  FrameWriterOptions output;
  std::string device;
  bool json = false;

  Metric other_metric() const { return compare_metric.value_or(method_options.metric); }
  bool other_is_truth() const {
    return compare_with && compare_with->exact && other_metric() == method_options.metric;
  }
};

/// How far a run has come.
struct Course {
  int frames = 0;        // that are complete, with all that is written of them
  Samples similarities;  // of the frames after frame 0, where all methods start from nothing
  ErrorSamples errors;   // the same, where the other method is the truth
  std::string trouble;   // what ended it too early; empty: nothing
};

Simulation make_simulation(const SimulateOptions& options, const MovingSeeds& source, const Device& device) {
  Seeds seeds = source.place(device);
  const Grid grid = seeds.grid();
  const std::size_t count = seeds.size();
  Simulation simulation(std::move(seeds), [&source](Seeds& moving, int) { return source.move(moving); });
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

void compare(const SimulateOptions& options, const Simulation& simulation, Course& course,
             FrameWriter& writer) {
  const Diagram& diagram = simulation.diagram(main_engine);
  const Diagram& other = simulation.diagram(other_engine);
  const double percent = similarity(diagram, other);
  std::optional<DistanceErrors> errors;
  if (options.other_is_truth()) {
    errors = distance_errors(simulation.seeds(), diagram, other, options.method_options.metric);
    course.errors.add(*errors);
  }
  course.similarities.add(percent);
  writer.add_similarity(simulation.frame(), percent, errors);
}

void write(const SimulateOptions& options, const MovingSeeds& source, const Simulation& simulation,
           AnalysisBuffers& buffers, FrameWriter& writer) {
  const int frame = simulation.frame();
  Analysis analysis(simulation.seeds(), simulation.diagram(main_engine), source.ids(),
                    options.method_options.metric, buffers);
  const FrameFacts facts = {frame, source.timestep().value_or(frame),
                            simulation.report(main_engine).milliseconds()};
  writer.add(facts, analysis, source.values());
}

/// All frames, or those before a signal or an error.
Course make_frames(const SimulateOptions& options, MovingSeeds& source, Simulation& simulation,
                   const Interruption& interruption, FrameWriter& writer) {
  Progress progress;
  AnalysisBuffers buffers;
  Course course;
  try {
    do {
      simulation.step();
      const int frame = simulation.frame();
      if (options.compare_with && frame > 0) compare(options, simulation, course, writer);
      if (writer.wants(frame)) write(options, source, simulation, buffers, writer);
      if (frame % most_frames_ahead == 0) {
        simulation.milliseconds(main_engine);  // waits, and forgets the events of these frames
        if (options.compare_with) simulation.milliseconds(other_engine);
      }
      ++course.frames;
      progress.show(course.frames, source.done());
      if (interruption.came()) {
        course.trouble = "interrupted";
        break;
      }
    } while (source.next());
  } catch (const std::exception& error) {  // ours, or out of memory, or OpenCV's: the frames so far are kept
    course.trouble = error.what();
  }
  return course;
}

nlohmann::ordered_json times(const std::string& method, Metric metric, Simulation& simulation,
                             std::size_t engine) {
  return {{"method", method},
          {"metric", to_string(metric)},
          {"waves", simulation.report(engine).waves()},
          {"milliseconds", simulation.milliseconds(engine)},
          {"host_milliseconds", simulation.host_milliseconds(engine)}};
}

/// A value of the frames after frame 0: null if there are none.
nlohmann::ordered_json value(const Samples& samples, double (Samples::*of)() const) {
  return samples.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json((samples.*of)());
}

void print_json(const SimulateOptions& options, Simulation& simulation, const Course& course) {
  const Seeds& seeds = simulation.seeds();
  nlohmann::ordered_json result = {
      {"method", options.method.name},   {"metric", to_string(options.method_options.metric)},
      {"device", seeds.device().name()}, {"width", seeds.grid().width()},
      {"height", seeds.grid().height()}, {"seeds", seeds.alive()},
      {"frames", simulation.frame()}};
  result.update(times(options.method.name, options.method_options.metric, simulation, main_engine));
  if (options.compare_with) {
    result["similarity"] = {{"mean", value(course.similarities, &Samples::mean)},
                            {"least", value(course.similarities, &Samples::least)}};
    if (options.other_is_truth()) {
      const ErrorSamples& errors = course.errors;
      result["errors"] = {{"wrong_percent_mean", value(errors.wrong_percent, &Samples::mean)},
                          {"wrong_percent_greatest", value(errors.wrong_percent, &Samples::greatest)},
                          {"largest_excess", value(errors.largest_excess, &Samples::greatest)},
                          {"mean_excess", value(errors.mean_excess, &Samples::mean)}};
    }
    result["compare_with"] =
        times(options.compare_with->name, options.other_metric(), simulation, other_engine);
  }
  fmt::print("{}\n", result.dump());
}

void print_times(const std::string& method, Simulation& simulation, std::size_t engine) {
  const int frames = simulation.frame();
  fmt::print("{}: {:.3f} ms a frame, {} waves in the last\n", method,
             frames > 0 ? simulation.milliseconds(engine) / frames : 0, simulation.report(engine).waves());
}

void print_text(const SimulateOptions& options, Simulation& simulation, const Course& course) {
  const Seeds& seeds = simulation.seeds();
  fmt::print("{} frames after frame 0, {} seeds on {} x {} pixels, on {}\n", simulation.frame(),
             seeds.alive(), seeds.grid().width(), seeds.grid().height(), seeds.device().name());
  print_times(options.method.name, simulation, main_engine);
  if (options.compare_with) print_times(options.compare_with->name, simulation, other_engine);
  if (const Samples& similarities = course.similarities; !similarities.empty()) {
    fmt::print("similarity: mean {:.4f} %, least {:.4f} %\n", similarities.mean(), similarities.least());
  }
  if (const ErrorSamples& errors = course.errors; !errors.wrong_percent.empty()) {
    fmt::print(
        "wrong pixels: mean {:.4f} %, greatest {:.4f} %; excess distance: mean {:.3g} pixels, largest "
        "{:.3f}\n",
        errors.wrong_percent.mean(), errors.wrong_percent.greatest(), errors.mean_excess.mean(),
        errors.largest_excess.greatest());
  }
  for (const NamedOutput& output : outputs_of(options.output)) {
    if (!output.path.empty()) fmt::print("wrote {}\n", output.path);
  }
}

void run(const SimulateOptions& options) {
  const Interruption interruption;  // before there are files
  FrameWriter writer(options.output, options.other_is_truth());
  const std::unique_ptr<MovingSeeds> source = read_moving_seeds(options.seeds, options.motion);
  check_picture_size(options.output.picture, source->grid());
  const Device device = Device::select(options.device);
  const FinishAtEnd finish(device);
  Simulation simulation = make_simulation(options, *source, device);
  const Course course = make_frames(options, *source, simulation, interruption, writer);
  if (course.frames > 0) writer.finish();
  if (!course.trouble.empty()) {
    throw Error(fmt::format("{}; frames complete before that: {}, written of them: {}", course.trouble,
                            course.frames, writer.frames()));
  }
  options.json ? print_json(options, simulation, course) : print_text(options, simulation, course);
}

}  // namespace

void add_simulate(CLI::App& app) {
  const auto options = std::make_shared<SimulateOptions>();
  CLI::App* const command =
      app.add_subcommand("simulate", "Make the diagrams of moving seeds: a film, pictures, labels, times");
  add_seed_options(*command, options->seeds, true);
  add_motion_options(*command, options->motion);
  add_choice(*command, "--method", options->method, method_choices(), "How to make the diagrams")->required();
  add_method_options(*command, options->method_options);
  const auto set_other = [options](const std::string& name) { return choose(method_choices(), name); };
  CLI::Option* const compare_with =
      add_parsed(*command, "--compare-with", options->compare_with, set_other,
                 "Another method to run on the same seeds, with its default waves, and to compare with");
  compare_with->type_name("NAME");
  const Choices<std::optional<Metric>> metrics = {{"euclidean", Metric::euclidean},
                                                  {"manhattan", Metric::manhattan}};
  add_choice(*command, "--compare-metric", options->compare_metric, metrics, "The other method's distance")
      ->default_str("that of --metric")
      ->needs(compare_with);
  add_frame_writer_options(*command, options->output);
  add_device_option(*command, options->device);
  add_json_option(*command, options->json);
  command->callback([command, options] {
    if (options->output.picture_path.empty()) refuse_picture_options(*command, "-o");
    check_method_options(*command, options->method_options, options->method.continues);
    options->seeds.value_column = options->output.picture.color.column;
    run(*options);
  });
}

}  // namespace vorocl::command
