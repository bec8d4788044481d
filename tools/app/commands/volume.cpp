#include "app/commands/volume.hpp"

#include <string>

#include "app/terminal/console.hpp"

namespace vorocl::command {

void check_volume_method(const Method& method, Metric metric) {
  if (method.exact && metric != Metric::euclidean) {
    throw UsageError(
        "exact diagrams of volumes are Euclidean; of methods that make volumes jump flooding takes --metric "
        "manhattan");
  }
  if (method.volumes) return;
  std::string names;
  for (const Method& other : methods()) {
    if (other.volumes) names += (names.empty() ? "" : ", ") + other.name;
  }
  throw UsageError("the method " + method.name + " is for planes; volumes have " + names);
}

void print_unlabelled(std::size_t voxels, std::size_t seeds) {
  if (voxels == 0) return;
  print("{} without a label: {}\n", counted(voxels, "voxel"),
        seeds == 0 ? "there are no seeds" : "no wave reached them");
}

}  // namespace vorocl::command
