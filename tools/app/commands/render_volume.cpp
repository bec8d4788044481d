#include "app/commands/render_volume.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/commands/volume.hpp"
#include "app/options/option_groups.hpp"
#include "app/outputs/measures.hpp"
#include "app/outputs/output_files.hpp"
#include "app/sources/volume_input.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "app/terminal/selected_device.hpp"
#include "formats/images/pictures.hpp"
#include "formats/raster_files.hpp"

namespace vorocl::command {

namespace {

std::vector<RequestedFile> requested_files(const VolumeRendering& options) {
  return {{"--labels", options.labels_path, volume_extensions()},
          {"-o", options.picture_path, picture_extensions()}};
}

void check(const VolumeRendering& options, const VolumeSize& sides) {
  check_volume_method(options.method, options.method_options.metric);
  if (options.picture_path.empty() && options.labels_path.empty()) {
    throw UsageError("nothing to write: give -o PICTURE with --slice z=K, --labels FILE or both");
  }
  check_slice(options.picture, options.picture_path, sides);
  check_outputs(requested_files(options), options.seeds);
}

void print_result(const VolumeRendering& options, const Seeds& seeds, const Report& report,
                  Measures& measures) {
  const std::size_t empty = measures.cell_count().empty;
  const auto unlabelled =
      static_cast<std::size_t>(std::count(measures.labels().begin(), measures.labels().end(), no_label));
  if (options.json) {
    Json json = json_of_diagram(options.method, measures.metric(), seeds, measures.view());
    json.update(Json{{"seeds", seeds.alive()},
                     {"empty_cells", empty},
                     {"unlabelled_voxels", unlabelled},
                     {"waves", report.waves()},
                     {"milliseconds", report.milliseconds()},
                     {"host_milliseconds", report.host_milliseconds()}});
    print_json(json);
    return;
  }
  print_diagram(options.method, seeds, measures.view(), report);
  print_cells_of_volume(empty, seeds.alive(), unlabelled);
  print_written(requested_files(options));
}

}  // namespace

void render_volume(const VolumeRendering& options) {
  const VolumeSize sides = volume_size(options.seeds);
  check(options, sides);
  const std::optional<OutputFile> picture = open_output(options.picture_path);
  const std::optional<OutputFile> label_file = open_output(options.labels_path);
  const Input input = read_volume_input(options.seeds);
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  const Seeds seeds = input.place(device);
  Diagram diagram(device, input.view.window);
  const Report report = options.method.run(seeds, diagram, options.method_options);
  MeasureBuffers buffers;
  Measures measures(seeds, diagram, input.ids, input.view, buffers);
  if (label_file) write_voxels(*label_file, "label", input.view.voxels(), measures.labels_by_id());
  if (picture) {
    const std::string stamp = stamp_of(options.seeds.frame, input.timestep);
    write_picture(*picture, Painter(options.picture).draw(measures, {}, stamp));
  }
  print_result(options, seeds, report, measures);
}

}  // namespace vorocl::command
