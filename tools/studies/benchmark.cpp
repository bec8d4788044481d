#include "studies/benchmark.hpp"

#include <functional>
#include <memory>

#include "studies/ground_truth.hpp"
#include "studies/opencv_baseline.hpp"
#include "studies/stopwatch.hpp"
#include "vorocl/jump_flooding.hpp"
#include "vorocl/motion.hpp"

namespace vorocl::command {

namespace {

/// How far seeds have moved along an axis, at most, since the diagram that djfa starts from (as in the
/// paper).
constexpr int max_displacement = 5;

/// A method as it is measured: `run` is what is timed, after `prepare`; `labels` are those of its last run.
struct Contender {
  std::function<void()> prepare;
  std::function<void()> run;
  std::function<std::vector<std::uint32_t>()> labels;
};

/// All methods share the diagram and its buffers. A mixed neighbourhood is for djfa: the others take part
/// with their own.
Contender other_method(const Method& method, const Seeds& seeds, Diagram& diagram, MethodOptions options) {
  if (options.neighbourhood == NeighbourhoodMix::mixed) options.neighbourhood.reset();
  const auto run = [&method, &seeds, &diagram, options] {
    method.run(seeds, diagram, 0, options);
    seeds.device().finish();
  };
  return {[] {}, run, [&diagram] { return diagram.read(); }};
}

Contender continuing_method(const Method& method, const Seeds& seeds, Diagram& diagram,
                            const MethodOptions& options) {
  const auto now = seeds.read();
  const auto moving = std::make_shared<Seeds>(seeds.clone());
  random_step(*moving, max_displacement, Border::reflect, 1, 0);
  const auto before = moving->read();
  const auto prepare = [moving, before, now, &diagram, options] {
    moving->move_to(before);
    jump_flooding(*moving, diagram, {options.metric});
    moving->move_to(now);
    moving->device().finish();
  };
  const auto run = [&method, moving, &diagram, options] {
    method.run(*moving, diagram, max_displacement, options);
    moving->device().finish();
  };
  return {prepare, run, [&diagram] { return diagram.read(); }};
}

Contender opencv(const Seeds& seeds, Metric metric) {
  const auto baseline = std::make_shared<OpenCvBaseline>(seeds.grid(), seeds.read(), metric);
  return {[] {}, [baseline] { baseline->run(); }, [baseline] { return baseline->labels(); }};
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
  static const Method method = {"opencv", false, false, false, nullptr, nullptr};
  return method;
}

std::vector<BenchmarkResult> benchmark(const std::vector<Method>& methods, const MethodOptions& options,
                                       const Seeds& seeds, int rounds) {
  Diagram diagram(seeds.device(), seeds.grid());
  std::vector<Contender> contenders;
  for (const Method& method : methods) contenders.push_back(contender(method, seeds, diagram, options));
  const GroundTruth truth(seeds.grid(), seeds.read(), options.metric);
  std::vector<BenchmarkResult> results;
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    contenders[i].prepare();
    contenders[i].run();
    results.push_back({methods[i].name, {}, truth.wrong_pixels(contenders[i].labels())});
  }
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      results[i].milliseconds.add(milliseconds_of(contenders[i]));
    }
  }
  return results;
}

}  // namespace vorocl::command
