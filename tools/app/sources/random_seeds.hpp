// Random seeds: the pixels of a plane that no device has to hold, and points that are drawn by a density.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vorocl/grid.hpp"

namespace vorocl::command {

/// The pixel of the seed with this id: on a grid the same as Seeds::random() gives it.
Point random_pixel(const Grid& grid, std::uint32_t id, std::uint64_t rng_seed);

/// Points as dense as the square root of a density, as which Lloyd relaxation spreads them
/// (docs/relaxation.md), anywhere in their pixels, of which each has a density of at least 0, and some have
/// more.
std::vector<Point> random_points(const Grid& grid, const std::vector<float>& density, std::size_t count,
                                 std::uint64_t rng_seed);

}  // namespace vorocl::command
