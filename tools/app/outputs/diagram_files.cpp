#include "app/outputs/diagram_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

/// A cell as its row in a table: pixels of the picture in the view's units. A value may be unknown, of a cell
/// without pixels.
class CellRow {
 public:
  using Value = std::optional<double>;

  CellRow(Measures& measures, std::uint32_t label)
      : measures_(measures), view_(measures.view()), label_(label), id_(measures.id_of(label)) {}

  std::uint32_t label() const { return label_; }

  Value id() const { return id_; }
  Value x() const { return view_.position(*measures_.seeds()[label_]).x; }
  Value y() const { return view_.position(*measures_.seeds()[label_]).y; }
  Value area() const { return view_.units.area(measures_.pixels()[label_]); }
  Value centroid_x() const { return if_full(centroid().x); }
  Value centroid_y() const { return if_full(centroid().y); }
  Value left() const { return if_full(extent().left); }
  Value top() const { return if_full(extent().top); }
  Value right() const { return if_full(extent().right); }
  Value bottom() const { return if_full(extent().bottom); }
  Value perimeter() const { return view_.units.length(measures_.perimeters()[label_]); }
  Value neighbours() const { return measures_.neighbours()[label_]; }
  Value largest_distance() const { return if_full(view_.units.length(measures_.largest_distance(label_))); }
  Value touches_border() const { return shape().touches_border ? 1 : 0; }

 private:
  Point centroid() const { return view_.position(measures_.sums()[label_].centroid()); }
  const CellShape& shape() const { return measures_.shapes()[label_]; }
  Extent extent() const {
    const double x = view_.x, y = view_.y;
    return view_.units.extent({shape().left + x, shape().top + y, shape().right + x, shape().bottom + y});
  }
  Value if_full(double value) const { return measures_.pixels()[label_] > 0 ? Value(value) : Value(); }

  Measures& measures_;
  const View& view_;
  std::uint32_t label_, id_;
};

/// Reads what a value is made of for all labels, if it was not read before, and says where it lies for this
/// one.
using Source = const void* (*)(Measures& measures, std::uint32_t label);

struct CellColumn {
  std::string name;
  CellRow::Value (CellRow::*value)() const;
  Source source;
};

const void* seed_of(Measures& measures, std::uint32_t label) { return measures.seeds().data() + label; }
const void* pixels_of(Measures& measures, std::uint32_t label) { return measures.pixels().data() + label; }

const std::vector<CellColumn>& all_cell_columns() {
  const auto sums = [](Measures& measures, std::uint32_t label) -> const void* {
    return measures.sums().data() + label;
  };
  const auto shapes = [](Measures& measures, std::uint32_t label) -> const void* {
    return measures.shapes().data() + label;
  };
  const auto perimeters = [](Measures& measures, std::uint32_t label) -> const void* {
    return measures.perimeters().data() + label;
  };
  const auto neighbours = [](Measures& measures, std::uint32_t label) -> const void* {
    return measures.neighbours().data() + label;
  };
  static const std::vector<CellColumn> columns = {{"id", &CellRow::id, seed_of},
                                                  {"x", &CellRow::x, seed_of},
                                                  {"y", &CellRow::y, seed_of},
                                                  {"area", &CellRow::area, pixels_of},
                                                  {"centroid_x", &CellRow::centroid_x, sums},
                                                  {"centroid_y", &CellRow::centroid_y, sums},
                                                  {"left", &CellRow::left, shapes},
                                                  {"top", &CellRow::top, shapes},
                                                  {"right", &CellRow::right, shapes},
                                                  {"bottom", &CellRow::bottom, shapes},
                                                  {"perimeter", &CellRow::perimeter, perimeters},
                                                  {"neighbours", &CellRow::neighbours, neighbours},
                                                  {"largest_distance", &CellRow::largest_distance, shapes},
                                                  {"touches_border", &CellRow::touches_border, shapes}};
  return columns;
}

