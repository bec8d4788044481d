#include "app/commands/render_volume.hpp"

#include <nlohmann/json.hpp>
#include <vector>

#include "app/commands/volume.hpp"
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
  check_volume_options(options.seeds);
  check_volume_method(options.method);
  if (options.picture_path.empty() && options.labels_path.empty()) {
    throw UsageError("nothing to write: give -o PICTURE with --slice z=K, --labels FILE or both");
  }
  check_slice(options.slice, options.picture_path, options.picture, sides);
  check_outputs(requested_files(options), options.seeds);
}

/// How many seeds own no voxel, and how many voxels have no label.
struct Missing {
  std::size_t cells, labels;
};

Missing missing_in(const std::vector<std::uint32_t>& labels, const Seeds& seeds) {
  std::vector<bool> has_voxels(seeds.size());
  std::size_t cells = 0, unlabelled = 0;
  for (const std::uint32_t label : labels) {
    if (label == no_label) {
      ++unlabelled;
    } else if (!has_voxels.at(label)) {
      has_voxels[label] = true;
      ++cells;
    }
  }
  return {seeds.alive() - cells, unlabelled};
}

void print_result(const VolumeRendering& options, const Seeds& seeds, const Diagram& diagram,
                  const Report& report, const View& view, const Missing& missing) {
  if (options.json) {
    Json json = json_of_diagram(options.method, diagram.metric(), seeds, view);
    json.update(Json{{"seeds", seeds.alive()},
                     {"empty_cells", missing.cells},
                     {"unlabelled_voxels", missing.labels},
                     {"waves", report.waves()},
                     {"milliseconds", report.milliseconds()},
                     {"host_milliseconds", report.host_milliseconds()}});
    print_json(json);
    return;
  }
  print_diagram(options.method, seeds, view, report);
  print_cells_of_volume(missing.cells, seeds.alive(), missing.labels);
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
  std::vector<std::uint32_t> labels = diagram.read();
  cv::Mat slice;
  if (picture) slice = draw_slice(*options.slice, options.picture, seeds, labels, input.ids);
  const Missing missing = missing_in(labels, seeds);
  name_labels(labels, input.ids);
  if (label_file) write_voxels(*label_file, "label", input.view.voxels(), labels);
  if (picture) write_picture(*picture, slice);
  print_result(options, seeds, diagram, report, input.view, missing);
}

}  // namespace vorocl::command
