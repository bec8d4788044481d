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

/// Throws UsageError for a method that knows planes alone, or no such metric in volumes.
void check_volume_method(const Method& method, Metric metric);

/// Says how many voxels no method reached; nothing if there are none.
void print_unlabelled(std::size_t voxels, std::size_t seeds);

}  // namespace vorocl::command
