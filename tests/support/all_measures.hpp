// All measures of a diagram, taken into results of its own and read when wanted, as numbers that can be
// compared.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "vorocl/vorocl.hpp"

namespace vorocl {

/// Numbers of all kinds in a row; NaN, which equals nothing, as -1e9.
class Numbers {
 public:
  template <typename... Values>
  void add(const Values&... values) {
    (all_.push_back(std::isnan(static_cast<double>(values)) ? -1e9 : static_cast<double>(values)), ...);
  }
  template <typename T>
  void add_all(const std::vector<T>& values) {
    add(values.size());
    for (const T& value : values) add(value);
  }
  const std::vector<double>& all() const { return all_; }

 private:
  std::vector<double> all_;
};

/// Every measure that enqueues and returns, of a diagram and of how it stands to an exact one. Only planes
/// without an axis that is spaced have vertices.
class AllMeasures {
 public:
  void take(const Diagram& diagram, const Diagram& exact) {
    const Grid& grid = diagram.window().grid();
    cell_sums(diagram, sums_);
    cell_shapes(diagram, shapes_);
    cell_statistics(diagram, statistics_);
    adjacency(diagram, adjacency_);
    if (grid.z().pixels() == 1 && grid.x().spacing() * grid.y().spacing() == 1) vertices(diagram, vertices_);
    distance_field(diagram, squares_);
    distance_field(diagram, distances_);
    border_mask(diagram, mask_);
    map_labels(diagram, std::vector<std::uint32_t>(sums_.size(), 7), mapped_);
    expand_labels(diagram, 5, expanded_);
    similarity(diagram, exact, same_labels_);
    similarity(diagram, exact, 0.5, same_distances_);
    distance_errors(diagram, exact, errors_);
  }

  std::vector<double> read() const {
    Numbers numbers;
    add_those_of_cells(numbers);
    for (const Point& vertex : vertices_.read()) numbers.add(vertex.x, vertex.y);
    numbers.add_all(squares_.read());
    numbers.add_all(mask_.read());
    numbers.add(same_labels_.read(), same_labels_.read_differences(), same_distances_.read());
    const DistanceErrors errors = errors_.read();
    numbers.add(errors.pixels, errors.wrong_pixels, errors.unlabelled_pixels, errors.largest_excess,
                errors.mean_excess);
    return numbers.all();
  }

  /// Those that ask which seed a label names.
  std::vector<double> read_of_cells() const {
    Numbers numbers;
    add_those_of_cells(numbers);
    return numbers.all();
  }

 private:
  void add_those_of_cells(Numbers& numbers) const {
    for (const CellSums& cell : sums_.read()) numbers.add(cell.area, cell.sum_x, cell.sum_y);
    for (const CellShape& cell : shapes_.read()) {
      numbers.add(cell.left, cell.top, cell.right, cell.bottom, cell.largest_distance, cell.touches_border);
    }
    const CellStatistics statistics = statistics_.read();
    numbers.add(statistics.cells, statistics.empty_cells, statistics.pixels, statistics.area_deviation);
    numbers.add_all(statistics_.read_areas());
    for (const CellPair& pair : adjacency_.read_pairs()) numbers.add(pair.a, pair.b, pair.length);
    numbers.add_all(adjacency_.read_neighbours());
    numbers.add_all(adjacency_.read_perimeters());
    numbers.add_all(distances_.read());
    numbers.add_all(mapped_.read());
    numbers.add_all(expanded_.read());
  }

  CellSumsResult sums_;
  CellShapesResult shapes_;
  CellStatisticsResult statistics_;
  AdjacencyResult adjacency_;
  VerticesResult vertices_;
  Field<std::int32_t> squares_;
  Field<float> distances_;
  Field<std::uint8_t> mask_;
  Field<std::uint32_t> mapped_, expanded_;
  SimilarityResult same_labels_, same_distances_;
  DistanceErrorsResult errors_;
};

/// The table of cells, which waits by itself.
inline std::vector<double> table_of(const Diagram& diagram) {
  Numbers numbers;
  for (const CellRow& row : cell_table(diagram)) {
    numbers.add(row.id, row.seed.x, row.seed.y, row.pixels, row.area, row.centroid.x, row.centroid.y,
                row.touches_border, row.neighbours);
  }
  return numbers.all();
}

}  // namespace vorocl
