// Random pixels of a plane that no device has to hold.
#pragma once

#include <cstdint>

#include "vorocl/grid.hpp"

namespace vorocl::command {

/// The pixel of the seed with this id: on a grid the same as Seeds::random() gives it.
Point random_pixel(const Plane& plane, std::uint32_t id, std::uint64_t rng_seed);

}  // namespace vorocl::command
