// Jump flooding (JFA): an approximate diagram in about log2(N) waves.
#pragma once

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"
#include "vorocl/plan.hpp"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

struct JumpFloodingOptions {
  Metric metric = Metric::euclidean;
  Neighbourhood neighbourhood = Neighbourhood::moore;
  JumpFloodingVariant variant = JumpFloodingVariant::jfa;
};

/// Fills the diagram by jump flooding (Rong & Tan 2006; the paper's Eq. 2). Enqueues and returns.
///
/// Approximate: with Moore waves every pixel gets a seed, nearly always its nearest; von Neumann waves alone
/// give wrong regions (the paper's Fig. 5) and may leave pixels without a label. Cost: log2(N) waves,
/// whatever the number of seeds; 13 bytes of device memory per pixel, the labels included, 12 per voxel of a
/// volume. Throws Error if
/// seeds and diagram do not fit together, the diagram's window is a part of its grid or seeds lie outside it
/// (exact diagrams take both) or the device has too little memory.
VOROCL_API Report jump_flooding(const Seeds& seeds, Diagram& diagram,
                                const JumpFloodingOptions& options = {});

/// Runs any plan of waves from the seeds, as jump_flooding() does. Throws Error unless steps are from 1 to
/// 32,768.
VOROCL_API Report flood(const Seeds& seeds, Diagram& diagram, const Plan& plan, Metric metric);

}  // namespace vorocl
