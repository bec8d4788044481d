// Jump flooding in volumes: see kernels/volumes/jump_flooding.cl.
#pragma once

#include "core/diagram_state.hpp"
#include "vorocl/plan.hpp"

namespace vorocl {

/// Runs the waves of a plan from the seeds, and fills the diagram of a volume. 12 bytes of device memory per
/// voxel, the labels included.
Report flood_volume(Filling& filling, DiagramState& state, const Plan& plan);

}  // namespace vorocl
