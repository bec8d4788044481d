// What measures find, on the host at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vorocl/analysis.hpp"
#include "vorocl/similarity.hpp"

namespace vorocl {

/// In percent.
inline double similarity_of(const Diagram& a, const Diagram& b) {
  SimilarityResult result;
  similarity(a, b, result);
  return result.read();
}

inline double similarity_of(const Diagram& a, const Diagram& b, double tolerance) {
  SimilarityResult result;
  similarity(a, b, tolerance, result);
  return result.read();
}

inline std::size_t changed_pixels_of(const Diagram& a, const Diagram& b) {
  SimilarityResult result;
  similarity(a, b, result);
  return result.read_differences();
}

inline DistanceErrors errors_of(const Diagram& diagram, const Diagram& exact) {
  DistanceErrorsResult result;
  distance_errors(diagram, exact, result);
  return result.read();
}

inline std::vector<CellSums> sums_of(const Diagram& diagram) {
  CellSumsResult result;
  cell_sums(diagram, result);
  return result.read();
}

inline std::vector<CellShape> shapes_of(const Diagram& diagram) {
  CellShapesResult result;
  cell_shapes(diagram, result);
  return result.read();
}

inline CellStatistics statistics_of(const Diagram& diagram) {
  CellStatisticsResult result;
  cell_statistics(diagram, result);
  return result.read();
}

inline std::vector<CellPair> pairs_of(const Diagram& diagram) {
  AdjacencyResult result;
  adjacency(diagram, result);
  return result.read_pairs();
}

inline std::vector<Point> vertices_of(const Diagram& diagram) {
  VerticesResult result;
  vertices(diagram, result);
  return result.read();
}

/// The labels' distances as whole numbers.
inline std::vector<std::int32_t> distances_of(const Diagram& diagram) {
  Field<std::int32_t> field;
  distance_field(diagram, field);
  return field.read();
}

}  // namespace vorocl
