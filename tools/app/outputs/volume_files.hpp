// The kinds of files that a volume and its measures are written to: see diagram_files.hpp.
#pragma once

#include "app/outputs/diagram_files.hpp"

namespace vorocl::command {

/// Labels by id, and distances to the nearest seed (float): .npy or .vti.
const FileKind& volume_labels_kind();
const FileKind& volume_distance_kind();

/// One row per cell with its seed, volume, centroid, extent, surface, neighbours, largest distance and
/// whether it touches a border; one row per pair of cells that touch, with the area of the voxel faces that
/// they share: .csv.
const FileKind& volume_cells_kind();
const FileKind& volume_adjacency_kind();

}  // namespace vorocl::command
