// vorocl cells: one diagram or exact cells, and what is measured of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/commands/commands.hpp"
#include "app/options/option_groups.hpp"
#include "app/outputs/exact_cell_files.hpp"
#include "app/outputs/measures.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "formats/files.hpp"

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

  /// Of a plane or the globe, or of a volume, which has no borders.
  std::vector<FileRequest> of(CellsOf grid) const {
    std::vector<FileRequest> files = {cells, adjacency, distance, border, labels};
    if (grid == CellsOf::volumes) files.erase(files.end() - 2);
    for (FileRequest& file : files) file = of_grid(file, grid);
    return files;
  }
};

struct CellsOptions : DiagramOptions {
  std::optional<double> max_distance;
  CellsFiles files;
  bool exact = false;

  std::vector<FileRequest> requests() const {
    if (exact) return {files.cells, files.adjacency, files.polygons};
    return files.of(is_volume() ? CellsOf::volumes : seeds.on_globe() ? CellsOf::globe : CellsOf::planes);
  }
};

/// `beyond`: how many pixels are too far away, where that is asked for.
void print_result(const CellsOptions& options, const Seeds& seeds, const Report& report,
                  const std::optional<std::size_t>& beyond, Measures& measures) {
  const CellStatistics statistics = measures.statistics();
  const View& view = measures.view();
  const std::size_t unlabelled = view.window.pixels() - statistics.pixels;
  if (options.json) {
    Json result = json_of_diagram(options.method, options.method_options.metric, seeds, view);
    result.update(Json{{"seeds", seeds.alive()},
                       {"cells", statistics.cells},
                       {"empty_cells", statistics.empty_cells},
                       {fmt::format("unlabelled_{}s", name_of_pixel(view)), unlabelled}});
    if (options.is_volume()) {
      result.update(
          Json{{"mean_volume", statistics.mean_area}, {"volume_deviation", statistics.area_deviation}});
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

void print_exact_result(const CellsOptions& options, const Seeds& seeds, ExactCellRows& rows,
                        const ExactCellsCheck& check, const Report& report) {
  const Grid& grid = seeds.grid();
  const bool is_volume = grid.is_volume();
  std::vector<double> corners;
  for (const bool is_end : {false, true}) {
    const auto add = [&](const Axis& axis) { corners.push_back(is_end ? axis.to() : axis.from()); };
    add(grid.x());
    add(grid.y());
    if (is_volume) add(grid.z());
  }
  const std::string measure = is_volume ? "volume" : "area";
  if (options.json) {
    print_json(Json{{"exact", true},
                    {"device", seeds.device().name()},
                    {is_volume ? "box" : "rectangle", corners},
                    {"periodic", to_string(grid.periodic())},
                    {"cells", rows.order().size()},
                    {"empty_cells", rows.empty_cells()},
                    {"mean_" + measure, rows.mean_area()},
                    {measure + "_deviation", rows.area_deviation()},
                    {"pairs", rows.pair_count()},
                    {measure, check.area},
                    {"not_mutual", check.not_mutual},
                    {"uncertified", check.uncertified},
                    {"milliseconds", report.milliseconds()},
                    {"host_milliseconds", report.host_milliseconds()}});
    return;
  }
  print("exact cells: {} in {} in {:.1f} ms, on {}\n", counted(seeds.alive(), "seed"),
        fmt::format("{}", fmt::join(corners, ",")), report.milliseconds(), seeds.device().name());
  if (rows.empty_cells() > 0) {
    print("{} without a cell: another one has the same place{}\n", counted(rows.empty_cells(), "seed"),
          options.seeds.weight_column.empty() ? "" : ", or greater weights around it have its cell");
  }
  const std::size_t outside = seeds.alive() - rows.order().size();
  if (outside > 0) print("{} outside the rectangle without a cell in it\n", counted(outside, "seed"));
  print("the mean {} is {:.6g}, with a deviation of {:.6g}\n", measure, rows.mean_area(),
        rows.area_deviation());
  print("{} between cells\n", counted(rows.pair_count(), is_volume ? "face" : "edge"));
  print_written(requested(options.requests()));
}

/// GeoJSON without a system means longitudes and latitudes, which readers take others for without a word.
void note_degrees(const std::string& path, const SeedOptions& seeds, const Grid& grid) {
  const std::string extension = extension_of(path);
  const bool is_geojson = extension == ".geojson" || extension == ".json";
  const double x = std::max(std::abs(grid.x().from()), std::abs(grid.x().to())),
               y = std::max(std::abs(grid.y().from()), std::abs(grid.y().to()));
  if (seeds.points.empty() || seeds.crs || !is_geojson || (x <= 360 && y <= 180)) return;
  print_note(
      path +
      " says no coordinate reference system, so readers take its numbers for degrees; --crs EPSG:N says it");
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

  std::vector<RequestedOutput> outputs = open_outputs(options.requests(), options.seeds);
  Input input = read_input(options.seeds);
  for (RequestedOutput& output : outputs)
    output.request = of_exact_cells(output.request, input.view.is_volume());
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  const Seeds seeds = input.place(device);
  ExactCellsResult result;
  const Report report = exact_cells(seeds, result);
  const auto rows = std::make_shared<ExactCellRows>(seeds, result, std::move(input), options.seeds);
  MeasureBuffers buffers;
  Measures measures(rows, buffers);
  for (const RequestedOutput& output : outputs) {
    output.request.kind.write(output.file, measures);
    note_degrees(output.file.path(), options.seeds, seeds.grid());
  }
  print_exact_result(options, seeds, *rows, result.check(), report);
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
  const auto beyond = leave_out_beyond(options.max_distance, seeds, input.view, diagram);
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
  add_method_options(command, options->method_options, Globe::yes);
  add_device_option(command, options->device);
  command.begin_section(files_to_write);
  CellsFiles& files = options->files;
  for (FileRequest* const request :
       {&files.cells, &files.adjacency, &files.distance, &files.border, &files.labels}) {
    add_file_option(command, *request);
  }
  add_cell_columns_option(command, files.cells);
  add_keep_option(command, options->seeds);
  add_weight_options(command, options->seeds);
  add_max_distance_option(command, options->max_distance);
  add_crs_option(command, options->seeds.crs, "labels and distances as .tif and polygons as .geojson say")
      .needs(command.option("--points"));
  add_json_option(command, options->json);
  const Option exact =
      command.add("--exact", options->exact,
                  "Cut the cells as polygons or polyhedra, at the seeds' own places and without pixels");
  add_file_option(command, files.polygons).needs(exact);
  command.set_work([command, options] {
    options->seeds.metric = options->method_options.metric;
    std::vector<std::string> paths;
    for (const FileRequest& request : options->requests()) paths.push_back(request.path);
    check_crs(options->seeds, paths);
    options->seeds.is_exact = options->exact;
    if (options->exact) return run_exact(command, *options);
    if (options->is_volume()) {
      if (command.has("--border")) refuse_in_volumes("--border");
      check_volume_method(options->method, options->method_options.metric);
    }
    check_method_options(command, {options->method}, options->method_options);
    snap_for(options->method, options->seeds);
    if (!options->method.windows) options->seeds.keeps_inside = keeps_flooding_inside;
    run(*options);
  });
}

}  // namespace vorocl::command
