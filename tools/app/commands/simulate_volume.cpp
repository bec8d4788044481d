#include "app/commands/simulate_volume.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/commands/volume.hpp"
#include "app/outputs/frame_files.hpp"
#include "app/outputs/frame_writer.hpp"
#include "app/outputs/journal.hpp"
#include "app/outputs/measures.hpp"
#include "app/outputs/output_files.hpp"
#include "app/sources/volume_input.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "app/terminal/progress.hpp"
#include "app/terminal/selected_device.hpp"
#include "formats/files.hpp"
#include "formats/images/film.hpp"
#include "formats/images/pictures.hpp"
#include "formats/numbered_files.hpp"
#include "formats/raster_files.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

namespace {

const FileRequest& labels_of(const SimulateOptions& options) { return options.output.files.at(0); }

bool makes_film(const SimulateOptions& options) {
  return extension_of(options.output.picture_path) == film_extension;
}

std::vector<RequestedFile> requested(const SimulateOptions& options) {
  std::vector<std::string> pictures = picture_extensions();
  pictures.push_back(film_extension);
  return {{"--labels", labels_of(options).path, volume_extensions(), true},
          {"--labels", collection_path(labels_of(options)), {".pvd"}},
          {"-o", options.output.picture_path, pictures, !makes_film(options)}};
}

void check(const Command& command, const SimulateOptions& options, const std::optional<VolumeSlice>& slice,
           const VolumeSize& sides) {
  if (options.seeds.trajectory.empty()) {
    throw UsageError("--size WxHxD: vorocl simulate makes volumes of a --trajectory");
  }
  check_volume_options(options.seeds);
  for (const char* const name : {"--compare-with", "--fit", "--cells", "--adjacency", "--distance",
                                 "--similarity", "--statistics", "--resume"}) {
    if (command.has(name)) refuse_in_volumes(name);
  }
  check_volume_method(options.method);
  check_slice(slice, options.output.picture_path, options.output.picture, sides);
  check_outputs(as_usage([&] { return requested(options); }), options.seeds);
}

/// What is written of the frames.
class Files {
 public:
  explicit Files(const SimulateOptions& options) {
    const std::string &labels = labels_of(options).path, &pictures = options.output.picture_path;
    refuse_journal(journal_path(labels.empty() ? pictures : labels));
    if (!labels.empty()) labels_.emplace(labels);
    const std::string collection = collection_path(labels_of(options));
    if (!collection.empty()) collection_.emplace(collection);
    if (pictures.empty()) return;
    if (makes_film(options)) {
      film_.emplace(pictures, options.output.frames_per_second);
    } else {
      pictures_.emplace(pictures);
    }
  }

  bool draw() const { return film_ || pictures_; }

  void add_picture(int frame, const cv::Mat& picture) {
    if (pictures_) return write_picture(pictures_->file(frame), picture);
    film_->add(picture);
    if (film_->pictures() == 1) note_of_size(*film_, picture.size());
  }

  void add_labels(int frame, std::int64_t time, const VolumeRaster& raster,
                  const std::vector<std::uint32_t>& labels) {
    if (!labels_) return;
    write_voxels(labels_->file(frame), "label", raster, labels);
    listed_.push_back({time, std::filesystem::path(labels_->path(frame)).filename().string()});
  }

  void finish() {
    if (collection_) write_pvd(*collection_, listed_);
    if (film_) film_->finish();
  }

 private:
  std::optional<NumberedFiles> labels_, pictures_;
  std::optional<OutputFile> collection_;
  std::vector<TimedFile> listed_;
  std::optional<Film> film_;
};

void print_result(const SimulateOptions& options, const Seeds& seeds, const View& view, int frames,
                  double milliseconds) {
  if (options.json) {
    Json json = json_of_diagram(options.method, options.method_options.metric, seeds, view);
    json.update(Json{{"seeds", seeds.alive()}, {"frames", frames}, {"milliseconds", milliseconds / frames}});
    print_json(json);
    return;
  }
  print("{}: {} of {}, {} in the last, {:.1f} ms per frame, on {}\n", options.method.name,
        counted(static_cast<std::uint64_t>(frames), "frame"), size_text(view), counted(seeds.alive(), "seed"),
        milliseconds / frames, seeds.device().name());
  print_written(requested(options));
}

/// A run, frame by frame.
class VolumeRun {
 public:
  VolumeRun(const SimulateOptions& options, const VolumeSlice* slice, const Device& device,
            VolumeFrames& source, Files& files)
      : options_(options),
        slice_(slice),
        source_(source),
        files_(files),
        seeds_(device, source.grid(), source.points(), Outside::refuse) {}

  const Seeds& seeds() const { return seeds_; }
  int frames() const { return frame_; }
  double milliseconds() const { return milliseconds_; }

  void add_frame() {
    if (frame_ > 0) seeds_.move_to(source_.grid(), source_.points());
    if (!diagram_ || diagram_->window().grid() != source_.grid())
      diagram_.emplace(seeds_.device(), source_.grid());
    milliseconds_ += options_.method.run(seeds_, *diagram_, options_.method_options).milliseconds();
    if (frame_ % options_.output.every == 0) write();
    ++frame_;
  }

  bool is_last() const { return options_.motion.frames && frame_ > *options_.motion.frames; }

 private:
  void write() {
    Measures measures(seeds_, *diagram_, source_.ids(), source_.view(), buffers_);
    files_.add_labels(frame_, source_.timestep().value_or(frame_), source_.view().voxels(),
                      measures.labels_by_id());
    if (!files_.draw()) return;
    files_.add_picture(
        frame_, draw_slice(*slice_, options_.output.picture, seeds_, measures.labels(), source_.ids()));
  }

  const SimulateOptions& options_;
  const VolumeSlice* slice_;
  VolumeFrames& source_;
  Files& files_;
  Seeds seeds_;
  std::optional<Diagram> diagram_;
  MeasureBuffers buffers_;
  int frame_ = 0;
  double milliseconds_ = 0;
};

}  // namespace

void simulate_volume(const Command& command, const SimulateOptions& options,
                     const std::optional<VolumeSlice>& slice) {
  const Interruption interruption;  // before there are files
  const VolumeSize sides = volume_size(options.seeds);
  check(command, options, slice, sides);
  Files files(options);
  VolumeFrames source(options.seeds);
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  VolumeRun run(options, slice ? &*slice : nullptr, device, source, files);
  Progress progress;
  std::string trouble;
  try {
    for (bool more = true; more; more = !run.is_last() && source.next()) {
      run.add_frame();
      progress.show(run.frames(), std::nullopt);
      if (!interruption.came()) continue;
      trouble = "interrupted";
      break;
    }
  } catch (const std::exception& error) {  // the frames so far are kept
    trouble = message_of(error);
  }
  progress.erase();
  try {
    if (run.frames() > 0) files.finish();
  } catch (const Error& error) {
    if (trouble.empty()) throw;
    trouble += fmt::format("; {}", error.what());
  }
  if (!trouble.empty()) {
    throw Error(fmt::format("{}; frames complete before that: {}", trouble, run.frames()));
  }
  print_result(options, run.seeds(), source.view(), run.frames(), run.milliseconds());
}

}  // namespace vorocl::command
