// Standard flooding (StF): waves of step 1 until nothing changes.
#pragma once

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

struct StandardFloodingOptions {
  Metric metric = Metric::euclidean;
  Neighbourhood neighbourhood = Neighbourhood::moore;
};

/// Fills the diagram by standard flooding, the paper's Section III. The only engine that waits: it reads
/// every few waves whether one of them changed a label. The report's waves are those that changed the
/// diagram.
///
/// Approximate, but wrong only where a region is thinner than a pixel. Cost: as many waves as the largest
/// Chebyshev distance of a pixel to its seed (up to N); 13 bytes of device memory per pixel. Throws as
/// jump_flooding().
VOROCL_API Report standard_flooding(const Seeds& seeds, Diagram& diagram,
                                    const StandardFloodingOptions& options = {});

}  // namespace vorocl
