// What vorocl tiles writes: labels, distances, a picture, tables; and how it goes on with an earlier run.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/outputs/output_files.hpp"
#include "app/outputs/tile_journal.hpp"
#include "app/sources/plane_input.hpp"
#include "app/terminal/samples.hpp"
#include "formats/planes/plane_file.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl::command {

/// Checkpoints are made so rarely that they take a tenth of the time.
constexpr double time_between_checkpoints = 10;

struct PlaneWriterOptions {
  std::string labels;  // empty names: none
  std::string distances;
  std::string picture;
  std::string cells;
  std::string adjacency;
  bool resume = false;
};

/// The files that it asks for. The first one gives the journal its name.
std::vector<RequestedFile> requested_files(const PlaneWriterOptions& options);

/// Whether the journal of an earlier run is there. Throws Error then, unless the run is to go on with that.
void check_journal(const PlaneWriterOptions& options);

/// The files that hold tiles, as far as they are asked for.
std::vector<std::unique_ptr<PlaneFile>> plane_files(const PlaneWriterOptions& options, const Tiling& tiling,
                                                    const std::optional<Georeference>& georeference);

/// The longest side of the picture.
constexpr std::int64_t longest_side_of_map = 4096;

/// A picture of a tiling's window in which each pixel stands for a square of the plane's, and has the colour
/// of the one in its middle: that of its seed's id, as in render's pictures. Until it is finished its labels
/// are kept in a file. Throws Error as plane_file().
std::unique_ptr<PlaneFile> plane_map(const std::string& path, const Tiling& tiling);

class PlaneTables;

/// The outputs of a run. They have their names when finish() is through; without it nothing stays of them,
/// unless the run can be resumed.
class PlaneWriter {
 public:
  /// `run` says in lines what is written, for runs that can be resumed. Throws Error if there is a journal of
  /// another run, or where no files can be made.
  PlaneWriter(const PlaneWriterOptions& options, const Tiling& tiling,
              const std::optional<Georeference>& georeference, const std::string& run);
  ~PlaneWriter();
  PlaneWriter(const PlaneWriter&) = delete;
  PlaneWriter& operator=(const PlaneWriter&) = delete;

  /// Begins the files, or goes on with those of an earlier run. `seeds` tells these from others. Throws Error
  /// if that run had others, or if its files are not as it has left them.
  void begin(const std::string& seeds);

  /// The tiles that an earlier run has completed.
  const std::set<std::uint64_t>& made_before() const { return made_before_; }

  /// The next tile to make; none at the end.
  std::optional<std::uint64_t> next();

  /// Where tiles are summed that are to be added then; null: nowhere.
  PlaneCells* cells();

  /// Writes a tile, and notes now and then in the journal which are complete.
  void add(const TileLabels& tile);

  /// Notes it now: after add() alone, for cells() hold the tile that is to be added next as soon as it is
  /// made.
  void checkpoint();

  /// Notes tiles that another process has written, with the sums of their cells (PlaneCells::take()).
  void add(const std::vector<TileJournal::Entry>& entries, const std::vector<char>& sums);

  /// Of a run that ends before all tiles are made: what stays of it, for an error.
  std::string kept() const;

  /// Gives the files their names.
  void finish(const Units& units, const EachSeed& seeds);

 private:
  /// The outputs' paths while they grow.
  std::vector<std::string> part_paths() const;

  Tiling tiling_;
  std::unique_ptr<TileJournal> journal_;
  std::vector<std::unique_ptr<PlaneFile>> files_;
  std::unique_ptr<PlaneTables> tables_;
  std::set<std::uint64_t> made_before_;
  std::uint64_t next_ = 0;
  std::size_t complete_ = 0;                 // tiles that the journal knows
  std::vector<TileJournal::Entry> entries_;  // of tiles that the journal does not know yet
  Stopwatch stopwatch_;
  double next_checkpoint_ = 0;  // in seconds
};

}  // namespace vorocl::command
