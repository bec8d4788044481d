#include "app/outputs/diagram_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
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

/// A cell of a diagram. On the globe the library measures it.
CellValues values_of(Measures& measures, std::uint32_t label, unsigned parts) {
  const View& view = measures.view();
  const bool is_full = measures.pixels()[label] > 0;
  CellValues cell;
  cell.id = measures.id_of(label);
  if ((parts & of_perimeter) != 0) cell.perimeter = view.units.border(measures.perimeters()[label]);
  if ((parts & of_neighbours) != 0) cell.neighbours = measures.neighbours()[label];
  if (measures.is_on_globe()) {
    const CellRow& of_globe = measures.on_globe()[label];
    cell.seed = of_globe.seed;
    cell.area = of_globe.area;
    cell.touches_border = of_globe.touches_border ? 1 : 0;
    if (is_full) cell.centroid = of_globe.centroid;
    if (is_full) cell.largest_distance = of_globe.largest_distance;
    return cell;
  }
  cell.seed = view.position(*measures.seeds()[label]);
  cell.area = view.units.area(measures.pixels()[label]);
  if (is_full && (parts & of_sums) != 0) cell.centroid = view.position(measures.sums()[label].centroid());
  if ((parts & of_shape) == 0) return cell;
  const CellShape& shape = measures.shapes()[label];
  cell.touches_border = shape.touches_border ? 1 : 0;
  if (!is_full) return cell;
  const auto at = [](std::int64_t first, std::int64_t pixel) { return static_cast<double>(first + pixel); };
  cell.extent = view.units.extent({at(view.x, shape.left), at(view.y, shape.top), at(view.x, shape.right),
                                   at(view.y, shape.bottom), at(0, shape.front), at(0, shape.back)});
  cell.largest_distance = view.units.length(shape.farthest(measures.metric()));
  return cell;
}

CellValues values_of(ExactCellRows& rows, std::uint32_t seed, unsigned parts) {
  const ExactCell& exact = rows.cell(seed);
  CellValues cell;
  cell.id = rows.id_of(seed);
  cell.seed = rows.point(seed);
  cell.area = exact.area;
  if (exact.area > 0) cell.centroid = exact.centroid;
  cell.perimeter = exact.perimeter;
  cell.neighbours = exact.neighbours;
  cell.touches_border = exact.touches_border ? 1 : 0;
  if ((parts & of_shape) == 0) return cell;
  Extent& extent = cell.extent;
  for (const Point& at : rows.vertices(seed)) {
    extent = {std::fmin(extent.left, at.x),   std::fmin(extent.top, at.y),   std::fmax(extent.right, at.x),
              std::fmax(extent.bottom, at.y), std::fmin(extent.front, at.z), std::fmax(extent.back, at.z)};
    cell.largest_distance = std::fmax(cell.largest_distance,
                                      std::hypot(at.x - cell.seed.x, at.y - cell.seed.y, at.z - cell.seed.z));
  }
  if (rows.y_up()) std::swap(extent.top, extent.bottom);
  return cell;
}

unsigned parts_of(const std::vector<CellColumn>& columns) {
  unsigned parts = 0;
  for (const CellColumn& column : columns) parts |= column.part;
  return parts;
}

void read_cells(unsigned parts, Measures& measures) {
  if (ExactCellRows* const exact = measures.exact()) {
    if ((parts & of_shape) != 0) exact->read_vertices();
    return;
  }
  if (measures.is_on_globe()) {
    measures.on_globe();
  } else {
    measures.seeds();
    if ((parts & of_sums) != 0) measures.sums();
    if ((parts & of_shape) != 0) measures.shapes();
  }
  measures.pixels();  // behind the sums, which have them
  if ((parts & of_perimeter) != 0) measures.perimeters();
  if ((parts & of_neighbours) != 0) measures.neighbours();
}

void add_cells(const std::vector<CellColumn>& columns, GrowingFile& table, const std::string& first,
               Measures& measures) {
  const unsigned parts = parts_of(columns);
  ExactCellRows* const exact = measures.exact();
  add_rows(table, first, measures.cells(), [&](RowText& text, std::uint32_t label) {
    add_cell(text, columns,
             exact != nullptr ? values_of(*exact, label, parts) : values_of(measures, label, parts),
             measures.kept() == nullptr ? nullptr : &measures.kept()->fields[label]);
  });
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
    const bool has_kept = kind->of_cells && measures.kept() != nullptr;
    rows << header_of_cells(kind->columns, measures.view().units,
                            has_kept ? measures.kept()->names : CsvFields());
    kind->add_rows(rows, "", measures);
    rows.finish();
  } else {
    std::get<0>(content)(file, measures);
  }
}

FileKind labels_kind() {
  return {"--labels", "Labels: .npy (uint32), .tif (32-bit) or .vti", label_extensions,
          [](Measures& measures) { measures.labels(); }, write_label_file};
}

