// The files of all frames that a simulation writes: numbered ones of one kind, with the collection that lists
// those that ParaView opens, or one table of that kind; and the table of statistics.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/outputs/diagram_files.hpp"
#include "app/outputs/measures.hpp"
#include "formats/numbered_files.hpp"
#include "formats/raster_files.hpp"
#include "formats/trajectory/trajectory.hpp"

namespace vorocl::command {

/// The collection of .vti, .vtu or .vtp files of this kind: the pattern without its number, as l.pvd for
/// l_%05d.vti, or the option's name where nothing is left. Empty for other files. The path is a NumberedName.
std::string collection_path(const FileRequest& request);

/// Files of one kind. Each numbered file is whole as soon as it is there. A long table has the columns frame
/// and timestep before its own, and grows under a temporary name until finish().
class FrameFiles {
 public:
  /// Throws Error if no file can be made there.
  explicit FrameFiles(const FileRequest& request);

  /// Reads what add() writes, from the device.
  void read(Measures& measures) const { request_.kind.read(measures); }

  /// Writes the file or the rows of a frame, which shows this time. Throws Error for rows in other units than
  /// those of the frames before.
  void add(int frame, std::int64_t time, Measures& measures);

  /// Lists the file of a frame, if an earlier run has left one.
  void pass(int frame, std::int64_t time);

  /// The table; null where there are numbered files.
  GrowingFile* table() const { return table_.get(); }

  /// Where the file of a frame is; empty where there is a table.
  std::string path(int frame) const { return files_ ? files_->path(frame) : std::string(); }

  /// Writes the collection, or gives the table its name.
  void finish();

 private:
  /// Writes the first line of the table, or checks that it is the same in these units. Throws as add().
  void add_header(int frame, const Units& units);
  void list(int frame, std::int64_t time);

  FileRequest request_;
  std::optional<NumberedFiles> files_;
  std::unique_ptr<GrowingFile> table_;
  std::string header_, units_;  // of the table, as the first frame is measured; empty before it
  std::optional<OutputFile> collection_;
  std::vector<TimedFile> listed_;
};

/// A table of the diagrams' statistics, one row per frame.
class FrameStatistics {
 public:
  /// Throws Error if the file cannot be made there.
  explicit FrameStatistics(const std::string& path);

  /// Reads what add() counts, from the device.
  static void read(Measures& measures);

  /// Every frame, in order; `milliseconds` is the device's time for its diagram, `time` and `box` the
  /// trajectory's.
  void add(int frame, std::int64_t time, double milliseconds, const std::optional<Box>& box,
           Measures& measures);

  /// The frame before the first one of the table.
  void pass(Measures& measures);

  GrowingFile* table() const { return file_.get(); }

  void finish() { file_->finish(); }

 private:
  std::unique_ptr<GrowingFile> file_;
  bool has_header_ = false;
  std::vector<std::uint32_t> last_labels_;  // by id, in the picture of the frame before; empty: there is none
};

}  // namespace vorocl::command
