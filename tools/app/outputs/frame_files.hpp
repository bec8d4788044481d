// The files of one kind that a simulation writes: numbered ones, with the collection that lists those that
// ParaView opens, or one table of all frames.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/outputs/diagram_files.hpp"
#include "app/outputs/frame_journal.hpp"
#include "formats/numbered_files.hpp"
#include "formats/vtk.hpp"

namespace vorocl::command {

/// The collection of .vti files of this kind: the pattern without its number, as l.pvd for l_%05d.vti, or the
/// option's name where nothing is left. Empty for other files. The path is a NumberedName.
std::string collection_path(const FileRequest& request);

/// Each numbered file is whole as soon as it is there. A long table has the columns frame and timestep before
/// its own, and grows under a temporary name until finish().
class FrameFiles {
 public:
  /// Throws Error if no file can be made there. With a journal, the table can be continued.
  explicit FrameFiles(const FileRequest& request, FrameJournal* journal = nullptr);

  /// Writes the file or the rows of a frame, which shows this time.
  void add(int frame, std::int64_t time, Measures& measures);

  /// As add(), of a frame whose file is there.
  void go_on_from(int frame, std::int64_t time);

  /// Where the file of a frame is; empty where there is a table.
  std::string path(int frame) const { return files_ ? files_->path(frame) : std::string(); }

  /// Writes the collection, or gives the table its name.
  void finish();

 private:
  FileRequest request_;
  std::optional<NumberedFiles> files_;
  std::unique_ptr<GrowingFile> table_;
  std::optional<OutputFile> collection_;
  std::vector<TimedFile> listed_;
};

}  // namespace vorocl::command
