// What a simulation writes of its frames: a film or numbered pictures, numbered labels, similarities.
#pragma once

#include <CLI/CLI.hpp>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "film.hpp"
#include "numbered_files.hpp"
#include "painter.hpp"
#include "vorocl/distance_errors.hpp"

namespace vorocl::command {

struct FrameWriterOptions {
  std::string picture_path;  // empty names: none
  std::string labels_path;
  std::string similarity_path;
  int every = 1;
  double frames_per_second = 25;
  PictureOptions picture;
};

/// Adds -o, --labels, --similarity, --every, --fps and how pictures are drawn.
void add_frame_writer_options(CLI::App& app, FrameWriterOptions& options);

/// Each numbered file is whole as soon as it is there. The film and the similarities grow under temporary
/// names until finish(); without it, they do not stay.
class FrameWriter {
 public:
  /// Throws UsageError for names that cannot be meant, Error if no files can be made there.
  /// `with_errors`: errors are written beside the similarities.
  FrameWriter(const FrameWriterOptions& options, Metric metric, bool with_errors = false);
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Whether the images of this frame are to be written.
  bool wants(int frame) const;

  void add(int frame, const Scene& scene);
  void add_similarity(int frame, double percent, const std::optional<DistanceErrors>& errors);

  /// The frames whose images are written.
  int frames() const { return frames_; }

  /// Gives the film and the similarities their names. Throws Error if one was not written whole.
  void finish();

 private:
  FrameWriterOptions options_;
  Painter painter_;
  std::optional<Film> film_;
  std::optional<NumberedFiles> pictures_;
  std::optional<NumberedFiles> labels_;
  std::optional<OutputFile> similarity_file_;
  std::ofstream similarities_;
  int frames_ = 0;
};

}  // namespace vorocl::command
