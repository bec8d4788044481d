#include "app/outputs/exact_cell_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "app/outputs/diagram_files.hpp"
#include "app/outputs/table_rows.hpp"
#include "app/terminal/console.hpp"
#include "formats/files.hpp"
#include "formats/polygon_files.hpp"

namespace vorocl::command {

namespace {

using Value = std::optional<double>;

/// The vertices of a polygon, in their order, or of a polyhedron.
struct Vertices {
  const Point *first = nullptr, *behind = nullptr;
  const Point* begin() const { return first; }
  const Point* end() const { return behind; }
};

template <typename Offset>
Vertices vertices_of(const std::vector<Point>& vertices, const std::vector<Offset>& offsets,
                     std::size_t seed) {
  return {vertices.data() + offsets[seed], vertices.data() + offsets[seed + 1]};
}

/// A cell as its row has it: the columns of the cells of diagrams, of polygons and polyhedra.
struct Row {
  std::uint32_t id;
  Point seed;
  const ExactCell& cell;
  Vertices vertices;  // none unless a column needs them
  bool y_up;

  Value extreme(double Point::*along, bool greatest) const {
    Value found;
    for (const Point& vertex : vertices) {
      if (!found || (vertex.*along > *found) == greatest) found = vertex.*along;
    }
    return found;
  }

  Value largest_distance() const {
    Value found;
    for (const Point& vertex : vertices)
      found =
          std::max(found.value_or(0), std::hypot(vertex.x - seed.x, vertex.y - seed.y, vertex.z - seed.z));
    return found;
  }

