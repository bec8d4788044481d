#include "app/commands/exact_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/outputs/exact_cell_files.hpp"
#include "app/outputs/output_files.hpp"
#include "app/sources/exact_input.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "app/terminal/progress.hpp"
#include "app/terminal/samples.hpp"
#include "app/terminal/selected_device.hpp"

namespace vorocl::command {

namespace {

/// How far a run has come.
struct ExactCourse {
  int frames = 0;
  std::size_t uncertified = 0, most_empty = 0;  // cells, of all frames and of one
  Samples milliseconds;
  Trouble trouble;
};

/// `input` is of the first frame.
ExactCourse make_frames(const ExactFramesOptions& options, ExactFrames& frames, std::optional<Input> input,
                        const Device& device, const Interruption& interruption, FrameWriter& writer) {
  ExactCourse course;
  const int last = options.frames.last.value_or(std::numeric_limits<int>::max());
  ExactCellsResult result;
  MeasureBuffers buffers;
  try {
    Progress progress;
    for (int frame = options.frames.first; input; ++frame) {
      const Seeds seeds = input->place(device);
      const Report report = exact_cells(seeds, result);
      const FrameFacts facts = {frame, input->timestep.value_or(frame), ""};
      const auto rows = std::make_shared<ExactCellRows>(seeds, result, std::move(*input), options.seeds);
      course.uncertified += rows->uncertified();
      course.most_empty = std::max(course.most_empty, rows->empty_cells());
      course.milliseconds.add(report.milliseconds());
      writer.add(facts, writer.wants(frame) ? std::make_shared<Measures>(rows, buffers) : nullptr);
      progress.show(++course.frames, std::nullopt);
      if (interruption.came()) {
        course.trouble.text = "interrupted";
        break;
      }
      input = frame < last ? frames.next() : std::nullopt;
    }
  } catch (const std::exception& error) {
    course.trouble = Trouble(error);
  }
  try {
    writer.wait();
  } catch (const std::exception& error) {  // of a frame before
    course.trouble = Trouble(error);
  }
  return course;
}

void print_result(const ExactFramesOptions& options, const ExactCourse& course, const Device& device) {
  if (options.json) {
    print_json(Json{{"exact", true},
                    {"device", device.name()},
                    {"first_frame", options.frames.first},
                    {"frames", course.frames - 1},
                    {"most_empty_cells", course.most_empty},
                    {"uncertified", course.uncertified},
                    {"milliseconds", course.milliseconds.mean()}});
    return;
  }
  print("exact cells of frame {} and {} after it in {:.1f} ms each, on {}\n", options.frames.first,
        counted(course.frames - 1, "frame"), course.milliseconds.mean(), device.name());
  if (course.most_empty > 0)
    print("up to {} of a frame without a cell\n", counted(course.most_empty, "seed"));
  print_written(requested_files(options.output));
}

}  // namespace

void run_exact_frames(const ExactFramesOptions& options) {
  const Interruption interruption;  // before there are files
  check_outputs(as_usage([&] { return requested_files(options.output); }), options.seeds);
  check_any(options.output.files);
  ExactFrames frames(options.seeds);
  FrameWriterOptions output = options.output;
  for (FileRequest& request : output.files) request = of_exact_cells(request, frames.is_volume());
  FrameWriter writer(output);
  while (frames.count() < options.frames.first && frames.skip()) {
    writer.pass({frames.count() - 1, frames.time(), ""}, nullptr);
    if (interruption.came()) throw Error("interrupted, before the first frame was made");
  }
  std::optional<Input> input = frames.next();
  if (!input)
    throw Error(fmt::format("{}: there is no frame {}, only {}", options.seeds.trajectory,
                            options.frames.first, counted(frames.count(), "frame")));
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  const ExactCourse course = make_frames(options, frames, std::move(input), device, interruption, writer);
  writer.end_run(course.trouble, options.frames);
  note_of_last(options.seeds.trajectory, options.frames, options.frames.first + course.frames - 1);
  print_result(options, course, device);
}

}  // namespace vorocl::command
