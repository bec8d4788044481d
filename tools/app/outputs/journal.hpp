// The file beside the outputs of a run that says how far it has come, so that another run can go on.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

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

/// What the run is, in lines, and behind them a line for each step that is complete: see TileJournal. Each
/// line ends with a checksum of itself and of all lines before it, so that what is left after damage is no
/// journal, or the beginning of the one that was there.
class Journal {
 public:
  const std::string& path() const { return path_; }

  /// Calls a function that opens an output. Its errors say how to start again, unless the run begins.
  void open(const std::function<void()>& output) const;

  /// When the outputs have their names.
  void remove();

 protected:
  /// `run` says what the run is. Reads the file, if there is one. Throws Error if it is of another run,
  /// damaged, or no journal, or if a run that still goes on writes it.
  Journal(const std::string& path, const std::string& run);
  ~Journal() = default;

  bool is_there() const { return is_there_; }

  /// The lines that were there behind those of the run.
  const std::vector<std::string>& steps() const { return steps_; }

  /// Writes the file with these steps, if there is none. One that is there stays as it is until lines are
  /// added, which go behind these, the first of its steps, in place of what follows them. Throws Error if
  /// writing fails, and before if an output is there that no journal tells of.
  void begin(const std::vector<std::string>& outputs, const std::vector<std::string>& steps);

  /// Adds lines behind all that count, all or none. Throws Error if that fails.
  void append(const std::vector<std::string>& lines);

  [[noreturn]] void refuse_damage() const;
  [[noreturn]] void refuse_run(const std::string& there, const std::string& here) const;

 private:
  void read();
  std::vector<std::string> read_sealed_lines();
  void lock();
  [[noreturn]] void refuse_other() const;

  std::string path_, run_;
  bool is_there_ = false;
  std::vector<std::string> steps_;
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
