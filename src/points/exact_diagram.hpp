// Exact diagrams of volumes: see kernels/points/diagram.cl.
#pragma once

#include "core/diagram_state.hpp"

namespace vorocl {

/// Throws Error for the Manhattan metric, and on devices of the group shape.
void check_exact_volume(const Filling& filling, const DiagramState& state);

/// Fills the diagram of a volume that was checked.
Report exact_diagram_of_volume(Filling& filling, DiagramState& state);

}  // namespace vorocl
