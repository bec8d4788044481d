// Exact diagrams by the places of the seeds.
#pragma once

#include "core/diagram_state.hpp"
#include "vorocl/report.hpp"

namespace vorocl {

/// Throws Error on devices of the group shape.
void check_exact_volume(const DiagramState& state);

/// Labels the diagram by lists of places (kernels/exact). That of a volume was checked.
Report exact_diagram_by_places(Filling& filling, DiagramState& state);

}  // namespace vorocl
