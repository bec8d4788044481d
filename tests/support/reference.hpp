// The exact diagram by trying every pixel against every seed on the device: what tests hold the engines
// against.
#pragma once

#include <cstdint>
#include <vector>

#include "vorocl/seeds.hpp"

namespace vorocl {

/// The labels that exact_diagram() makes, in pixels times seeds steps. All seeds lie in the grid. Waits.
std::vector<std::uint32_t> reference_labels(const Seeds& seeds, Metric metric);

}  // namespace vorocl
