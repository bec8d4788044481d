#include "app/outputs/diagram_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/outputs/exact_cell_files.hpp"
#include "app/outputs/table_rows.hpp"
#include "formats/files.hpp"
#include "formats/images/pictures.hpp"
#include "formats/polygon_files.hpp"
#include "formats/raster_files.hpp"

namespace vorocl::command {

namespace {

void write_label_file(const OutputFile& file, Measures& measures) {
  write_labels(file, measures.view().picture, measures.labels_in_picture());
}

/// A cell as its row in a table: pixels of the picture, or voxels, in the view's units. What a cell without
/// pixels does not have is unknown.
class CellRow {
 public:
  CellRow(Measures& measures, std::uint32_t label)
      : measures_(measures), view_(measures.view()), label_(label) {}

  double id() const { return measures_.id_of(label_); }
  double x() const { return is_on_globe() ? of_globe().seed.x : x_at(measures_.seeds()[label_]->x); }
  double y() const { return is_on_globe() ? of_globe().seed.y : y_at(measures_.seeds()[label_]->y); }
  double z() const { return z_at(measures_.seeds()[label_]->z); }
  double area() const {
    return is_on_globe() ? of_globe().area : view_.units.area(measures_.pixels()[label_]);
  }
  double centroid_x() const { return if_full(is_on_globe() ? of_globe().centroid.x : x_at(centroid().x)); }
  double centroid_y() const { return if_full(is_on_globe() ? of_globe().centroid.y : y_at(centroid().y)); }
  double centroid_z() const { return if_full(z_at(centroid().z)); }
  double left() const { return if_full(x_at(shape().left)); }
  double top() const { return if_full(y_at(shape().top)); }
  double front() const { return if_full(z_at(shape().front)); }
  double right() const { return if_full(view_.units.x_end(static_cast<double>(shape().right) + view_.x)); }
  double bottom() const { return if_full(view_.units.y_end(static_cast<double>(shape().bottom) + view_.y)); }
  double back() const { return if_full(view_.units.z_end(shape().back)); }
  double perimeter() const { return view_.units.border(measures_.perimeters()[label_]); }
  double neighbours() const { return measures_.neighbours()[label_]; }
  double largest_distance() const { return if_full(view_.units.length(measures_.largest_distance(label_))); }
  double touches_border() const {
    return (is_on_globe() ? of_globe().touches_border : shape().touches_border) ? 1 : 0;
  }

 private:
  double x_at(double of_diagram) const { return view_.units.x(of_diagram + view_.x); }
  double y_at(double of_diagram) const { return view_.units.y(of_diagram + view_.y); }
  double z_at(double of_diagram) const { return view_.units.z(of_diagram); }
  bool is_on_globe() const { return measures_.is_on_globe(); }
  const vorocl::CellRow& of_globe() const { return measures_.on_globe()[label_]; }
  Point centroid() const { return measures_.sums()[label_].centroid(); }
  const CellShape& shape() const { return measures_.shapes()[label_]; }
  double if_full(double value) const { return measures_.pixels()[label_] > 0 ? value : RowText::unknown; }

  Measures& measures_;
  const View& view_;
  std::uint32_t label_;
};

/// An exact cell as its row in the same table. What a cell without vertices does not have is unknown.
class ExactRow {
 public:
  ExactRow(Measures& measures, std::uint32_t seed)
      : rows_(*measures.exact()), seed_(seed), cell_(rows_.cell(seed)) {}

  double id() const { return rows_.id_of(seed_); }
  double x() const { return rows_.point(seed_).x; }
  double y() const { return rows_.point(seed_).y; }
  double z() const { return rows_.point(seed_).z; }
  double area() const { return cell_.area; }
  double centroid_x() const { return if_full(cell_.centroid.x); }
  double centroid_y() const { return if_full(cell_.centroid.y); }
  double centroid_z() const { return if_full(cell_.centroid.z); }
  double left() const { return extreme(&Point::x, false); }
  double top() const { return extreme(&Point::y, rows_.y_up()); }
  double front() const { return extreme(&Point::z, false); }
  double right() const { return extreme(&Point::x, true); }
  double bottom() const { return extreme(&Point::y, !rows_.y_up()); }
  double back() const { return extreme(&Point::z, true); }
  double perimeter() const { return cell_.perimeter; }
  double neighbours() const { return cell_.neighbours; }
  double largest_distance() const {
    double found = RowText::unknown;
    for (const Point& at : rows_.vertices(seed_))
      found = std::fmax(found, std::hypot(at.x - x(), at.y - y(), at.z - z()));
    return found;
  }
  double touches_border() const { return cell_.touches_border ? 1 : 0; }

