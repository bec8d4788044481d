// The lengths of a pixel as whole numbers: what distances are compared in.
#pragma once

#include <array>
#include <cstdint>

#include "vorocl/distance_transform.hpp"

namespace vorocl {

struct WholeSizes {
  std::array<std::int64_t, 3> squares = {1, 1, 1};  // of the lengths along x, y and z, in units
  double unit = 1;                                  // the square of a distance is a number of these

  /// The greatest whole number of units whose root, in the unit of the lengths, is at most `distance`.
  std::int64_t most_within(double distance) const;
};

/// See PixelSize. Throws Error unless the lengths are positive and finite and at most 1,000 times each other.
/// `sides` are those of the image in pixels.
WholeSizes whole_sizes(const PixelSize& size, const std::array<int, 3>& sides);

}  // namespace vorocl
