// What the commands that make a volume share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/sources/seed_input.hpp"
#include "formats/raster.hpp"
#include "vorocl/grid.hpp"
#include "vorocl/method.hpp"

namespace vorocl::command {

/// The volume that --size asks for.
VolumeSize volume_size(const SeedOptions& seeds);

/// Throws UsageError for a method that knows planes alone, or no such metric in volumes.
void check_volume_method(const Method& method, Metric metric);

/// Says which seeds own no voxel and which voxels no method reached; nothing if there are none.
void print_cells_of_volume(std::size_t empty, std::size_t seeds, std::size_t unlabelled);

}  // namespace vorocl::command
