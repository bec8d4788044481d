#include "app/outputs/volume_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>

#include "app/outputs/table_rows.hpp"
#include "vorocl/cells.hpp"

namespace vorocl::command {

namespace {

/// A value of a row; none of a cell without voxels.
using Value = std::optional<double>;

void add_row(fmt::memory_buffer& text, std::initializer_list<Value> values) {
  bool is_first = true;
  for (const Value& value : values) {
    if (!is_first) text.push_back(',');
    is_first = false;
    if (value) add_number(text, *value);
  }
  text.push_back('\n');
}

}  // namespace

void write_volume_cells(const OutputFile& file, const Seeds& seeds, const Diagram& diagram,
                        const AdjacencyResult& pairs) {
  CellSumsResult sums_of_cells;
  CellShapesResult shapes_of_cells;
  cell_sums(diagram, sums_of_cells);
  cell_shapes(diagram, shapes_of_cells);
  const auto places = seeds.read_voxels();
  const auto sums = sums_of_cells.read();
  const auto shapes = shapes_of_cells.read();
  const auto neighbours = pairs.read_neighbours(), surfaces = pairs.read_perimeters();
  std::vector<std::uint32_t> ids;
  for (std::uint32_t id = 0; id < places.size(); ++id) {
    if (places[id]) ids.push_back(id);
  }
  GrowingFile table(file);
  table << "id,x,y,z,volume,centroid_x,centroid_y,centroid_z,left,top,front,right,bottom,back,surface,"
           "neighbours,largest_distance,touches_border\n";
  add_rows(table, ids, [&](fmt::memory_buffer& text, std::uint32_t id) {
    const Point3 seed = *places[id], centroid = sums[id].centroid3();
    const CellShape& shape = shapes[id];
    const auto if_full = [&](double value) { return sums[id].area > 0 ? Value(value) : Value(); };
    const double farthest =
        diagram.metric() == Metric::euclidean ? std::sqrt(shape.largest_distance) : shape.largest_distance;
    add_row(text, {id, seed.x, seed.y, seed.z, sums[id].area, if_full(centroid.x), if_full(centroid.y),
                   if_full(centroid.z), if_full(shape.left), if_full(shape.top), if_full(shape.front),
                   if_full(shape.right), if_full(shape.bottom), if_full(shape.back), surfaces[id],
                   neighbours[id], if_full(farthest), shape.touches_border ? 1 : 0});
  });
  table.finish();
}

void write_volume_pairs(const OutputFile& file, const AdjacencyResult& pairs) {
  GrowingFile table(file);
  table << "a,b,area\n";
  add_rows(table, pairs.read_pairs(), [](fmt::memory_buffer& text, const CellPair& pair) {
    add_row(text, {pair.a, pair.b, pair.length});
  });
  table.finish();
}

}  // namespace vorocl::command
