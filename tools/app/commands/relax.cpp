// vorocl relax: Lloyd relaxation of seeds, with exact diagrams.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/commands/finish_at_end.hpp"
#include "app/options/options.hpp"
#include "app/outputs/diagram_files.hpp"
#include "app/outputs/frame_writer.hpp"
#include "app/outputs/painter.hpp"
#include "app/sources/seed_input.hpp"
#include "app/terminal/interruption.hpp"
#include "app/terminal/progress.hpp"
#include "formats/npy.hpp"
#include "vorocl/exact_diagram.hpp"
#include "vorocl/relaxation.hpp"

namespace vorocl::command {

namespace {

struct RelaxOptions {
  SeedOptions seeds;
  int rounds = 0;
  std::string device;
  FrameWriterOptions pictures;  // -o: a film or pictures of the rounds, or one picture
  std::vector<FileRequest> files = {{labels_kind(), ""}};
  std::string points_path;
  std::string energy_path;
  bool json = false;

  /// Whether -o asks for the rounds, not for the end alone.
  bool shows_rounds() const {
    return extension_of(pictures.picture_path) == ".mp4" ||
           pictures.picture_path.find('%') != std::string::npos;
  }
};

std::vector<NamedOutput> outputs_of(const RelaxOptions& options) {
  return {{options.files[0].kind.option, options.files[0].path},
          {"--relaxed-points", options.points_path},
          {"--energy", options.energy_path},
          {"-o", options.pictures.picture_path}};
}

struct Outputs {
  std::unique_ptr<FrameWriter> rounds;
  std::optional<OutputFile> picture;
  std::optional<OutputFile> labels;
  std::optional<OutputFile> points;
  std::optional<OutputFile> energy;
};

/// All that can be said about the outputs before there is anything to put in.
Outputs check_outputs(const RelaxOptions& options) {
  check_distinct(outputs_of(options));
  Outputs outputs;
  const auto open = [](std::optional<OutputFile>& file, const std::string& path,
                       const std::vector<std::string>& extensions) {
    if (path.empty()) return;
    check_extension(path, extensions);
    file.emplace(path);
  };
  check_picture_options(options.pictures.picture);
  if (options.shows_rounds()) {  // first: it makes the folder of numbered pictures
    outputs.rounds = std::make_unique<FrameWriter>(options.pictures);
  } else {
    open(outputs.picture, options.pictures.picture_path, picture_extensions());
  }
  open(outputs.labels, options.files[0].path, options.files[0].kind.extensions);
  open(outputs.points, options.points_path, {".csv", ".npy"});
  open(outputs.energy, options.energy_path, {".csv"});
  return outputs;
}

void write_points(const std::string& path, const Seeds& seeds, const std::vector<std::uint32_t>& ids) {
  std::vector<Point> points;
  for (const std::optional<Point>& point : seeds.read()) points.push_back(point.value());
  if (extension_of(path) == ".npy") {
    write_npy_points(path, points);
    return;
  }
  std::ofstream file = open_to_write(path);
  file << "id,x,y\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    file << fmt::format("{},{},{}\n", ids.empty() ? i : ids[i], points[i].x, points[i].y);
  }
  check_written(file, path);
}

void write_energies(const std::string& path, const Relaxation& relaxation) {
  std::ofstream file = open_to_write(path);
  file << "round,energy,moved\n";
  for (std::size_t round = 0; round < relaxation.energies.size(); ++round) {
    file << fmt::format("{},{},{}\n", round, relaxation.energies[round],
                        round == 0 ? 0 : relaxation.moved[round - 1]);
  }
  check_written(file, path);
}

Relaxation run_rounds(const RelaxOptions& options, const Input& input, Seeds& seeds, Diagram& diagram,
                      const Interruption& interruption, FrameWriter* writer) {
  Progress progress("rounds");
  AnalysisBuffers buffers;
  const auto engine = [](const Seeds& at, Diagram& filled, double) { return exact_diagram(at, filled); };
  const auto observer = [&](const Seeds& at, const Diagram& filled, const Relaxation& so_far) {
    const int round = so_far.rounds();
    if (writer != nullptr) {
      Analysis analysis(at, filled, input.ids, Metric::euclidean, buffers);
      writer->add({round, round, 0}, analysis, input.values);
    }
    progress.show(round, options.rounds > 0 ? static_cast<double>(round) / options.rounds : 1);
    return !interruption.came();
  };
  return relax(seeds, diagram, engine, options.rounds, observer);
}

void write_end(const Outputs& outputs, const RelaxOptions& options, const Input& input, const Seeds& seeds,
               const Diagram& diagram, const Relaxation& relaxation) {
  AnalysisBuffers buffers;
  Analysis analysis(seeds, diagram, input.ids, Metric::euclidean, buffers);
  if (outputs.labels) {
    outputs.labels->write([&](const std::string& path) { options.files[0].kind.write(path, analysis); });
  }
  if (outputs.points) {
    outputs.points->write([&](const std::string& path) { write_points(path, seeds, input.ids); });
  }
  if (outputs.energy) {
    outputs.energy->write([&](const std::string& path) { write_energies(path, relaxation); });
  }
  if (outputs.picture) {
    const cv::Mat picture = Painter(options.pictures.picture).draw(analysis, input.values);
    outputs.picture->write([&](const std::string& path) { write_picture(path, picture); });
  }
  if (outputs.rounds) outputs.rounds->finish();
}

void print_json(const Seeds& seeds, const Relaxation& relaxation) {
  const nlohmann::ordered_json result = {{"device", seeds.device().name()},
                                         {"width", seeds.grid().width()},
                                         {"height", seeds.grid().height()},
                                         {"seeds", seeds.alive()},
                                         {"rounds", relaxation.rounds()},
                                         {"settled", relaxation.converged},
                                         {"energy_at_start", relaxation.energies.front()},
                                         {"energy_at_end", relaxation.energies.back()}};
  fmt::print("{}\n", result.dump());
}

void print_text(const RelaxOptions& options, const Seeds& seeds, const Relaxation& relaxation) {
  fmt::print("{} seeds on {} x {} pixels, {} rounds, {}, on {}\n", seeds.alive(), seeds.grid().width(),
             seeds.grid().height(), relaxation.rounds(),
             relaxation.converged ? "settled: no seed moves any more" : "not settled yet",
             seeds.device().name());
  fmt::print("energy: {} at the start, {} at the end\n", relaxation.energies.front(),
             relaxation.energies.back());
  for (const NamedOutput& output : outputs_of(options)) {
    if (!output.path.empty()) fmt::print("wrote {}\n", output.path);
  }
}

void run(const RelaxOptions& options) {
  const Interruption interruption;  // before there are files
  const Outputs outputs = check_outputs(options);
  const Input input = read_input(options.seeds);
  check_picture_size(options.pictures.picture, input.grid);
  const Device device = Device::select(options.device);
  const FinishAtEnd finish(device);
  Seeds seeds = input.place(device);
  Diagram diagram(device, input.grid);
  const Relaxation relaxation =
      run_rounds(options, input, seeds, diagram, interruption, outputs.rounds.get());
  write_end(outputs, options, input, seeds, diagram, relaxation);
  if (!relaxation.converged && relaxation.rounds() < options.rounds) {
    throw Error(
        fmt::format("interrupted after {} rounds; the files show the last of them", relaxation.rounds()));
  }
  options.json ? print_json(seeds, relaxation) : print_text(options, seeds, relaxation);
}

}  // namespace

