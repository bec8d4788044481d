// Random motion of seeds, the paper's model.
#pragma once

#include <cstdint>

#include "vorocl/export.h"
#include "vorocl/seeds.hpp"

namespace vorocl {

/// What happens to a seed that would leave the grid along an axis that is not periodic: along a periodic one
/// it always comes in on the other side.
enum class Border {
  reflect,   ///< it bounces off the grid's edge
  periodic,  ///< it comes in on the other side
};

/// Moves each seed by (dx, dy) pixels, each uniform in [-max_displacement, max_displacement], on the device.
/// The numbers come from Philox-4x32-10 keyed by the rng seed, the seed's id and the frame: the same on every
/// device. Enqueues and returns. Throws Error unless `max_displacement` is in [0, Window::max_side], the grid
/// is no larger than a diagram can be and all seeds lie in it.
VOROCL_API void random_step(Seeds& seeds, int max_displacement, Border border, std::uint64_t rng_seed,
                            std::uint32_t frame);

}  // namespace vorocl
