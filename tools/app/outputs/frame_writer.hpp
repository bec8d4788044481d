// What a simulation writes of its frames: a film or numbered pictures, numbered files, tables.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/outputs/diagram_files.hpp"
#include "app/outputs/frame_files.hpp"
#include "app/outputs/painter.hpp"
#include "formats/images/film.hpp"
#include "formats/numbered_files.hpp"
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
  bool resume = false;
};

/// The files that it asks for, the collections among them. Throws Error for a pattern without its place for a
/// number.
std::vector<RequestedFile> requested_files(const FrameWriterOptions& options);

/// What is written of a frame besides its diagram.
struct FrameFacts {
  int frame = 0;
  std::int64_t time = 0;    ///< what collections say: the time step of the trajectory, else the frame
  std::string stamp;        ///< what is written into pictures where the options ask for it
  double milliseconds = 0;  ///< of the device, for the diagram
  std::optional<Box> box = std::nullopt;  ///< of the trajectory
};

/// Each numbered file is whole as soon as it is there. The film and the tables grow under temporary names
/// until finish(); without it, they do not stay, unless the run can be resumed.
class FrameWriter {
 public:
  /// Throws UsageError for names that are not possible, Error if no files can be made there.
  /// `with_errors`: errors are written beside the similarities. `run` says in lines what is written, for runs
  /// that can be resumed: Error if there is a journal of another one, or a file is missing that it names.
  explicit FrameWriter(const FrameWriterOptions& options, bool with_errors = false,
                       const std::string& run = "");

  /// Whether add() writes anything of this frame's diagram.
  bool wants(int frame) const { return statistics_ || wants_images(frame); }

  /// `values` are those that pictures may show, as in Painter::draw().
  void add(const FrameFacts& facts, Measures& measures, const std::vector<double>& values);
  void add_similarity(int frame, double percent, const std::optional<DistanceErrors>& errors);

  /// How far an earlier run came, if this one goes on with it; null: it cannot be resumed.
  FrameJournal* journal() const { return journal_.get(); }

  /// Whether go_on_from() needs the diagram of a frame that is complete.
  bool needs_diagram(int frame) const;

  /// As add(), of a frame that is complete: writes nothing. `measures` are null if it needs none.
  void go_on_from(const FrameFacts& facts, Measures* measures, const std::vector<double>& values);

  /// The frames whose images are written.
  int frames() const { return frames_; }

  /// Gives the film and the tables their names, and lists the numbered files. Throws Error if one was not
  /// written whole.
  void finish();

 private:
  void open_files();
  void check_written() const;
  bool wants_images(int frame) const;
  void write_images(const FrameFacts& facts, Measures& measures, const std::vector<double>& values);

  FrameWriterOptions options_;
  Painter painter_;
  std::unique_ptr<FrameJournal> journal_;
  std::optional<Film> film_;
  std::optional<NumberedFiles> pictures_;
  std::vector<std::unique_ptr<FrameFiles>> files_;
  std::unique_ptr<GrowingFile> similarities_;
  std::optional<FrameStatistics> statistics_;
  int frames_ = 0;
};

}  // namespace vorocl::command
