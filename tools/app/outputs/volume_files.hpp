// The kinds of files that a volume and its measures are written to: see diagram_files.hpp.
#pragma once

#include "app/outputs/diagram_files.hpp"

namespace vorocl::command {

/// What the option of a plane's file asks for where it is given for a volume: --labels and --distance (.npy
/// or .vti); --cells, with the seed, volume, centroid, extent, surface, neighbours and largest distance of
/// each cell, and whether it touches a border; --adjacency, with the area of the voxel faces that two cells
/// share. There are no others.
FileRequest of_volume(const FileRequest& of_plane);

}  // namespace vorocl::command
