// The files that exact cells are written to: tables with the columns of diagrams' cells, and polygons.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/output_file.hpp"
#include "vorocl/exact_cells.hpp"

namespace vorocl::command {

/// Exact cells by the ids that files have, read once for all files.
class ExactCellRows {
 public:
  /// `ids` says what files call each seed; empty: their indices. Waits; throws as the library.
  ExactCellRows(const Seeds& seeds, const ExactCellsResult& result, std::vector<std::uint32_t> ids);

  /// One row per cell, by id, with these columns: some of cell_columns(). Seeds outside the rectangle
  /// have one only if their cells reach into it. A field is empty where an empty cell has no value.
  void write_cells(const OutputFile& file, const std::vector<std::string>& columns) const;

  /// One row per edge between two cells, a <= b: its length and its middle.
  void write_pairs(const OutputFile& file) const;

  /// The same cells as polygons: see polygon_files.hpp.
  void write_polygons(const OutputFile& file) const;

  std::size_t cells() const { return order_.size(); }
  std::size_t empty_cells() const;
  std::size_t pairs() const { return pairs_.size(); }
  double mean_area() const;
  double area_deviation() const;

 private:
  std::uint32_t id_of(std::size_t seed) const {
    return ids_.empty() ? static_cast<std::uint32_t>(seed) : ids_.at(seed);
  }
  std::vector<Point> polygon_of(std::size_t seed) const;

  std::vector<std::uint32_t> ids_;
  std::vector<std::optional<Point>> points_;
  std::vector<ExactCell> cells_;
  std::vector<ExactPair> pairs_;
  ExactPolygons polygons_;
  std::vector<std::size_t> order_;  // of the seeds that have rows, by id
};

}  // namespace vorocl::command
