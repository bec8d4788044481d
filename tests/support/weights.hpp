// Weights of seeds, for which exact cells are held against rational numbers.
#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace vorocl {

/// Weights of all sizes beside so many squared steps, for which cells are empty or far from their points,
/// too.
inline std::vector<double> weights_of(std::size_t count, double unit) {
  std::mt19937_64 random(21);
  std::vector<double> weights;
  for (std::size_t i = 0; i < count; ++i)
    weights.push_back(std::nearbyint(
        unit * std::ldexp(static_cast<double>(random() % 4096), -static_cast<int>(i % 5) - 11)));
  return weights;
}

}  // namespace vorocl
