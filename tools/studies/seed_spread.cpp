#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "studies/ablation.hpp"

namespace vorocl::command {

namespace {

/// Uniform in [0, 1), the same on every platform.
class Uniform {
 public:
  explicit Uniform(std::uint64_t rng_seed) : bits_(rng_seed) {}
  double operator()() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 bits_;
};

/// A point of the unit square, to the point of the grid that it stands for; one beyond the border is moved to
/// it.
Point on(const Grid& grid, double x, double y) {
  const auto along = [](double fraction, std::int64_t pixels) {
    const auto side = static_cast<double>(pixels);
    return std::clamp(fraction * side, 0.0, std::nextafter(side, 0.0));
  };
  return {along(x, grid.width()), along(y, grid.height())};
}

std::vector<Point> clusters(const Grid& grid, std::size_t count, Uniform& uniform) {
  constexpr std::size_t centre_count = 16;
  constexpr double deviation = 1.0 / 50, full_turn = 2 * 3.14159265358979323846;
  std::vector<Point> centres(centre_count), points;
  for (Point& centre : centres) centre = {uniform(), uniform()};
  for (std::size_t i = 0; i < count; ++i) {
    const Point& centre = centres[i % centre_count];
    const double radius = deviation * std::sqrt(-2 * std::log(1 - uniform())), angle = full_turn * uniform();
    points.push_back(on(grid, centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)));
  }
  return points;
}

std::vector<Point> gradient(const Grid& grid, std::size_t count, Uniform& uniform) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = std::sqrt(uniform());
    points.push_back(on(grid, x, uniform()));
  }
  return points;
}

}  // namespace

Seeds spread_seeds(const Device& device, const Grid& grid, std::size_t count, Spread spread,
                   std::uint64_t rng_seed) {
  if (spread == Spread::uniform) return Seeds::random(device, grid, count, rng_seed);
  Uniform uniform(rng_seed);
  return {device,
          grid,
          spread == Spread::clusters ? clusters(grid, count, uniform) : gradient(grid, count, uniform),
          {Outside::count, Snap::to_pixels}};
}

}  // namespace vorocl::command
