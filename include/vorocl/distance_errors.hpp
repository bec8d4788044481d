// Errors of a diagram against the exact one: which labels are wrong, and by how many pixels.
#pragma once

#include <cstddef>

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"
#include "vorocl/own_state.hpp"
#include "vorocl/report.hpp"

namespace vorocl {

struct DistanceErrorsState;

/// What distance_errors() finds. A pixel's excess distance is how much farther the seed of its label is than
/// its nearest seed: 0 where the label is right. It is in pixels, or in units of the spacing in a grid with
/// an axis that is spaced (Axis::spaced()).
struct DistanceErrors {
  std::size_t pixels = 0;             ///< of the diagram
  std::size_t wrong_pixels = 0;       ///< whose label is not that of a seed at the least distance
  std::size_t unlabelled_pixels = 0;  ///< of these: whose label names no seed; they have no excess distance
  double largest_excess = 0;          ///< of all pixels
  double mean_excess = 0;  ///< over all pixels, the right ones too; each counts to 1/32768 of the unit

  double wrong_percent() const {
    return 100.0 * static_cast<double>(wrong_pixels) / static_cast<double>(pixels);
  }
};

/// What distance_errors() found, on the device.
///
/// Threads, lifetime, ordering: as SimilarityResult.
class VOROCL_API DistanceErrorsResult {
 public:
  /// Nothing but zeros while the result is empty. Waits. Throws BadPoint if the seeds had one.
  DistanceErrors read() const;

 private:
  friend struct Internal;
  OwnState<DistanceErrorsState> state_;
};

/// Judges a diagram by the exact one of the same seeds and metric (see exact_diagram()). A pixel that is as
/// near to the seed of its label as to that of the exact one is right: a tie may be given to any seed.
///
/// The counts are exact, the excess distances within 1e-4 of their value. Cost: one pass over the two label
/// images, with a look-up of the seeds where they differ. Enqueues and returns. Throws Error if the diagrams
/// do not fit together, are not of one frame of seeds and one metric, or their seeds have weights.
VOROCL_API Report distance_errors(const Diagram& diagram, const Diagram& exact, DistanceErrorsResult& result);

}  // namespace vorocl
