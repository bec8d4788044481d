// What a simulation writes of its frames: a film or numbered pictures, numbered files, tables.
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/outputs/diagram_files.hpp"
#include "app/outputs/painter.hpp"
#include "app/sources/moving_seeds.hpp"
#include "app/terminal/console.hpp"
#include "formats/images/film.hpp"
#include "formats/numbered_files.hpp"
#include "formats/trajectory/trajectory.hpp"
#include "formats/workers.hpp"
#include "vorocl/distance_errors.hpp"

namespace vorocl::command {

struct FrameWriterOptions {
  std::string picture_path;        // empty names: none
  std::vector<FileRequest> files;  // numbered
  std::string similarity_path;
  std::string statistics_path;
  int every = 1;
  double frames_per_second = 25;
  PictureOptions picture;
};

/// The files that it asks for, the collections among them. Throws Error for a pattern without its place for a
/// number.
std::vector<RequestedFile> requested_files(const FrameWriterOptions& options);

/// What a frame is compared with, as a row of a table.
struct FrameSimilarity {
  double percent = 0;
  std::optional<DistanceErrors> errors;
};

/// Throws UsageError if of all these frames none is written.
void check_every(const FrameRange& frames, int every);

/// What is written of a frame besides its diagram.
struct FrameFacts {
  int frame = 0;
  std::int64_t time = 0;    ///< what collections say: the time step of the trajectory, else the frame
  std::string stamp;        ///< what is written into pictures where the options ask for it
  double milliseconds = 0;  ///< of the device, for the diagram
  std::optional<Box> box = std::nullopt;  ///< of the trajectory
  ColumnValues values = {};               ///< those that pictures may show, as in Painter::draw()
  std::optional<FrameSimilarity> similarity = std::nullopt;
};

/// What ended a run before all its frames were made; without a text nothing did.
struct Trouble {
  Trouble() = default;
  explicit Trouble(const std::exception& error)
      : text(message_of(error)), is_of_frame(dynamic_cast<const BadFrame*>(&error) != nullptr) {}

  std::string text;
  bool is_of_frame = false;  ///< in its file, where a run of the others would end too
};

class FrameFiles;
class FrameStatistics;

/// Each numbered file is whole as soon as it is there. The film and the tables grow under temporary names
/// until finish(); without it, they do not stay.
///
/// Frames are written in order by a thread of its own, behind the caller, who can make the next one
/// meanwhile. It holds one frame at most, and none behind one that failed.
class FrameWriter {
 public:
  /// Throws UsageError for names that are not possible, Error if no files can be made there.
  /// `with_errors`: errors are written beside the similarities.
  explicit FrameWriter(const FrameWriterOptions& options, bool with_errors = false);
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Whether add() writes anything of this frame's diagram.
  bool wants(int frame) const { return statistics_ || wants_images(frame); }

  /// Reads what is written of a frame from the device, waits until the frame before is written, and returns.
  /// `measures`, of a frame that it wants, stay until this one is. Throws what went wrong with a frame
  /// before, each time from then on.
  void add(FrameFacts facts, const std::shared_ptr<Measures>& measures);

  /// Waits until all frames are written. Throws what went wrong.
  void wait() { behind_.wait(); }

  /// Whether pass() needs the diagram of a frame before the `first` one of the run.
  bool needs_diagram(int frame, int first) const;

  /// A frame before the first one of the run, in order: what is written of later ones follows from it.
  /// `measures` are null if it needs none.
  void pass(const FrameFacts& facts, Measures* measures);

  /// The frames that are complete, once wait() has ended, also where it threw.
  int complete() const { return complete_; }

  /// "; frames complete before that: 3, written of them: 2", for the error that ended a run.
  std::string progress() const;

  /// After wait(), also where that threw: gives the film and the tables, with the rows of complete frames,
  /// their names, and lists the numbered files. Throws Error if one could not be written whole; the others
  /// are.
  void finish();

  /// finish(), of a run of these frames. If trouble ended it, throws Error that says what did, how far it
  /// came and what makes the others; or that no frame was to be written.
  void end_run(const Trouble& trouble, const FrameRange& frames);

 private:
  void open_files();
  bool wants_images(int frame) const;
  void read(int frame, Measures& measures) const;
  void write(const FrameFacts& facts, Measures* measures);
  void write_images(const FrameFacts& facts, Measures& measures);
  void write_similarity(int frame, const FrameSimilarity& similarity);
  void mark_tables();

  FrameWriterOptions options_;
  Painter painter_;
  std::optional<Film> film_;
  std::optional<NumberedFiles> pictures_;
  std::vector<std::unique_ptr<FrameFiles>> files_;
  std::unique_ptr<GrowingFile> similarities_;
  std::unique_ptr<FrameStatistics> statistics_;
  std::vector<GrowingFile*> tables_;  // of all these
  int complete_ = 0, frames_ = 0;
  Workers behind_{1};  // the last member: its thread ends before what it writes goes
};

}  // namespace vorocl::command
