// The cells of diagrams of great circles, which the host measures: rows have pixels of unequal areas.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "globe/globe.hpp"

namespace vorocl {

namespace {

constexpr double radians = 3.14159265358979323846 / 180;

/// What is summed over the pixels of a cell: their areas on a sphere of radius 1, and as much of the way to
/// each.
struct GlobeSum {
  std::uint32_t pixels = 0;
  double area = 0, x = 0, y = 0, z = 0;
  float farthest = 0;
  bool touches_border = false;
};

double length_of_pixel(const Axis& axis) {
  return (axis.to() - axis.from()) / static_cast<double>(axis.pixels());
}

std::vector<GlobeSum> sums_of(const MeasuredDiagram& of, const std::vector<std::uint32_t>& labels,
                              const std::vector<float>& distances) {
  const Window& window = of.window;
  const Axis &east = window.grid().x(), &north = window.grid().y();
  const auto width = static_cast<std::size_t>(window.width()),
             height = static_cast<std::size_t>(window.height());
  const auto latitude = [&](double row) {
    return north.coordinate(static_cast<double>(window.y()) + row) * radians;
  };
  std::vector<double> cosines(width + 1), sines(width + 1);  // sums of the columns before
  for (std::size_t x = 0; x < width; ++x) {
    const double longitude =
        east.coordinate(static_cast<double>(window.x()) + static_cast<double>(x) + 0.5) * radians;
    cosines[x + 1] = cosines[x] + std::cos(longitude);
    sines[x + 1] = sines[x] + std::sin(longitude);
  }
  const bool ends = !of.grid.periodic_x();
  const auto is_border = [&](double row) { return std::abs(latitude(row)) < 89.999999999 * radians; };
  const bool begins_apart = is_border(0), ends_apart = is_border(static_cast<double>(height));
  std::vector<GlobeSum> sums(of.count());
  for (std::size_t y = 0; y < height; ++y) {
    const auto row = static_cast<double>(y);
    const double middle = latitude(row + 0.5);
    const double area =
        length_of_pixel(east) * radians * std::abs(std::sin(latitude(row + 1)) - std::sin(latitude(row)));
    const bool is_end = (y == 0 && begins_apart) || (y + 1 == height && ends_apart);
    for (std::size_t x = 0, next; x < width; x = next) {
      const std::uint32_t label = labels[y * width + x];
      for (next = x + 1; next < width && labels[y * width + next] == label;) ++next;
      if (label >= sums.size()) continue;
      GlobeSum& sum = sums[label];
      const auto pixels = static_cast<double>(next - x);
      sum.pixels += static_cast<std::uint32_t>(next - x);
      sum.area += area * pixels;
      sum.x += area * std::cos(middle) * (cosines[next] - cosines[x]);
      sum.y += area * std::cos(middle) * (sines[next] - sines[x]);
      sum.z += area * std::sin(middle) * pixels;
      const auto at = distances.begin() + static_cast<std::ptrdiff_t>(y * width);
      sum.farthest = std::max(sum.farthest, *std::max_element(at + static_cast<std::ptrdiff_t>(x),
                                                              at + static_cast<std::ptrdiff_t>(next)));
      sum.touches_border = sum.touches_border || is_end || (ends && (x == 0 || next == width));
    }
  }
  return sums;
}

/// In degrees, of longitudes from this one on.
Point centroid_of(const GlobeSum& sum, double west) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (sum.pixels == 0) return {none, none, none};
  const double longitude = std::atan2(sum.y, sum.x) / radians;
  return {longitude - 360 * std::floor((longitude - west) / 360),
          std::atan2(sum.z, std::hypot(sum.x, sum.y)) / radians, 0};
}

}  // namespace

std::vector<CellRow> cells_on_globe(const MeasuredDiagram& of, const std::vector<std::uint32_t>& labels,
                                    const std::vector<float>& distances,
                                    const std::vector<std::uint32_t>& neighbours) {
  const std::vector<GlobeSum> sums = sums_of(of, labels, distances);
  const std::vector<std::optional<Point>> points = points_on_globe(*of.seeds);
  std::vector<CellRow> rows;
  for (std::uint32_t id = 0; id < points.size(); ++id) {
    if (!points[id]) continue;
    const GlobeSum& sum = sums[id];
    rows.push_back({id, *points[id], sum.pixels, sum.area * earth_radius * earth_radius,
                    centroid_of(sum, of.window.grid().x().from()), sum.touches_border, neighbours[id],
                    sum.pixels > 0 ? sum.farthest : std::numeric_limits<double>::quiet_NaN()});
  }
  return rows;
}

}  // namespace vorocl
