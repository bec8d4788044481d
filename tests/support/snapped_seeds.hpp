// Options of seeds that tests share.
#pragma once

#include "vorocl/seeds.hpp"

namespace vorocl {

/// What is no default: seeds at the centres of their pixels.
constexpr SeedsOptions to_centres = {Outside::count, Snap::to_pixels};

/// What lets points in floats of a buffer stay on the device.
constexpr SeedsOptions kept_on_device = {Outside::refuse, Snap::to_pixels};

}  // namespace vorocl
