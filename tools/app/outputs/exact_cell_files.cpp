#include "app/outputs/exact_cell_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "app/outputs/table_rows.hpp"
#include "formats/polygon_files.hpp"

namespace vorocl::command {

namespace {

using Value = std::optional<double>;

/// The vertices of a polygon.
struct Ring {
  const Point *first = nullptr, *behind = nullptr;
  const Point* begin() const { return first; }
  const Point* end() const { return behind; }
};

Ring ring_of(const ExactPolygons& polygons, std::size_t seed) {
  const Point* const vertices = polygons.vertices.data();
  return {vertices + polygons.offsets[seed], vertices + polygons.offsets[seed + 1]};
}

/// A cell as its row has it: the columns of the cells of diagrams, of polygons.
struct Row {
  std::uint32_t id;
  Point seed;
  const ExactCell& cell;
  Ring polygon;  // empty unless a column needs it
  bool y_up;

  Value extreme(double Point::*along, bool greatest) const {
    Value found;
    for (const Point& vertex : polygon) {
      if (!found || (vertex.*along > *found) == greatest) found = vertex.*along;
    }
    return found;
  }

  Value largest_distance() const {
    Value found;
    for (const Point& vertex : polygon)
      found = std::max(found.value_or(0), std::hypot(vertex.x - seed.x, vertex.y - seed.y));
    return found;
  }

