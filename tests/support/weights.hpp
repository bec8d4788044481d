// Weights of seeds, for which exact cells are held against rational numbers and labels against whole ones.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
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

/// Weights in pixels squared that are hard for labels, where a cell has about so many pixels along an axis.
inline std::vector<double> hard_weights(std::size_t count, double side, std::mt19937_64& rng) {
  const std::uint64_t kind = rng() % 7;
  std::vector<double> weights(count);
  for (double& weight : weights) {
    const double part = static_cast<double>(rng() >> 11) * 0x1p-53;
    weight = kind == 0   ? side * side * part                            // polydisperse
             : kind == 1 ? std::floor(4 * part) / 2048                   // of a few least steps, and ties
             : kind == 2 ? std::floor(4 * part)                          // of whole pixels, and ties
             : kind == 3 ? std::pow(side * std::floor(3 * part) / 2, 2)  // two or three sizes
             : kind == 4 ? (part < 0.02 ? 40000 * part : 0)              // few that swallow most
             : kind == 5 ? 1e6 * part * part                             // hardly any has pixels
                         : -part * side * side - 1e5;
  }
  return weights;
}

/// Lags by their definition: how far weights of pixels squared are below the greatest, in 1/4096 pixel
/// squared.
template <typename Points>
std::vector<std::int64_t> lags_by_definition(const std::vector<double>& weights, const Points& is_there) {
  double greatest = 0;
  bool is_first = true;
  for (std::size_t id = 0; id < weights.size(); ++id) {
    if (!is_there(id)) continue;
    greatest = is_first ? weights[id] : std::fmax(greatest, weights[id]);
    is_first = false;
  }
  std::vector<std::int64_t> lags;
  for (const double weight : weights)
    lags.push_back(static_cast<std::int64_t>(std::nearbyint((greatest - weight) * 2048)) * 8192);
  return lags;
}

}  // namespace vorocl
