// Similarity of two diagrams, the paper's measure: 100 x matching pixels / all pixels.
#pragma once

#include <cstdint>
#include <vector>

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"

namespace vorocl {

/// The share of pixels with equal labels in percent, of two label images of one size. Throws Error if the
/// sizes differ or are 0.
VOROCL_API double similarity(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b);

/// As above, counted on the device: one pass over the two label images. Waits. Throws Error if the diagrams
/// have different grids or devices.
VOROCL_API double similarity(const Diagram& a, const Diagram& b);

}  // namespace vorocl
