#include "app/commands/simulate_volume.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/commands/volume.hpp"
#include "app/outputs/output_files.hpp"
#include "app/sources/bounds.hpp"
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

const std::string& labels_path(const SimulateOptions& options) { return options.output.files.at(0).path; }

bool makes_film(const SimulateOptions& options) {
  return extension_of(options.output.picture_path) == film_extension;
}

std::vector<RequestedFile> requested(const SimulateOptions& options) {
  std::vector<std::string> pictures = picture_extensions();
  pictures.push_back(film_extension);
  return {{"--labels", labels_path(options), volume_extensions(), true},
          {"-o", options.output.picture_path, pictures, !makes_film(options)}};
}

void check(const Command& command, const SimulateOptions& options, const std::optional<VolumeSlice>& slice,
           const VolumeSize& sides) {
  if (options.seeds.trajectory.empty()) {
    throw UsageError("--size WxHxD: vorocl simulate makes volumes of a --trajectory");
  }
  check_volume_options(options.seeds);
  for (const char* const name : {"--compare-with", "--fit", "--cells", "--adjacency", "--distance",
                                 "--similarity", "--statistics", "--resume", "--snap", "--no-snap"}) {
    if (command.has(name)) {
      throw UsageError(std::string(name) + " is for planes, and --size WxHxD asks for a volume");
    }
  }
  check_volume_method(options.method);
  check_slice(slice, options.output.picture_path, options.output.picture, sides);
  check_outputs(as_usage([&] { return requested(options); }), options.seeds);
}

/// What is written of the frames.
class Files {
 public:
  explicit Files(const SimulateOptions& options) {
    if (!labels_path(options).empty()) labels_.emplace(labels_path(options));
    if (options.output.picture_path.empty()) return;
    if (makes_film(options)) {
      film_.emplace(options.output.picture_path, options.output.frames_per_second);
    } else {
      pictures_.emplace(options.output.picture_path);
    }
  }

  bool draw() const { return film_ || pictures_; }

  void add_picture(int frame, const cv::Mat& picture) {
    film_ ? film_->add(picture) : write_picture(pictures_->file(frame), picture);
  }

  void add_labels(int frame, const VolumeSize& sides, const std::vector<std::uint32_t>& labels) const {
    if (labels_) write_volume(labels_->file(frame), sides, labels);
  }

  void finish() {
    if (film_) film_->finish();
  }

 private:
  std::optional<NumberedFiles> labels_, pictures_;
  std::optional<Film> film_;
};

void print_result(const SimulateOptions& options, const Seeds& seeds, int frames, double milliseconds) {
  const Grid& grid = seeds.grid();
  if (options.json) {
    print_json(Json{{"method", options.method.name},
                    {"metric", to_string(options.method_options.metric)},
                    {"device", seeds.device().name()},
                    {"width", grid.width()},
                    {"height", grid.height()},
                    {"depth", grid.depth()},
                    {"periodic", to_string(grid.periodic(), grid.z().is_periodic())},
                    {"seeds", seeds.alive()},
                    {"frames", frames},
                    {"milliseconds", milliseconds / frames}});
    return;
  }
  print("{}: {} of {} x {} x {} voxels, {} in the last, {:.1f} ms per frame, on {}\n", options.method.name,
        counted(static_cast<std::uint64_t>(frames), "frame"), grid.width(), grid.height(), grid.depth(),
        counted(seeds.alive(), "seed"), milliseconds / frames, seeds.device().name());
  print_written(requested(options));
}

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
  Seeds seeds(device, source.grid(), source.points(), Outside::refuse);
  std::optional<Diagram> diagram;
  Progress progress;
  int frame = 0;
  double milliseconds = 0;
  for (bool more = true; more; ++frame) {
    if (frame > 0) seeds.move_to(source.grid(), source.points());
    if (!diagram || diagram->window().grid() != source.grid()) diagram.emplace(device, source.grid());
    const Report report = options.method.run(seeds, *diagram, options.method_options);
    if (frame % options.output.every == 0) {
      std::vector<std::uint32_t> labels = diagram->read();
      if (files.draw()) {
        files.add_picture(frame, draw_slice(*slice, options.output.picture, seeds, labels, source.ids()));
      }
      name_labels(labels, source.ids());
      files.add_labels(frame, sides, labels);
    }
    milliseconds += report.milliseconds();
    progress.show(frame + 1, std::nullopt);
    if (interruption.came())
      throw Error(fmt::format("interrupted; frames complete before that: {}", frame + 1));
    more = (!options.motion.frames || frame < *options.motion.frames) && source.next();
  }
  files.finish();
  progress.erase();
  print_result(options, seeds, frame, milliseconds);
}

}  // namespace vorocl::command
