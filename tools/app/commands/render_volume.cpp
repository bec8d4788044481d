#include "app/commands/render_volume.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "app/outputs/output_files.hpp"
#include "app/sources/bounds.hpp"
#include "app/sources/volume_input.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "app/terminal/selected_device.hpp"
#include "formats/images/pictures.hpp"
#include "formats/raster_files.hpp"
#include "formats/values.hpp"

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

void print_result(const VolumeRendering& options, const Seeds& seeds, const Diagram& diagram,
                  const Report& report) {
  const Grid& grid = seeds.grid();
  if (options.json) {
    print_json(Json{{"method", options.method.name},
                    {"metric", to_string(diagram.metric())},
                    {"device", seeds.device().name()},
                    {"width", grid.width()},
                    {"height", grid.height()},
                    {"depth", grid.depth()},
                    {"periodic", to_string(grid.periodic(), grid.z().is_periodic())},
                    {"seeds", seeds.alive()},
                    {"waves", report.waves()},
                    {"milliseconds", report.milliseconds()},
                    {"host_milliseconds", report.host_milliseconds()}});
    return;
  }
  print("{}: {} on {} x {} x {} voxels in {:.1f} ms, {}, on {}\n", options.method.name,
        counted(seeds.alive(), "seed"), grid.width(), grid.height(), grid.depth(), report.milliseconds(),
        counted(report.waves(), "wave"), seeds.device().name());
  print_written(requested_files(options));
}

}  // namespace

void check_volume_method(const Method& method) {
  if (method.volumes) return;
  std::string names;
  for (const Method& other : methods()) {
    if (other.volumes) names += (names.empty() ? "" : ", ") + other.name;
  }
  throw UsageError("the method " + method.name + " is for planes; volumes have " + names);
}

void name_labels(std::vector<std::uint32_t>& labels, const std::vector<std::uint32_t>& ids) {
  if (ids.empty()) return;
  for (std::uint32_t& label : labels) label = label == no_label ? no_label : ids[label];
}

void render_volume(const VolumeRendering& options) {
  const VolumeSize sides = {options.seeds.size ? options.seeds.size->width() : 0,
                            options.seeds.size ? options.seeds.size->height() : 0, options.seeds.depth};
  check(options, sides);
  const std::optional<OutputFile> picture = open_output(options.picture_path);
  const std::optional<OutputFile> label_file = open_output(options.labels_path);
  const VolumeInput input = read_volume_input(options.seeds);
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  const Seeds seeds = input.place(device);
  Diagram diagram(device, input.grid);
  const Report report = options.method.run(seeds, diagram, options.method_options);
  std::vector<std::uint32_t> labels = diagram.read();
  if (picture) {
    write_picture(*picture, draw_slice(*options.slice, options.picture, seeds, labels, input.ids));
  }
  name_labels(labels, input.ids);
  if (label_file) write_volume(*label_file, sides, labels);
  print_result(options, seeds, diagram, report);
}

}  // namespace vorocl::command
