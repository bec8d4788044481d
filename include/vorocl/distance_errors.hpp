// Errors of a diagram against the exact one: which labels are wrong, and by how many pixels.
#pragma once

#include <cstddef>

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"
#include "vorocl/seeds.hpp"

namespace vorocl {

/// What distance_errors() finds. A pixel's excess distance is how much farther the seed of its label is than
/// its nearest seed, in pixels: 0 where the label is right.
struct DistanceErrors {
  std::size_t pixels = 0;             ///< of the diagram
  std::size_t wrong_pixels = 0;       ///< whose label is not that of a seed at the least distance
  std::size_t unlabelled_pixels = 0;  ///< of these: whose label names no seed; they have no excess distance
  double largest_excess = 0;          ///< of all pixels
  double mean_excess = 0;             ///< over all pixels, the right ones too

  double wrong_percent() const {
    return 100.0 * static_cast<double>(wrong_pixels) / static_cast<double>(pixels);
  }
};

/// Judges a diagram of the seeds by their exact diagram (see exact_diagram()) in the same metric. A pixel
/// that is as near to the seed of its label as to that of the exact one is right: a tie may be given to any
/// seed.
///
/// The counts are exact, the excess distances within 1e-4 of their value. Cost: one pass over the two label
/// images, with a look-up of the seeds where they differ. Waits. Throws Error if seeds and diagrams do not
/// fit together or the seeds had a bad point.
VOROCL_API DistanceErrors distance_errors(const Seeds& seeds, const Diagram& diagram, const Diagram& exact,
                                          Metric metric = Metric::euclidean);

}  // namespace vorocl
