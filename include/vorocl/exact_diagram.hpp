// Exact diagrams: every pixel gets its nearest seed.
#pragma once

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

struct ExactOptions {
  Metric metric = Metric::euclidean;
};

/// Fills the diagram so that every pixel has the label of its nearest seed; of several at the least distance,
/// of the one that comes first in row-major order of position. Enqueues and returns.
///
/// Exact: all distances are integers, and the labels are the same on every device, for every tuning and,
/// where no two seeds share a pixel, for every order of the seeds. Where seeds at the centres of pixels are
/// dense, the nearest seed of each row and then the best row is taken (as in separable distance transforms);
/// else those seeds near that no other one beats at all four corners of a square of pixels are tried. Cost:
/// in proportion to the pixels, within a factor of a few (docs/performance.md); where points lie on a curve
/// or surface with many per pixel, in proportion to that number too (docs/true_positions.md,
/// docs/volumes.md). 4 bytes of device memory per pixel, the labels, and 12 per seed besides its position,
/// and up to 20 of an index (24 with Shape::group, and 2 per pixel of squares of 32); where seeds are dense
/// up to 3.3 (6.2) more per pixel in their place. Throws Error if seeds and diagram do not fit together or
/// the device has too little memory.
///
/// Of seeds with Snap::none the points themselves are taken: the nearest is that of the least (distance from
/// the pixel's centre, y, x, id), in whole numbers of 1/4096 pixel: 8 more bytes of device memory per seed.
/// Throws Error too if a seed that may own a pixel is more than 262,144 pixels from the window's first one.
///
/// Any window of any grid: seeds outside it, and images across its periods, are taken into account, in 64-bit
/// integers where they need be. Where the window is not one whole period of at most 32,000 pixels, or seeds
/// lie outside it, each seed and image that may own a pixel costs a place in the list.
///
/// In a tilted grid (Grid::tilted()) all seeds are taken as points, snapped ones at the centres of their
/// pixels. Where the window is a part of it, or all of a plane that is longer than 32,000 pixels or very flat
/// (its length squared more than 1.8 million times its height, at a tilt of half a period), the host places
/// their images whenever they have moved, and looks at as many as rows of images may reach the window: sides
/// of at most 131,072 pixels then, else this throws Error. Volumes as flat throw Error.
///
/// By great circles (Metric::great_circle) the grid's x are longitudes and its y latitudes, both in degrees.
/// It may show a part of the globe, or go round it: as a periodic axis of 360 degrees, so that cells touch
/// across its ends. Points anywhere on the globe count, whatever their longitude. Directions to seeds and
/// pixels are rounded once, to 2^-31: within a quarter of the globe of a seed no label is farther than the
/// nearest seed by more than 2 cm. Of seeds at one distance the northern one wins, then the western one from
/// -180 on, then the lowest id. Distances are kilometres on a sphere of 6371.0088 km, the mean radius, up to
/// 0.6 % beside those on the ellipsoid. 90 bytes of device memory per seed; the host sorts the seeds. Of
/// measures there are cell_table(), in square kilometres, cell_statistics(), adjacency(), vertices(),
/// map_labels(), border_mask() and distance_field() of floats. Throws BadPoint for a latitude beyond a pole,
/// and Error for other grids and without doubles (cl_khr_fp64). docs/globe.md says how.
///
/// In a volume: of several seeds at the least distance the one that comes first by z, then y, then x. 4
/// bytes of device memory per voxel, the labels, and 36 per seed besides its place (with Shape::group 38, and
/// of points 1 per voxel of boxes of 16 x 16 x 8). Snapped seeds that stand close together, and those of
/// masks, cost what their voxels do: with Shape::group 6 more bytes per voxel. Throws Error for the Manhattan
/// metric. docs/volumes.md says how and how fast.
VOROCL_API Report exact_diagram(const Seeds& seeds, Diagram& diagram, const ExactOptions& options = {});

}  // namespace vorocl
