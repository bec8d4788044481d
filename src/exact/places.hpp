// Exact diagrams by the places of the seeds.
#pragma once

#include "core/diagram_state.hpp"
#include "vorocl/report.hpp"

namespace vorocl {

/// Labels the diagram by lists of places (kernels/exact).
Report exact_diagram_by_places(Filling& filling, DiagramState& state);

}  // namespace vorocl
