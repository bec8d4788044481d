#include "app/outputs/diagram_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "formats/files.hpp"
#include "formats/images/pictures.hpp"
#include "formats/raster_files.hpp"

namespace vorocl::command {

namespace {

void write_label_file(const OutputFile& file, Measures& measures) {
  write_labels(file, measures.view().picture, measures.labels_in_picture());
}

/// In pixels, of what CellShape has.
double distance_of(std::int64_t distance, Metric metric) {
  switch (metric) {
    case Metric::euclidean:
      return std::sqrt(static_cast<double>(distance));
    case Metric::manhattan:
      break;
  }
  return static_cast<double>(distance);
}

std::string row_of(const CellMeasures& cell, const View& view, Metric metric) {
  const Units& units = view.units;
  std::string extent = ",,,,,", distance;
  if (cell.sums.area > 0) {
    const Point centroid = cell.sums.centroid();
    const CellShape& shape = cell.shape;
    extent = fmt::format("{},{},{},{},{},{}", centroid.x + view.x, centroid.y + view.y, shape.left + view.x,
                         shape.top + view.y, shape.right + view.x, shape.bottom + view.y);
    distance = fmt::format("{}", units.length(distance_of(shape.largest_distance, metric)));
  }
  return fmt::format("{},{},{},{},{},{},{},{},{}\n", cell.id, cell.seed.x + view.x, cell.seed.y + view.y,
                     units.area(cell.sums.area), extent, units.length(cell.perimeter), cell.neighbours,
                     distance, cell.shape.touches_border ? 1 : 0);
}

void add_cells(GrowingFile& table, const std::string& first, Measures& measures) {
  for (const CellMeasures& cell : measures.cells()) {
    table << first << row_of(cell, measures.view(), measures.metric());
  }
}

void add_pairs(GrowingFile& table, const std::string& first, Measures& measures) {
  for (const CellPair& pair : measures.pairs()) {
    table << first << fmt::format("{},{},{}\n", pair.a, pair.b, measures.view().units.length(pair.length));
  }
}

void write_distance_file(const OutputFile& file, Measures& measures) {
  const View& view = measures.view();
  const std::vector<float> distances = view.units.lengths(measures.distances());
  std::vector<float> room;
  write_pixels(file, "distance", view.picture, view.in_picture(distances, INFINITY, room));
}

void write_border_file(const OutputFile& file, Measures& measures) {
  const View& view = measures.view();
  const std::vector<std::uint8_t> of_diagram = measures.borders();
  std::vector<std::uint8_t> room;
  const std::vector<std::uint8_t>& borders = view.in_picture(of_diagram, std::uint8_t{0}, room);
  if (extension_of(file.path()) == ".png") {
    const Size& size = view.picture.size;
    write_picture(file, 255 * cv::Mat(borders).reshape(1, size.height()));
  } else {
    write_pixels(file, "border", view.picture, borders);
  }
}

}  // namespace

void FileKind::write(const OutputFile& file, Measures& measures) const {
  if (const TableKind* const kind = table()) {
    GrowingFile rows(file);
    rows << kind->columns << "\n";
    kind->add_rows(rows, "", measures);
    rows.finish();
  } else {
    std::get<0>(content)(file, measures);
  }
}

const FileKind& labels_kind() {
  static const FileKind kind = {
      "--labels", "Labels: .npy (uint32), .tif (32-bit) or .vti (y upwards from the lower left corner)",
      label_extensions(), write_label_file};
  return kind;
}

const FileKind& cells_kind() {
  static const FileKind kind = {
      "--cells",
      "A .csv file with one row per cell: its area, centroid, extent, perimeter, neighbours",
      {".csv"},
      TableKind{"id,x,y,area,centroid_x,centroid_y,left,top,right,bottom,perimeter,neighbours,"
                "largest_distance,touches_border",
                add_cells}};
  return kind;
}

const FileKind& adjacency_kind() {
  static const FileKind kind = {
      "--adjacency",
      "A .csv file with one row per pair of cells that touch: their ids and the pixel edges they share",
      {".csv"},
      TableKind{"a,b,length", add_pairs}};
  return kind;
}

const FileKind& distance_kind() {
  static const FileKind kind = {
      "--distance",
      "Distances to the nearest seed: .npy (float32), .tif (32-bit float) or .vti (y upwards "
      "from the lower left corner)",
      {".npy", ".tif", ".tiff", ".vti"},
      write_distance_file};
  return kind;
}

const FileKind& border_kind() {
  static const FileKind kind = {
      "--border",
      "1 where a pixel's edge is shared with another cell, else 0: .npy (uint8), .vti, or .png (white for 1)",
      {".npy", ".png", ".vti"},
      write_border_file};
  return kind;
}

RequestedFile requested(const FileRequest& request) {
  return {request.kind.option, request.path, request.kind.extensions};
}

RequestedFile requested_of_frames(const FileRequest& request) {
  return {request.kind.option, request.path, request.kind.extensions, !request.is_long_table()};
}

}  // namespace vorocl::command
