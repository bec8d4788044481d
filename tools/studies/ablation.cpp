#include "studies/ablation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/sources/random_seeds.hpp"
#include "vorocl/method.hpp"
#include "vorocl/similarity.hpp"

namespace vorocl::command {

namespace {

constexpr int engines_side_by_side = 3;  // a variant twice, and the exact method

/// With the paper's plan, except where its reach is the study.
Simulation::Engine engine_of(const std::string& name, MethodOptions options = {},
                             Reach reach = Reach::paper) {
  options.reach = reach;
  return engine(method(name), options);
}

/// The studies of dJFA's own options.
void add_options(std::vector<Variant>& variants, int max_displacement) {
  const auto add = [&](const std::string& study, const std::string& setting, const MethodOptions& options) {
    variants.push_back({study, setting, engine_of("djfa", options), max_displacement});
  };
  for (const int waves : {0, 1, 2}) {
    MethodOptions options;
    options.von_neumann_waves = waves;
    add("von Neumann waves", std::to_string(waves), options);
  }
  MethodOptions all_von_neumann;
  all_von_neumann.neighbourhood = NeighbourhoodMix::von_neumann;
  add("von Neumann waves", "all", all_von_neumann);
  for (const int waves : {0, 1, 2}) {
    MethodOptions options;
    options.extra_waves = waves;
    add("extra waves", std::to_string(waves), options);
  }
  for (const int interval : {0, 5, 10}) {
    MethodOptions options;
    options.refresh_interval = interval;
    add("refresh interval", std::to_string(interval), options);
  }
}

Simulation walk(const Device& device, const Configuration& configuration, const EvaluationSettings& settings,
                const Variant& variant) {
  const Grid grid(configuration.side, configuration.side);
  const Device tuned = variant.one_pixel_per_work_item ? device.with_tuning(Tuning{}) : device;
  return {spread_seeds(tuned, grid, configuration.seeds, variant.spread, settings.rng_seed),
          RandomMotion{variant.max_displacement, settings.rng_seed}};
}

void measure_accuracy(Simulation simulation, const Variant& variant, int frames, VariantResult& result,
                      const std::function<void(int)>& made) {
  const std::size_t one = simulation.add_engine(variant.engine),
                    again = simulation.add_engine(variant.engine),
                    exact = simulation.add_engine(engine_of("exact"));
  SimilarityResult similar;
  DistanceErrorsResult errors;
  for (int frame = 0; frame <= frames; ++frame) {
    simulation.step();
    made(engines_side_by_side);
    if (frame == 0) continue;
    result.waves.add(variant.record ? variant.record->waves() : simulation.report(one).waves());
    similarity(simulation.diagram(one), simulation.diagram(exact), similar);
    result.similarity_to_exact.add(similar.read());
    similarity(simulation.diagram(one), simulation.diagram(again), similar);
    result.differing_between_runs.add(100 - similar.read());
    distance_errors(simulation.diagram(one), simulation.diagram(exact), errors);
    result.errors.add(errors.read());
  }
}

}  // namespace

std::vector<Variant> variants_of(const Device& device, const Configuration& configuration,
                                 const EvaluationSettings& settings) {
  const int max_displacement = settings.step_length;
  std::vector<Variant> variants;
  for (const char* method : {"jfa", "djfa", "exact"})
    variants.push_back({"method", method, engine_of(method), max_displacement});
  add_options(variants, max_displacement);
  const double length =
      std::sqrt(static_cast<double>(configuration.pixels()) / static_cast<double>(configuration.seeds));
  for (const int times : {1, 2, 3, 4}) {
    const auto displacement = std::min(std::round(times * length), static_cast<double>(Window::max_side));
    const auto most = static_cast<int>(displacement);
    const std::string setting = std::to_string(times) + " L";
    variants.push_back({"d_max", setting + ", jfa", engine_of("jfa"), most});
    variants.push_back({"d_max", setting + ", djfa", engine_of("djfa"), most});
  }
  const std::pair<const char*, Spread> spreads[] = {
      {"uniform", Spread::uniform}, {"clusters", Spread::clusters}, {"gradient", Spread::gradient}};
  for (const auto& [name, spread] : spreads) {
    for (const char* method : {"jfa", "djfa"}) {
      variants.push_back(
          {"seeds", std::string(name) + ", " + method, engine_of(method), max_displacement, spread});
    }
  }
  variants.push_back({"waves", "gather", engine_of("djfa"), max_displacement});
  variants.push_back({"waves", "gather, one pixel per work-item", engine_of("djfa"), max_displacement,
                      Spread::uniform, true});
  const std::pair<const char*, Stamping> scatters[] = {{"scatter in place, as printed", Stamping::none},
                                                       {"scatter in place, seeds stamped", Stamping::seeds}};
  for (const auto& [name, stamping] : scatters) {
    const auto record = std::make_shared<ScatterRecord>();
    variants.push_back({"waves", name, in_place_scatter(device, stamping, record), max_displacement,
                        Spread::uniform, false, record});
  }
  return variants;
}

std::vector<VariantResult> measure(const Device& device, const Configuration& configuration,
                                   const EvaluationSettings& settings, const std::vector<Variant>& variants,
                                   const std::function<void(int)>& made) {
  std::vector<VariantResult> results(variants.size());
  for (std::size_t i = 0; i < variants.size(); ++i) {
    measure_accuracy(walk(device, configuration, settings, variants[i]), variants[i], settings.frames,
                     results[i], made);
  }
  for (int round = 0; round < settings.repeats; ++round) {
    for (std::size_t i = 0; i < variants.size(); ++i) {
      const Variant& variant = variants[i];
      if (variant.record) variant.record->take_milliseconds();
      const RunTimes times = timed_run(walk(device, configuration, settings, variant), variant.engine,
                                       settings.timed_frames, made);
      results[i].milliseconds.add(variant.record ? variant.record->take_milliseconds() : times.milliseconds);
    }
  }
  return results;
}

int diagrams_of_variant(const EvaluationSettings& settings) {
  return engines_side_by_side * (settings.frames + 1) + settings.repeats * (settings.timed_frames + 1);
}

}  // namespace vorocl::command
