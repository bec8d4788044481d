// vorocl bench: methods side by side on the same seeds, in time and in wrong pixels.

#include <memory>
#include <nlohmann/json.hpp>

#include "app/bench/benchmark.hpp"
#include "app/commands/commands.hpp"
#include "app/options/option_groups.hpp"
#include "app/outputs/measures.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

namespace {

struct BenchOptions {
  SeedOptions seeds;
  std::vector<Method> methods;
  BenchmarkOptions benchmark = {{}, 9};
  std::string device;
  bool json = false;
};

void print_result(const BenchOptions& options, const Seeds& seeds, const View& view,
                  const std::vector<BenchmarkResult>& results) {
  if (options.json) {
    std::vector<Json> list;
    list.reserve(results.size());
    for (const BenchmarkResult& result : results) {
      list.push_back(Json{{"method", result.method},
                          {"median_ms", result.milliseconds.median()},
                          {"min_ms", result.milliseconds.least()},
                          {"wrong_pixels", result.wrong_pixels}});
    }
    const Grid& grid = seeds.grid();
    Json json = json_of_grid(options.benchmark.method.metric, seeds, grid.width(), grid.height());
    json.update(Json{{"seeds", seeds.alive()}, {"repeat", options.benchmark.rounds}, {"results", list}});
    print_json(json);
    return;
  }
  print("{} on {}, {}, {}, on {}\n", counted(seeds.alive(), "seed"), size_text(view),
        to_string(options.benchmark.method.metric), counted(options.benchmark.rounds, "round"),
        seeds.device().name());
  print("{:<20}{:>12}{:>12}{:>10}{:>16}\n", "method", "median ms", "least ms", "ratio",
        seeds.grid().is_volume() ? "wrong voxels" : "wrong pixels");
  const double first_median = results.front().milliseconds.median();
  for (const BenchmarkResult& result : results) {
    const double median = result.milliseconds.median();
    print("{:<20}{:>12.3f}{:>12.3f}{:>10.3f}{:>16}\n", result.method, median, result.milliseconds.least(),
          median / first_median, result.wrong_pixels);
  }
}

void run(const BenchOptions& options) {
  const Input input = read_input(options.seeds);
  refuse_window(input, "bench");
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  const Seeds seeds = input.place(device);
  print_result(options, seeds, input.view, benchmark(options.methods, options.benchmark, seeds));
}

void add_methods_option(Command& command, std::vector<Method>& methods) {
  Choices<Method> choices = method_choices();
  choices.emplace_back(opencv_method().name, opencv_method());
  const auto parse = [choices](const std::string& name) { return choose(choices, name); };
  command.add_list("--methods", methods, parse, "Some of " + names_of(choices))
      .value_name("M,...")
      .required();
}

}  // namespace

void add_bench(CommandLine& line) {
  const auto options = std::make_shared<BenchOptions>();
  Command command = line.add("bench", "Time methods side by side and count their wrong pixels");
  add_seed_options(command, options->seeds, 1, false, Makes::volumes_too);
  add_frame_option(command, options->seeds);
  add_snap_option(command, options->seeds, "Make exact diagrams and judge all labels");
  command.begin_section("Methods");
  add_methods_option(command, options->methods);
  add_method_options(command, options->benchmark.method);
  command.begin_section("Benchmark");
  command.add("--repeat", options->benchmark.rounds, "Rounds after the warm-up")
      .value_name("R")
      .in_range(1, 1000000)
      .default_is_value();
  add_device_option(command, options->device);
  add_json_option(command, options->json);
  command.set_work([command, options] {
    for (const Method& method : options->methods) {
      if (options->seeds.is_volume()) check_volume_method(method, options->benchmark.method.metric);
    }
    check_method_options(command, options->methods, options->benchmark.method);
    options->seeds.keeps_inside = "bench cannot take";
    options->seeds.usual_snap = Snap::to_pixels;
    run(*options);
  });
}

}  // namespace vorocl::command
