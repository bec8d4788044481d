// The files that exact cells are written to: tables with the columns of diagrams' cells, polygons and
// polyhedra.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/sources/exact_input.hpp"
#include "formats/output_file.hpp"
#include "vorocl/exact_cells.hpp"

namespace vorocl::command {

/// Along x, y and z.
using PeriodCounts = std::array<std::int32_t, 3>;

/// Exact cells by the ids that files have. What is asked for is read once, when it is first asked for.
class ExactCellRows {
 public:
  /// Keeps references to the result, the input, which the seeds are of, and the options that asked for it.
  /// Waits; throws as the library, as do its functions.
  ExactCellRows(const Seeds& seeds, const ExactCellsResult& result, const Input& input,
                const SeedOptions& options);

  /// One row per cell, by id, with these columns: some of cell_columns(). Seeds outside the rectangle
  /// have one only if their cells reach into it. A field is empty where an empty cell has no value. `first`
  /// stands before each row.
  void add_cells(GrowingFile& table, const std::string& first, const std::vector<std::string>& columns);

  /// One row per edge between two cells, a <= b: its length and its middle. Of a volume one per face: its
  /// area, and the image of b behind it, of the points as rows of cells have them.
  void add_pairs(GrowingFile& table, const std::string& first);

  /// The same cells as polygons or polyhedra: see polygon_files.hpp.
  void write_polygons(const OutputFile& file);

  const KeptColumns& kept() const { return input_.kept; }
  std::size_t cells() const { return order_.size(); }
  std::size_t empty_cells() const;
  std::size_t uncertified() const;
  std::size_t pair_count() { return is_volume() ? faces().size() : pairs().size(); }
  double mean_area() const;
  double area_deviation() const;

 private:
  std::uint32_t id_of(std::size_t seed) const {
    return input_.ids.empty() ? static_cast<std::uint32_t>(seed) : input_.ids.at(seed);
  }
  bool is_volume() const { return input_.view.is_volume(); }
  const std::vector<ExactPair>& pairs();
  const std::vector<ExactFace>& faces();
  const ExactPolygons& polygons();
  const ExactPolyhedra& polyhedra();

  const ExactCellsResult& result_;
  const Input& input_;
  const SeedOptions& options_;
  std::vector<std::optional<Point>> points_;
  std::vector<ExactCell> cells_;
  std::vector<PeriodCounts> periods_;  // from the seeds' points to the images that their cells lie around
  std::optional<std::vector<ExactPair>> pairs_;
  std::optional<std::vector<ExactFace>> faces_;
  std::optional<ExactPolygons> polygons_;
  std::optional<ExactPolyhedra> polyhedra_;
  std::vector<std::size_t> order_;  // of the seeds that have rows
};

/// A table of exact cells: the names of its columns, and its rows, each with `first` before it.
struct ExactTable {
  std::vector<std::string> columns;
  std::function<void(ExactCellRows& rows, GrowingFile& table, const std::string& first)> add_rows;
  bool of_cells = false;

  /// The first line, with these columns of the input behind the table's.
  std::string header(const KeptColumns& kept = {}) const;

  /// Writes the table of one frame. Throws Error if that fails.
  void write(const OutputFile& file, ExactCellRows& rows) const;
};

/// The tables of the rows that ExactCellRows has, with the columns that were chosen: see chosen_columns().
ExactTable exact_cells_table(const std::vector<std::string>& chosen, bool of_volume);
ExactTable exact_pairs_table(bool of_volume);

/// Throws UsageError for a file of polygons that is to have polyhedra, or the other way round.
void check_polygons(const std::string& path, bool of_volume);

}  // namespace vorocl::command
