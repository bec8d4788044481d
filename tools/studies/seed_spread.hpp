// Seeds that are spread in other ways than evenly, which is what dJFA assumes.
#pragma once

#include <cstdint>

#include "vorocl/seeds.hpp"

namespace vorocl::command {

enum class Spread {
  uniform,   ///< as Seeds::random()
  clusters,  ///< normally distributed about 16 random centres, with a fiftieth of the sides as deviation
  gradient,  ///< the density grows in proportion to x
};

Seeds spread_seeds(const Device& device, const Grid& grid, std::size_t count, Spread spread,
                   std::uint64_t rng_seed);

}  // namespace vorocl::command
