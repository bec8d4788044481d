#include "app/commands/simulate_course.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/outputs/measures.hpp"
#include "app/outputs/output_files.hpp"
#include "app/sources/bounds.hpp"
#include "app/terminal/console.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

namespace {

/// A value of the frames after frame 0: null if none has one.
Json value(const Samples& samples, double (Samples::*of)() const) {
  return samples.empty() ? Json() : Json((samples.*of)());
}

Json range(const Samples& samples) {
  return Json{{"least", value(samples, &Samples::least)}, {"greatest", value(samples, &Samples::greatest)}};
}

Json json_of(const SimulateOptions& options, const MovingSeeds& source, Simulation& simulation,
             const Course& course, Measures& measures) {
  const Seeds& seeds = simulation.seeds();
  Json result = json_of_diagram(options.method, options.method_options.metric, seeds, source.frame().view);
  result.update(Json{{"seeds", seeds.alive()},
                     {"empty_cells", measures.cell_count().empty},
                     {"first_frame", options.motion.frames.first},
                     {"frames", simulation.frame() - options.motion.frames.first},
                     {"waves", simulation.report(main_engine).waves()},
                     {"milliseconds", simulation.milliseconds(main_engine)},
                     {"host_milliseconds", simulation.host_milliseconds(main_engine)}});
  if (options.method.continues) {
    const PlanSamples& plans = course.plans;
    result["plans"] = Json{{"first_step", range(plans.first_steps)},
                           {"waves", range(plans.waves)},
                           {"max_displacement", range(plans.displacements)},
                           {"frames_from_seeds", plans.from_seeds},
                           {"jfa_frames", plans.jfa}};
  }
  if (!options.compare_with) return result;
  const Samples& similarities = course.similarities;
  result["similarity"] =
      Json{{"mean", value(similarities, &Samples::mean)}, {"least", value(similarities, &Samples::least)}};
  if (options.other_is_exact()) {
    const ErrorSamples& errors = course.errors;
    result["errors"] = Json{{"wrong_percent_mean", value(errors.wrong_percent, &Samples::mean)},
                            {"wrong_percent_greatest", value(errors.wrong_percent, &Samples::greatest)},
                            {"largest_excess", value(errors.largest_excess, &Samples::greatest)},
                            {"mean_excess", value(errors.mean_excess, &Samples::mean)}};
  }
  result["compare_with"] = Json{{"method", options.compare_with->name},
                                {"metric", to_string(options.other_metric())},
                                {"tolerance", options.tolerance ? Json(*options.tolerance) : Json()},
                                {"waves", simulation.report(other_engine).waves()},
                                {"milliseconds", simulation.milliseconds(other_engine)},
                                {"host_milliseconds", simulation.host_milliseconds(other_engine)}};
  return result;
}

void print_times(const std::string& method, Simulation& simulation, std::size_t engine, int frames) {
  print("{}: {:.3f} ms per frame, {} in the last\n", method,
        frames > 0 ? simulation.milliseconds(engine) / frames : 0,
        counted(simulation.report(engine).waves(), "wave"));
}

void print_text(const SimulateOptions& options, const MovingSeeds& source, Simulation& simulation,
                const Course& course, Measures& measures) {
  const Seeds& seeds = simulation.seeds();
  const View& view = source.frame().view;
  const int first = options.motion.frames.first;
  print("{} after frame {}, {} on {}, on {}\n", counted(simulation.frame() - first, "frame"), first,
        counted(seeds.alive(), "seed"), size_text(view), seeds.device().name());
  const CellCount count = measures.cell_count();
  print_empty_cells(count.empty, count.cells, seeds.alive(), name_of_pixel(view));
  const auto name_of = [&](const Method& method, Metric metric) {
    const bool differs = options.compare_with && options.other_metric() != options.method_options.metric;
    return differs ? fmt::format("{} ({})", method.name, to_string(metric)) : std::string(method.name);
  };
  print_times(name_of(options.method, options.method_options.metric), simulation, main_engine, course.timed);
  if (const PlanSamples& plans = course.plans; !plans.waves.empty()) {
    const std::string displacements =
        plans.displacements.empty()
            ? "no d_max (each frame has another grid than the one before)"
            : fmt::format("d_max {:.4g} to {:.4g} pixels", plans.displacements.least(),
                          plans.displacements.greatest());
    print("plans: first steps {} to {}, {} to {} waves, {}\n", plans.first_steps.least(),
          plans.first_steps.greatest(), plans.waves.least(), plans.waves.greatest(), displacements);
    print("frames from the seeds instead of the last labels: {}, of which {} with all waves of JFA\n",
          plans.from_seeds, plans.jfa);
  }
  if (options.compare_with) {
    print_times(name_of(*options.compare_with, options.other_metric()), simulation, other_engine,
                course.timed);
  }
  if (const Samples& similarities = course.similarities; !similarities.empty()) {
    print("similarity: mean {:.4f} %, least {:.4f} %\n", similarities.mean(), similarities.least());
  }
  if (const ErrorSamples& errors = course.errors; !errors.wrong_percent.empty()) {
    print("wrong {}s: mean {:.4f} %, greatest {:.4f} %; excess distance: mean {:.3g} {}, largest {:.3f}\n",
          name_of_pixel(view), errors.wrong_percent.mean(), errors.wrong_percent.greatest(),
          errors.mean_excess.mean(), unit_of_distances(view.window.grid()), errors.largest_excess.greatest());
  }
  print_written(requested_files(options.output));
}

}  // namespace

void print_result(const SimulateOptions& options, const MovingSeeds& source, Simulation& simulation,
                  const Course& course, Measures& measures) {
  if (options.json) {
    print_json(json_of(options, source, simulation, course, measures));
  } else {
    print_text(options, source, simulation, course, measures);
  }
}

}  // namespace vorocl::command
