#include "app/outputs/frame_writer.hpp"

#include <fmt/format.h>

#include "app/terminal/console.hpp"
#include "app/terminal/usage_error.hpp"
#include "formats/files.hpp"
#include "formats/images/pictures.hpp"

namespace vorocl::command {

namespace {

const std::string film_extension = ".mp4";

/// A film's sides are even.
void note_of_size(const Film& film, const cv::Size& picture) {
  const cv::Size size = film_size(picture);
  if (size == picture) return;
  print_note(
      fmt::format("{}: a film's sides are even, so {} x {} has become {} x {} by repeating the last {}",
                  film.path(), picture.width, picture.height, size.width, size.height,
                  picture.width % 2 == 0    ? "row"
                  : picture.height % 2 == 0 ? "column"
                                            : "row and column"));
}

}  // namespace

std::vector<RequestedFile> requested_files(const FrameWriterOptions& options) {
  std::vector<RequestedFile> files;
  for (const FileRequest& request : options.files) {
    files.push_back(requested_of_frames(request));
    files.push_back({request.kind.option, collection_path(request), {".pvd"}});
  }
  files.push_back({"--similarity", options.similarity_path, {".csv"}});
  files.push_back({"--statistics", options.statistics_path, {".csv"}});
  std::vector<std::string> extensions = picture_extensions();
  extensions.insert(extensions.begin(), film_extension);
  const bool is_film = extension_of(options.picture_path) == film_extension;
  files.push_back({"-o", options.picture_path, extensions, !is_film});
  return files;
}

FrameWriter::FrameWriter(const FrameWriterOptions& options, bool with_errors)
    : options_(options), painter_(options.picture, true) {
  check_outputs(as_usage([&] { return requested_files(options); }));
  for (const FileRequest& request : options.files) {
    if (!request.path.empty()) files_.push_back(std::make_unique<FrameFiles>(request));
  }
  if (extension_of(options.picture_path) == film_extension) {
    film_.emplace(options.picture_path, options.frames_per_second);
  } else if (!options.picture_path.empty()) {
    pictures_.emplace(options.picture_path);
  }
  if (!options.similarity_path.empty()) {
    similarities_.emplace(options.similarity_path);
    *similarities_ << "frame,similarity" << (with_errors ? ",wrong_percent,largest_excess,mean_excess" : "")
                   << "\n";
  }
  if (!options.statistics_path.empty()) statistics_.emplace(options.statistics_path);
}

bool FrameWriter::wants_images(int frame) const {
  return frame % options_.every == 0 && (film_ || pictures_ || !files_.empty());
}

void FrameWriter::add(const FrameFacts& facts, Measures& measures, const std::vector<double>& values) {
  if (wants_images(facts.frame)) write_images(facts, measures, values);
  if (statistics_) statistics_->add(facts.frame, facts.milliseconds, facts.box, measures);
}

void FrameWriter::write_images(const FrameFacts& facts, Measures& measures,
                               const std::vector<double>& values) {
  for (const auto& files : files_) files->add(facts.frame, facts.time, measures);
  if (film_ || pictures_) {
    const cv::Mat picture = painter_.draw(measures, values, facts.stamp);
    if (film_) {
      film_->add(picture);
      if (film_->pictures() == 1) note_of_size(*film_, picture.size());
    }
    if (pictures_) write_picture(pictures_->file(facts.frame), picture);
  }
  ++frames_;
}

void FrameWriter::add_similarity(int frame, double percent, const std::optional<DistanceErrors>& errors) {
  if (!similarities_) return;
  *similarities_ << fmt::format("{},{}", frame, percent);
  if (errors) {
    *similarities_ << fmt::format(",{},{},{}", errors->wrong_percent(), errors->largest_excess,
                                  errors->mean_excess);
  }
  *similarities_ << "\n";
}

void FrameWriter::finish() {
  // The film last: should it fail, the others are whole nevertheless.
  for (const auto& files : files_) files->finish();
  if (similarities_) similarities_->finish();
  if (statistics_) statistics_->finish();
  if (film_) film_->finish();
}

}  // namespace vorocl::command
