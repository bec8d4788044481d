#include "app/commands/cells_volume.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/commands/volume.hpp"
#include "app/options/option_groups.hpp"
#include "app/outputs/output_files.hpp"
#include "app/outputs/volume_tables.hpp"
#include "app/sources/volume_input.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "app/terminal/selected_device.hpp"
#include "formats/raster_files.hpp"
#include "vorocl/cells.hpp"

namespace vorocl::command {

namespace {

std::vector<RequestedFile> requested_files(const VolumeCells& options) {
  return {{"--cells", options.cells, {".csv"}},
          {"--adjacency", options.adjacency, {".csv"}},
          {"--labels", options.labels, volume_extensions()}};
}

void check(const VolumeCells& options) {
  check_volume_options(options.seeds);
  check_volume_method(options.method);
  if (options.seeds.random == 0) throw UsageError("cells of volumes are made of --random seeds");
  if (options.cells.empty() && options.adjacency.empty() && options.labels.empty()) {
    throw UsageError("nothing to write: give at least one of --cells, --adjacency, --labels");
  }
  check_outputs(requested_files(options), options.seeds);
}

void print_result(const VolumeCells& options, const Seeds& seeds, const Diagram& diagram,
                  const Report& report, std::size_t pairs) {
  CellStatisticsResult result;
  cell_statistics(diagram, result);
  const CellStatistics statistics = result.read();
  const std::size_t unlabelled = diagram.window().pixels() - statistics.pixels;
  if (options.json) {
    Json json = json_of_volume(options.method, seeds, diagram, report);
    json.update(Json{{"cells", statistics.cells},
                     {"empty_cells", statistics.empty_cells},
                     {"unlabelled_voxels", unlabelled},
                     {"mean_volume", statistics.mean_area},
                     {"volume_deviation", statistics.area_deviation},
                     {"pairs", pairs}});
    print_json(json);
    return;
  }
  print_volume(options.method, seeds, report);
  print_cells_of_volume(statistics.empty_cells, seeds.alive(), unlabelled);
  print("the mean volume is {:.6g}, with a deviation of {:.6g} (voxels)\n", statistics.mean_area,
        statistics.area_deviation);
  print("{} of cells that touch\n", counted(pairs, "pair"));
  print_written(requested_files(options));
}

}  // namespace

void measure_volume(const VolumeCells& options) {
  check(options);
  const VolumeSize sides = volume_size(options.seeds);
  const std::optional<OutputFile> cells = open_output(options.cells),
                                  adjacent = open_output(options.adjacency),
                                  labels = open_output(options.labels);
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  const VolumeInput input = read_volume_input(options.seeds);
  const Seeds seeds = input.place(device);
  Diagram diagram(device, input.grid);
  const Report report = options.method.run(seeds, diagram, options.method_options);
  AdjacencyResult pairs;
  adjacency(diagram, pairs);
  if (cells) write_volume_cells(*cells, seeds, diagram, pairs);
  if (adjacent) write_volume_pairs(*adjacent, pairs);
  if (labels) write_volume(*labels, sides, diagram.read());
  print_result(options, seeds, diagram, report, pairs.pairs());
}

}  // namespace vorocl::command
