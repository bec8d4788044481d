#include "studies/evaluation.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "app/sources/random_seeds.hpp"
#include "vorocl/cells.hpp"
#include "vorocl/error.hpp"
#include "vorocl/method.hpp"
#include "vorocl/similarity.hpp"
#include "vorocl/simulation.hpp"

namespace vorocl::command {

namespace {

/// How many frames of a timed run may be on their way to the device.
constexpr int most_frames_ahead = 16;

Simulation::Engine engine_of(const MethodResult& result) {
  MethodOptions options;
  options.metric = result.metric;
  options.reach = Reach::paper;
  return engine(method(result.method), options);
}

Simulation walk(const Device& device, const Configuration& configuration,
                const EvaluationSettings& settings) {
  const Grid grid(configuration.side, configuration.side);
  return {Seeds::random(device, grid, configuration.seeds, settings.rng_seed),
          RandomMotion{settings.step_length, settings.rng_seed}};
}

/// The similarities of a frame's diagrams, each pair compared once.
class Similarities {
 public:
  explicit Similarities(const Simulation& simulation) : simulation_(simulation) {}

  double between(std::size_t a, std::size_t b) {
    if (a == b) return 100;
    const auto [entry, is_new] = found_.try_emplace(std::minmax(a, b));
    if (is_new) {
      similarity(simulation_.diagram(a), simulation_.diagram(b), result_);
      entry->second = result_.read();
    }
    return entry->second;
  }

 private:
  const Simulation& simulation_;
  SimilarityResult result_;
  std::map<std::pair<std::size_t, std::size_t>, double> found_;
};

/// Where a method is among the results, which is also the number of its engine.
std::size_t index_of(const std::vector<MethodResult>& results, const std::string& method, Metric metric) {
  const auto found = std::find_if(results.begin(), results.end(), [&](const MethodResult& result) {
    return result.method == method && result.metric == metric;
  });
  if (found == results.end()) throw Error("the method " + method + " is not evaluated");
  return static_cast<std::size_t>(found - results.begin());
}

void compare(const Simulation& simulation, std::vector<MethodResult>& results) {
  Similarities similarities(simulation);
  DistanceErrorsResult errors;
  for (std::size_t i = 0; i < results.size(); ++i) {
    MethodResult& result = results[i];
    const std::size_t exact = index_of(results, "exact", result.metric);
    result.similarity_to_euclidean_jfa.add(
        similarities.between(i, index_of(results, "jfa", Metric::euclidean)));
    result.similarity_to_jfa.add(similarities.between(i, index_of(results, "jfa", result.metric)));
    result.similarity_to_exact.add(similarities.between(i, exact));
    distance_errors(simulation.diagram(i), simulation.diagram(exact), errors);
    result.errors.add(errors.read());
  }
}

void measure_accuracy(Simulation simulation, int frames, ConfigurationResult& result,
                      const std::function<void(int)>& made) {
  for (const MethodResult& method : result.methods) simulation.add_engine(engine_of(method));
  for (int frame = 0; frame <= frames; ++frame) {
    simulation.step();
    if (frame == 0) {
      const std::size_t exact = index_of(result.methods, "exact", Metric::euclidean);
      CellStatisticsResult statistics;
      cell_statistics(simulation.diagram(exact), statistics);
      result.coincident_seeds = statistics.read().empty_cells;
    } else {
      compare(simulation, result.methods);
    }
    made(static_cast<int>(result.methods.size()));
  }
  for (std::size_t i = 0; i < result.methods.size(); ++i) {
    result.methods[i].waves = simulation.report(i).waves();
  }
}

}  // namespace

RunTimes timed_run(Simulation simulation, const Simulation::Engine& engine, int frames,
                   const std::function<void(int)>& made) {
  simulation.add_engine(engine);
  for (int frame = 0; frame <= frames; ++frame) {
    simulation.step();
    if (frame % most_frames_ahead == 0) simulation.milliseconds();  // waits
    made(1);
  }
  return {simulation.milliseconds(), simulation.host_milliseconds()};
}

const std::vector<std::string>& evaluated_methods() {
  static const std::vector<std::string> methods = {"jfa", "djfa", "exact"};
  return methods;
}

const MethodResult& ConfigurationResult::of(const std::string& method, Metric metric) const {
  return methods[index_of(methods, method, metric)];
}

ConfigurationResult evaluate(const Device& device, const Configuration& configuration,
                             const EvaluationSettings& settings, const std::function<void(int)>& made) {
  ConfigurationResult result;
  for (const Metric metric : {Metric::euclidean, Metric::manhattan}) {
    for (const std::string& method : evaluated_methods()) {
      result.methods.emplace_back();
      result.methods.back().method = method;
      result.methods.back().metric = metric;
    }
  }
  measure_accuracy(walk(device, configuration, settings), settings.frames, result, made);
  for (int round = 0; round < settings.repeats; ++round) {
    for (MethodResult& method : result.methods) {
      const RunTimes times =
          timed_run(walk(device, configuration, settings), engine_of(method), settings.timed_frames, made);
      method.milliseconds.add(times.milliseconds);
      method.host_milliseconds.add(times.host_milliseconds);
    }
  }
  return result;
}

int diagrams_of(const EvaluationSettings& settings) {
  const auto methods = static_cast<int>(2 * evaluated_methods().size());
  return methods * (settings.frames + 1 + settings.repeats * (settings.timed_frames + 1));
}

}  // namespace vorocl::command
