// The exact diagram in the group shape, for GPUs: a work-group labels a square of pixels together
// (kernels/exact/group/).
#pragma once

#include "core/diagram_state.hpp"

namespace vorocl {

/// Whether the device has this shape, and the index room for the seeds and their images.
bool labels_in_groups(const Filling& filling, const DiagramState& state);

/// Fills a diagram as exact_diagram(), whatever the shape of the device's tuning.
Report exact_diagram_in_groups(Filling& filling, DiagramState& state);

}  // namespace vorocl
