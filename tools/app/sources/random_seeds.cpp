#include "app/sources/random_seeds.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace vorocl::command {

namespace {

std::uint32_t low(std::uint64_t product) { return static_cast<std::uint32_t>(product); }
std::uint32_t high(std::uint64_t product) { return static_cast<std::uint32_t>(product >> 32); }

/// Philox-4x32-10 of a counter whose other words are 0, as in kernels/core/philox.cl.
std::array<std::uint32_t, 4> philox(std::uint32_t counter, std::uint64_t key) {
  std::array<std::uint32_t, 4> words = {counter, 0, 0, 0};
  std::uint32_t key_0 = low(key), key_1 = high(key);
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t product_0 = std::uint64_t{words[0]} * 0xd2511f53u;
    const std::uint64_t product_1 = std::uint64_t{words[2]} * 0xcd9e8d57u;
    words = {high(product_1) ^ words[1] ^ key_0, low(product_1), high(product_0) ^ words[3] ^ key_1,
             low(product_0)};
    key_0 += 0x9e3779b9u;
    key_1 += 0xbb67ae85u;
  }
  return words;
}

double centre_below(std::uint32_t bits, std::int64_t count) {
  return high(std::uint64_t{bits} * static_cast<std::uint64_t>(count)) + 0.5;
}

}  // namespace

Point random_pixel(const Grid& grid, std::uint32_t id, std::uint64_t rng_seed) {
  const std::array<std::uint32_t, 4> bits = philox(id, rng_seed);
  return {centre_below(bits[0], grid.width()), centre_below(bits[1], grid.height())};
}

std::vector<Point> random_points(const Grid& grid, const std::vector<float>& density, std::size_t count,
                                 std::uint64_t rng_seed) {
  std::vector<double> sums;  // up to and with each pixel
  sums.reserve(density.size());
  double sum = 0;
  for (const double of_pixel : density) sums.push_back(sum += std::sqrt(of_pixel));
  std::vector<Point> points;
  points.reserve(count);
  for (std::size_t id = 0; id < count; ++id) {
    const std::array<std::uint32_t, 4> bits = philox(static_cast<std::uint32_t>(id), rng_seed);
    // Below the sum of all, also when it is rounded.
    const double at =
        std::ldexp(static_cast<double>((std::uint64_t{bits[0]} << 32 | bits[1]) >> 11), -53) * sum;
    const std::int64_t pixel = std::upper_bound(sums.begin(), sums.end(), at) - sums.begin();
    const std::int64_t x = pixel % grid.width(), y = pixel / grid.width();
    points.push_back({static_cast<double>(x) + std::ldexp(bits[2], -32),
                      static_cast<double>(y) + std::ldexp(bits[3], -32)});
  }
  return points;
}

}  // namespace vorocl::command
