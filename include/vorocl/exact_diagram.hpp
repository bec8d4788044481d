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
/// in proportion to the pixels, whatever the distribution of the seeds, within a factor of a few
/// (docs/performance.md). 4 bytes of device memory per pixel, the labels, and 12 per seed besides its
/// position, and up to 10 of an index; where seeds are dense 2.2 more per pixel in their place. Throws Error
/// if seeds and diagram do not fit together or the device has too little memory.
///
/// Of seeds with Snap::none the points themselves are taken: the nearest is that of the least (distance from
/// the pixel's centre, y, x, id), in whole numbers of 1/4096 pixel: 8 more bytes of device memory per seed.
/// Throws Error too if a seed that may own a pixel is more than 262,144 pixels from the window's first one.
/// What follows about windows costs a place in the list for each seed and image that may own a pixel.
///
/// Any window of any grid: seeds outside it, and images across its periods, are taken into account, in 64-bit
/// integers where they need be. Where the window is not one whole period of at most 32,000 pixels, or seeds
/// lie outside it, they cost 0.5 bytes per pixel and a search near the window's rim, farther in where seeds
/// are few. With Shape::group, as on a GPU, that holds of periods of more than 16,000 pixels.
///
/// In a tilted grid (Grid::tilted()) all seeds are taken as points, snapped ones at the centres of their
/// pixels, and the host places their images whenever they have moved. In a flat box it looks at more of them:
/// as many as rows of images may reach the window. Throws Error if such a grid has a side of more than
/// 131,072 pixels.
///
/// In a volume: of several seeds at the least distance the one that comes first by z, then y, then x. 4
/// bytes of device memory per voxel, the labels, and 34 per seed besides its place. Snapped seeds that stand
/// close together, and those of masks, cost what their voxels do. Throws Error for the Manhattan metric, and
/// with Shape::group, as on a GPU. docs/volumes.md says how and how fast.
VOROCL_API Report exact_diagram(const Seeds& seeds, Diagram& diagram, const ExactOptions& options = {});

}  // namespace vorocl
