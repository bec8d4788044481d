#include "app/outputs/frame_writer.hpp"

#include <fmt/format.h>

#include <exception>
#include <utility>

#include "app/terminal/console.hpp"
#include "formats/files.hpp"
#include "formats/images/pictures.hpp"

namespace vorocl::command {

namespace {

/// Says on standard error where a film's sides, which are even, are longer than those of its pictures.
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
  open_files();
  if (!options.similarity_path.empty()) {
    similarities_ = std::make_unique<GrowingFile>(OutputFile(options.similarity_path));
    *similarities_ << "frame,similarity" << (with_errors ? ",wrong_percent,largest_excess,mean_excess" : "")
                   << "\n";
  }
  if (!options.statistics_path.empty()) statistics_.emplace(options.statistics_path);
  for (const auto& files : files_) {
    if (files->table() != nullptr) tables_.push_back(files->table());
  }
  if (similarities_) tables_.push_back(similarities_.get());
  if (statistics_) tables_.push_back(statistics_->table());
}

void FrameWriter::open_files() {
  for (const FileRequest& request : options_.files) {
    if (!request.path.empty()) files_.push_back(std::make_unique<FrameFiles>(request));
  }
  if (extension_of(options_.picture_path) == film_extension) {
    film_.emplace(options_.picture_path, options_.frames_per_second);
  } else if (!options_.picture_path.empty()) {
    pictures_.emplace(options_.picture_path);
  }
}

bool FrameWriter::wants_images(int frame) const {
  return frame % options_.every == 0 && (film_ || pictures_ || !files_.empty());
}

void FrameWriter::add(FrameFacts facts, const std::shared_ptr<Measures>& measures) {
  if (measures) {
    read(facts.frame, *measures);
    measures->leave_device();
  }
  behind_.add([this, facts = std::move(facts), measures] { write(facts, measures.get()); });
}

void FrameWriter::read(int frame, Measures& measures) const {
  if (wants_images(frame)) {
    for (const auto& files : files_) files->read(measures);
    if (film_ || pictures_) painter_.read(measures);
  }
  if (statistics_) FrameStatistics::read(measures);
}

void FrameWriter::write(const FrameFacts& facts, Measures* measures) {
  if (facts.similarity && similarities_) write_similarity(facts.frame, *facts.similarity);
  if (wants_images(facts.frame)) write_images(facts, *measures);
  if (statistics_) statistics_->add(facts.frame, facts.time, facts.milliseconds, facts.box, *measures);
  mark_tables();
  ++complete_;
  if (wants_images(facts.frame)) ++frames_;
}

/// All have the rows of this frame, or none has.
void FrameWriter::mark_tables() {
  for (const auto step : {&GrowingFile::flush, &GrowingFile::mark}) {
    for (GrowingFile* const table : tables_) (table->*step)();
  }
}

bool FrameWriter::needs_diagram(int frame, int first) const {
  if (statistics_ && frame == first - 1) return true;  // which their first row is compared with
  return (film_ || pictures_) && wants_images(frame) && !painter_.is_independent();
}

void FrameWriter::pass(const FrameFacts& facts, Measures* measures) {
  if (wants_images(facts.frame)) {
    for (const auto& files : files_) files->pass(facts.frame, facts.time);
    if ((film_ || pictures_) && measures != nullptr) painter_.draw(*measures, facts.values);
  }
  if (statistics_ && measures != nullptr) statistics_->pass(*measures);
}

void FrameWriter::write_images(const FrameFacts& facts, Measures& measures) {
  for (const auto& files : files_) files->add(facts.frame, facts.time, measures);
  if (film_ || pictures_) {
    const cv::Mat picture = painter_.draw(measures, facts.values, facts.stamp);
    if (film_) {
      film_->add(picture);
      if (film_->pictures() == 1) note_of_size(*film_, picture.size());
    }
    if (pictures_) write_picture(pictures_->file(facts.frame), picture);
  }
}

void FrameWriter::write_similarity(int frame, const FrameSimilarity& similarity) {
  *similarities_ << fmt::format("{},{}", frame, similarity.percent);
  if (const std::optional<DistanceErrors>& errors = similarity.errors) {
    *similarities_ << fmt::format(",{},{},{}", errors->wrong_percent(), errors->largest_excess,
                                  errors->mean_excess);
  }
  *similarities_ << "\n";
}

std::string FrameWriter::progress() const {
  std::string text = fmt::format("; frames complete before that: {}", complete_);
  if (film_ || pictures_ || !files_.empty()) text += fmt::format(", written of them: {}", frames_);
  return text;
}

void FrameWriter::finish() {
  painter_.note_of_scale();
  std::exception_ptr first;
  const auto finish = [&first](auto& output) {
    try {
      output.finish();
    } catch (...) {
      if (!first) first = std::current_exception();
    }
  };
  for (const auto& files : files_) finish(*files);
  if (similarities_) finish(*similarities_);
  if (statistics_) finish(*statistics_);
  if (film_) finish(*film_);
  if (first) std::rethrow_exception(first);
}

void FrameWriter::end_run(const Trouble& trouble, const FrameRange& frames) {
  std::string late;
  try {
    if (complete_ > 0) finish();
  } catch (const Error& error) {
    if (trouble.text.empty()) throw;
    late = fmt::format("; {}", error.what());
  }
  if (trouble.text.empty()) return;
  const std::string more =
      film_ || trouble.is_of_frame ? "" : how_to_continue(frames, complete_, !tables_.empty());
  throw Error(trouble.text + progress() + more + late);
}

}  // namespace vorocl::command
