// vorocl cells: one diagram, and what is measured of its cells.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/commands.hpp"
#include "app/commands/finish_at_end.hpp"
#include "app/options/method_options.hpp"
#include "app/outputs/diagram_files.hpp"
#include "app/sources/seed_input.hpp"
#include "app/terminal/usage_error.hpp"
#include "formats/files.hpp"

namespace vorocl::command {

namespace {

struct CellsOptions {
  SeedOptions seeds;
  Method method = vorocl::method("exact");
  MethodOptions method_options;
  std::string device;
  std::vector<FileRequest> files = {{cells_kind(), ""},
                                    {adjacency_kind(), ""},
                                    {distance_kind(), ""},
                                    {border_kind(), ""},
                                    {labels_kind(), ""}};
  bool json = false;
};

struct Output {
  FileKind kind;
  OutputFile file;
};

/// All that can be said about the outputs before there is anything to put in.
std::vector<Output> check_outputs(const std::vector<FileRequest>& requests) {
  std::vector<NamedOutput> names;
  std::string all;
  for (const FileRequest& request : requests) {
    all += (all.empty() ? "" : ", ") + request.kind.option;
    if (request.path.empty()) continue;
    check_extension(request.path, request.kind.extensions);
    names.push_back({request.kind.option, request.path});
  }
  if (names.empty()) throw UsageError("nothing to write: give at least one of " + all);
  check_distinct(names);
  std::vector<Output> outputs;
  for (const FileRequest& request : requests) {
    if (!request.path.empty()) outputs.push_back({request.kind, OutputFile(request.path)});
  }
  return outputs;
}

void print_json(const CellsOptions& options, const Seeds& seeds, const Report& report, Analysis& analysis) {
  const CellStatistics statistics = analysis.statistics();
  const nlohmann::ordered_json result = {{"method", options.method.name},
                                         {"metric", to_string(options.method_options.metric)},
                                         {"device", seeds.device().name()},
                                         {"width", seeds.grid().width()},
                                         {"height", seeds.grid().height()},
                                         {"cells", statistics.cells},
                                         {"empty_cells", statistics.empty_cells},
                                         {"mean_area", statistics.mean_area},
                                         {"area_deviation", statistics.area_deviation},
                                         {"vertices", analysis.vertices()},
                                         {"pairs", analysis.pair_count()},
                                         {"waves", report.waves()},
                                         {"milliseconds", report.milliseconds()},
                                         {"host_milliseconds", report.host_milliseconds()}};
  fmt::print("{}\n", result.dump());
}

void print_text(const CellsOptions& options, const Seeds& seeds, const Report& report, Analysis& analysis) {
  const CellStatistics statistics = analysis.statistics();
  fmt::print(
      "{}: {} cells on {} x {} pixels in {:.1f} ms (a first run: it may build kernels), {} waves, on {}\n",
      options.method.name, statistics.cells, seeds.grid().width(), seeds.grid().height(),
      report.milliseconds(), report.waves(), seeds.device().name());
  fmt::print("{} cells are empty; the mean area is {:.2f} pixels, with a deviation of {:.2f}\n",
             statistics.empty_cells, statistics.mean_area, statistics.area_deviation);
  fmt::print("{} vertices, {} pairs of cells that touch\n", analysis.vertices(), analysis.pair_count());
  for (const FileRequest& request : options.files) {
    if (!request.path.empty()) fmt::print("wrote {}\n", request.path);
  }
}

void run(const CellsOptions& options) {
  const std::vector<Output> outputs = check_outputs(options.files);
  const Input input = read_input(options.seeds);
  const Device device = Device::select(options.device);
  const FinishAtEnd finish(device);
  const Seeds seeds = input.place(device);
  Diagram diagram(device, input.grid);
  const Report report = options.method.run(seeds, diagram, 0, options.method_options);
  AnalysisBuffers buffers;
  Analysis analysis(seeds, diagram, input.ids, options.method_options.metric, buffers);
  for (const Output& output : outputs) {
    output.file.write([&](const std::string& path) { output.kind.write(path, analysis); });
  }
  options.json ? print_json(options, seeds, report, analysis) : print_text(options, seeds, report, analysis);
}

}  // namespace

void add_cells(CLI::App& app) {
  const auto options = std::make_shared<CellsOptions>();
  CLI::App* const command = app.add_subcommand(
      "cells", "Measure the cells of one diagram: areas, centroids, neighbours, distances, borders");
  add_seed_options(*command, options->seeds);
  add_frame_option(*command, options->seeds);
  add_choice(*command, "--method", options->method, method_choices(), "How to make the diagram")
      ->default_str(options->method.name);
  add_method_options(*command, options->method_options);
  add_device_option(*command, options->device);
  add_file_options(*command, options->files);
  add_json_option(*command, options->json);
  command->callback([command, options] {
    check_method_options(*command, options->method_options, options->method.continues);
    run(*options);
  });
}

}  // namespace vorocl::command
