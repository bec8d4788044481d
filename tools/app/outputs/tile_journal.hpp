// The file beside the outputs of a run that makes tiles. It says how far the run has come, so that another
// can go on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "formats/output_file.hpp"
#include "formats/planes/plane_file.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

/// A lock on a file, which goes with the process.
class FileLock {
 public:
  FileLock() = default;
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  /// Locks the file that has this name, and lets go of the one before. False if another run has it. Where a
  /// file system has no locks, there is none.
  bool take(const std::string& path);

 private:
  int descriptor_ = -1;
};

/// What the run is, in lines, and behind them the tiles that all outputs hold whole, each with the bytes that
/// it takes in them, and with the bytes of the sums of cells that hold these tiles and no others. Each line
/// ends with a checksum of itself and of all lines before it, so that what is left after damage is no
/// journal, or the beginning of the one that was there.
class TileJournal {
 public:
  /// `run` says what the run is. Reads the file, if there is one. Throws Error if it is of another run,
  /// damaged, or no journal, or if a run that still goes on writes it.
  TileJournal(const std::string& path, const std::string& run);

  const std::string& path() const { return path_; }

  /// Writes the file if there is none, before any output. `parts` are the paths where outputs grow, `seeds`
  /// tells them from others. One that is there stays as it is until tiles are complete. Throws Error if
  /// writing fails or the seeds are not those of the run that it is of, and before if an output is there that
  /// no journal tells of.
  void begin(const std::vector<std::string>& parts, const std::string& seeds);

  /// What was kept of an output, by its place in the lists of bytes, and of the sums; none: it begins.
  std::optional<KeptTiles> kept(std::size_t output) const;
  std::optional<Kept> kept_sums() const;

  /// Calls a function that opens an output. Its errors say how to start again, unless the run begins.
  void open(const std::function<void()>& output) const;

  /// A tile, of each output.
  struct Entry {
    std::uint64_t number = 0;
    std::vector<std::uint64_t> bytes;
  };

  /// The tiles that are complete, in the order in which they were.
  const std::vector<Entry>& tiles() const { return tiles_; }

  /// All that is written of tiles is there. Throws Error if it cannot be noted.
  void complete(const std::vector<Entry>& entries, std::size_t bytes_of_sums);

  /// No tile is to come: the outputs may get their names.
  void finish();

  /// When the outputs have their names.
  void remove();

 private:
  void read();
  void read_tiles();
  void append(const std::vector<std::string>& lines);
  void lock();
  [[noreturn]] void refuse_other() const;
  [[noreturn]] void refuse(const std::string& what) const;
  [[noreturn]] void refuse_run(const std::string& there, const std::string& here) const;

  std::string path_, run_;
  bool is_there_ = false;
  std::vector<std::string> steps_;  // the lines that were there behind those of the run
  std::string seeds_;
  std::vector<Entry> tiles_;
  std::size_t bytes_of_sums_ = 0;
  bool is_last_ = false;
  std::size_t bytes_ = 0;  // of the lines that count
  Hash hash_;              // of these lines
  FileLock lock_;          // while the run goes on
};

/// The path of the journal of a run whose first output this is.
std::string journal_path(const std::string& output);

/// Throws Error if there is a journal, for a run without --resume: it must not take the place of one that can
/// go on.
void refuse_journal(const std::string& path);

}  // namespace vorocl::command
