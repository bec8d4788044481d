// The pass after the exact engine where seeds lie outside its pixels (kernels/exact/outer.cl).
#pragma once

#include "core/diagram_state.hpp"

namespace vorocl {

/// Corrects labels that were made of the seeds inside the pixels by those outside. Returns the last command:
/// `last`, that of the engine, if there are none.
cl::Event add_outer_seeds(const Filling& filling, DiagramState& state, const cl::Event& last);

}  // namespace vorocl
