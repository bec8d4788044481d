// vorocl simulate: the diagrams of moving seeds, frame by frame, as a film, pictures, labels or times alone.

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/commands/simulate_course.hpp"
#include "app/options/option_groups.hpp"
#include "formats/values.hpp"
#include "vorocl/similarity.hpp"

namespace vorocl::command {

namespace {

/// How many frames may be on their way to the device where nothing is read from it.
constexpr int most_frames_ahead = 16;

std::optional<double> parse_tolerance(const std::string& text) {
  const auto pixels = parse_number<double>(text);
  if (!pixels || !std::isfinite(*pixels) || *pixels < 0) {
    throw Error("\"" + text + "\" must be a number of pixels, at least 0");
  }
  return pixels;
}

/// A run: its frames, one after the other.
class Run {
 public:
  Run(const SimulateOptions& options, MovingSeeds& source, const Device& device, FrameWriter& writer)
      : options_(options),
        source_(source),
        writer_(writer),
        simulation_(source.frame().place(device), source.frame().view.window,
                    [this](Seeds& moving, Window& window, int) {
                      source_.move(moving, window);
                      displacement_ = source_.frame().displacement;
                    }) {
    add_engine(options.method, options.method_options);
    if (options.compare_with) {
      // The reference: it runs with its own waves, whatever those of the first method are.
      MethodOptions other;
      other.metric = options.other_metric();
      add_engine(*options.compare_with, other);
    }
  }
  Run(const Run&) = delete;  // the motion keeps a pointer
  Run& operator=(const Run&) = delete;

  Simulation& simulation() { return simulation_; }
  const Course& course() const { return course_; }

  /// Of the last frame.
  std::shared_ptr<Measures> measures() {
    return std::make_shared<Measures>(simulation_.seeds(), simulation_.diagram(main_engine),
                                      source_.frame().ids, source_.frame().view, buffers_);
  }

  /// A frame before the first one. A method that goes on from the last labels makes it anew, because what it
  /// knows of them besides the labels is in no file.
  void pass_frame(int frame) {
    const bool needs_diagram = writer_.needs_diagram(frame, options_.motion.frames.first);
    const bool continues =
        options_.method.continues || (options_.compare_with && options_.compare_with->continues);
    continues || needs_diagram ? make_diagrams() : simulation_.skip();
    const std::shared_ptr<Measures> measures = needs_diagram ? this->measures() : nullptr;
    writer_.pass(facts(), measures.get());
  }

  /// Makes the next frame, and has it written.
  void add_frame() {
    make_diagrams();
    const int frame = simulation_.frame();
    FrameFacts facts = this->facts();
    if (options_.compare_with && frame > 0) facts.similarity = compare();
    std::shared_ptr<Measures> measures;
    if (writer_.wants(frame)) {
      measures = this->measures();
      facts.milliseconds = simulation_.report(main_engine).milliseconds();
    }
    writer_.add(std::move(facts), measures);
    if (frame % most_frames_ahead == 0) {
      simulation_.milliseconds(main_engine);  // waits, and forgets the events of these frames
      if (options_.compare_with) simulation_.milliseconds(other_engine);
    }
  }

 private:
  /// Its kernels are built before: this must not count as time of the first frames.
  void add_engine(const Method& method, const MethodOptions& options) {
    const Seeds& seeds = simulation_.seeds();
    prepare(method, seeds.device(), source_.frame().view.window, seeds.size(), options,
            options_.seeds.snapping());
    simulation_.add_engine([this, run = method.run, options](const Seeds& of, Diagram& diagram) {
      MethodOptions known = options;
      known.max_displacement = displacement_;  // which a box may make less than the seeds know
      return run(of, diagram, known);
    });
  }

  /// Makes the diagrams of the next frame.
  void make_diagrams() {
    simulation_.step();
    if (simulation_.frame() == 0) return;
    ++course_.timed;
    if (options_.method.continues) {
      course_.plans.add(simulation_.report(main_engine), displacement_, source_.frame().view.window);
    }
  }

