// What a simulation writes of its frames: a film or numbered pictures, numbered files, tables.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/outputs/diagram_files.hpp"
#include "app/outputs/frame_files.hpp"
#include "app/outputs/frame_statistics.hpp"
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
};

/// Adds -o, with a help text, --fps and how pictures are drawn.
void add_film_options(CLI::App& app, FrameWriterOptions& options, const std::string& about);

/// Adds all that, the numbered files, --similarity, --statistics and --every.
void add_frame_writer_options(CLI::App& app, FrameWriterOptions& options);

/// The paths that were asked for.
std::vector<NamedOutput> outputs_of(const FrameWriterOptions& options);

/// What a frame is apart from its diagram.
struct FrameFacts {
  int frame = 0;
  std::int64_t time = 0;    ///< what collections say: the time step of the trajectory, else the frame
  double milliseconds = 0;  ///< of the device, for the diagram
};

/// Each numbered file is whole as soon as it is there. The film and the tables grow under temporary names
/// until finish(); without it, they do not stay.
class FrameWriter {
 public:
  /// Throws UsageError for names that cannot be meant, Error if no files can be made there.
  /// `with_errors`: errors are written beside the similarities.
  explicit FrameWriter(const FrameWriterOptions& options, bool with_errors = false);

  /// Whether anything of this frame's diagram is to be written.
  bool wants(int frame) const { return statistics_ || wants_images(frame); }

  /// `values` are those that pictures may show, as in Painter::draw().
  void add(const FrameFacts& facts, Analysis& analysis, const std::vector<double>& values);
  void add_similarity(int frame, double percent, const std::optional<DistanceErrors>& errors);

  /// The frames whose images are written.
  int frames() const { return frames_; }

  /// Gives the film and the tables their names, and lists the numbered files. Throws Error if one was not
  /// written whole.
  void finish();

 private:
  bool wants_images(int frame) const;
  void write_images(const FrameFacts& facts, Analysis& analysis, const std::vector<double>& values);

  FrameWriterOptions options_;
  Painter painter_;
  std::optional<Film> film_;
  std::optional<NumberedFiles> pictures_;
  std::vector<std::unique_ptr<FrameFiles>> files_;
  std::optional<GrowingFile> similarities_;
  std::optional<FrameStatistics> statistics_;
  int frames_ = 0;
};

}  // namespace vorocl::command
