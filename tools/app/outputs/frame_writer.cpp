#include "app/outputs/frame_writer.hpp"

#include <fmt/format.h>

namespace vorocl::command {

namespace {

const std::string film_extension = ".mp4";

void check_picture_path(const std::string& path) {
  std::vector<std::string> extensions = picture_extensions();
  extensions.insert(extensions.begin(), film_extension);
  check_extension(path, extensions);
}

}  // namespace

void add_film_options(CLI::App& app, FrameWriterOptions& options, const std::string& about) {
  CLI::Option* const picture = app.add_option("-o", options.picture_path, about);
  picture->type_name("FILM|PICTURES");
  app.add_option("--fps", options.frames_per_second, "Frames a second of the film")
      ->type_name("F")
      ->check(CLI::Range(0.1, 240.0))
      ->capture_default_str()
      ->needs(picture);
  add_picture_options(app, options.picture);
}

void add_frame_writer_options(CLI::App& app, FrameWriterOptions& options) {
  add_film_options(app, options,
                   "Film to write, .mp4 (H.264), or a picture for each frame, such as frames/%05d.png");
  options.files = {{labels_kind(), ""}, {cells_kind(), ""}, {adjacency_kind(), ""}, {distance_kind(), ""}};
  add_file_options(app, options.files, true);
  app.add_option("--similarity", options.similarity_path,
                 "Similarities to write, frame by frame: a .csv file with the columns frame and similarity "
                 "and, with --compare-with exact in the same metric, wrong_percent, largest_excess and "
                 "mean_excess")
      ->type_name("FILE")
      ->needs("--compare-with");
  app.add_option(
         "--statistics", options.statistics_path,
         "Statistics to write, a row for every frame: a .csv file with the numbers of cells and of empty "
         "cells, the mean and the deviation of their areas, the pixels that changed since the frame "
         "before, and the diagram's milliseconds")
      ->type_name("FILE");
  app.add_option("--every", options.every, "Write pictures and numbered files of frames 0, K, 2 K, ... alone")
      ->type_name("K")
      ->check(CLI::Range(1, 1000000000))
      ->capture_default_str();
}

std::vector<NamedOutput> outputs_of(const FrameWriterOptions& options) {
  std::vector<NamedOutput> outputs;
  for (const FileRequest& request : options.files) {
    outputs.push_back({request.kind.option, request.path});
    outputs.push_back({request.kind.option, collection_path(request)});
  }
  outputs.push_back({"--similarity", options.similarity_path});
  outputs.push_back({"--statistics", options.statistics_path});
  outputs.push_back({"-o", options.picture_path});
  return outputs;
}

FrameWriter::FrameWriter(const FrameWriterOptions& options, bool with_errors)
    : options_(options), painter_(options.picture, true) {
  check_picture_options(options.picture);
  if (!options.picture_path.empty()) check_picture_path(options.picture_path);
  for (const FileRequest& request : options.files) {
    if (!request.path.empty()) check_extension(request.path, request.kind.extensions);
  }
  if (!options.similarity_path.empty()) check_extension(options.similarity_path, {".csv"});
  if (!options.statistics_path.empty()) check_extension(options.statistics_path, {".csv"});
  check_distinct(outputs_of(options));

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
    similarities_->stream() << "frame,similarity"
                            << (with_errors ? ",wrong_percent,largest_excess,mean_excess" : "") << '\n';
  }
  if (!options.statistics_path.empty()) statistics_.emplace(options.statistics_path);
}

bool FrameWriter::wants_images(int frame) const {
  return frame % options_.every == 0 && (film_ || pictures_ || !files_.empty());
}

void FrameWriter::add(const FrameFacts& facts, Analysis& analysis, const std::vector<double>& values) {
  if (wants_images(facts.frame)) write_images(facts, analysis, values);
  if (statistics_) statistics_->add(facts.frame, facts.milliseconds, analysis);
}

void FrameWriter::write_images(const FrameFacts& facts, Analysis& analysis,
                               const std::vector<double>& values) {
  for (const auto& files : files_) files->add(facts.frame, facts.time, analysis);
  if (film_ || pictures_) {
    const cv::Mat picture = painter_.draw(analysis, values);
    if (film_) film_->add(picture);
    if (pictures_)
      pictures_->file(facts.frame).write([&](const std::string& path) { write_picture(path, picture); });
  }
  ++frames_;
}

void FrameWriter::add_similarity(int frame, double percent, const std::optional<DistanceErrors>& errors) {
  if (!similarities_) return;
  std::ofstream& table = similarities_->stream();
  table << fmt::format("{},{}", frame, percent);
  if (errors) {
    table << fmt::format(",{},{},{}", errors->wrong_percent(), errors->largest_excess, errors->mean_excess);
  }
  table << '\n';
}

void FrameWriter::finish() {
  // The film last: should it fail, the others are whole nevertheless.
  for (const auto& files : files_) files->finish();
  if (similarities_) similarities_->finish();
  if (statistics_) statistics_->finish();
  if (film_) film_->finish();
}

}  // namespace vorocl::command
