// Similarity of two diagrams, the paper's measure: 100 x matching pixels / all pixels.
#pragma once

#include <cstdint>
#include <vector>

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"
#include "vorocl/seeds.hpp"

namespace vorocl {

/// The share of pixels with equal labels in percent, of two label images of one size. Throws Error if the
/// sizes differ or are 0.
VOROCL_API double similarity(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b);

/// As above, counted on the device: one pass over the two label images. Waits. Throws Error if the diagrams
/// have different grids or devices.
VOROCL_API double similarity(const Diagram& a, const Diagram& b);

/// The share of pixels, in percent, whose labels name seeds that are equally far from them in the metric,
/// within a tolerance in pixels; labels that name no seed are equal to each other alone. With 1e-4 times the
/// grid's side it is the similarity of the program by the paper's authors. One pass over the two label
/// images, with a look-up of the seeds where they differ. Waits. Throws Error if the diagrams do not fit
/// together or with the seeds, the tolerance is negative or not finite, or the seeds had a bad point.
VOROCL_API double similarity(const Seeds& seeds, const Diagram& a, const Diagram& b, double tolerance,
                             Metric metric = Metric::euclidean);

}  // namespace vorocl
