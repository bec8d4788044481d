// vorocl render: one diagram, as a picture, as labels, or both.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/options/option_groups.hpp"
#include "app/outputs/measures.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "formats/images/pictures.hpp"
#include "formats/numbered_files.hpp"
#include "formats/values.hpp"
#include "vorocl/jump_flooding.hpp"

namespace vorocl::command {

namespace {

struct RenderOptions : DiagramOptions {
  std::string picture_path;
  std::string waves_pattern;
  FileRequest labels = {labels_kind(), ""};
  std::optional<double> max_distance;
  PictureOptions picture;

  bool draws() const { return !picture_path.empty() || !waves_pattern.empty(); }
};

std::vector<RequestedFile> requested_files(const RenderOptions& options) {
  return {requested(options.labels),
          {"-o", options.picture_path, picture_extensions},
          {"--waves", options.waves_pattern, picture_extensions, true}};
}

struct Outputs {
  std::optional<OutputFile> picture;
  std::unique_ptr<NumberedFiles> waves;
  std::optional<OutputFile> labels;
};

Outputs open_outputs(const RenderOptions& options) {
  if (!options.draws() && options.labels.path.empty()) {
    throw UsageError(options.is_volume()
                         ? "nothing to write: give -o PICTURE with --slice z=K, --labels FILE or both"
                         : "nothing to write: give -o PICTURE, --labels FILE or both, or --waves PICTURES");
  }
  if (!options.waves_pattern.empty() && !options.method.plan) {
    throw UsageError("--waves: the method " + std::string(options.method.name) + " has no waves");
  }
  if (options.is_volume()) check_slice(options.picture, options.picture_path, *options.seeds.size);
  check_outputs(requested_files(options), options.seeds);
  if (options.draws()) check_picture_options(options.picture);
  Outputs outputs;
  outputs.picture = open_output(options.picture_path);
  if (!options.waves_pattern.empty()) outputs.waves = std::make_unique<NumberedFiles>(options.waves_pattern);
  outputs.labels = open_output(options.labels.path);
  return outputs;
}

/// `beyond`: how many pixels are too far away, where that is asked for.
void print_result(const RenderOptions& options, const Seeds& seeds, const Report& report,
                  const std::optional<std::size_t>& beyond, Measures& measures) {
  const View& view = measures.view();
  const CellCount count = measures.cell_count();
  std::size_t unlabelled = 0;
  if (options.is_volume()) {
    const std::vector<std::uint32_t>& labels = measures.labels();
    unlabelled = static_cast<std::size_t>(std::count(labels.begin(), labels.end(), no_label));
  }
  if (options.json) {
    Json result = json_of_diagram(options.method, options.method_options.metric, seeds, view);
    result.update(Json{{"seeds", seeds.alive()}, {"empty_cells", count.empty}});
    result.update(options.is_volume() ? Json{{"unlabelled_voxels", unlabelled}} : Json{{"frames", 1}});
    if (beyond) result["beyond_max_distance"] = *beyond;
    result.update(Json{{"waves", report.waves()},
                       {"milliseconds", report.milliseconds()},
                       {"host_milliseconds", report.host_milliseconds()}});
    print_json(result);
    return;
  }
  print_diagram(options.method, seeds, view, report);
  print_empty_cells(count.empty, count.cells, seeds.alive(), name_of_pixel(view));
  if (options.is_volume()) print_unlabelled(unlabelled - beyond.value_or(0), seeds.alive());
  print_beyond(beyond, view);
  print_written(requested_files(options));
}

/// Draws the diagram before the first wave of the plan, where the seeds alone have labels, and after every
/// wave. Each picture is flooded anew, by the waves so far.
void draw_waves(const NumberedFiles& files, const Plan& plan, const Input& input, const Seeds& seeds,
                Metric metric, Painter& painter) {
  Diagram diagram(seeds.device(), input.view.window);
  MeasureBuffers buffers;
  Plan waves;
  for (std::size_t i = 0; i <= plan.size(); ++i) {
    flood(seeds, diagram, waves, metric);
    Measures measures(seeds, diagram, input.ids, input.view, buffers);
    const cv::Mat picture =
        painter.draw(measures, input.values, fmt::format("{} waves of {}", i, plan.size()));
    write_picture(files.file(static_cast<int>(i)), picture);
    if (i < plan.size()) waves.push_back(plan[i]);
  }
}

void run(const RenderOptions& options) {
  const Outputs outputs = open_outputs(options);
  const Input input = read_input(options.seeds);
  if (!options.is_volume()) check_picture_size(options.picture, input.view.picture.size);
  check_max_distance(options.max_distance, input.view);
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  const Seeds seeds = input.place(device);
  MeasureBuffers buffers;
  Diagram diagram = buffers.diagram_to_read(device, input.view.window);
  const Report report = options.method.run(seeds, diagram, options.method_options);
  const auto beyond = leave_out_beyond(options.max_distance, seeds, input.view, diagram);
  Measures measures(seeds, diagram, input.ids, input.view, buffers);
  if (outputs.labels) options.labels.kind.write(*outputs.labels, measures);
  if (options.draws()) {
    Painter painter(options.picture, outputs.waves != nullptr);
    // First, so that the waves have its scale.
    const cv::Mat picture =
        painter.draw(measures, input.values, stamp_of(options.seeds.frame, input.timestep));
    if (outputs.picture) write_picture(*outputs.picture, picture);
    if (outputs.waves) {
      const Plan plan = options.method.plan(input.view.window, report.waves(), options.method_options);
      draw_waves(*outputs.waves, plan, input, seeds, options.method_options.metric, painter);
    }
  }
  print_result(options, seeds, report, beyond, measures);
}

/// Throws UsageError for options that volumes do not have, and asks for the files that they do.
void prepare_volume(const Command& command, RenderOptions& options) {
  if (command.has("--waves")) refuse_in_volumes("--waves");
  check_volume_method(options.method, options.method_options.metric);
  options.labels = of_grid(options.labels, CellsOf::volumes);
}

/// Throws UsageError for options that planes do not have.
void prepare_plane(RenderOptions& options) {
  if (options.picture.slice) throw UsageError("--slice is for volumes: give --size WxHxD");
  options.seeds.value_column = options.picture.color.column;
}

}  // namespace

void add_render(CommandLine& line) {
  const auto options = std::make_shared<RenderOptions>();
  Command command = line.add("render", "Make one diagram: a picture, its labels or both");
  add_seed_options(command, options->seeds, 1, false, Makes::volumes_too);
  add_frame_option(command, options->seeds);
  add_weight_options(command, options->seeds);
  add_snap_option(command, options->seeds);
  add_units_option(command, options->seeds);
  add_method_option(command, options->method, "How to make the diagram");
  add_method_options(command, options->method_options, Globe::yes);
  add_device_option(command, options->device);
  command.begin_section(files_to_write);
  command.add("-o", options->picture_path, "Picture to write: .png, .jpg, .bmp or .tif")
      .value_name("PICTURE");
  add_file_option(command, options->labels);
  add_crs_option(command, options->seeds.crs, "labels as .tif say").needs(command.option("--points"));
  add_max_distance_option(command, options->max_distance);
  command
      .add("--waves", options->waves_pattern,
           "Pictures to write before the first wave and after each one, such as waves/%02d.png")
      .value_name("PICTURES");
  add_slice_option(command, options->picture);
  add_picture_options(command, options->picture);
  add_json_option(command, options->json);
  command.set_work([command, options] {
    if (!options->draws()) refuse_picture_options(command, "-o or --waves");
    check_method_options(command, {options->method}, options->method_options);
    options->seeds.metric = options->method_options.metric;
    if (options->picture.stamp && options->waves_pattern.empty() && options->seeds.trajectory.empty()) {
      throw UsageError("--stamp needs frames: give --trajectory, or --waves");
    }
    if (options->max_distance && !options->waves_pattern.empty()) {
      throw UsageError("--max-distance is for whole diagrams, without --waves");
    }
    check_crs(options->seeds, {options->labels.path});
    snap_for(options->method, options->seeds);
    options->is_volume() ? prepare_volume(command, *options) : prepare_plane(*options);
    if (!options->method.windows) options->seeds.keeps_inside = keeps_flooding_inside;
    run(*options);
  });
}

}  // namespace vorocl::command