  /// The other method's labels, as ones by the first method's metric.
  const Diagram& in_one_metric(const Diagram& other) {
    const Metric metric = options_.method_options.metric;
    if (options_.other_metric() == metric) return other;
    if (!judged_ || judged_->window() != other.window()) judged_.emplace(other.device(), other.window());
    judged_->write(other.labels(), simulation_.seeds(), metric);
    return *judged_;
  }

  FrameSimilarity compare() {
    const Diagram& diagram = simulation_.diagram(main_engine);
    const Diagram& other = simulation_.diagram(other_engine);
    options_.tolerance ? similarity(diagram, in_one_metric(other), *options_.tolerance, similarity_)
                       : similarity(diagram, other, similarity_);
    const double percent = similarity_.read();
    std::optional<DistanceErrors> errors;
    if (options_.other_is_exact()) {
      distance_errors(diagram, other, errors_);
      errors = errors_.read();
      course_.errors.add(*errors);
    }
    course_.similarities.add(percent);
    return {percent, errors};
  }

  FrameFacts facts() const {
    const int frame = simulation_.frame();
    return {frame,
            source_.frame().timestep.value_or(frame),
            stamp_of(frame, source_.frame().timestep),
            0,
            source_.frame().box,
            source_.frame().values,
            {}};
  }

