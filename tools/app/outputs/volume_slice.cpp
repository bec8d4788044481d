#include "app/outputs/volume_slice.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace vorocl::command {

namespace {

/// The plane of a slice: x and y of a slice across z, x and z across y, y and z across x.
struct Plane {
  Size size;
  std::size_t first, along_row, along_column;  // of its pixels in the volume
  bool is_periodic_x, is_periodic_y;

  Grid grid() const { return size.grid(axes_of(is_periodic_x, is_periodic_y)); }
};

Plane plane_of(const Grid& grid, const VolumeSlice& slice) {
  const auto width = static_cast<std::size_t>(grid.width()), at = static_cast<std::size_t>(slice.at);
  const std::size_t area = width * static_cast<std::size_t>(grid.height());
  const bool x = grid.x().is_periodic(), y = grid.y().is_periodic(), z = grid.z().is_periodic();
  if (slice.axis == 'x') return {{grid.height(), grid.depth()}, at, width, area, y, z};
  if (slice.axis == 'y') return {{grid.width(), grid.depth()}, at * width, 1, area, x, z};
  return {{grid.width(), grid.height()}, at * area, 1, width, x, y};
}

std::vector<std::uint32_t> labels_in(const Plane& plane, const std::vector<std::uint32_t>& labels) {
  const auto columns = static_cast<std::size_t>(plane.size.width()),
             rows = static_cast<std::size_t>(plane.size.height());
  std::vector<std::uint32_t> of_slice;
  of_slice.reserve(columns * rows);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      of_slice.push_back(labels[plane.first + row * plane.along_column + column * plane.along_row]);
    }
  }
  return of_slice;
}

/// The seeds in the slice; the others are absent.
std::vector<std::optional<Point>> seeds_in(const VolumeSlice& slice,
                                           const std::vector<std::optional<Point>>& voxels) {
  std::vector<std::optional<Point>> points;
  for (const std::optional<Point>& voxel : voxels) {
    std::optional<Point>& point = points.emplace_back();
    if (!voxel) continue;
    const double across = slice.axis == 'x' ? voxel->x : slice.axis == 'y' ? voxel->y : voxel->z;
    if (static_cast<std::int64_t>(across) != slice.at) continue;
    point = slice.axis == 'x'   ? Point{voxel->y, voxel->z}
            : slice.axis == 'y' ? Point{voxel->x, voxel->z}
                                : Point{voxel->x, voxel->y};
  }
  return points;
}

}  // namespace

std::int64_t slices_along(const Grid& grid, char axis) {
  return axis == 'x' ? grid.width() : axis == 'y' ? grid.height() : grid.depth();
}

Size size_of_slice(const Grid& grid, const VolumeSlice& slice) { return plane_of(grid, slice).size; }

Measures in_slice(Measures& volume, const VolumeSlice& slice, bool with_seeds, MeasureBuffers& buffers) {
  const Plane plane = plane_of(volume.view().window.grid(), slice);
  std::vector<std::optional<Point>> seeds;
  if (with_seeds) seeds = seeds_in(slice, volume.seeds());
  return {
      {plane.size, plane.grid()}, labels_in(plane, volume.labels()), std::move(seeds), volume.ids(), buffers};
}

}  // namespace vorocl::command
