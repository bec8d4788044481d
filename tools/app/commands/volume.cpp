#include "app/commands/volume.hpp"

#include <nlohmann/json.hpp>
#include <string>

#include "app/sources/bounds.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

VolumeSize volume_size(const SeedOptions& seeds) {
  return {seeds.size->width(), seeds.size->height(), seeds.depth};
}

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

Json json_of_volume(const Method& method, const Seeds& seeds, Metric metric) {
  const Grid& grid = seeds.grid();
  return {{"method", method.name},
          {"metric", to_string(metric)},
          {"device", seeds.device().name()},
          {"width", grid.width()},
          {"height", grid.height()},
          {"depth", grid.depth()},
          {"periodic", to_string(grid.periodic(), grid.z().is_periodic())},
          {"seeds", seeds.alive()}};
}

Json json_of_volume(const Method& method, const Seeds& seeds, const Diagram& diagram, const Report& report) {
  Json json = json_of_volume(method, seeds, diagram.metric());
  json.update(Json{{"waves", report.waves()},
                   {"milliseconds", report.milliseconds()},
                   {"host_milliseconds", report.host_milliseconds()}});
  return json;
}

void print_volume(const Method& method, const Seeds& seeds, const Report& report) {
  const Grid& grid = seeds.grid();
  print("{}: {} on {} x {} x {} voxels in {:.1f} ms, {}, on {}\n", method.name,
        counted(seeds.alive(), "seed"), grid.width(), grid.height(), grid.depth(), report.milliseconds(),
        counted(report.waves(), "wave"), seeds.device().name());
}

void print_cells_of_volume(std::size_t empty, std::size_t seeds, std::size_t unlabelled) {
  if (empty > 0) print("{} of {} seeds own no voxel\n", empty, seeds);
  if (unlabelled == 0) return;
  print("{} without a label: {}\n", counted(unlabelled, "voxel"),
        seeds == 0 ? "there are no seeds" : "no wave reached them");
}

}  // namespace vorocl::command
