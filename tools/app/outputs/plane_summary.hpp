// What is written of a plane besides its labels: a picture, for people to look at, and the tables of its
// cells.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/sources/plane_input.hpp"
#include "app/sources/view.hpp"
#include "formats/output_file.hpp"
#include "formats/planes/plane_file.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl::command {

/// The longest side of the picture.
constexpr std::int64_t longest_side_of_map = 4096;

/// A picture of a tiling's window in which each pixel stands for a square of the plane's, and has the colour
/// of the one in its middle: that of its seed's id, as in render's pictures. Until it is finished its labels
/// are kept in a file. Throws Error as plane_file().
std::unique_ptr<PlaneFile> plane_map(const std::string& path, const Tiling& tiling);

/// Tables as those of cells_kind() and adjacency_kind(), with the columns that are known of a plane's cells,
/// and one row per cell that has pixels. What another run is to go on with are the sums of tiles, in pieces
/// that are appended to a file.
class PlaneTables {
 public:
  /// The files' paths, empty: not asked for; and the pixels that all cells have together. Throws Error if no
  /// file can be made there.
  PlaneTables(const std::string& cells, const std::string& adjacency, std::uint64_t pixels);

  bool is_asked_for() const { return cells_file_ || adjacency_file_; }

  /// Where tiles are summed; null without tables.
  PlaneCells* recent() { return is_asked_for() ? &recent_ : nullptr; }

  /// Begins a file of sums, or goes on behind what was kept of it. `is_complete`: if there is none, the
  /// tables must be there already. Throws Error if that fails, or it is no such file.
  void open_part(const std::optional<Kept>& kept, bool is_complete);
  std::string part_path() const { return (cells_file_ ? *cells_file_ : *adjacency_file_).part_path(); }

  /// Makes the disk have the sums so far, and returns the bytes of their file; 0 without one.
  std::size_t sync();

  /// Writes the tables. Throws Error if the cells' areas do not add up to the pixels.
  void finish(const Units& units, const EachSeed& seeds);

 private:
  void read_sums(const std::string& path, std::size_t bytes);

  std::optional<OutputFile> cells_file_, adjacency_file_;
  std::uint64_t pixels_;
  PlaneCells cells_, recent_;  // those of the tiles before the last sync(), and since
  std::unique_ptr<GrowingFile> sums_;
  bool is_finished_ = false;
};

}  // namespace vorocl::command
