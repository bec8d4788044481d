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
#include "app/terminal/selected_device.hpp"
#include "formats/numbered_files.hpp"
#include "formats/polygon_files.hpp"
#include "trials/samples.hpp"

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
  explicit ExactRun(const ExactFramesOptions& options)
      : options_(options),
        cells_(options.cells, exact_cells_table(options.cells.kind.table()->columns)),
        pairs_(options.adjacency, exact_pairs_table()) {
    if (!options.polygons.empty()) polygons_.emplace(options.polygons);
  }

  void add(const Device& device, const ExactInput& input) {
    const Seeds seeds = input.place(device);
    const Report report = exact_cells(seeds, result_);
    ExactCellRows rows(seeds, result_, input, points_up(options_.seeds));
    if (frames_ % options_.every == 0) {
      cells_.add(rows, frames_, input.timestep.value_or(frames_));
      pairs_.add(rows, frames_, input.timestep.value_or(frames_));
      if (polygons_) rows.write_polygons(polygons_->file(frames_));
    }
    mark_tables();
    uncertified_ += rows.uncertified();
    milliseconds_.add(report.milliseconds());
    ++frames_;
  }

  /// Gives the tables, with the rows of complete frames, their names.
  void finish() {
    cells_.finish();
    pairs_.finish();
  }

  int frames() const { return frames_; }

  void print_result(const Device& device) const {
    if (options_.json) {
      print_json(Json{{"exact", true},
                      {"device", device.name()},
                      {"frames", frames_ - 1},
                      {"uncertified", uncertified_},
                      {"milliseconds", milliseconds_.mean()}});
      return;
    }
    print("exact cells of frame 0 and {} after it in {:.1f} ms each, on {}\n", counted(frames_ - 1, "frame"),
          milliseconds_.mean(), device.name());
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
  int frames_ = 0;
  std::size_t uncertified_ = 0;  // cells
  Samples milliseconds_;
};

}  // namespace

void run_exact_frames(const ExactFramesOptions& options) {
  const Interruption interruption;  // before there are files
  check_outputs(as_usage([&] { return requested_files(options); }), options.seeds);
  check_seed_options(options.seeds, false);
  ExactRun run(options);
  ExactFrames frames(options.seeds);
  std::optional<ExactInput> input = frames.next();
  if (!input) throw Error(options.seeds.trajectory + ": there is no frame");
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  std::string trouble, late;
  try {
    const int most = options.frames ? *options.frames + 1 : std::numeric_limits<int>::max();
    for (Progress progress; input; input = run.frames() < most ? frames.next() : std::nullopt) {
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
    throw Error(fmt::format("{}; frames complete before that: {}{}", trouble, run.frames(), late));
  run.print_result(device);
}

}  // namespace vorocl::command