  const SimulateOptions& options_;
  MovingSeeds& source_;
  FrameWriter& writer_;
  std::optional<double> displacement_;  // of the last motion
  Simulation simulation_;
  MeasureBuffers buffers_;
  SimilarityResult similarity_;
  std::optional<Diagram> judged_;  // see in_one_metric()
  DistanceErrorsResult errors_;
  Course course_;
};

void run(const SimulateOptions& options) {
  const Interruption interruption;  // before there are files
  check_outputs(as_usage([&] { return requested_files(options.output); }), options.seeds);
  check_picture_options(options.output.picture);
  FrameWriter writer(options.output, options.other_is_exact());
  const std::unique_ptr<MovingSeeds> source = read_moving_seeds(options.seeds, options.motion, interruption);
  const View& view = source->frame().view;
  const std::optional<VolumeSlice>& slice = options.output.picture.slice;
  check_picture_size(options.output.picture,
                     slice ? size_of_slice(view.window.grid(), *slice) : view.picture.size);
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  Run run(options, *source, device, writer);
  pass_frames(options, *source, interruption, [&](int frame) { run.pass_frame(frame); });
  const Trouble trouble = make_frames(options, *source, interruption, writer, [&](int) { run.add_frame(); });
  writer.end_run(trouble, options.motion.frames);
  note_of_last(options.seeds.trajectory, options.motion.frames, run.simulation().frame());
  print_result(options, *source, run.simulation(), run.course(), *run.measures());
}

/// Points that something floods are snapped. Throws UsageError if they must not be.
void choose_snap(SimulateOptions& options) {
  options.seeds.metric = options.method_options.metric;
  if (!options.seeds.weight_column.empty() && options.seeds.trajectory.empty())
    throw UsageError("random motion knows no --weights and no --radius: they are of a --trajectory");
  if (!options.seeds.weight_column.empty() && options.compare_with) {
    throw UsageError("--compare-with knows no --weights and no --radius: it judges labels by distances");
  }
  if (options.compare_with && options.compare_with->exact != options.method.exact) {
    options.seeds.usual_snap = Snap::to_pixels;  // with --no-snap, what floods is judged by the points
  } else {
    snap_for(options.method, options.seeds);
  }
}

/// Throws UsageError for options that volumes do not have, and asks for the files that they do.
void prepare_volumes(const Command& command, SimulateOptions& options) {
  SeedOptions& seeds = options.seeds;
  if (seeds.trajectory.empty()) {
    throw UsageError("--size WxHxD: vorocl simulate makes volumes of a --trajectory");
  }
  check_volume_options(seeds);
  if (command.has("--tolerance")) refuse_in_volumes("--tolerance");
  check_volume_method(options.method, options.method_options.metric);
  if (options.compare_with) check_volume_method(*options.compare_with, options.other_metric());
  check_slice(options.output.picture, options.output.picture_path, *seeds.size);
  choose_snap(options);
}

/// Throws UsageError for options that planes do not have, or that do not go together there.
void prepare_planes(SimulateOptions& options) {
  if (options.output.picture.slice) throw UsageError("--slice is for volumes: give --size WxHxD");
  choose_snap(options);
  options.seeds.value_column = options.output.picture.color.column;
}

/// The cells of a trajectory without diagrams. Throws UsageError for options that say something of one.
void run_exact(const Command& command, SimulateOptions& options) {
  const std::string others =
      command.given({"--exact", "--trajectory", "--frames", "--cells", "--cell-columns", "--adjacency",
                     "--polygons", "--every", "--bounds", "--y-up", "--y-down", "--periodic", "--outside",
                     "--weights", "--radius", "--device", "--json"});
  if (!others.empty()) {
    throw UsageError(others.substr(0, others.find_first_of(" \n")) +
                     " is not for --exact, which cuts the cells of a trajectory's own positions and makes no "
                     "diagrams");
  }
  if (options.seeds.trajectory.empty()) throw UsageError("--exact requires --trajectory");
  check_every(options.motion.frames, options.output.every);
  options.seeds.is_exact = true;
  options.output.files = {options.output.files.at(1), options.output.files.at(2), options.polygons};
  run_exact_frames(options);
}

}  // namespace

void add_simulate(CommandLine& line) {
  const auto options = std::make_shared<SimulateOptions>();
  Command command =
      line.add("simulate", "Make the diagrams of moving seeds: a film, pictures, labels, times");
  add_seed_options(command, options->seeds, 1, true, Makes::volumes_too);
  add_units_option(command, options->seeds);
  add_snap_option(command, options->seeds);
  add_motion_options(command, options->motion);
  add_method_option(command, options->method, "How to make the diagrams");
  add_method_options(command, options->method_options);
  command.begin_section("Another method, to compare with");
  const auto set_other = [](const std::string& name) { return choose(method_choices(), name); };
  const Option compare_with = command
                                  .add_parsed("--compare-with", options->compare_with, set_other,
                                              "Another method to run on the same seeds, and to compare with")
                                  .value_name("NAME");
  const Choices<std::optional<Metric>> metrics = {{"euclidean", Metric::euclidean},
                                                  {"manhattan", Metric::manhattan}};
  command.add_choice("--compare-metric", options->compare_metric, metrics, "The other method's distance")
      .default_text("that of --metric")
      .needs(compare_with);
  command
      .add_parsed("--tolerance", options->tolerance, parse_tolerance,
                  "Compare distances instead of labels, to within this many pixels")
      .value_name("PIXELS")
      .needs(compare_with);
  add_weight_options(command, options->seeds);
  add_frame_writer_options(command, options->output);
  add_slice_option(command, options->output.picture);
  add_device_option(command, options->device);
  add_json_option(command, options->json);
  const Option exact = command.add("--exact", options->exact,
                                   "Cut the cells of a trajectory as polygons or polyhedra, without pixels");
  add_file_option(command, options->polygons, true).needs(exact);
  command.set_work([command, options] {
    if (options->exact) return run_exact(command, *options);
    check_film_options(command, options->output);
    const std::vector<FileRequest>& files = options->output.files;
    const bool writes =
        !options->output.picture_path.empty() ||
        std::any_of(files.begin(), files.end(), [](const auto& file) { return !file.path.empty(); });
    if (command.has("--every") && !writes)
      throw UsageError("--every is for -o and for files of each frame, such as --cells: none is asked for");
    check_every(options->motion.frames, options->output.every);
    check_method_options(command, {options->method}, options->method_options);
    options->seeds.is_volume() ? prepare_volumes(command, *options) : prepare_planes(*options);
    const auto& other = options->compare_with;
    if (!options->method.windows || (other && !other->windows))
      options->seeds.keeps_inside = keeps_flooding_inside;
    for (FileRequest& request : options->output.files)
      request = of_grid(request, options->seeds.is_volume() ? CellsOf::volumes : CellsOf::planes);
    run(*options);
  });
}

}  // namespace vorocl::command
