// How far a run that makes tiles has come.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/outputs/journal.hpp"
#include "formats/output_file.hpp"
#include "formats/planes/plane_file.hpp"

namespace vorocl::command {

/// A file with the tiles that all outputs hold whole, each with the bytes that it takes in them, and with the
/// bytes of the sums of cells that hold these tiles and no others. A run that ends at any time is continued
/// with the other tiles.
class TileJournal : public Journal {
 public:
  /// Throws Error as Journal.
  TileJournal(const std::string& path, const std::string& run);

  /// Writes the file if there is none, before any output. `parts` are the paths where outputs grow, `seeds`
  /// tells them from others. Throws Error as Journal, and if the seeds are not those of the run that it is
  /// of.
  void begin(const std::vector<std::string>& parts, const std::string& seeds);

  using Journal::is_there;

  /// Whether all tiles are, and the outputs may have their names.
  bool is_complete() const { return is_last_; }

  /// The tiles that are complete, in the order in which they were.
  const std::vector<std::uint64_t>& tiles() const { return tiles_; }

  /// What was kept of an output, by its place in the lists of bytes, and of the sums; none: it begins.
  std::optional<KeptTiles> kept(std::size_t output) const;
  std::optional<Kept> kept_sums() const;

  /// A tile, of each output.
  struct Entry {
    std::uint64_t number = 0;
    std::vector<std::uint64_t> bytes;
  };

  /// All that is written of tiles is there. Throws Error if it cannot be noted.
  void complete(const std::vector<Entry>& entries, std::size_t bytes_of_sums);

  /// No tile is to come: the outputs may get their names.
  void finish();

 private:
  std::string seeds_;
  std::vector<Entry> entries_;
  std::vector<std::uint64_t> tiles_;
  std::size_t bytes_of_sums_ = 0;
  bool is_last_ = false;
};

}  // namespace vorocl::command
