// vorocl simulate --exact: cells as polygons or polyhedra in each frame of a trajectory, without diagrams.

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/simulate_course.hpp"
#include "app/options/option_groups.hpp"
#include "app/outputs/exact_cell_files.hpp"
#include "app/outputs/output_files.hpp"

namespace vorocl::command {

namespace {

/// How far a run has come.
struct ExactCourse {
  std::size_t uncertified = 0, most_empty = 0;  // cells, of all frames and of one
  Samples milliseconds;
};

/// Of so many frames behind the first one.
void print_result(const SimulateOptions& options, const ExactCourse& course, int frames,
                  const Device& device) {
  if (options.json) {
    print_json(Json{{"exact", true},
                    {"device", device.name()},
                    {"first_frame", options.motion.frames.first},
                    {"frames", frames},
                    {"most_empty_cells", course.most_empty},
                    {"uncertified", course.uncertified},
                    {"milliseconds", course.milliseconds.mean()}});
    return;
  }
  print("exact cells of frame {} and {} after it in {:.1f} ms each, on {}\n", options.motion.frames.first,
        counted(frames, "frame"), course.milliseconds.mean(), device.name());
  if (course.most_empty > 0)
    print("up to {} of a frame without a cell\n", counted(course.most_empty, "seed"));
  print_written(requested_files(options.output));
}

}  // namespace

void run_exact_frames(SimulateOptions options) {
  const Interruption interruption;  // before there are files
  check_outputs(as_usage([&] { return requested_files(options.output); }), options.seeds);
  check_any(options.output.files);
  const std::unique_ptr<MovingSeeds> source = read_moving_seeds(options.seeds, options.motion, interruption);
  for (FileRequest& request : options.output.files)
    request = of_exact_cells(request, source->frame().view.is_volume());
  FrameWriter writer(options.output);
  const auto facts_of = [&](int frame) {
    return FrameFacts{frame, source->frame().timestep.value_or(frame), ""};
  };
  pass_frames(options, *source, interruption, [&](int frame) { writer.pass(facts_of(frame), nullptr); });
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  ExactCourse course;
  ExactCellsResult result;
  MeasureBuffers buffers;
  const Trouble trouble = make_frames(options, *source, interruption, writer, [&](int frame) {
    const Seeds seeds = source->frame().place(device);
    course.milliseconds.add(exact_cells(seeds, result).milliseconds());
    const auto rows = std::make_shared<ExactCellRows>(seeds, result, source->frame(), options.seeds);
    course.uncertified += rows->uncertified();
    course.most_empty = std::max(course.most_empty, rows->empty_cells());
    writer.add(facts_of(frame), writer.wants(frame) ? std::make_shared<Measures>(rows, buffers) : nullptr);
  });
  writer.end_run(trouble, options.motion.frames);
  const int frames = writer.complete() - 1;
  note_of_last(options.seeds.trajectory, options.motion.frames, options.motion.frames.first + frames);
  print_result(options, course, frames, device);
}

}  // namespace vorocl::command