  Value if_full(double value) const { return cell.area > 0 ? Value(value) : Value(); }
};

struct Column {
  Value (*value)(const Row& of);
  bool of_polygon = false;
};

Column column_of(const std::string& name) {
  static const std::map<std::string, Column> columns = {
      {"id", {[](const Row& of) { return Value(of.id); }}},
      {"x", {[](const Row& of) { return Value(of.seed.x); }}},
      {"y", {[](const Row& of) { return Value(of.seed.y); }}},
      {"area", {[](const Row& of) { return Value(of.cell.area); }}},
      {"centroid_x", {[](const Row& of) { return of.if_full(of.cell.centroid.x); }}},
      {"centroid_y", {[](const Row& of) { return of.if_full(of.cell.centroid.y); }}},
      {"left", {[](const Row& of) { return of.extreme(&Point::x, false); }, true}},
      {"top", {[](const Row& of) { return of.extreme(&Point::y, of.y_up); }, true}},
      {"right", {[](const Row& of) { return of.extreme(&Point::x, true); }, true}},
      {"bottom", {[](const Row& of) { return of.extreme(&Point::y, !of.y_up); }, true}},
      {"perimeter", {[](const Row& of) { return Value(of.cell.perimeter); }}},
      {"neighbours", {[](const Row& of) { return Value(of.cell.neighbours); }}},
      {"largest_distance", {[](const Row& of) { return of.largest_distance(); }, true}},
      {"touches_border", {[](const Row& of) { return Value(of.cell.touches_border ? 1 : 0); }}}};
  return columns.at(name);
}

/// The image of a seed that its cell lies around; of a cell without an area one in the period.
Point image_at_cell(Point seed, const ExactCell& cell, const Grid& grid) {
  const auto middle = [](const Axis& axis) { return axis.from() + (axis.to() - axis.from()) / 2; };
  const Point near = cell.area > 0 ? cell.centroid : Point{middle(grid.x()), middle(grid.y())};
  const auto periods = [](const Axis& axis, double way) {
    return axis.is_periodic() ? std::nearbyint(way / (axis.to() - axis.from())) : 0;
  };
  const double rows = periods(grid.y(), near.y - seed.y);
  seed.y += rows * (grid.y().to() - grid.y().from());
  seed.x += rows * grid.tilt();
  seed.x += periods(grid.x(), near.x - seed.x) * (grid.x().to() - grid.x().from());
  return seed;
}

}  // namespace

ExactCellRows::ExactCellRows(const Seeds& seeds, const ExactCellsResult& result, const ExactInput& input,
                             bool y_up)
    : result_(result), input_(input), y_up_(y_up), points_(seeds.read()), cells_(result.read()) {
  const Grid& grid = seeds.grid();
  for (std::size_t seed = 0; seed < cells_.size(); ++seed) {
    std::optional<Point>& point = points_[seed];
    if (point) point = image_at_cell(*point, cells_[seed], grid);
    if (point && (cells_[seed].area > 0 || (grid.x().covers(point->x) && grid.y().covers(point->y))))
      order_.push_back(seed);
  }
  std::sort(order_.begin(), order_.end(),
            [this](std::size_t a, std::size_t b) { return id_of(a) < id_of(b); });
}

const ExactPolygons& ExactCellRows::polygons() {
  if (!polygons_) polygons_ = result_.read_polygons();
  return *polygons_;
}

const std::vector<ExactPair>& ExactCellRows::pairs() {
  if (pairs_) return *pairs_;
  pairs_ = result_.read_pairs();
  if (input_.ids.empty()) return *pairs_;
  for (ExactPair& pair : *pairs_) std::tie(pair.a, pair.b) = std::minmax({id_of(pair.a), id_of(pair.b)});
  std::stable_sort(pairs_->begin(), pairs_->end(), [](const ExactPair& p, const ExactPair& q) {
    return std::tie(p.a, p.b) < std::tie(q.a, q.b);
  });
  return *pairs_;
}

void ExactCellRows::add_cells(GrowingFile& table, const std::string& first,
                              const std::vector<std::string>& names) {
  std::vector<Column> columns;
  columns.reserve(names.size());
  for (const std::string& name : names) columns.push_back(column_of(name));
  const bool need_polygons =
      std::any_of(columns.begin(), columns.end(), [](const Column& column) { return column.of_polygon; });
  const ExactPolygons* const polygons = need_polygons ? &this->polygons() : nullptr;
  add_rows(table, first, order_, [&](RowText& text, std::size_t seed) {
    const Ring ring = polygons != nullptr ? ring_of(*polygons, seed) : Ring();
    const Row row = {id_of(seed), *points_[seed], cells_[seed], ring, y_up_};
    for (const Column& column : columns) text.add(column.value(row));
    if (!kept().fields.empty()) text.add(kept().fields[seed]);
  });
}

void ExactCellRows::add_pairs(GrowingFile& table, const std::string& first) {
  add_rows(table, first, pairs(), [](RowText& text, const ExactPair& pair) {
    text.add(pair.a, pair.b, pair.length, pair.midpoint.x, pair.midpoint.y);
  });
}

void ExactCellRows::write_polygons(const OutputFile& file) {
  std::vector<PolygonCell> cells;
  cells.reserve(order_.size());
  for (const std::size_t seed : order_) {
    const Ring ring = ring_of(polygons(), seed);
    cells.push_back({id_of(seed),
                     *points_[seed],
                     cells_[seed].area,
                     cells_[seed].neighbours,
                     {ring.begin(), ring.end()},
                     kept().fields.empty() ? CsvFields() : kept().fields[seed]});
  }
  const Axis& x = input_.grid.x();
  const bool has_date_line = x.is_periodic() && x.from() == -180 && x.to() == 180;
  command::write_polygons(file, cells, {kept().names, input_.crs, has_date_line});
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

ExactTable exact_cells_table(const std::vector<std::string>& columns) {
  return {columns,
          [columns](ExactCellRows& rows, GrowingFile& table, const std::string& first) {
            rows.add_cells(table, first, columns);
          },
          true};
}

ExactTable exact_pairs_table() {
  return {{"a", "b", "length", "midpoint_x", "midpoint_y"},
          [](ExactCellRows& rows, GrowingFile& table, const std::string& first) {
            rows.add_pairs(table, first);
          }};
}

}  // namespace vorocl::command
