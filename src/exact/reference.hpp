// The exact diagram by trying every pixel against every seed on the device: what tests hold the engines
// against.
#pragma once

#include "vorocl/exact_diagram.hpp"

namespace vorocl {

/// As exact_diagram(), in pixels times seeds steps.
Report reference_diagram(const Seeds& seeds, Diagram& diagram, Metric metric);

}  // namespace vorocl
