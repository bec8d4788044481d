// Exact diagrams of planes by the places of the seeds.
#pragma once

#include "core/diagram_state.hpp"
#include "vorocl/report.hpp"

namespace vorocl {

/// Labels the diagram by lists of places (kernels/exact). On devices of the group shape seeds must be points.
Report exact_diagram_of_plane(Filling& filling, DiagramState& state);

}  // namespace vorocl
