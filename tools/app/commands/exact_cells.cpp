#include "app/commands/exact_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/outputs/exact_cell_files.hpp"
#include "app/outputs/output_files.hpp"
#include "app/sources/exact_input.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "app/terminal/selected_device.hpp"
#include "formats/files.hpp"

namespace vorocl::command {

namespace {

void print_result(const ExactCellsOptions& options, const Seeds& seeds, ExactCellRows& rows,
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
          rows.input().values.numbers.empty() ? "" : ", or greater weights around it have its cell");
  }
  print("the mean {} is {:.6g}, with a deviation of {:.6g}\n", measure, rows.mean_area(),
        rows.area_deviation());
  print("{} between cells\n", counted(rows.pair_count(), is_volume ? "face" : "edge"));
  print_written(requested(options.files));
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

}  // namespace

void run_exact_cells(const ExactCellsOptions& options) {
  std::vector<RequestedOutput> outputs = open_outputs(options.files, options.seeds);
  Input input = read_exact_input(options.seeds);
  for (RequestedOutput& output : outputs)
    output.request = of_exact_cells(output.request, input.view.is_volume());
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  const Seeds seeds = input.place(device);
  ExactCellsResult result;
  const Report report = exact_cells(seeds, result, {input.values.numbers});
  const auto rows = std::make_shared<ExactCellRows>(seeds, result, std::move(input), options.seeds);
  MeasureBuffers buffers;
  Measures measures(rows, buffers);
  for (const RequestedOutput& output : outputs) {
    output.request.kind.write(output.file, measures);
    note_degrees(output.file.path(), options.seeds, seeds.grid());
  }
  print_result(options, seeds, *rows, result.check(), report);
}

}  // namespace vorocl::command
