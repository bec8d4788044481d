#include "app/outputs/diagram_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/core.hpp>
#include <optional>
#include <string_view>

#include "app/outputs/table_rows.hpp"
#include "formats/files.hpp"
#include "formats/images/pictures.hpp"
#include "formats/raster_files.hpp"

namespace vorocl::command {

namespace {

void write_label_file(const OutputFile& file, Measures& measures) {
  write_labels(file, measures.view().picture, measures.labels_in_picture());
}

/// In pixels, of what CellShape has.
double distance_of(double distance, Metric metric) {
  return metric == Metric::euclidean ? std::sqrt(distance) : distance;
}

/// A cell as its row in a table: pixels of the picture in the view's units. A value may be unknown, of a cell
/// without pixels.
class CellRow {
 public:
  using Value = std::optional<double>;

  CellRow(const CellMeasures& cell, const View& view, Metric metric)
      : cell_(cell), view_(view), metric_(metric) {}

  Value id() const { return cell_.id; }
  Value x() const { return view_.position(cell_.seed).x; }
  Value y() const { return view_.position(cell_.seed).y; }
  Value area() const { return view_.units.area(cell_.sums.area); }
  Value centroid_x() const { return if_full(view_.position(cell_.sums.centroid()).x); }
  Value centroid_y() const { return if_full(view_.position(cell_.sums.centroid()).y); }
  Value left() const { return if_full(extent().left); }
  Value top() const { return if_full(extent().top); }
  Value right() const { return if_full(extent().right); }
  Value bottom() const { return if_full(extent().bottom); }
  Value perimeter() const { return view_.units.length(cell_.perimeter); }
  Value neighbours() const { return cell_.neighbours; }
  Value largest_distance() const {
    return if_full(view_.units.length(distance_of(cell_.shape.largest_distance, metric_)));
  }
  Value touches_border() const { return cell_.shape.touches_border ? 1 : 0; }

 private:
  Extent extent() const {
    const double x = view_.x, y = view_.y;
    const CellShape& shape = cell_.shape;
    return view_.units.extent({shape.left + x, shape.top + y, shape.right + x, shape.bottom + y});
  }
  Value if_full(double value) const { return cell_.sums.area > 0 ? Value(value) : Value(); }

  const CellMeasures& cell_;
  const View& view_;
  Metric metric_;
};

struct CellColumn {
  std::string name;
  CellRow::Value (CellRow::*value)() const;
};

const std::vector<CellColumn>& all_cell_columns() {
  static const std::vector<CellColumn> columns = {{"id", &CellRow::id},
                                                  {"x", &CellRow::x},
                                                  {"y", &CellRow::y},
                                                  {"area", &CellRow::area},
                                                  {"centroid_x", &CellRow::centroid_x},
                                                  {"centroid_y", &CellRow::centroid_y},
                                                  {"left", &CellRow::left},
                                                  {"top", &CellRow::top},
                                                  {"right", &CellRow::right},
                                                  {"bottom", &CellRow::bottom},
                                                  {"perimeter", &CellRow::perimeter},
                                                  {"neighbours", &CellRow::neighbours},
                                                  {"largest_distance", &CellRow::largest_distance},
                                                  {"touches_border", &CellRow::touches_border}};
  return columns;
}

void add_cells(const std::vector<CellColumn>& columns, GrowingFile& table, const std::string& first,
               Measures& measures) {
  const View& view = measures.view();
  const Metric metric = measures.metric();
  add_rows(table, measures.cells(), [&](fmt::memory_buffer& text, const CellMeasures& cell) {
    const CellRow row(cell, view, metric);
    text.append(std::string_view(first));
    bool is_first = true;
    for (const CellColumn& column : columns) {
      if (!is_first) text.push_back(',');
      is_first = false;
      if (const CellRow::Value value = (row.*column.value)()) {
        fmt::format_to(std::back_inserter(text), "{}", *value);
      }
    }
    text.push_back('\n');
  });
}

void add_pairs(GrowingFile& table, const std::string& first, Measures& measures) {
  const Units& units = measures.view().units;
  add_rows(table, measures.pairs(), [&](fmt::memory_buffer& text, const CellPair& pair) {
    fmt::format_to(std::back_inserter(text), "{}{},{},{}\n", first, pair.a, pair.b,
                   units.length(pair.length));
  });
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
    rows << measures.view().units.header(kind->columns);
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

std::vector<std::string> cell_columns() {
  std::vector<std::string> names;
  for (const CellColumn& column : all_cell_columns()) names.push_back(column.name);
  return names;
}

FileKind cells_kind(const std::vector<std::string>& names) {
  std::vector<CellColumn> columns;
  for (const std::string& name : names) {
    const auto column = std::find_if(all_cell_columns().begin(), all_cell_columns().end(),
                                     [&name](const CellColumn& any) { return any.name == name; });
    columns.push_back(*column);
  }
  const auto add_rows = [columns](GrowingFile& table, const std::string& first, Measures& measures) {
    add_cells(columns, table, first, measures);
  };
  return {"--cells",
          "A .csv file with one row per cell: its area, centroid, extent, perimeter, neighbours",
          {".csv"},
          TableKind{names, add_rows}};
}

const FileKind& adjacency_kind() {
  static const FileKind kind = {
      "--adjacency",
      "A .csv file with one row per pair of cells that touch: their ids and the pixel edges they share",
      {".csv"},
      TableKind{{"a", "b", "length"}, add_pairs}};
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
