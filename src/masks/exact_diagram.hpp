// Exact diagrams by the mask engine, whose cost depends on the pixels and not on the seeds.
#pragma once

#include "core/diagram_state.hpp"

namespace vorocl {

/// Whether this engine is the one for the seeds: they were made from a mask, or are crowded.
bool labels_by_passes(const Filling& filling, const DiagramState& state);

/// Fills a diagram of such seeds.
Report exact_diagram_by_passes(Filling& filling, DiagramState& state);

}  // namespace vorocl
