// Labels and distances where seeds lie outside the grid and the plane may repeat: every pixel against every
// seed and its images, in 64-bit integers, on the host.
#pragma once

#include <cstdint>
#include <random>
#include <tuple>
#include <vector>

#include "transformed.hpp"
#include "vorocl/grid.hpp"

namespace vorocl {

/// A pixel of the plane, from the grid's first one.
struct PlanePixel {
  std::int64_t x, y;
};

inline std::vector<Point> centres(const std::vector<PlanePixel>& pixels) {
  return transformed(pixels, [](const PlanePixel& pixel) {
    return Point{static_cast<double>(pixel.x) + 0.5, static_cast<double>(pixel.y) + 0.5};
  });
}

inline std::int64_t brought_into(std::int64_t at, std::int64_t first, std::int64_t period) {
  while (at < first) at += period;
  while (at >= first + period) at -= period;
  return at;
}

inline PlanePixel brought_into(const Domain& domain, PlanePixel pixel) {
  if (has_x(domain.periodic)) pixel.x = brought_into(pixel.x, domain.x, domain.width);
  if (has_y(domain.periodic)) pixel.y = brought_into(pixel.y, domain.y, domain.height);
  return pixel;
}

/// The distance along an axis between a pixel of the domain and the nearest image of a seed.
inline std::int64_t distance_along(std::int64_t from, std::int64_t to, bool periodic, std::int64_t period) {
  std::int64_t least = std::abs(from - to);
  if (periodic) {
    for (std::int64_t k = -2; k <= 2; ++k) least = std::min(least, std::abs(from - to + k * period));
  }
  return least;
}

inline std::int64_t distance(const Domain& domain, const PlanePixel& a, const PlanePixel& b, Metric metric) {
  const std::int64_t dx = distance_along(a.x, b.x, has_x(domain.periodic), domain.width);
  const std::int64_t dy = distance_along(a.y, b.y, has_y(domain.periodic), domain.height);
  return metric == Metric::euclidean ? dx * dx + dy * dy : dx + dy;
}

/// Whether a pixel of the grid gets a label.
inline bool in_domain(const Domain& domain, const PlanePixel& pixel) {
  return (!has_x(domain.periodic) || (pixel.x >= domain.x && pixel.x < domain.x + domain.width)) &&
         (!has_y(domain.periodic) || (pixel.y >= domain.y && pixel.y < domain.y + domain.height));
}

inline std::vector<std::uint32_t> brute_force(const Grid& grid, const Domain& domain,
                                              std::vector<PlanePixel> seeds, Metric metric) {
  for (PlanePixel& seed : seeds) seed = brought_into(domain, seed);
  std::vector<std::uint32_t> labels;
  for (std::int64_t y = 0; y < grid.height(); ++y) {
    for (std::int64_t x = 0; x < grid.width(); ++x) {
      std::uint32_t best = no_label;
      std::tuple<std::int64_t, std::int64_t, std::int64_t> least;
      for (std::uint32_t id = 0; in_domain(domain, {x, y}) && id < seeds.size(); ++id) {
        const std::tuple rank(distance(domain, {x, y}, seeds[id], metric), seeds[id].y, seeds[id].x);
        if (best == no_label || rank < least) {
          best = id;
          least = rank;
        }
      }
      labels.push_back(best);
    }
  }
  return labels;
}

/// Random pixels of a rectangle of the plane.
inline std::vector<PlanePixel> random_plane_pixels(std::int64_t left, std::int64_t top, std::int64_t right,
                                                   std::int64_t bottom, std::size_t count,
                                                   std::mt19937_64& rng) {
  std::uniform_int_distribution<std::int64_t> x(left, right), y(top, bottom);
  std::vector<PlanePixel> pixels;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t column = x(rng);
    pixels.push_back({column, y(rng)});
  }
  return pixels;
}

}  // namespace vorocl