  Value if_full(double value) const { return cell.area > 0 ? Value(value) : Value(); }
};

struct Column {
  Value (*value)(const Row& of);
  bool of_vertices = false;
};

Column column_of(const std::string& name) {
  constexpr auto area = [](const Row& of) { return Value(of.cell.area); };
  constexpr auto perimeter = [](const Row& of) { return Value(of.cell.perimeter); };
  static const std::map<std::string, Column> columns = {
      {"id", {[](const Row& of) { return Value(of.id); }}},
      {"x", {[](const Row& of) { return Value(of.seed.x); }}},
      {"y", {[](const Row& of) { return Value(of.seed.y); }}},
      {"z", {[](const Row& of) { return Value(of.seed.z); }}},
      {"area", {area}},
      {"volume", {area}},
      {"centroid_x", {[](const Row& of) { return of.if_full(of.cell.centroid.x); }}},
      {"centroid_y", {[](const Row& of) { return of.if_full(of.cell.centroid.y); }}},
      {"centroid_z", {[](const Row& of) { return of.if_full(of.cell.centroid.z); }}},
      {"left", {[](const Row& of) { return of.extreme(&Point::x, false); }, true}},
      {"top", {[](const Row& of) { return of.extreme(&Point::y, of.y_up); }, true}},
      {"front", {[](const Row& of) { return of.extreme(&Point::z, false); }, true}},
      {"right", {[](const Row& of) { return of.extreme(&Point::x, true); }, true}},
      {"bottom", {[](const Row& of) { return of.extreme(&Point::y, !of.y_up); }, true}},
      {"back", {[](const Row& of) { return of.extreme(&Point::z, true); }, true}},
      {"perimeter", {perimeter}},
      {"surface", {perimeter}},
      {"neighbours", {[](const Row& of) { return Value(of.cell.neighbours); }}},
      {"largest_distance", {[](const Row& of) { return of.largest_distance(); }, true}},
      {"touches_border", {[](const Row& of) { return Value(of.cell.touches_border ? 1 : 0); }}}};
  return columns.at(name);
}

/// Moves a seed to the image that its cell lies around; of a cell without an area to one in the period.
/// Returns by how many periods.
PeriodCounts move_to_cell(Point& seed, const ExactCell& cell, const Grid& grid) {
  const auto move = [&](const Axis& axis, double Point::*along) {
    const double length = axis.to() - axis.from();
    const double near = cell.area > 0 ? cell.centroid.*along : axis.from() + length / 2;
    const double periods = axis.is_periodic() ? std::nearbyint((near - seed.*along) / length) : 0;
    seed.*along += periods * length;
    return static_cast<std::int32_t>(periods);
  };
  PeriodCounts moved = {0, move(grid.y(), &Point::y), move(grid.z(), &Point::z)};
  seed.x += moved[1] * grid.tilt();
  moved[0] = move(grid.x(), &Point::x);
  return moved;
}

}  // namespace

ExactCellRows::ExactCellRows(const Seeds& seeds, const ExactCellsResult& result, const Input& input,
                             const SeedOptions& options)
    : result_(result),
      input_(input),
      options_(options),
      points_(seeds.read()),
      cells_(result.read()),
      periods_(cells_.size()) {
  const Grid& grid = seeds.grid();
  for (std::size_t seed = 0; seed < cells_.size(); ++seed) {
    std::optional<Point>& point = points_[seed];
    if (point) periods_[seed] = move_to_cell(*point, cells_[seed], grid);
    const auto is_inside = [&] {
      return grid.is_volume() || (grid.x().covers(point->x) && grid.y().covers(point->y));
    };
    if (point && (cells_[seed].area > 0 || is_inside())) order_.push_back(seed);
  }
}

const ExactPolygons& ExactCellRows::polygons() {
  if (!polygons_) polygons_ = result_.read_polygons();
  return *polygons_;
}

const ExactPolyhedra& ExactCellRows::polyhedra() {
  if (!polyhedra_) polyhedra_ = result_.read_polyhedra();
  return *polyhedra_;
}

const std::vector<ExactPair>& ExactCellRows::pairs() {
  if (!pairs_) pairs_ = result_.read_pairs();
  return *pairs_;
}

const std::vector<ExactFace>& ExactCellRows::faces() {
  if (faces_) return *faces_;
  faces_ = result_.read_faces();
  for (ExactFace& face : *faces_) {  // images of the points as rows have them
    for (std::size_t axis = 0; axis < 3; ++axis)
      face.image[axis] += periods_[face.a][axis] - periods_[face.b][axis];
  }
  return *faces_;
}

void ExactCellRows::add_cells(GrowingFile& table, const std::string& first,
                              const std::vector<std::string>& names) {
  std::vector<Column> columns;
  columns.reserve(names.size());
  for (const std::string& name : names) columns.push_back(column_of(name));
  const bool need_vertices =
      std::any_of(columns.begin(), columns.end(), [](const Column& column) { return column.of_vertices; });
  const ExactPolygons* const polygons = need_vertices && !is_volume() ? &this->polygons() : nullptr;
  const ExactPolyhedra* const polyhedra = need_vertices && is_volume() ? &this->polyhedra() : nullptr;
  const bool y_up = points_up(options_) && !is_volume();
  add_rows(table, first, order_, [&](RowText& text, std::size_t seed) {
    const Vertices vertices = polygons != nullptr ? vertices_of(polygons->vertices, polygons->offsets, seed)
                              : polyhedra != nullptr
                                  ? vertices_of(polyhedra->vertices, polyhedra->vertex_offsets, seed)
                                  : Vertices();
    const Row row = {id_of(seed), *points_[seed], cells_[seed], vertices, y_up};
    for (const Column& column : columns) text.add(column.value(row));
    if (!kept().fields.empty()) text.add(kept().fields[seed]);
  });
}

void ExactCellRows::add_pairs(GrowingFile& table, const std::string& first) {
  if (is_volume()) {
    add_rows(table, first, faces(), [this](RowText& text, const ExactFace& face) {
      text.add(id_of(face.a), id_of(face.b), face.area, face.image[0], face.image[1], face.image[2]);
    });
  } else {
    add_rows(table, first, pairs(), [this](RowText& text, const ExactPair& pair) {
      text.add(id_of(pair.a), id_of(pair.b), pair.length, pair.midpoint.x, pair.midpoint.y);
    });
  }
}

void ExactCellRows::write_polygons(const OutputFile& file) {
  std::vector<PolygonCell> cells;
  cells.reserve(order_.size());
  for (const std::size_t seed : order_) {
    cells.push_back({id_of(seed),
                     *points_[seed],
                     cells_[seed].area,
                     cells_[seed].neighbours,
                     {},
                     kept().fields.empty() ? CsvFields() : kept().fields[seed]});
    if (is_volume()) continue;
    const Vertices vertices = vertices_of(polygons().vertices, polygons().offsets, seed);
    cells.back().polygon.assign(vertices.begin(), vertices.end());
  }
  if (is_volume()) return write_polyhedra(file, cells, order_, polyhedra(), kept().names);
  const Axis& x = input_.view.window.grid().x();
  const bool has_date_line = x.is_periodic() && x.from() == -180 && x.to() == 180;
  command::write_polygons(file, cells, {kept().names, options_.crs, has_date_line});
}

std::size_t ExactCellRows::empty_cells() const {
  return static_cast<std::size_t>(std::count_if(order_.begin(), order_.end(),
                                                [this](std::size_t seed) { return cells_[seed].area == 0; }));
}

std::size_t ExactCellRows::uncertified() const {
  return static_cast<std::size_t>(
      std::count_if(cells_.begin(), cells_.end(), [](const ExactCell& cell) { return !cell.certified; }));
}

double ExactCellRows::mean_area() const {
  double sum = 0;
  for (const std::size_t seed : order_) sum += cells_[seed].area;
  return order_.empty() ? 0 : sum / static_cast<double>(order_.size());
}

double ExactCellRows::area_deviation() const {
  const double mean = mean_area();
  double squares = 0;
  for (const std::size_t seed : order_) squares += (cells_[seed].area - mean) * (cells_[seed].area - mean);
  return order_.empty() ? 0 : std::sqrt(squares / static_cast<double>(order_.size()));
}

std::string ExactTable::header(const KeptColumns& kept) const {
  CsvFields names = columns;
  if (of_cells) {
    const CsvFields others = other_names(kept.names, columns);
    names.insert(names.end(), others.begin(), others.end());
  }
  return to_csv(names) + "\n";
}

void ExactTable::write(const OutputFile& file, ExactCellRows& rows) const {
  GrowingFile table(file);
  table << header(rows.kept());
  add_rows(rows, table, "");
  table.finish();
}

void check_polygons(const std::string& path, bool of_volume) {
  if (path.empty() || (extension_of(path) == polyhedra_extension) == of_volume) return;
  throw UsageError("--polygons " + path +
                   (of_volume ? ": cells of a volume are polyhedra, which .vtu files hold"
                              : ": .vtu files hold polyhedra, and cells of a plane are polygons"));
}

ExactTable exact_cells_table(const std::vector<std::string>& chosen, bool of_volume) {
  const std::vector<std::string> columns = chosen_columns(chosen, of_volume);
  return {columns,
          [columns](ExactCellRows& rows, GrowingFile& table, const std::string& first) {
            rows.add_cells(table, first, columns);
          },
          true};
}

ExactTable exact_pairs_table(bool of_volume) {
  const std::vector<std::string> of_faces = {"a", "b", "area", "image_x", "image_y", "image_z"};
  return {of_volume ? of_faces : std::vector<std::string>{"a", "b", "length", "midpoint_x", "midpoint_y"},
          [](ExactCellRows& rows, GrowingFile& table, const std::string& first) {
            rows.add_pairs(table, first);
          }};
}

}  // namespace vorocl::command
