// vorocl bench: methods side by side on the same seeds, in time and in wrong pixels.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/commands.hpp"
#include "app/commands/finish_at_end.hpp"
#include "app/options/method_options.hpp"
#include "app/sources/seed_input.hpp"
#include "studies/ground_truth.hpp"
#include "studies/opencv_baseline.hpp"
#include "studies/samples.hpp"
#include "vorocl/jump_flooding.hpp"
#include "vorocl/motion.hpp"

namespace vorocl::command {

namespace {

/// Takes part without being a method of ours: it has nothing to run on a diagram.
const Method opencv_method = {"opencv", false, false, nullptr, nullptr};

/// How far seeds have moved since the diagram that a dynamic method starts from: the paper's step length.
constexpr int step_length = 5;

struct BenchOptions {
  SeedOptions seeds;
  std::vector<Method> methods;
  MethodOptions method_options;
  int repeat = 9;
  std::string device;
  bool json = false;
};

/// One of the methods in the race: `run` is what is timed, after `prepare`; `labels` are those of its last
/// run.
struct Contender {
  std::string name;
  std::function<void()> prepare;
  std::function<void()> run;
  std::function<std::vector<std::uint32_t>()> labels;
  Samples milliseconds;
  std::size_t wrong_pixels = 0;
};

/// From seeds on the device to labels on the device, finished. All methods share the diagram and its buffers.
Contender engine(const Method& method, const Seeds& seeds, Diagram& diagram, const MethodOptions& options) {
  const auto run = [&method, &seeds, &diagram, options] {
    method.run(seeds, diagram, 0, options);
    seeds.device().finish();
  };
  return {method.name, [] {}, run, [&diagram] { return diagram.read(); }, {}, 0};
}

/// A method that goes on from the last frame: each run starts from the JFA of the seeds one random step away.
Contender dynamic_engine(const Method& method, const Seeds& seeds, Diagram& diagram,
                         const MethodOptions& options) {
  const auto now = seeds.read();
  const auto moving = std::make_shared<Seeds>(seeds.clone());
  random_step(*moving, step_length, Border::reflect, 1, 0);
  const auto before = moving->read();
  const auto prepare = [moving, before, now, &diagram, options] {
    moving->move_to(before);
    jump_flooding(*moving, diagram, {options.metric});
    moving->move_to(now);
    moving->device().finish();
  };
  const auto run = [&method, moving, &diagram, options] {
    method.run(*moving, diagram, step_length, options);
    moving->device().finish();
  };
  return {method.name, prepare, run, [&diagram] { return diagram.read(); }, {}, 0};
}

Contender opencv(const Seeds& seeds, Metric metric) {
  const auto peer = std::make_shared<OpenCvPeer>(seeds.grid(), seeds.read(), metric);
  return {opencv_method.name, [] {}, [peer] { peer->run(); }, [peer] { return peer->labels(); }, {}, 0};
}

double milliseconds_of(const Contender& contender) {
  contender.prepare();
  const auto start = std::chrono::steady_clock::now();
  contender.run();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// The warm-up builds programs and allocates, and is what is judged; engines are deterministic. Then the
/// methods take turns, so that a machine that slows down slows all of them.
void race(std::vector<Contender>& contenders, int repeat, const Truth& truth) {
  for (Contender& contender : contenders) {
    contender.prepare();
    contender.run();
    contender.wrong_pixels = truth.wrong_pixels(contender.labels());
  }
  for (int round = 0; round < repeat; ++round) {
    for (Contender& contender : contenders) contender.milliseconds.add(milliseconds_of(contender));
  }
}

void print_json(const BenchOptions& options, const Seeds& seeds, const std::vector<Contender>& contenders) {
  auto results = nlohmann::ordered_json::array();
  for (const Contender& contender : contenders) {
    results.push_back({{"method", contender.name},
                       {"median_ms", contender.milliseconds.median()},
                       {"min_ms", contender.milliseconds.least()},
                       {"wrong_pixels", contender.wrong_pixels}});
  }
  const nlohmann::ordered_json result = {{"metric", to_string(options.method_options.metric)},
                                         {"device", seeds.device().name()},
                                         {"width", seeds.grid().width()},
                                         {"height", seeds.grid().height()},
                                         {"seeds", seeds.alive()},
                                         {"repeat", options.repeat},
                                         {"results", results}};
  fmt::print("{}\n", result.dump());
}

void print_table(const BenchOptions& options, const Seeds& seeds, const std::vector<Contender>& contenders) {
  fmt::print("{} seeds on {} x {} pixels, {}, {} rounds, on {}\n", seeds.alive(), seeds.grid().width(),
             seeds.grid().height(), to_string(options.method_options.metric), options.repeat,
             seeds.device().name());
  fmt::print("{:<20}{:>12}{:>12}{:>10}{:>16}\n", "method", "median ms", "least ms", "ratio", "wrong pixels");
  const double first_median = contenders.front().milliseconds.median();
  for (const Contender& contender : contenders) {
    const double median = contender.milliseconds.median();
    fmt::print("{:<20}{:>12.3f}{:>12.3f}{:>10.3f}{:>16}\n", contender.name, median,
               contender.milliseconds.least(), median / first_median, contender.wrong_pixels);
  }
}

void run(const BenchOptions& options) {
  const Input input = read_input(options.seeds);
  const Device device = Device::select(options.device);
  const FinishAtEnd finish(device);
  const Seeds seeds = input.place(device);
  Diagram diagram(device, input.grid);
  std::vector<Contender> contenders;
  for (const Method& method : options.methods) {
    if (!method.run) {
      contenders.push_back(opencv(seeds, options.method_options.metric));
    } else if (method.continues) {
      contenders.push_back(dynamic_engine(method, seeds, diagram, options.method_options));
    } else {
      contenders.push_back(engine(method, seeds, diagram, options.method_options));
    }
  }
  const Truth truth(input.grid, seeds.read(), options.method_options.metric);
  race(contenders, options.repeat, truth);
  options.json ? print_json(options, seeds, contenders) : print_table(options, seeds, contenders);
}

void add_methods_option(CLI::App& app, std::vector<Method>& methods) {
  Choices<Method> choices = method_choices();
  choices.emplace_back(opencv_method.name, opencv_method);
  const auto parse = [choices](const std::string& name) { return choose(choices, name); };
  add_list(app, "--methods", methods, parse, "Some of " + names_of(choices))->type_name("M,...")->required();
}

}  // namespace

void add_bench(CLI::App& app) {
  const auto options = std::make_shared<BenchOptions>();
  CLI::App* const command =
      app.add_subcommand("bench", "Time methods side by side and count their wrong pixels");
  add_seed_options(*command, options->seeds);
  add_frame_option(*command, options->seeds);
  add_methods_option(*command, options->methods);
  add_method_options(*command, options->method_options);
  command->add_option("--repeat", options->repeat, "Rounds after the warm-up")
      ->type_name("R")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  add_device_option(*command, options->device);
  add_json_option(*command, options->json);
  command->callback([command, options] {
    const auto is_djfa = [](const Method& method) { return method.continues; };
    check_method_options(*command, options->method_options,
                         std::any_of(options->methods.begin(), options->methods.end(), is_djfa));
    run(*options);
  });
}

}  // namespace vorocl::command
