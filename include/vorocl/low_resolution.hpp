// Low resolution with reconstruction: a diagram of coarse pixels, brought up to the grid's.
#pragma once

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

/// Fills the diagram from one of a quarter of the resolution: the paper's idea for motion of any kind. JFA
/// makes the diagram of coarse pixels, 4 x 4 each, which keep one of their seeds. Twice then pixels are
/// halved. A label stands for all seeds in its coarse pixel: of those that the pixel's four parts keep the
/// nearest one is taken, and Moore waves of steps 4, 2 and 1, at the last level 2 and 1, mend the rest.
/// Enqueues and returns.
///
/// Approximate: where seeds are spread evenly no more pixels are wrong than by JFA, in the mean. Where cells
/// are thin and long, as inside a ring of seeds, many more (docs/evaluation.md). The metric is Euclidean: by
/// the Manhattan one up to one pixel in some thousand was wrong, and JFA has hardly a wrong one. Cost: some
/// six passes over the pixels, whatever the size; 15 bytes of device memory per pixel, the labels included.
/// The report counts no waves. Throws as jump_flooding().
VOROCL_API Report low_resolution(const Seeds& seeds, Diagram& diagram);

}  // namespace vorocl
