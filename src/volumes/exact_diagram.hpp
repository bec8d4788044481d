// Exact diagrams of volumes: see kernels/volumes/exact.cl.
#pragma once

#include "core/diagram_state.hpp"

namespace vorocl {

/// Fills the diagram of a volume. Throws Error for the Manhattan metric, and on devices of the group shape.
Report exact_diagram_of_volume(Filling& filling, DiagramState& state);

}  // namespace vorocl