void add_relax(CLI::App& app) {
  const auto options = std::make_shared<RelaxOptions>();
  CLI::App* const command =
      app.add_subcommand("relax", "Move seeds to the centroids of their exact cells (Lloyd relaxation)");
  add_seed_options(*command, options->seeds);
  add_frame_option(*command, options->seeds);
  command->add_option("--rounds", options->rounds, "Rounds to make at most; ends sooner when no seed moves")
      ->type_name("K")
      ->check(CLI::Range(0, 1000000000))
      ->required();
  add_device_option(*command, options->device);
  add_film_options(
      *command, options->pictures,
      "Picture of the end, such as a.png; or of all rounds from the start: a film, .mp4 (H.264), "
      "or numbered pictures, such as rounds/%05d.png");
  command->get_option("-o")->type_name("PICTURE|FILM|PICTURES");
  add_file_options(*command, options->files);
  command
      ->add_option("--relaxed-points", options->points_path,
                   "Points to write, in pixels: .csv (id, x, y) or .npy (N, 2); on a grid of W x H, --points "
                   "reads them back with --bounds 0,0,W,H")
      ->type_name("FILE");
  command
      ->add_option("--energy", options->energy_path,
                   "A .csv file with a row a round: the sum of the squared distances of all pixels to their "
                   "seeds, and how many seeds the round moved")
      ->type_name("FILE");
  add_json_option(*command, options->json);
  command->callback([command, options] {
    if (options->pictures.picture_path.empty()) refuse_picture_options(*command, "-o");
    options->seeds.value_column = options->pictures.picture.color.column;
    run(*options);
  });
}

}  // namespace vorocl::command
