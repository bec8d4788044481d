// How far a run that makes frames has come.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/outputs/journal.hpp"
#include "formats/output_file.hpp"

namespace vorocl::command {

/// A file with a line for each frame that is complete: its numbered files are there, and the tables, which
/// grow under names that stay (see GrowingFile), hold its rows. A run that ends between two frames, or in the
/// middle of one, is continued behind the last line.
class FrameJournal : public Journal {
 public:
  /// Throws Error as Journal.
  FrameJournal(const std::string& path, const std::string& run);

  /// The last frame that is complete; -1: none.
  int last_frame() const { return last_ ? last_->frame : -1; }

  /// What complete() was told of the seeds of that frame.
  std::uint64_t seeds() const { return last_ ? last_->seeds : 0; }

  /// Writes the file if there is none, before any output. Throws Error if that fails, and before if one of
  /// the tables is a pipe or a device, or is there and no journal tells of it.
  void begin(const std::vector<std::string>& tables);

  /// A table of the run, always in the same order. Throws as GrowingFile.
  std::unique_ptr<GrowingFile> open_table(const std::string& path);

  /// All that is written of a frame is there; `seeds` tells them from others. Throws Error if it cannot be
  /// noted.
  void complete(int frame, std::uint64_t seeds);

  /// No frame is to come: the tables may get their names.
  void finish();

 private:
  struct Entry {
    int frame = 0;
    std::uint64_t seeds = 0;
    bool is_last = false;             // no frame is to come
    std::vector<std::size_t> tables;  // their bytes
  };
  Entry entry_of(const std::string& line) const;
  static std::string line_of(const Entry& entry);

  std::optional<Entry> last_;
  std::vector<GrowingFile*> tables_;
};

/// A table of all frames, which another run can continue if there is a journal. Throws Error if it cannot be
/// made there.
std::unique_ptr<GrowingFile> open_table(const std::string& path, FrameJournal* journal);

/// The same with this header.
std::unique_ptr<GrowingFile> open_table(const std::string& path, const std::string& header,
                                        FrameJournal* journal);

/// Whether a run's tables begin with it: no journal tells of complete frames.
bool is_new(const FrameJournal* journal);

}  // namespace vorocl::command
