#include "app/bench/benchmark.hpp"

#include <functional>
#include <memory>

#include "app/terminal/samples.hpp"
#include "vorocl/motion.hpp"

namespace vorocl::command {

namespace {

/// How far seeds move along an axis, at most, from the diagram that djfa starts from (as in the paper).
constexpr int step_length = 5;

/// A method as it is measured: `run` is what is timed, after `prepare`; `labels` are those of its last run.
struct Contender {
  std::string name;
  std::function<void()> prepare;
  std::function<void()> run;
  std::function<std::vector<std::uint32_t>()> labels;
};

/// All methods share the diagram and its buffers. A mixed neighbourhood is for djfa: the others take part
/// with their own.
Contender other_method(const Method& method, const Seeds& seeds, Diagram& diagram, MethodOptions options) {
  if (options.neighbourhood == NeighbourhoodMix::mixed) options.neighbourhood.reset();
  const auto run = [&method, &seeds, &diagram, options] {
    method.run(seeds, diagram, options);
    seeds.device().finish();
  };
  return {method.name, [] {}, run, [&diagram] { return diagram.read(); }};
}

/// As frame 1 of a simulation: what is prepared is its frame 0, which starts from nothing.
Contender continuing_method(const Method& method, const Seeds& seeds, Diagram& diagram,
                            const MethodOptions& options) {
  const auto now = seeds.read();
  const auto moving = std::make_shared<Seeds>(seeds.clone());
  random_step(*moving, step_length, Border::reflect, 1, 0);
  const auto before = moving->read();
  MethodOptions anew = options;
  anew.refresh_interval = 1;
  const auto prepare = [&method, moving, before, now, &diagram, anew] {
    moving->move_to(before);
    method.run(*moving, diagram, anew);
    moving->move_to(now);
    moving->device().finish();
  };
  const auto run = [&method, moving, &diagram, options] {
    method.run(*moving, diagram, options);
    moving->device().finish();
  };
  return {method.name, prepare, run, [&diagram] { return diagram.read(); }};
}

Contender opencv(const Seeds& seeds, Metric metric) {
  const auto baseline = std::make_shared<OpenCvBaseline>(seeds.grid(), seeds.read_pixels(), metric);
  return {opencv_method().name, [] {}, [baseline] { baseline->run(); },
          [baseline] { return baseline->labels(); }};
}

Contender contender(const Method& method, const Seeds& seeds, Diagram& diagram,
                    const MethodOptions& options) {
  if (!method.run) return opencv(seeds, options.metric);
  return method.continues ? continuing_method(method, seeds, diagram, options)
                          : other_method(method, seeds, diagram, options);
}

double milliseconds_of(const Contender& contender) {
  contender.prepare();
  const Stopwatch stopwatch;
  contender.run();
  return stopwatch.milliseconds();
}

}  // namespace

const Method& opencv_method() {
  static const Method method = {"opencv", false, false, false, false, nullptr, nullptr};
  return method;
}

std::vector<BenchmarkResult> benchmark(const std::vector<Method>& methods, const BenchmarkOptions& options,
                                       const Seeds& seeds) {
  Diagram diagram(seeds.device(), seeds.grid());
  std::vector<Contender> contenders;
  contenders.reserve(methods.size());
  for (const Method& method : methods)
    contenders.push_back(contender(method, seeds, diagram, options.method));
  const GroundTruth truth(seeds.grid(), seeds.read_pixels(), options.method.metric);
  std::vector<BenchmarkResult> results;
  for (const Contender& contender : contenders) {
    contender.prepare();
    contender.run();
    results.push_back({contender.name, {}, truth.wrong_pixels(contender.labels())});
  }
  for (int round = 0; round < options.rounds; ++round) {
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      results[i].milliseconds.add(milliseconds_of(contenders[i]));
    }
  }
  return results;
}

}  // namespace vorocl::command
