#include "app/commands/volume_slice.hpp"

#include <fmt/format.h>

#include "app/options/option_groups.hpp"
#include "app/terminal/console.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

namespace {

std::int64_t side_along(const VolumeSize& sides, char axis) {
  return axis == 'x' ? sides.width : axis == 'y' ? sides.height : sides.depth;
}

/// The plane of a slice: x and y of a slice across z, x and z across y, y and z across x.
struct Plane {
  Size size;
  std::size_t first, along_row, along_column;  // of its pixels in the volume
  bool is_periodic_x, is_periodic_y;

  Grid grid() const { return size.grid(periodic_along(is_periodic_x, is_periodic_y)); }
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
std::vector<std::optional<Point>> seeds_in(const VolumeSlice& slice, const Seeds& seeds) {
  std::vector<std::optional<Point>> points;
  for (const std::optional<Point3>& voxel : seeds.read_voxels()) {
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

VolumeSlice parse_slice(const std::string& text) {
  const bool is_of_an_axis = text.size() > 2 && text[1] == '=' && text[0] >= 'x' && text[0] <= 'z';
  const auto at = is_of_an_axis ? parse_number<std::int64_t>(text.substr(2)) : std::nullopt;
  if (!at || *at < 0) throw Error("\"" + text + "\" must be z=K, y=K or x=K, such as z=128");
  return {text[0], *at};
}

void add_slice_option(Command& command, std::optional<VolumeSlice>& slice) {
  command
      .add_parsed("--slice", slice, parse_slice,
                  "Of a volume, the slice that the picture shows, from 0: z=K, or along x or y")
      .value_name("z=K");
}

void check_slice(const std::optional<VolumeSlice>& slice, const std::string& picture_path,
                 const PictureOptions& options, const VolumeSize& sides) {
  if (picture_path.empty()) {
    if (slice) throw UsageError("--slice is of the picture: give -o PICTURE");
    return;
  }
  if (!slice) throw UsageError("-o needs --slice z=K, the slice of the volume that it shows");
  const std::int64_t side = side_along(sides, slice->axis);
  if (slice->at >= side) {
    throw UsageError(fmt::format("--slice {}={}: the volume has slices from 0 to {} there", slice->axis,
                                 slice->at, side - 1));
  }
  const char* const of_planes = options.color.quantity != Quantity::id ? "--color"
                                : options.color_bar                    ? "--color-bar"
                                : options.scale                        ? "--scale"
                                : options.logarithmic                  ? "--log"
                                : options.contours                     ? "--contours"
                                : options.stamp                        ? "--stamp"
                                                                       : nullptr;
  if (of_planes != nullptr) {
    throw UsageError(std::string(of_planes) + " is for planes: the picture of a slice shows ids");
  }
  check_picture_options(options);
  check_picture_size(options, plane_of(sides.grid(), *slice).size);
}

cv::Mat draw_slice(const VolumeSlice& slice, const PictureOptions& options, const Seeds& seeds,
                   const std::vector<std::uint32_t>& labels, const std::vector<std::uint32_t>& ids) {
  const Plane plane = plane_of(seeds.grid(), slice);
  const View view = {plane.size, plane.grid()};
  const Seeds in_slice(seeds.device(), plane.grid(), seeds_in(slice, seeds));
  Diagram diagram(seeds.device(), plane.grid());
  diagram.write(labels_in(plane, labels), in_slice, Metric::euclidean);
  MeasureBuffers buffers;
  Measures measures(in_slice, diagram, ids, view, buffers);
  return Painter(options).draw(measures, {});
}

}  // namespace vorocl::command