/// What rows of these columns are made of, each once. The pixels, which say whether a cell is empty, stand
/// behind the sums, which have them.
std::vector<Source> sources_of(const std::vector<CellColumn>& columns) {
  std::vector<Source> sources;
  const auto add = [&sources](Source source) {
    if (std::find(sources.begin(), sources.end(), source) == sources.end()) sources.push_back(source);
  };
  for (const CellColumn& column : columns) {
    if (column.source != pixels_of) add(column.source);
  }
  add(seed_of);
  add(pixels_of);
  return sources;
}

void read_plane_cells(const std::vector<CellColumn>& columns, Measures& measures) {
  for (const Source source : sources_of(columns)) source(measures, 0);
}

void add_plane_cells(const std::vector<CellColumn>& columns, GrowingFile& table, const std::string& first,
                     Measures& measures) {
  const std::vector<Source> sources = sources_of(columns);
  std::vector<CellRow> rows;
  for (const std::uint32_t label : measures.cells()) rows.emplace_back(measures, label);
  const auto add = [&](fmt::memory_buffer& text, const CellRow& row) {
    text.append(std::string_view(first));
    bool is_first = true;
    for (const CellColumn& column : columns) {
      if (!is_first) text.push_back(',');
      is_first = false;
      if (const CellRow::Value value = (row.*column.value)()) add_number(text, *value);
    }
    text.push_back('\n');
  };
  // Ids say nothing of where labels lie.
  const auto fetch = [&](const CellRow& row) {
    for (const Source source : sources) __builtin_prefetch(source(measures, row.label()));
  };
  add_rows(table, rows, add, fetch);
}

void add_plane_pairs(GrowingFile& table, const std::string& first, Measures& measures) {
  const Units& units = measures.view().units;
  add_rows(table, measures.pairs_by_id(), [&](fmt::memory_buffer& text, const CellPair& pair) {
    text.append(std::string_view(first));
    add_number(text, pair.a);
    text.push_back(',');
    add_number(text, pair.b);
    text.push_back(',');
    add_number(text, units.length(pair.length));
    text.push_back('\n');
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
  std::vector<std::uint8_t> room;
  const std::vector<std::uint8_t>& borders = view.in_picture(measures.borders(), std::uint8_t{0}, room);
  if (extension_of(file.path()) == ".png") {
    const Size& size = view.picture.size;
    write_picture(file, 255 * cv::Mat(borders).reshape(1, size.height()));
  } else {
    write_pixels(file, "border", view.picture, borders);
  }
}

}  // namespace

void FileKind::write(const OutputFile& file, Measures& measures) const {
  read(measures);
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
      label_extensions(), [](Measures& measures) { measures.labels(); }, write_label_file};
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
    add_plane_cells(columns, table, first, measures);
  };
  return {"--cells",
          "A .csv file with one row per cell: its area, centroid, extent, perimeter, neighbours",
          {".csv"},
          [columns](Measures& measures) { read_plane_cells(columns, measures); },
          TableKind{names, add_rows}};
}

const FileKind& adjacency_kind() {
  static const FileKind kind = {
      "--adjacency",
      "A .csv file with one row per pair of cells that touch: their ids and the pixel edges they share",
      {".csv"},
      [](Measures& measures) { measures.pairs(); },
      TableKind{{"a", "b", "length"}, add_plane_pairs}};
  return kind;
}

const FileKind& distance_kind() {
  static const FileKind kind = {
      "--distance",
      "Distances to the nearest seed: .npy (float32), .tif (32-bit float) or .vti (y upwards "
      "from the lower left corner)",
      {".npy", ".tif", ".tiff", ".vti"},
      [](Measures& measures) { measures.distances(); },
      write_distance_file};
  return kind;
}

const FileKind& border_kind() {
  static const FileKind kind = {
      "--border",
      "1 where a pixel's edge is shared with another cell, else 0: .npy (uint8), .vti, or .png (white for 1)",
      {".npy", ".png", ".vti"},
      [](Measures& measures) { measures.borders(); },
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
