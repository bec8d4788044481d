// vorocl relax: Lloyd relaxation of seeds, with exact diagrams.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "app/commands/commands.hpp"
#include "app/options/option_groups.hpp"
#include "app/sources/random_seeds.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "app/terminal/progress.hpp"
#include "formats/files.hpp"
#include "formats/images/pictures.hpp"
#include "formats/point_files.hpp"
#include "vorocl/exact_diagram.hpp"
#include "vorocl/relaxation.hpp"

namespace vorocl::command {

namespace {

struct RelaxCommand {
  SeedOptions seeds;
  int rounds = 0;
  std::string density_path;
  bool exact = false;
  std::string device;
  FrameWriterOptions pictures;  // -o: a film or pictures of the rounds, or one picture
  FileRequest labels = {labels_kind(), ""};
  std::string points_path;
  std::string energy_path;
  bool json = false;

  /// Whether -o asks for the rounds, not for the end alone.
  bool shows_rounds() const {
    return extension_of(pictures.picture_path) == film_extension ||
           pictures.picture_path.find('%') != std::string::npos;
  }
};

std::vector<RequestedFile> requested_files(const RelaxCommand& options) {
  std::vector<RequestedFile> files = {requested(options.labels),
                                      {"--relaxed-points", options.points_path, {".csv", ".npy"}},
                                      {"--energy", options.energy_path, {".csv"}}};
  if (options.shows_rounds()) {
    const std::vector<RequestedFile> of_rounds = requested_files(options.pictures);
    files.insert(files.end(), of_rounds.begin(), of_rounds.end());
  } else {
    files.push_back({"-o", options.pictures.picture_path, picture_extensions});
  }
  return files;
}

struct RelaxOutputs {
  std::unique_ptr<FrameWriter> rounds;
  std::optional<OutputFile> picture;
  std::optional<OutputFile> labels;
  std::optional<OutputFile> points;
  std::optional<OutputFile> energy;
};

RelaxOutputs open_outputs(const RelaxCommand& options) {
  check_outputs(requested_files(options), options.seeds, {{"--density", options.density_path, {}}});
  check_picture_options(options.pictures.picture);
  RelaxOutputs outputs;
  if (options.shows_rounds()) {  // first: it makes the folder of numbered pictures
    outputs.rounds = std::make_unique<FrameWriter>(options.pictures);
  } else {
    outputs.picture = open_output(options.pictures.picture_path);
  }
  outputs.labels = open_output(options.labels.path);
  outputs.points = open_output(options.points_path);
  outputs.energy = open_output(options.energy_path);
  return outputs;
}

/// Where seeds are, none of which is absent, in the view's units; without the rounding of diagrams where they
/// are exact.
std::vector<Point> positions_of(const Seeds& seeds, const View& view, bool are_exact) {
  const Grid& grid = seeds.grid();
  std::vector<Point> points;
  for (const std::optional<Point>& seed : are_exact ? seeds.read() : seeds.read_pixels()) {
    const Point at = seed.value();
    points.push_back(view.position(are_exact ? Point{grid.x().position(at.x), grid.y().position(at.y)} : at));
  }
  return points;
}

/// What an Error says that this throws; empty: it throws none.
template <typename Work>
std::string trouble_of(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string stamp_of_round(int round) { return fmt::format("round {}", round); }

void write_energies(const OutputFile& file, const Relaxation& relaxation) {
  GrowingFile table(file);
  table << "round,energy,moved\n";
  for (std::size_t round = 0; round < relaxation.energies.size(); ++round) {
    table << fmt::format("{},{:.17g},{}\n", round, relaxation.energies[round],
                         round == 0 ? 0 : relaxation.moved[round - 1]);
  }
  table.finish();
}

/// The density of the grid's pixels; none if it is not asked for.
std::vector<float> density_of_grid(const RelaxCommand& options, std::optional<DensityImage>&& density,
                                   const Input& input) {
  if (!density) return {};
  const Size size(input.view.window);
  if (density->size != size) {
    throw Error(fmt::format("{} is {} x {} pixels and the grid {} x {}; a density has a value for each pixel",
                            options.density_path, density->size.width(), density->size.height(), size.width(),
                            size.height()));
  }
  if (*std::max_element(density->values.begin(), density->values.end()) > 0)
    return std::move(density->values);
  throw Error(options.density_path +
              " weighs nothing anywhere: a picture is white or transparent, an array 0");
}

struct Rounds {
  Relaxation relaxation;
  std::string trouble;  // what ended it early; empty: nothing
};

/// A round that cannot be written ends it, as a signal does: at the latest one round later, for rounds are
/// written while the next one is made.
Rounds run_rounds(const RelaxCommand& options, const Input& input, Seeds& seeds, Diagram& diagram,
                  const Interruption& interruption, FrameWriter* writer, RelaxOptions&& how) {
  Rounds course;
  Progress progress({"rounds"});
  MeasureBuffers buffers;
  const auto engine = [](const Seeds& at, Diagram& filled) { return exact_diagram(at, filled); };
  const auto observer = [&](const Seeds& at, const Diagram& filled, const Relaxation& so_far) {
    const int round = so_far.rounds();
    if (writer != nullptr) {
      FrameFacts facts = {round, round, stamp_of_round(round)};
      facts.values = input.values;
      const auto measures = std::make_shared<Measures>(at, filled, input.ids, input.view, buffers);
      course.trouble = trouble_of([&] { writer->add(std::move(facts), measures); });
    }
    progress.show(round, options.rounds > 0 ? static_cast<double>(round) / options.rounds : 1);
    if (course.trouble.empty() && round < options.rounds && interruption.came()) {
      course.trouble = "interrupted";
    }
    return course.trouble.empty();
  };
  const auto wait = [&] {
    if (writer != nullptr) writer->wait();  // it reads `buffers`
  };
  try {
    course.relaxation = relax(seeds, diagram, engine, options.rounds, observer, how);
  } catch (...) {
    wait();
    throw;
  }
  const std::string late = trouble_of(wait);
  if (course.trouble.empty()) course.trouble = late;
  return course;
}

/// Writes all that can be written, and then returns the number of seeds without a pixel, or throws the first
/// trouble.
std::size_t write_end(const RelaxOutputs& outputs, const RelaxCommand& options, const Input& input,
                      const Seeds& seeds, const Diagram& diagram, Rounds& course) {
  const Relaxation& relaxation = course.relaxation;
  MeasureBuffers buffers;
  Measures measures(seeds, diagram, input.ids, input.view, buffers);
  if (!course.trouble.empty()) {
    course.trouble +=
        fmt::format(" after {}; the files show the last of them", counted(relaxation.rounds(), "round"));
    if (outputs.rounds && outputs.rounds->complete() <= relaxation.rounds()) {
      course.trouble += outputs.rounds->progress();
    }
  }
  const auto attempt = [&](const auto& write) {
    const std::string trouble = trouble_of(write);
    if (course.trouble.empty()) course.trouble = trouble;
  };
  if (outputs.labels) attempt([&] { options.labels.kind.write(*outputs.labels, measures); });
  if (outputs.points) {
    attempt(
        [&] { write_points(*outputs.points, positions_of(seeds, input.view, options.exact), input.ids); });
  }
  if (outputs.energy) attempt([&] { write_energies(*outputs.energy, relaxation); });
  if (outputs.picture) {
    attempt([&] {
      Painter painter(options.pictures.picture);
      write_picture(*outputs.picture,
                    painter.draw(measures, input.values, stamp_of_round(relaxation.rounds())));
    });
  }
  if (outputs.rounds) attempt([&] { outputs.rounds->finish(); });
  if (!course.trouble.empty()) throw Error(course.trouble);
  return measures.cell_count().empty;
}

void print_result(const RelaxCommand& options, const Seeds& seeds, const Relaxation& relaxation,
                  std::size_t empty_cells) {
  if (options.json) {
    print_json({{"device", seeds.device().name()},
                {"width", seeds.grid().width()},
                {"height", seeds.grid().height()},
                {"periodic", to_string(seeds.grid().periodic())},
                {"seeds", seeds.alive()},
                {"empty_cells", empty_cells},
                {"rounds", relaxation.rounds()},
                {"settled", relaxation.converged},
                {"energy_at_start", relaxation.energies.front()},
                {"energy_at_end", relaxation.energies.back()}});
    return;
  }
  print("{} on {} x {} pixels, {}, {}, on {}\n", counted(seeds.alive(), "seed"), seeds.grid().width(),
        seeds.grid().height(), counted(relaxation.rounds(), "round"),
        relaxation.converged ? "settled: no seed moves by 1/64 of a pixel" : "as many as allowed",
        seeds.device().name());
  print_empty_cells(empty_cells, seeds.alive(), seeds.alive());
  print("energy: {:.12g} at the start, {:.12g} at the end\n", relaxation.energies.front(),
        relaxation.energies.back());
  print_written(requested_files(options));
}

void run(RelaxCommand& options) {
  const Interruption interruption;  // before there are files
  const RelaxOutputs outputs = open_outputs(options);
  std::optional<DensityImage> density;
  if (!options.density_path.empty()) density = read_density(options.density_path);
  if (density && options.seeds.random > 0 && !options.seeds.size) options.seeds.size = density->size.grid();
  Input input = read_input(options.seeds);
  RelaxOptions how;
  how.exact = options.exact;
  how.density = density_of_grid(options, std::move(density), input);
  if (options.seeds.random > 0 && !how.density.empty()) {
    input.place = [&](const Device& device) {
      const Grid& grid = input.view.window.grid();
      return Seeds(device, grid,
                   random_points(grid, how.density, options.seeds.random, options.seeds.rng_seed),
                   {Outside::count, Snap::none});
    };
  }
  refuse_window(input, "relax");
  check_picture_size(options.pictures.picture, input.view.picture.size);
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  Seeds seeds = input.place(device);
  Diagram diagram(device, input.view.window);
  Rounds course =
      run_rounds(options, input, seeds, diagram, interruption, outputs.rounds.get(), std::move(how));
  const std::size_t empty_cells = write_end(outputs, options, input, seeds, diagram, course);
  print_result(options, seeds, course.relaxation, empty_cells);
}

}  // namespace

void add_relax(CommandLine& line) {
  const auto options = std::make_shared<RelaxCommand>();
  Command command = line.add("relax", "Move seeds to the centroids of their exact cells (Lloyd relaxation)");
  add_seed_options(command, options->seeds);
  add_frame_option(command, options->seeds);
  add_snap_option(command, options->seeds);
  add_units_option(command, options->seeds);
  command.begin_section("Relaxation");
  command
      .add("--rounds", options->rounds,
           "Greatest number of rounds; it ends when no seed moves by 1/64 of a pixel")
      .value_name("K")
      .in_range(0, 1000000000)
      .required();
  const Option exact = command.add("--exact", options->exact,
                                   "Move seeds to the centroids of their polygons, not of their pixels");
  command
      .add("--density", options->density_path,
           "How dense the seeds shall be: a picture, dense where it is dark, or numbers in .npy")
      .value_name("IMAGE")
      .excludes(exact);
  add_device_option(command, options->device);
  add_film_options(command, options->pictures, "PICTURE|FILM|PICTURES",
                   "Picture of the end, a.png; or of all rounds: a film, .mp4, or pictures, rounds/%05d.png");
  add_file_option(command, options->labels);
  command
      .add("--relaxed-points", options->points_path,
           "Points to write, in the units of --units: .csv (id, x, y) or .npy (N, 2)")
      .value_name("FILE");
  command.add("--energy", options->energy_path, "Energies to write, one row per round: .csv")
      .value_name("FILE");
  add_json_option(command, options->json);
  command.set_work([command, options] {
    if (options->exact && options->seeds.snap == Snap::to_pixels)
      throw UsageError("--exact moves seeds to any place, and --snap keeps them at pixels");
    check_film_options(command, options->pictures);
    options->seeds.value_column = options->pictures.picture.color.column;
    options->seeds.keeps_inside = "relax cannot take";
    options->seeds.of_pixels = Snap::none;
    run(*options);
  });
}

}  // namespace vorocl::command
