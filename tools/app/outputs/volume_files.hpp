// The tables of a volume's cells, in voxels.
#pragma once

#include <string>
#include <vector>

#include "formats/output_file.hpp"
#include "vorocl/adjacency.hpp"
#include "vorocl/diagram.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl::command {

/// One row per cell with its seed, volume, centroid, extent, surface, neighbours, largest distance and
/// whether it touches a border. Measures what it needs. Throws Error if a measurement fails or the file
/// cannot be written.
void write_volume_cells(const OutputFile& file, const Seeds& seeds, const Diagram& diagram,
                        const AdjacencyResult& pairs);

/// One row per pair of cells that touch: their ids and the voxel faces that they share. Throws likewise.
void write_volume_pairs(const OutputFile& file, const AdjacencyResult& pairs);

}  // namespace vorocl::command