 private:
  double extreme(double Point::*along, bool greatest) const {
    double found = RowText::unknown;
    for (const Point& vertex : rows_.vertices(seed_))
      found = greatest ? std::fmax(found, vertex.*along) : std::fmin(found, vertex.*along);
    return found;
  }
  double if_full(double value) const { return cell_.area > 0 ? value : RowText::unknown; }

  ExactCellRows& rows_;
  std::uint32_t seed_;
  const ExactCell& cell_;
};

/// Reads what a value is made of for all labels, if it was not read before, and says where it lies for this
/// one.
using Source = const void* (*)(Measures& measures, std::uint32_t label);

template <typename T, const std::vector<T>& (Measures::*all)()>
const void* entry_of(Measures& measures, std::uint32_t label) {
  return (measures.*all)().data() + label;
}
/// The same of what has its place in on_globe() there.
template <typename T, const std::vector<T>& (Measures::*all)()>
const void* entry_of_plane(Measures& measures, std::uint32_t label) {
  return measures.is_on_globe() ? entry_of<vorocl::CellRow, &Measures::on_globe>(measures, label)
                                : entry_of<T, all>(measures, label);
}
constexpr Source seed = entry_of_plane<std::optional<Point>, &Measures::seeds>,
                 pixels = entry_of_plane<std::uint32_t, &Measures::pixels>,
                 sums = entry_of_plane<CellSums, &Measures::sums>,
                 shape = entry_of_plane<CellShape, &Measures::shapes>,
                 perimeter = entry_of<std::uint32_t, &Measures::perimeters>,
                 neighbours = entry_of<std::uint32_t, &Measures::neighbours>;

struct CellColumn {
  std::string name;
  CellsOf of;
  Source source;  // of a diagram's cells; those of shapes are of the vertices of exact ones
  /// Finds the values of the labels [begin, end).
  void (*find)(Measures& measures, const std::uint32_t* begin, const std::uint32_t* end, double* values);
};

template <Source source, double (CellRow::*value)() const, double (ExactRow::*exact_value)() const>
CellColumn column(const char* name, CellsOf of = CellsOf::both) {
  const auto find = [](Measures& measures, const std::uint32_t* begin, const std::uint32_t* end,
                       double* values) {
    constexpr std::ptrdiff_t ahead = 8;  // ids say nothing of where labels lie
    const bool are_exact = measures.exact() != nullptr;
    for (const std::uint32_t* label = begin; label != end; ++label) {
      if (!are_exact && end - label > ahead) __builtin_prefetch(source(measures, label[ahead]));
      *values++ =
          are_exact ? (ExactRow(measures, *label).*exact_value)() : (CellRow(measures, *label).*value)();
    }
  };
  return {name, of, source, find};
}

const std::vector<CellColumn>& all_cell_columns() {
  static const std::vector<CellColumn> columns = {
      column<seed, &CellRow::id, &ExactRow::id>("id"),
      column<seed, &CellRow::x, &ExactRow::x>("x"),
      column<seed, &CellRow::y, &ExactRow::y>("y"),
      column<seed, &CellRow::z, &ExactRow::z>("z", CellsOf::volumes),
      column<pixels, &CellRow::area, &ExactRow::area>("area", CellsOf::planes),
      column<pixels, &CellRow::area, &ExactRow::area>("volume", CellsOf::volumes),
      column<sums, &CellRow::centroid_x, &ExactRow::centroid_x>("centroid_x"),
      column<sums, &CellRow::centroid_y, &ExactRow::centroid_y>("centroid_y"),
      column<sums, &CellRow::centroid_z, &ExactRow::centroid_z>("centroid_z", CellsOf::volumes),
      column<shape, &CellRow::left, &ExactRow::left>("left"),
      column<shape, &CellRow::top, &ExactRow::top>("top"),
      column<shape, &CellRow::front, &ExactRow::front>("front", CellsOf::volumes),
      column<shape, &CellRow::right, &ExactRow::right>("right"),
      column<shape, &CellRow::bottom, &ExactRow::bottom>("bottom"),
      column<shape, &CellRow::back, &ExactRow::back>("back", CellsOf::volumes),
      column<perimeter, &CellRow::perimeter, &ExactRow::perimeter>("perimeter", CellsOf::planes),
      column<perimeter, &CellRow::perimeter, &ExactRow::perimeter>("surface", CellsOf::volumes),
      column<neighbours, &CellRow::neighbours, &ExactRow::neighbours>("neighbours"),
      column<shape, &CellRow::largest_distance, &ExactRow::largest_distance>("largest_distance"),
      column<shape, &CellRow::touches_border, &ExactRow::touches_border>("touches_border")};
  return columns;
}

void read_cells(const std::vector<CellColumn>& columns, Measures& measures) {
  if (ExactCellRows* const exact = measures.exact()) {
    const auto is_of_vertices = [](const CellColumn& column) { return column.source == shape; };
    if (std::any_of(columns.begin(), columns.end(), is_of_vertices)) exact->read_vertices();
    return;
  }
  for (const CellColumn& column : columns) {
    if (column.source != pixels) column.source(measures, 0);
  }
  seed(measures, 0);    // these and the pixels say which cells have rows
  pixels(measures, 0);  // behind the sums, which have them
}

void add_cells(const std::vector<CellColumn>& columns, GrowingFile& table, const std::string& first,
               Measures& measures) {
  // A column after the other for some rows, so that each is a short loop; then row by row the text.
  constexpr std::ptrdiff_t most_rows = 256;
  const auto add = [&](RowText& text, const std::uint32_t* begin, const std::uint32_t* end) {
    std::vector<std::array<double, most_rows>> values(columns.size());
    for (std::ptrdiff_t rows = 0; begin < end; begin += rows) {
      rows = std::min(end - begin, most_rows);
      for (std::size_t i = 0; i < columns.size(); ++i)
        columns[i].find(measures, begin, begin + rows, values[i].data());
      for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
        text.begin_row();
        for (const auto& column : values) text.add(column[row]);
        if (measures.kept() != nullptr) text.add(measures.kept()->fields[begin[row]]);
        text.end_row();
      }
    }
  };
  add_pieces(table, first, measures.cells(), add);
}

void add_exact_pairs(GrowingFile& table, const std::string& first, Measures& measures) {
  ExactCellRows& exact = *measures.exact();
  if (exact.is_volume()) {
    add_rows(table, first, exact.faces(), [&exact](RowText& text, const ExactFace& face) {
      text.add(exact.id_of(face.a), exact.id_of(face.b), face.area, face.image[0], face.image[1],
               face.image[2]);
    });
  } else {
    add_rows(table, first, exact.pairs(), [&exact](RowText& text, const ExactPair& pair) {
      text.add(exact.id_of(pair.a), exact.id_of(pair.b), pair.length, pair.midpoint.x, pair.midpoint.y);
    });
  }
}

void add_pairs(GrowingFile& table, const std::string& first, Measures& measures) {
  const Units& units = measures.view().units;
  add_rows(table, first, measures.pairs_by_id(), [&units](RowText& text, const CellPair& pair) {
    text.add(pair.a, pair.b, units.border(pair.length));
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
    std::string header = measures.view().units.header(kind->columns);
    if (kind->of_cells && measures.kept() != nullptr)
      header.insert(header.size() - 1, ',' + to_csv(other_names(measures.kept()->names, kind->columns)));
    rows << header;
    kind->add_rows(rows, "", measures);
    rows.finish();
  } else {
    std::get<0>(content)(file, measures);
  }
}

const FileKind& labels_kind() {
  static const FileKind kind = {"--labels", "Labels: .npy (uint32), .tif (32-bit) or .vti",
                                label_extensions(), [](Measures& measures) { measures.labels(); },
                                write_label_file};
  return kind;
}

std::vector<std::string> cell_columns(CellsOf cells) {
  std::vector<std::string> names;
  for (const CellColumn& column : all_cell_columns()) {
    if (cells == CellsOf::globe) {  // without what is in pixels
      const std::set<std::string> none = {"left", "top", "right", "bottom", "perimeter"};
      if (column.of != CellsOf::volumes && none.count(column.name) == 0) names.push_back(column.name);
    } else if (cells == CellsOf::both || column.of == CellsOf::both || column.of == cells) {
      names.push_back(column.name);
    }
  }
  return names;
}

std::vector<std::string> chosen_columns(const std::vector<std::string>& chosen, CellsOf cells) {
  const std::vector<std::string> all = cell_columns(cells);
  for (const std::string& name : chosen) {
    if (std::find(all.begin(), all.end(), name) == all.end())
      throw UsageError("--cell-columns " + name + ": cells of " +
                       (cells == CellsOf::volumes ? "volumes"
                        : cells == CellsOf::globe ? "the globe"
                                                  : "planes") +
                       " have no such column, but " + to_csv(all));
  }
  return chosen.empty() ? all : chosen;
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
          [columns](Measures& measures) { read_cells(columns, measures); },
          TableKind{names, add_rows, true}};
}

const FileKind& adjacency_kind() {
  static const FileKind kind = {
      "--adjacency",
      "A .csv file with one row per pair of cells that touch: their ids and the pixel edges they share",
      {".csv"},
      [](Measures& measures) { measures.pairs(); },
      TableKind{{"a", "b", "length"}, add_pairs}};
  return kind;
}

const FileKind& distance_kind() {
  static const FileKind kind = {"--distance",
                                "Distances to the nearest seed: .npy (float32), .tif (32-bit float) or .vti",
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

const FileKind& polygons_kind() {
  static const FileKind kind = {
      "--polygons",
      "The polygons of --exact: .geojson, .csv (with a column of WKT) or .vtp (ParaView); polyhedra: .vtu",
      polygon_extensions(), [](Measures& measures) { measures.exact()->read_vertices(); },
      [](const OutputFile& file, Measures& measures) { measures.exact()->write_polygons(file); }};
  return kind;
}

FileRequest of_grid(FileRequest request, CellsOf cells) {
  const bool is_volume = cells == CellsOf::volumes;
  FileKind& kind = request.kind;
  if (kind.table() != nullptr && kind.table()->of_cells) {
    kind = cells_kind(chosen_columns(request.columns, cells));
  } else if (is_volume && kind.table() != nullptr) {
    std::get<TableKind>(kind.content).columns = {"a", "b", "area"};
  } else if (is_volume) {
    kind.extensions = volume_extensions();
  }
  return request;
}

FileRequest of_exact_cells(FileRequest request, bool is_volume) {
  FileKind& kind = request.kind;
  if (kind.table() == nullptr) {
    check_polygons(request.path, is_volume);
  } else if (kind.table()->of_cells) {
    return of_grid(request, is_volume ? CellsOf::volumes : CellsOf::planes);
  } else {
    const std::vector<std::string> of_faces = {"a", "b", "area", "image_x", "image_y", "image_z"},
                                   of_edges = {"a", "b", "length", "midpoint_x", "midpoint_y"};
    kind.read = [](Measures& measures) { measures.exact()->pair_count(); };
    kind.content = TableKind{is_volume ? of_faces : of_edges, add_exact_pairs};
  }
  return request;
}

RequestedFile requested(const FileRequest& request) {
  return {request.kind.option, request.path, request.kind.extensions};
}

std::vector<RequestedFile> requested(const std::vector<FileRequest>& requests) {
  std::vector<RequestedFile> files;
  files.reserve(requests.size());
  for (const FileRequest& request : requests) files.push_back(requested(request));
  return files;
}

void check_any(const std::vector<FileRequest>& files) {
  std::string all;
  for (const FileRequest& file : files) {
    if (!file.path.empty()) return;
    all += (all.empty() ? "" : ", ") + file.kind.option;
  }
  throw UsageError("nothing to write: give at least one of " + all);
}

std::vector<RequestedOutput> open_outputs(const std::vector<FileRequest>& files, const SeedOptions& seeds) {
  check_outputs(requested(files), seeds);
  check_any(files);
  std::vector<RequestedOutput> outputs;
  for (const FileRequest& file : files) {
    if (!file.path.empty()) outputs.push_back({file, OutputFile(file.path)});
  }
  return outputs;
}

RequestedFile requested_of_frames(const FileRequest& request) {
  return {request.kind.option, request.path, request.kind.extensions, !request.is_long_table()};
}

}  // namespace vorocl::command
