#include "app/commands/render_volume.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "app/commands/volume.hpp"
#include "app/options/option_groups.hpp"
#include "app/outputs/output_files.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "app/terminal/selected_device.hpp"
#include "formats/images/pictures.hpp"
#include "formats/raster_files.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

namespace {

std::vector<RequestedFile> requested_files(const VolumeRendering& options) {
  return {{"--labels", options.labels_path, volume_extensions()},
          {"-o", options.picture_path, picture_extensions()}};
}

std::int64_t side_along(const Grid& grid, char axis) {
  return axis == 'x' ? grid.width() : axis == 'y' ? grid.height() : grid.depth();
}

/// The plane of a slice: x and y of a slice across z, x and z across y, y and z across x.
struct Plane {
  Size size;
  std::size_t first, along_row, along_column;  // of its pixels in the volume
};

Plane plane_of(const Grid& grid, const VolumeSlice& slice) {
  const auto width = static_cast<std::size_t>(grid.width()), at = static_cast<std::size_t>(slice.at);
  const std::size_t area = width * static_cast<std::size_t>(grid.height());
  if (slice.axis == 'x') return {{grid.height(), grid.depth()}, at, width, area};
  if (slice.axis == 'y') return {{grid.width(), grid.depth()}, at * width, 1, area};
  return {{grid.width(), grid.height()}, at * area, 1, width};
}

void check_slice(const VolumeRendering& options, const Grid& grid) {
  if (options.picture_path.empty()) {
    if (options.slice) throw UsageError("--slice is of the picture: give -o PICTURE");
    return;
  }
  if (!options.slice) throw UsageError("-o needs --slice z=K, the slice of the volume that it shows");
  const std::int64_t side = side_along(grid, options.slice->axis);
  if (options.slice->at >= side) {
    throw UsageError(fmt::format("--slice {}={}: the volume has slices from 0 to {} there",
                                 options.slice->axis, options.slice->at, side - 1));
  }
  check_picture_size(options.picture, plane_of(grid, *options.slice).size);
}

void check_picture(const VolumeRendering& options) {
  const PictureOptions& picture = options.picture;
  const char* const of_planes = picture.color.quantity != Quantity::id ? "--color"
                                : picture.contours                     ? "--contours"
                                : picture.stamp                        ? "--stamp"
                                                                       : nullptr;
  if (of_planes != nullptr) {
    throw UsageError(std::string(of_planes) + " is for planes: the picture of a slice shows ids");
  }
  check_picture_options(picture);
}

void check(const VolumeRendering& options, const Grid& grid) {
  check_volume(options.seeds, options.method);
  if (options.picture_path.empty() && options.labels_path.empty()) {
    throw UsageError("nothing to write: give -o PICTURE with --slice z=K, --labels FILE or both");
  }
  check_slice(options, grid);
  check_picture(options);
  check_outputs(requested_files(options), options.seeds);
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

/// Draws a slice as the diagram of a plane.
void draw(const OutputFile& file, const VolumeRendering& options, const Seeds& seeds, const Diagram& volume,
          const std::vector<std::uint32_t>& labels) {
  const Plane plane = plane_of(seeds.grid(), *options.slice);
  const View view = {plane.size, plane.size.grid()};
  const Seeds in_slice(seeds.device(), plane.size.grid(), seeds_in(*options.slice, seeds));
  Diagram diagram(seeds.device(), plane.size.grid());
  diagram.write(labels_in(plane, labels), in_slice, volume.metric());
  MeasureBuffers buffers;
  Measures measures(in_slice, diagram, {}, view, buffers);
  write_picture(file, Painter(options.picture).draw(measures, {}));
}

/// How many seeds own no voxel, and how many voxels have no label.
struct Missing {
  std::size_t cells, labels;
};

Missing missing_in(const std::vector<std::uint32_t>& labels, const Seeds& seeds) {
  std::vector<bool> has_voxels(seeds.size());
  std::size_t cells = 0, unlabelled = 0;
  for (const std::uint32_t label : labels) {
    if (label == no_label) {
      ++unlabelled;
    } else if (!has_voxels.at(label)) {
      has_voxels[label] = true;
      ++cells;
    }
  }
  return {seeds.alive() - cells, unlabelled};
}

void print_result(const VolumeRendering& options, const Seeds& seeds, const Diagram& diagram,
                  const Report& report, const Missing& missing) {
  if (options.json) {
    Json json = json_of_volume(options.method, seeds, diagram, report);
    json.update(Json{{"empty_cells", missing.cells}, {"unlabelled_voxels", missing.labels}});
    print_json(json);
    return;
  }
  print_volume(options.method, seeds, report);
  print_cells_of_volume(missing.cells, seeds.alive(), missing.labels);
  print_written(requested_files(options));
}

}  // namespace

VolumeSlice parse_slice(const std::string& text) {
  const bool is_of_an_axis = text.size() > 2 && text[1] == '=' && text[0] >= 'x' && text[0] <= 'z';
  const auto at = is_of_an_axis ? parse_number<std::int64_t>(text.substr(2)) : std::nullopt;
  if (!at || *at < 0) throw Error("\"" + text + "\" must be z=K, y=K or x=K, such as z=128");
  return {text[0], *at};
}

void render_volume(const VolumeRendering& options) {
  const VolumeSize sides = volume_size(options.seeds);
  const Grid grid = sides.grid();
  check(options, grid);
  const std::optional<OutputFile> picture = open_output(options.picture_path);
  const std::optional<OutputFile> label_file = open_output(options.labels_path);
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  const Seeds seeds = Seeds::random(device, grid, options.seeds.random, options.seeds.rng_seed);
  Diagram diagram(device, grid);
  const Report report = options.method.run(seeds, diagram, options.method_options);
  const std::vector<std::uint32_t> labels = diagram.read();
  if (label_file) write_volume(*label_file, sides, labels);
  if (picture) draw(*picture, options, seeds, diagram, labels);
  print_result(options, seeds, diagram, report, missing_in(labels, seeds));
}

}  // namespace vorocl::command
