// vorocl cells: one diagram, and what is measured of its cells.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/commands.hpp"
#include "app/commands/exact_cells.hpp"
#include "app/commands/volume.hpp"
#include "app/options/option_groups.hpp"
#include "app/outputs/measures.hpp"
#include "app/sources/volume_input.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "app/terminal/selected_device.hpp"

namespace vorocl::command {

namespace {

/// The files that may be asked for.
struct CellsFiles {
  FileRequest cells = {cells_kind(), ""};
  FileRequest adjacency = {adjacency_kind(), ""};
  FileRequest distance = {distance_kind(), ""};
  FileRequest border = {border_kind(), ""};
  FileRequest labels = {labels_kind(), ""};
  FileRequest polygons = {polygons_kind(), ""};  // of exact cells

  std::vector<FileRequest> of_exact() const { return {cells, adjacency, polygons}; }

  /// Of a plane, or of a volume, which has no borders.
  std::vector<FileRequest> of(bool is_volume) const {
    std::vector<FileRequest> files = {cells, adjacency, distance, border, labels};
    if (is_volume) files.erase(files.end() - 2);
    for (FileRequest& file : files) file = of_grid(file, is_volume);
    return files;
  }
};

struct CellsOptions {
  SeedOptions seeds;
  Method method = vorocl::method("exact");
  MethodOptions method_options;
  std::optional<double> max_distance;
  std::string device;
  CellsFiles files;
  bool json = false;
  bool exact = false;

  bool is_volume() const { return seeds.is_volume(); }
  std::vector<FileRequest> requests() const { return files.of(is_volume()); }
};

/// `beyond`: how many pixels are too far away, where that is asked for.
void print_result(const CellsOptions& options, const Seeds& seeds, const Report& report,
                  const std::optional<std::size_t>& beyond, Measures& measures) {
  const CellStatistics statistics = measures.statistics();
  const View& view = measures.view();
  const std::size_t unlabelled = view.window.pixels() - statistics.pixels;
  if (options.json) {
    Json result = json_of_diagram(options.method, options.method_options.metric, seeds, view);
    result.update(Json{{"cells", statistics.cells}, {"empty_cells", statistics.empty_cells}});
    if (options.is_volume()) {
      result.update(Json{{"seeds", seeds.alive()},
                         {"unlabelled_voxels", unlabelled},
                         {"mean_volume", statistics.mean_area},
                         {"volume_deviation", statistics.area_deviation}});
    } else {
      result.update(Json{{"mean_area", statistics.mean_area},
                         {"area_deviation", statistics.area_deviation},
                         {"vertices", measures.vertices()}});
    }
    if (beyond) result["beyond_max_distance"] = *beyond;
    result.update(Json{{"pairs", measures.pair_count()},
                       {"waves", report.waves()},
                       {"milliseconds", report.milliseconds()},
                       {"host_milliseconds", report.host_milliseconds()}});
    print_json(result);
    return;
  }
  print_diagram(options.method, seeds, view, report);
  print_empty_cells(statistics.empty_cells, statistics.cells, seeds.alive(), name_of_pixel(view));
  if (options.is_volume()) print_unlabelled(unlabelled - beyond.value_or(0), seeds.alive());
  print_beyond(beyond, view);
  print("the mean {} is {:.6g}, with a deviation of {:.6g} ({})\n", options.is_volume() ? "volume" : "area",
        statistics.mean_area, statistics.area_deviation, view.units.area_title());
  if (!options.is_volume()) print("{}, ", counted(measures.vertices(), "vertex", "vertices"));
  print("{} of cells that touch\n", counted(measures.pair_count(), "pair"));
  print_written(requested(options.requests()));
}

/// The cells without a diagram. Throws UsageError for options that say something of one.
void run_exact(const Command& command, const CellsOptions& options) {
  for (const char* name :
       {"--method", "--metric", "--neighbourhood", "--von-neumann-waves", "--extra-waves",
        "--refresh-interval", "--reach", "--snap", "--distance", "--border", "--labels", "--max-distance"}) {
    if (command.has(name)) throw UsageError(std::string(name) + " is of diagrams, and --exact makes none");
  }
  if (in_pixels(options.seeds)) {
    throw UsageError("--exact measures in the units of the data, and --units px says pixels");
  }
  run_exact_cells({options.seeds, options.device, options.files.of_exact(), options.json});
}

void run(const CellsOptions& options) {
  const std::vector<RequestedOutput> outputs = open_outputs(options.requests(), options.seeds);
  const Input input = read_input(options.seeds);
  check_max_distance(options.max_distance, input.view);
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  const Seeds seeds = input.place(device);
  Diagram diagram(device, input.view.window);
  const Report report = options.method.run(seeds, diagram, options.method_options);
  std::optional<std::size_t> beyond;
  if (options.max_distance) beyond = leave_out_beyond(*options.max_distance, seeds, input.view, diagram);
  MeasureBuffers buffers;
  Measures measures(seeds, diagram, input.ids, input.view, buffers);
  if (!input.kept.names.empty()) measures.keep(input.kept);
  for (const RequestedOutput& output : outputs) output.request.kind.write(output.file, measures);
  print_result(options, seeds, report, beyond, measures);
}

}  // namespace

void add_cells(CommandLine& line) {
  const auto options = std::make_shared<CellsOptions>();
  Command command =
      line.add("cells", "Measure the cells of one diagram: areas, centroids, neighbours, distances, borders");
  add_seed_options(command, options->seeds, 1, false, Makes::volumes_too);
  add_frame_option(command, options->seeds);
  add_snap_option(command, options->seeds);
  add_units_option(command, options->seeds);
  add_method_option(command, options->method, "How to make the diagram");
  add_method_options(command, options->method_options);
  add_device_option(command, options->device);
  command.begin_section(files_to_write);
  CellsFiles& files = options->files;
  for (FileRequest* const request :
       {&files.cells, &files.adjacency, &files.distance, &files.border, &files.labels}) {
    add_file_option(command, *request);
  }
  add_cell_columns_option(command, files.cells);
  add_keep_option(command, options->seeds);
  add_max_distance_option(command, options->max_distance);
  add_crs_option(command, options->seeds.crs, "labels and distances as .tif and polygons as .geojson say")
      .needs("--points");
  add_json_option(command, options->json);
  const Option exact = command.add(
      "--exact", options->exact,
      "Cut the cells as polygons, of points and particles with z as polyhedra, at the seeds' own places and "
      "without pixels: for --cells, --adjacency and --polygons, in the units of the data");
  add_file_option(command, files.polygons).needs(exact);
  add_weight_options(command, options->seeds, exact);
  command.set_work([command, options] {
    check_crs(options->seeds.crs, options->exact ? std::vector<std::string>{options->files.polygons.path}
                                                 : std::vector<std::string>{options->files.labels.path,
                                                                            options->files.distance.path});
    if (options->exact) return run_exact(command, *options);
    if (options->is_volume()) {
      if (command.has("--border")) refuse_in_volumes("--border");
      check_volume_method(options->method, options->method_options.metric);
    }
    check_method_options(command, {options->method}, options->method_options);
    snap_for(options->method, options->seeds);
    if (options->is_volume()) return run(*options);
    if (!options->method.windows) options->seeds.keeps_inside = keeps_flooding_inside;
    run(*options);
  });
}

}  // namespace vorocl::command
