// What the processes of vorocl-mpi tiles write together.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/mpi/ranks.hpp"
#include "app/outputs/plane_writer.hpp"
#include "app/terminal/samples.hpp"

namespace vorocl::command {

/// Every rank writes its tiles to the same files. Rank 0 makes the files, keeps the journal, sums the cells
/// and gives the files their names; the others tell it what they have written. A journal is always kept, for
/// files that several processes write need a name that all know.
class SharedPlaneWriter {
 public:
  /// Throws Error as PlaneWriter.
  SharedPlaneWriter(const Ranks& ranks, PlaneWriterOptions options, const Tiling& tiling,
                    const std::optional<Georeference>& georeference, const std::string& run);

  /// Collective.
  void begin(const std::string& seeds);

  /// The tiles that an earlier run has completed, on all ranks.
  const std::set<std::uint64_t>& made_before() const { return made_before_; }

  /// Where this rank's tiles are summed; null: nowhere.
  PlaneCells* cells();

  /// Writes a tile.
  void add(const TileLabels& tile);

  /// Notes what this rank has written: after add() alone.
  void checkpoint();

  /// The tiles that rank 0 knows to be written.
  std::uint64_t known() const { return known_; }

  /// Of a run that ends before all tiles are made: what stays of it, for an error.
  std::string kept() const;

  /// When this rank has written its tiles. Rank 0 waits until all have, and the disk has them.
  void end();

  /// On all ranks, after end(): gives the files their names.
  void finish(const Units& units, const EachSeed& seeds);

 private:
  void send(int tag);
  void wait_for_message();
  void receive(const MPI_Status& status);

  MPI_Comm communicator_;
  int rank_, ranks_;
  bool has_tables_;
  std::unique_ptr<PlaneWriter> writer_;  // on rank 0
  std::set<std::uint64_t> made_before_;
  std::uint64_t known_ = 0;

  // On the others:
  std::vector<std::unique_ptr<PlaneFile>> files_;
  PlaneCells cells_;
  std::vector<TileJournal::Entry> entries_;  // that rank 0 does not know yet
  std::vector<char> message_;                // on its way
  MPI_Request sending_ = MPI_REQUEST_NULL;
  Stopwatch stopwatch_;
  double next_checkpoint_ = 0;  // in seconds
};

}  // namespace vorocl::command
