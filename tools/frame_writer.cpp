#include "frame_writer.hpp"

#include <fmt/format.h>

#include "label_file.hpp"

namespace vorocl::command {

namespace {

const std::string film_extension = ".mp4";

void check_picture_path(const std::string& path) {
  std::vector<std::string> extensions = picture_extensions();
  extensions.insert(extensions.begin(), film_extension);
  check_extension(path, extensions);
}

}  // namespace

void add_frame_writer_options(CLI::App& app, FrameWriterOptions& options) {
  CLI::Option* const picture =
      app.add_option("-o", options.picture_path,
                     "Film to write, .mp4 (H.264), or a picture for each frame, such as frames/%05d.png");
  picture->type_name("FILM|PICTURES");
  app.add_option("--labels", options.labels_path, "Labels to write of each frame, such as frames/%05d.npy")
      ->type_name("FILES");
  app.add_option(
         "--similarity", options.similarity_path,
         "Similarities to write, frame by frame: a .csv file with the columns frame and similarity and, "
         "with --compare-with exact in the same metric, wrong_percent, largest_excess and mean_excess")
      ->type_name("FILE")
      ->needs("--compare-with");
  app.add_option("--every", options.every, "Write pictures and labels of frames 0, K, 2 K, ... alone")
      ->type_name("K")
      ->check(CLI::Range(1, 1000000000))
      ->capture_default_str();
  app.add_option("--fps", options.frames_per_second, "Frames a second of the film")
      ->type_name("F")
      ->check(CLI::Range(0.1, 240.0))
      ->capture_default_str()
      ->needs(picture);
  add_picture_options(app, options.picture);
}

FrameWriter::FrameWriter(const FrameWriterOptions& options, Metric metric, bool with_errors)
    : options_(options), painter_(options.picture, metric, true) {
  check_picture_options(options.picture);
  if (!options.picture_path.empty()) check_picture_path(options.picture_path);
  if (!options.labels_path.empty()) check_label_path(options.labels_path);
  if (!options.similarity_path.empty()) check_extension(options.similarity_path, {".csv"});

  if (!options.labels_path.empty()) labels_.emplace(options.labels_path);
  if (extension_of(options.picture_path) == film_extension) {
    film_.emplace(options.picture_path, options.frames_per_second);
  } else if (!options.picture_path.empty()) {
    pictures_.emplace(options.picture_path);
  }
  if (!options.similarity_path.empty()) {
    similarity_file_.emplace(options.similarity_path);
    similarities_ = open_to_write(similarity_file_->temporary_path());
    similarities_ << "frame,similarity" << (with_errors ? ",wrong_percent,largest_excess,mean_excess" : "")
                  << '\n';
  }
}

FrameWriter::~FrameWriter() {
  if (similarity_file_) similarity_file_->discard();
}

bool FrameWriter::wants(int frame) const {
  return frame % options_.every == 0 && (film_ || pictures_ || labels_);
}

void FrameWriter::add(int frame, const Scene& scene) {
  if (labels_) labels_->file(frame).write([&](const std::string& path) { write_labels(path, scene.named); });
  if (film_ || pictures_) {
    const cv::Mat picture = painter_.draw(scene);
    if (film_) film_->add(picture);
    if (pictures_)
      pictures_->file(frame).write([&](const std::string& path) { write_picture(path, picture); });
  }
  ++frames_;
}

void FrameWriter::add_similarity(int frame, double percent, const std::optional<DistanceErrors>& errors) {
  if (!similarity_file_) return;
  similarities_ << fmt::format("{},{}", frame, percent);
  if (errors) {
    similarities_ << fmt::format(",{},{},{}", errors->wrong_percent(), errors->largest_excess,
                                 errors->mean_excess);
  }
  similarities_ << '\n';
}

void FrameWriter::finish() {
  // The film last: should it fail, the similarities are whole nevertheless.
  if (similarity_file_) {
    check_written(similarities_, similarity_file_->path());
    similarity_file_->commit();
  }
  if (film_) film_->finish();
}

}  // namespace vorocl::command
