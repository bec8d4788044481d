#include "app/commands/exact_frames.hpp"

#include <fmt/format.h>

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
#include "formats/numbered_files.hpp"
#include "formats/polygon_files.hpp"

namespace vorocl::command {

namespace {

std::vector<RequestedFile> requested_files(const ExactFramesOptions& options) {
  return {requested_of_frames(options.cells),
          requested_of_frames(options.adjacency),
          {"--polygons", options.polygons, polygon_extensions(), true}};
}

/// Tables of one kind: one of all frames, or one of each.
class ExactTables {
 public:
  ExactTables(const FileRequest& request, ExactTable kind) : kind_(std::move(kind)) {
    if (request.path.empty()) return;
    if (!request.is_long_table()) {
      files_.emplace(request.path);
      return;
    }
    table_ = std::make_unique<GrowingFile>(OutputFile(request.path));
    *table_ << "frame,timestep," << kind_.header();
  }

  void add(ExactCellRows& rows, int frame, std::int64_t time) {
    if (table_) kind_.add_rows(rows, *table_, fmt::format("{},{},", frame, time));
    if (files_) kind_.write(files_->file(frame), rows);
  }

  /// The table; null: none, or one of each frame.
  GrowingFile* table() const { return table_.get(); }

  void finish() {
    if (table_) table_->finish();
  }

 private:
  ExactTable kind_;
  std::optional<NumberedFiles> files_;
  std::unique_ptr<GrowingFile> table_;
};

class ExactRun {
 public:
  ExactRun(const ExactFramesOptions& options, bool of_volume)
      : options_(options),
        cells_(options.cells, exact_cells_table(options.cells.columns, of_volume)),
        pairs_(options.adjacency, exact_pairs_table(of_volume)),
        frame_(options.frames.first) {
    check_polygons(options.polygons, of_volume);
    if (!options.polygons.empty()) polygons_.emplace(options.polygons);
  }

  void add(const Device& device, const Input& input) {
    const Seeds seeds = input.place(device);
    const Report report = exact_cells(seeds, result_, {input.values.numbers});
    ExactCellRows rows(seeds, result_, input, options_.seeds);
    if (frame_ % options_.every == 0) {
      cells_.add(rows, frame_, input.timestep.value_or(frame_));
      pairs_.add(rows, frame_, input.timestep.value_or(frame_));
      if (polygons_) rows.write_polygons(polygons_->file(frame_));
    }
    mark_tables();
    uncertified_ += rows.uncertified();
    milliseconds_.add(report.milliseconds());
    ++frame_;
  }

  /// Gives the tables, with the rows of complete frames, their names.
  void finish() {
    cells_.finish();
    pairs_.finish();
  }

  int next_frame() const { return frame_; }
  bool has_tables() const { return cells_.table() != nullptr || pairs_.table() != nullptr; }
  int frames() const { return frame_ - options_.frames.first; }

  void print_result(const Device& device) const {
    if (options_.json) {
      print_json(Json{{"exact", true},
                      {"device", device.name()},
                      {"first_frame", options_.frames.first},
                      {"frames", frames() - 1},
                      {"uncertified", uncertified_},
                      {"milliseconds", milliseconds_.mean()}});
      return;
    }
    print("exact cells of frame {} and {} after it in {:.1f} ms each, on {}\n", options_.frames.first,
          counted(frames() - 1, "frame"), milliseconds_.mean(), device.name());
    print_written(requested_files(options_));
  }

 private:
  /// Both have the rows of this frame, or none has.
  void mark_tables() {
    for (const auto step : {&GrowingFile::flush, &GrowingFile::mark}) {
      for (GrowingFile* const table : {cells_.table(), pairs_.table()}) {
        if (table != nullptr) (table->*step)();
      }
    }
  }

  const ExactFramesOptions& options_;
  ExactTables cells_, pairs_;
  std::optional<NumberedFiles> polygons_;
  ExactCellsResult result_;
  int frame_;                    // the next one
  std::size_t uncertified_ = 0;  // cells
  Samples milliseconds_;
};

}  // namespace

void run_exact_frames(const ExactFramesOptions& options) {
  const Interruption interruption;  // before there are files
  check_outputs(as_usage([&] { return requested_files(options); }), options.seeds);
  ExactFrames frames(options.seeds);
  ExactRun run(options, frames.is_volume());
  while (frames.count() < options.frames.first && frames.skip()) {
    if (interruption.came()) throw Error("interrupted, before the first frame was made");
  }
  std::optional<Input> input = frames.next();
  if (!input)
    throw Error(fmt::format("{}: there is no frame {}, only {}", options.seeds.trajectory,
                            options.frames.first, counted(frames.count(), "frame")));
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  std::string trouble, late;
  try {
    const int last = options.frames.last.value_or(std::numeric_limits<int>::max());
    for (Progress progress; input; input = run.next_frame() <= last ? frames.next() : std::nullopt) {
      run.add(device, *input);
      progress.show(run.frames(), std::nullopt);
      if (interruption.came()) {
        trouble = "interrupted";
        break;
      }
    }
  } catch (const std::exception& error) {
    trouble = message_of(error);
  }
  try {
    if (run.frames() > 0) run.finish();
  } catch (const Error& error) {
    if (trouble.empty()) throw;
    late = fmt::format("; {}", error.what());
  }
  if (!trouble.empty())
    throw Error(fmt::format("{}; frames complete before that: {}{}{}", trouble, run.frames(),
                            how_to_continue(options.frames, run.frames(), run.has_tables()), late));
  note_of_last(options.seeds.trajectory, options.frames, run.next_frame() - 1);
  run.print_result(device);
}

}  // namespace vorocl::command