const std::vector<CellColumn>& all_cell_columns() {
  using Cell = CellValues;
  constexpr CellsOf both = CellsOf::both, planes = CellsOf::planes, volumes = CellsOf::volumes;
  static const std::vector<CellColumn> columns = {
      {"id", both, in_any, [](const Cell& cell) { return cell.id; }},
      {"x", both, in_any, [](const Cell& cell) { return cell.seed.x; }},
      {"y", both, in_any, [](const Cell& cell) { return cell.seed.y; }},
      {"z", volumes, in_any, [](const Cell& cell) { return cell.seed.z; }},
      {"area", planes, in_any, [](const Cell& cell) { return cell.area; }},
      {"volume", volumes, in_any, [](const Cell& cell) { return cell.area; }},
      {"centroid_x", both, of_sums, [](const Cell& cell) { return cell.centroid.x; }},
      {"centroid_y", both, of_sums, [](const Cell& cell) { return cell.centroid.y; }},
      {"centroid_z", volumes, of_sums, [](const Cell& cell) { return cell.centroid.z; }},
      {"left", both, of_shape, [](const Cell& cell) { return cell.extent.left; }},
      {"top", both, of_shape, [](const Cell& cell) { return cell.extent.top; }},
      {"front", volumes, of_shape, [](const Cell& cell) { return cell.extent.front; }},
      {"right", both, of_shape, [](const Cell& cell) { return cell.extent.right; }},
      {"bottom", both, of_shape, [](const Cell& cell) { return cell.extent.bottom; }},
      {"back", volumes, of_shape, [](const Cell& cell) { return cell.extent.back; }},
      {"perimeter", planes, of_perimeter, [](const Cell& cell) { return cell.perimeter; }},
      {"surface", volumes, of_perimeter, [](const Cell& cell) { return cell.perimeter; }},
      {"neighbours", both, of_neighbours, [](const Cell& cell) { return cell.neighbours; }},
      {"largest_distance", both, of_shape, [](const Cell& cell) { return cell.largest_distance; }},
      {"touches_border", both, of_shape, [](const Cell& cell) { return cell.touches_border; }}};
  return columns;
}

std::vector<CellColumn> cell_columns_of(const std::vector<std::string>& names) {
  std::vector<CellColumn> columns;
  columns.reserve(names.size());
  for (const std::string& name : names) {
    columns.push_back(*std::find_if(all_cell_columns().begin(), all_cell_columns().end(),
                                    [&name](const CellColumn& any) { return any.name == name; }));
  }
  return columns;
}

void add_cell(RowText& text, const std::vector<CellColumn>& columns, const CellValues& cell,
              const CsvFields* kept) {
  for (const CellColumn& column : columns) text.add(column.value(cell));
  if (kept != nullptr) text.add(*kept);
}

std::string header_of_cells(const std::vector<std::string>& columns, const Units& units,
                            const CsvFields& kept) {
  std::string header = units.header(columns);
  if (!kept.empty()) header.insert(header.size() - 1, ',' + to_csv(other_names(kept, columns)));
  return header;
}

std::vector<std::string> cell_columns(CellsOf cells) {
  std::vector<std::string> names;
  for (const CellColumn& column : all_cell_columns()) {
    if (cells == CellsOf::globe || cells == CellsOf::tiles) {
      const std::set<std::string> in_pixels = {"left", "top", "right", "bottom", "perimeter"};
      const std::set<std::string> none =
          cells == CellsOf::globe ? in_pixels : std::set<std::string>{"largest_distance"};
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
  const std::vector<CellColumn> columns = cell_columns_of(names);
  const auto add_rows = [columns](GrowingFile& table, const std::string& first, Measures& measures) {
    add_cells(columns, table, first, measures);
  };
  return {"--cells",
          "Cells, with area, centroid, extent, perimeter, neighbours: .csv",
          {".csv"},
          [columns](Measures& measures) { read_cells(parts_of(columns), measures); },
          TableKind{names, add_rows, true}};
}

FileKind adjacency_kind() {
  return {"--adjacency",
          "Pairs of cells that touch, with what they share: .csv",
          {".csv"},
          [](Measures& measures) { measures.pairs(); },
          TableKind{{"a", "b", "length"}, add_pairs}};
}

FileKind distance_kind() {
  return {"--distance", "Distances to the nearest seed: .npy (float32), .tif (32-bit float) or .vti",
          label_extensions, [](Measures& measures) { measures.distances(); }, write_distance_file};
}

FileKind border_kind() {
  return {"--border",
          "1 where a pixel borders on another cell, else 0: .npy (uint8), .vti, or .png (white)",
          {".npy", ".png", ".vti"},
          [](Measures& measures) { measures.borders(); },
          write_border_file};
}

FileKind polygons_kind() {
  return {"--polygons", "Polygons of --exact: .geojson, .csv (WKT) or .vtp (ParaView); polyhedra: .vtu",
          polygon_extensions, [](Measures& measures) { measures.exact()->read_vertices(); },
          [](const OutputFile& file, Measures& measures) { measures.exact()->write_polygons(file); }};
}

FileRequest of_grid(FileRequest request, CellsOf cells) {
  const bool is_volume = cells == CellsOf::volumes;
  FileKind& kind = request.kind;
  if (kind.table() != nullptr && kind.table()->of_cells) {
    kind = cells_kind(chosen_columns(request.columns, cells));
  } else if (is_volume && kind.table() != nullptr) {
    std::get<TableKind>(kind.content).columns = {"a", "b", "area"};
  } else if (is_volume) {
    kind.extensions = volume_extensions;
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
