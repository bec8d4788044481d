// The tables of a plane's cells.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/sources/units.hpp"
#include "formats/output_file.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl::command {

/// Tables as those of cells_kind() and adjacency_kind(), with the columns that are known of a plane's cells,
/// and one row per cell that has pixels. What another run is to go on with are the sums of tiles, in pieces
/// that are appended to a file.
class PlaneTables {
 public:
  /// The files' paths; empty: not asked for. Throws Error if no file can be made there.
  PlaneTables(const std::string& cells, const std::string& adjacency);

  bool is_asked_for() const { return cells_file_ || adjacency_file_; }

  /// Where tiles are summed; null without tables.
  PlaneCells* recent() { return is_asked_for() ? &recent_ : nullptr; }

  /// Begins a file of sums, or goes on behind what was kept of it. `is_complete`: if there is none, the
  /// tables are there already. Throws Error if that fails, or it is no such file.
  void open_part(const std::optional<Kept>& kept, bool is_complete);
  std::string part_path() const { return (cells_file_ ? *cells_file_ : *adjacency_file_).part_path(); }

  /// Makes the disk have the sums so far, and returns the bytes of their file; 0 without one.
  std::size_t sync();

  /// Writes the tables.
  void finish(const Units& units);

 private:
  void read_sums(const std::string& path, std::size_t bytes);

  std::optional<OutputFile> cells_file_, adjacency_file_;
  PlaneCells cells_, recent_;  // those of the tiles before the last sync(), and since
  std::unique_ptr<GrowingFile> sums_;
  bool is_finished_ = false;
};

}  // namespace vorocl::command
