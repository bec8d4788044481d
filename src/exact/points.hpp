// Exact diagrams of points at positions within their pixels.
#pragma once

#include "core/diagram_state.hpp"
#include "vorocl/report.hpp"

namespace vorocl {

/// Labels the diagram by the seeds' places, which are those of points (kernels/exact/points).
Report exact_diagram_of_points(Filling& filling, DiagramState& state);

}  // namespace vorocl
