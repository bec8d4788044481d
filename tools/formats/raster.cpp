#include "formats/raster.hpp"

#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

int checked_side(std::int64_t side, const char* name) {
  if (side >= 1 && side <= Size::max_side) return static_cast<int>(side);
  throw Error("the grid's " + std::string(name) + " is " + std::to_string(side) + "; it must be from 1 to " +
              std::to_string(Size::max_side) + " pixels");
}

}  // namespace

Size::Size(std::int64_t width, std::int64_t height)
    : width_(checked_side(width, "width")), height_(checked_side(height, "height")) {
  if (pixels() > Window::max_pixels) {
    throw Error("a grid of " + std::to_string(width) + " x " + std::to_string(height) +
                " has too many pixels; at most 2^30 (such as 32768 x 32768) are possible");
  }
}

std::string sides_of(const Grid& grid) {
  const std::string slice = std::to_string(grid.width()) + " x " + std::to_string(grid.height());
  return grid.is_volume() ? slice + " x " + std::to_string(grid.depth()) : slice;
}

std::optional<Georeference> georeference_of(const std::optional<GeoTags>& mask, std::int64_t x,
                                            std::int64_t y) {
  if (!mask) return std::nullopt;
  Georeference result;
  GeoTags& tags = result.tags.emplace(*mask);
  const double offset[] = {static_cast<double>(x), static_cast<double>(y)};
  for (std::size_t i = 0; i < tags.tie_points.size(); ++i)
    if (i % 6 < 2) tags.tie_points[i] -= offset[i % 6];
  for (std::size_t row = 0; row + 4 <= tags.transformation.size(); row += 4)
    for (const std::size_t axis : {0, 1})
      tags.transformation[row + 3] += offset[axis] * tags.transformation[row + axis];
  return result;
}

}  // namespace vorocl::command
