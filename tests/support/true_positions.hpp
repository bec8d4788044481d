// Exact diagrams of points within their pixels by their definition: every pixel's distances to all seeds in
// 128-bit integers, on the host.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include "brute_force.hpp"

namespace vorocl {

__extension__ using Wide = __int128;

/// Whole numbers of 1/4096 pixel.
using Position = Pixel;
constexpr std::int64_t parts = 4096;

/// A point's position by its definition: the nearest one that lies in the point's pixel.
inline Position position_of(const Grid& grid, const Point& point) {
  const auto along = [](const Axis& axis, double at) {
    const double pixel = axis.pixel(at);
    double place = at;
    if (axis.is_periodic()) place = at - std::floor(at / axis.to()) * axis.to();
    const double fraction = std::min(std::max(std::nearbyint((place - pixel) * parts), 0.0), parts - 1.0);
    return static_cast<std::int64_t>(pixel) * parts + static_cast<std::int64_t>(fraction);
  };
  return {along(grid.x(), point.x), along(grid.y(), point.y)};
}

inline Wide wide_distance(const Grid& grid, const Position& seed, std::int64_t column, std::int64_t row,
                          Metric metric) {
  const auto along = [](const Axis& axis, std::int64_t way) {
    if (!axis.is_periodic()) return std::abs(way);
    const std::int64_t period = axis.pixels() * parts, rest = (way % period + period) % period;
    return std::min(rest, period - rest);
  };
  const Wide dx = along(grid.x(), column * parts + parts / 2 - seed.x);
  const Wide dy = along(grid.y(), row * parts + parts / 2 - seed.y);
  return metric == Metric::euclidean ? dx * dx + dy * dy : dx + dy;
}

/// Whether a window shows a pixel where the grid has it: one that is longer than a period has no labels
/// beside.
inline bool is_labelled(const Axis& axis, std::int64_t at, std::int64_t length) {
  return !axis.is_periodic() || length <= axis.pixels() || (at >= 0 && at < axis.pixels());
}

/// `lags`, which are added to distances: none, or by id.
inline Labels labels_by_definition(const Window& window, const std::vector<std::optional<Position>>& seeds,
                                   Metric metric, const std::vector<std::int64_t>& lags = {}) {
  const Grid& grid = window.grid();
  Labels labels;
  for (std::int64_t y = window.y(); y < window.y() + window.height(); ++y) {
    for (std::int64_t x = window.x(); x < window.x() + window.width(); ++x) {
      std::uint32_t best = no_label;
      Wide least = 0;
      const bool shown =
          is_labelled(grid.x(), x, window.width()) && is_labelled(grid.y(), y, window.height());
      for (std::uint32_t id = 0; shown && id < seeds.size(); ++id) {
        if (!seeds[id]) continue;
        const Wide distance = wide_distance(grid, *seeds[id], x, y, metric) + (lags.empty() ? 0 : lags[id]);
        if (best == no_label || distance < least || (distance == least && *seeds[id] < *seeds[best])) {
          best = id;
          least = distance;
        }
      }
      labels.push_back(best);
    }
  }
  return labels;
}

inline std::vector<std::optional<Position>> positions_of(const Grid& grid,
                                                         const std::vector<std::optional<Point>>& points) {
  std::vector<std::optional<Position>> positions;
  for (const auto& point : points) {
    positions.push_back(point ? std::optional<Position>(position_of(grid, *point)) : std::nullopt);
  }
  return positions;
}

}  // namespace vorocl
