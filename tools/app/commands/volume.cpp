#include "app/commands/volume.hpp"

#include <nlohmann/json.hpp>
#include <string>

#include "formats/values.hpp"

namespace vorocl::command {

VolumeSize volume_size(const SeedOptions& seeds) {
  return {seeds.size->width(), seeds.size->height(), seeds.depth};
}

void check_volume(const SeedOptions& seeds, const Method& method) {
  if (seeds.random == 0) {
    throw UsageError(
        "--size WxHxD: a volume is made of --random seeds; points and masks of volumes are for Python");
  }
  SeedOptions of_a_plane = seeds;
  of_a_plane.depth = 1;
  check_seed_options(of_a_plane);
  if (method.volumes) return;
  std::string names;
  for (const Method& other : methods()) {
    if (other.volumes) names += (names.empty() ? "" : ", ") + other.name;
  }
  throw UsageError("the method " + method.name + " is for planes; volumes have " + names);
}

Json json_of_volume(const Method& method, const Seeds& seeds, const Diagram& diagram, const Report& report) {
  const Grid& grid = seeds.grid();
  return {{"method", method.name},
          {"metric", to_string(diagram.metric())},
          {"device", seeds.device().name()},
          {"width", grid.width()},
          {"height", grid.height()},
          {"depth", grid.depth()},
          {"seeds", seeds.alive()},
          {"waves", report.waves()},
          {"milliseconds", report.milliseconds()},
          {"host_milliseconds", report.host_milliseconds()}};
}

void print_volume(const Method& method, const Seeds& seeds, const Report& report) {
  const Grid& grid = seeds.grid();
  print("{}: {} on {} x {} x {} voxels in {:.1f} ms, {}, on {}\n", method.name,
        counted(seeds.alive(), "seed"), grid.width(), grid.height(), grid.depth(), report.milliseconds(),
        counted(report.waves(), "wave"), seeds.device().name());
}

void print_cells_of_volume(std::size_t empty, std::size_t seeds, std::size_t unlabelled) {
  if (empty > 0) print("{} of {} seeds own no voxel\n", empty, seeds);
  if (unlabelled > 0) print("{} without a label: no wave reached them\n", counted(unlabelled, "voxel"));
}

}  // namespace vorocl::command
