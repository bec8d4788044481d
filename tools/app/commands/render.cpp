// vorocl render: one diagram, as a picture, as labels, or both.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/commands/finish_at_end.hpp"
#include "app/options/method_options.hpp"
#include "app/outputs/diagram_files.hpp"
#include "app/outputs/painter.hpp"
#include "app/sources/seed_input.hpp"
#include "app/terminal/usage_error.hpp"
#include "formats/files.hpp"
#include "formats/numbered_files.hpp"
#include "vorocl/jump_flooding.hpp"

namespace vorocl::command {

namespace {

struct RenderOptions {
  SeedOptions seeds;
  Method method = {};
  MethodOptions method_options;
  std::string device;
  std::string picture_path;
  std::string labels_path;
  std::string waves_pattern;
  PictureOptions picture;
  bool json = false;

  bool draws() const { return !picture_path.empty() || !waves_pattern.empty(); }
};

struct Outputs {
  std::optional<OutputFile> picture;
  std::unique_ptr<NumberedFiles> waves;
  std::optional<OutputFile> labels;
};

/// All that can be said about the outputs before there is anything to put in.
Outputs check_outputs(const RenderOptions& options) {
  if (!options.draws() && options.labels_path.empty()) {
    throw UsageError("nothing to write: give -o PICTURE, --labels FILE or both, or --waves PICTURES");
  }
  check_distinct(
      {{"-o", options.picture_path}, {"--labels", options.labels_path}, {"--waves", options.waves_pattern}});
  if (!options.waves_pattern.empty() && !options.method.plan) {
    throw UsageError("--waves: the method " + options.method.name + " has no waves");
  }
  if (options.draws()) check_picture_options(options.picture);
  Outputs outputs;
  if (!options.picture_path.empty()) {
    check_extension(options.picture_path, picture_extensions());
    outputs.picture.emplace(options.picture_path);
  }
  if (!options.waves_pattern.empty()) {
    check_extension(options.waves_pattern, picture_extensions());
    outputs.waves = std::make_unique<NumberedFiles>(options.waves_pattern);
  }
  if (!options.labels_path.empty()) {
    check_extension(options.labels_path, labels_kind().extensions);
    outputs.labels.emplace(options.labels_path);
  }
  return outputs;
}

void print_json(const RenderOptions& options, const Seeds& seeds, const Report& report) {
  const nlohmann::ordered_json result = {{"method", options.method.name},
                                         {"metric", to_string(options.method_options.metric)},
                                         {"device", seeds.device().name()},
                                         {"width", seeds.grid().width()},
                                         {"height", seeds.grid().height()},
                                         {"seeds", seeds.alive()},
                                         {"frames", 1},
                                         {"waves", report.waves()},
                                         {"milliseconds", report.milliseconds()},
                                         {"host_milliseconds", report.host_milliseconds()}};
  fmt::print("{}\n", result.dump());
}

void print_text(const RenderOptions& options, const Seeds& seeds, const Report& report) {
  fmt::print(
      "{}: {} seeds on {} x {} pixels in {:.1f} ms (a first run: it may build kernels), {} waves, on {}\n",
      options.method.name, seeds.alive(), seeds.grid().width(), seeds.grid().height(), report.milliseconds(),
      report.waves(), seeds.device().name());
  for (const std::string& path : {options.labels_path, options.picture_path, options.waves_pattern}) {
    if (!path.empty()) fmt::print("wrote {}\n", path);
  }
}

/// Draws the diagram before the first wave of the plan, where the seeds alone have labels, and after every
/// wave. Each picture is flooded anew, by the waves so far.
void draw_waves(const NumberedFiles& files, const Plan& plan, const Input& input, const Seeds& seeds,
                Metric metric, Painter& painter) {
  Diagram diagram(seeds.device(), input.grid);
  AnalysisBuffers buffers;
  Plan waves;
  for (std::size_t i = 0; i <= plan.size(); ++i) {
    flood(seeds, diagram, waves, metric);
    Analysis analysis(seeds, diagram, input.ids, metric, buffers);
    const cv::Mat picture = painter.draw(analysis, input.values);
    files.file(static_cast<int>(i)).write([&](const std::string& path) { write_picture(path, picture); });
    if (i < plan.size()) waves.push_back(plan[i]);
  }
}

void run(const RenderOptions& options) {
  const Outputs outputs = check_outputs(options);
  const Input input = read_input(options.seeds);
  check_picture_size(options.picture, input.grid);
  const Device device = Device::select(options.device);
  const FinishAtEnd finish(device);
  const Seeds seeds = input.place(device);
  Diagram diagram(device, input.grid);
  const Report report = options.method.run(seeds, diagram, 0, options.method_options);
  AnalysisBuffers buffers;
  Analysis analysis(seeds, diagram, input.ids, options.method_options.metric, buffers);
  if (outputs.labels) {
    outputs.labels->write([&](const std::string& path) { labels_kind().write(path, analysis); });
  }
  if (options.draws()) {
    Painter painter(options.picture, outputs.waves != nullptr);
    const cv::Mat picture = painter.draw(analysis, input.values);  // first, so that the waves have its scale
    if (outputs.picture)
      outputs.picture->write([&](const std::string& path) { write_picture(path, picture); });
    if (outputs.waves) {
      const Plan plan = options.method.plan(input.grid, report.waves(), options.method_options);
      draw_waves(*outputs.waves, plan, input, seeds, options.method_options.metric, painter);
    }
  }
  options.json ? print_json(options, seeds, report) : print_text(options, seeds, report);
}

}  // namespace

void add_render(CLI::App& app) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* const command = app.add_subcommand("render", "Make one diagram: a picture, its labels or both");
  add_seed_options(*command, options->seeds);
  add_frame_option(*command, options->seeds);
  add_choice(*command, "--method", options->method, method_choices(), "How to make the diagram")->required();
  add_method_options(*command, options->method_options);
  add_device_option(*command, options->device);
  command->add_option("-o", options->picture_path, "Picture to write: .png, .jpg, .bmp or .tif")
      ->type_name("PICTURE");
  command->add_option("--labels", options->labels_path, labels_kind().about)->type_name("FILE");
  command
      ->add_option("--waves", options->waves_pattern,
                   "Pictures to write of the diagram before the first wave and after every wave, such as "
                   "waves/%02d.png; of djfa, those of the JFA that it starts with")
      ->type_name("PICTURES");
  add_picture_options(*command, options->picture);
  add_json_option(*command, options->json);
  command->callback([command, options] {
    if (!options->draws()) refuse_picture_options(*command, "-o or --waves");
    check_method_options(*command, options->method_options, options->method.continues);
    options->seeds.value_column = options->picture.color.column;
    run(*options);
  });
}

}  // namespace vorocl::command
