// Exact diagrams: every pixel gets its nearest seed.
#pragma once

#include "vorocl/diagram.hpp"
#include "vorocl/export.hpp"
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
/// where no two seeds share a pixel, for every order of the seeds. Where seeds are sparse, candidates of a
/// tile are searched from coarse cells to fine ones and dropped when another seed beats them at all four
/// corners of the tile; where they are dense, the nearest seed of each row and then the best row is taken (as
/// in separable distance transforms). Cost: in proportion to the pixels, whatever the seeds' distribution,
/// except for the few tiles that see very many seeds at almost one distance (the middle of a ring). 9.2 bytes
/// of device memory a pixel, the labels included, and 4 a seed. Throws Error if seeds and diagram do not fit
/// together or the device has too little memory.
VOROCL_API Report exact_diagram(const Seeds& seeds, Diagram& diagram, const ExactOptions& options = {});

}  // namespace vorocl
