// The exact diagram in the group shape, for GPUs: a work-group labels a square of pixels together
// (kernels/exact/group/).
#pragma once

#include "vorocl/exact_diagram.hpp"

namespace vorocl {

/// Whether the shape can do it: its periods are limited.
bool fits_in_groups(const Grid& grid);

/// As exact_diagram(), whatever the shape of the device's tuning.
Report exact_diagram_in_groups(const Seeds& seeds, Diagram& diagram, const ExactOptions& options);

}  // namespace vorocl
