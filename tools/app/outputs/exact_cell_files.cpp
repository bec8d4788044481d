#include "app/outputs/exact_cell_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "formats/polygon_files.hpp"

namespace vorocl::command {

namespace {

using Value = std::optional<double>;

/// A cell as its row has it: the columns of the cells of diagrams, of polygons.
struct Row {
  std::uint32_t id;
  Point seed;
  const ExactCell& cell;
  const std::vector<Point>& polygon;

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

  Value if_full(double value) const { return polygon.empty() ? Value() : Value(value); }
};

Value value_of(const Row& row, const std::string& column) {
  static const std::map<std::string, Value (*)(const Row&)> columns = {
      {"id", [](const Row& of) { return Value(of.id); }},
      {"x", [](const Row& of) { return Value(of.seed.x); }},
      {"y", [](const Row& of) { return Value(of.seed.y); }},
      {"area", [](const Row& of) { return Value(of.cell.area); }},
      {"centroid_x", [](const Row& of) { return of.if_full(of.cell.centroid.x); }},
      {"centroid_y", [](const Row& of) { return of.if_full(of.cell.centroid.y); }},
      {"left", [](const Row& of) { return of.extreme(&Point::x, false); }},
      {"top", [](const Row& of) { return of.extreme(&Point::y, true); }},
      {"right", [](const Row& of) { return of.extreme(&Point::x, true); }},
      {"bottom", [](const Row& of) { return of.extreme(&Point::y, false); }},
      {"perimeter", [](const Row& of) { return Value(of.cell.perimeter); }},
      {"neighbours", [](const Row& of) { return Value(of.cell.neighbours); }},
      {"largest_distance", [](const Row& of) { return of.largest_distance(); }},
      {"touches_border", [](const Row& of) { return Value(of.cell.touches_border ? 1 : 0); }}};
  return columns.at(column)(row);
}

}  // namespace

ExactCellRows::ExactCellRows(const Seeds& seeds, const ExactCellsResult& result,
                             std::vector<std::uint32_t> ids)
    : ids_(std::move(ids)),
      points_(seeds.read()),
      cells_(result.read()),
      pairs_(result.read_pairs()),
      polygons_(result.read_polygons()) {
  const Grid& grid = seeds.grid();
  for (std::size_t seed = 0; seed < cells_.size(); ++seed) {
    const std::optional<Point>& point = points_[seed];
    if (point && (cells_[seed].area > 0 || (grid.x().covers(point->x) && grid.y().covers(point->y))))
      order_.push_back(seed);
  }
  if (ids_.empty()) return;
  std::sort(order_.begin(), order_.end(), [this](std::size_t a, std::size_t b) { return ids_[a] < ids_[b]; });
  for (ExactPair& pair : pairs_) std::tie(pair.a, pair.b) = std::minmax({ids_[pair.a], ids_[pair.b]});
  std::stable_sort(pairs_.begin(), pairs_.end(), [](const ExactPair& p, const ExactPair& q) {
    return std::tie(p.a, p.b) < std::tie(q.a, q.b);
  });
}

std::vector<Point> ExactCellRows::polygon_of(std::size_t seed) const {
  const auto first = polygons_.vertices.begin();
  return {first + polygons_.offsets[seed], first + polygons_.offsets[seed + 1]};
}

void ExactCellRows::write_cells(const OutputFile& file, const std::vector<std::string>& columns) const {
  GrowingFile table(file);
  table << fmt::format("{}\n", fmt::join(columns, ","));
  fmt::memory_buffer text;
  for (const std::size_t seed : order_) {
    text.clear();
    const std::vector<Point> polygon = polygon_of(seed);
    const Row row = {id_of(seed), *points_[seed], cells_[seed], polygon};
    for (const std::string& column : columns) {
      if (&column != columns.data()) text.push_back(',');
      if (const Value value = value_of(row, column)) fmt::format_to(std::back_inserter(text), "{}", *value);
    }
    text.push_back('\n');
    table << std::string_view(text.data(), text.size());
  }
  table.finish();
}

void ExactCellRows::write_pairs(const OutputFile& file) const {
  GrowingFile table(file);
  table << "a,b,length,midpoint_x,midpoint_y\n";
  for (const ExactPair& pair : pairs_) {
    table << fmt::format("{},{},{},{},{}\n", pair.a, pair.b, pair.length, pair.midpoint.x, pair.midpoint.y);
  }
  table.finish();
}

void ExactCellRows::write_polygons(const OutputFile& file) const {
  std::vector<PolygonCell> cells;
  cells.reserve(order_.size());
  for (const std::size_t seed : order_) {
    cells.push_back(
        {id_of(seed), *points_[seed], cells_[seed].area, cells_[seed].neighbours, polygon_of(seed)});
  }
  command::write_polygons(file, cells);
}

std::size_t ExactCellRows::empty_cells() const {
  return static_cast<std::size_t>(std::count_if(order_.begin(), order_.end(),
                                                [this](std::size_t seed) { return cells_[seed].area == 0; }));
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

}  // namespace vorocl::command
