#include "vorocl/method.hpp"

#include "runtime/metric.hpp"
#include "runtime/pixel_grid.hpp"
#include "vorocl/dynamic_jump_flooding.hpp"
#include "vorocl/error.hpp"
#include "vorocl/exact_diagram.hpp"
#include "vorocl/jump_flooding.hpp"
#include "vorocl/low_resolution.hpp"
#include "vorocl/standard_flooding.hpp"

namespace vorocl {

namespace {

/// Throws Error for options that djfa alone has a use for.
void refuse_mixed(const MethodOptions& options) {
  if (options.neighbourhood == NeighbourhoodMix::mixed) {
    throw Error("a mixed neighbourhood is for dynamic jump flooding (djfa) alone");
  }
}

/// For low resolution, whose waves all look at Moore neighbours and which the Manhattan metric does not
/// serve.
void check_low_resolution(const MethodOptions& options) {
  refuse_mixed(options);
  if (options.metric != Metric::euclidean) {
    throw Error(
        "low-resolution has the Euclidean metric alone; by the Manhattan one jfa takes hardly longer and has "
        "fewer wrong pixels");
  }
  if (options.neighbourhood == NeighbourhoodMix::von_neumann) {
    throw Error("the waves of low-resolution have the Moore neighbourhood; von-neumann is for the others");
  }
}

/// For methods whose waves all have one neighbourhood.
Neighbourhood neighbourhood(const MethodOptions& options) {
  refuse_mixed(options);
  return options.neighbourhood == NeighbourhoodMix::von_neumann ? Neighbourhood::von_neumann
                                                                : Neighbourhood::moore;
}

Report run_standard_flooding(const Seeds& seeds, Diagram& diagram, const MethodOptions& options) {
  return standard_flooding(seeds, diagram, {options.metric, neighbourhood(options)});
}

template <JumpFloodingVariant variant>
Report run_jump_flooding(const Seeds& seeds, Diagram& diagram, const MethodOptions& options) {
  return jump_flooding(seeds, diagram, {options.metric, neighbourhood(options), variant});
}

Report run_dynamic_jump_flooding(const Seeds& seeds, Diagram& diagram, const MethodOptions& options) {
  const DynamicPlanOptions plan = {options.neighbourhood.value_or(NeighbourhoodMix::mixed),
                                   options.von_neumann_waves, options.extra_waves};
  return dynamic_jump_flooding(
      seeds, diagram,
      {options.metric, plan, options.refresh_interval, options.reach, options.max_displacement});
}

Report run_low_resolution(const Seeds& seeds, Diagram& diagram, const MethodOptions& options) {
  check_low_resolution(options);
  return low_resolution(seeds, diagram);
}

Report run_exact(const Seeds& seeds, Diagram& diagram, const MethodOptions& options) {
  refuse_mixed(options);
  return exact_diagram(seeds, diagram, {options.metric});
}

Plan plan_standard_flooding(const Window&, int waves, const MethodOptions& options) {
  if (waves < 0) throw Error("a plan of " + std::to_string(waves) + " waves is not possible; 0 is the least");
  return Plan(static_cast<std::size_t>(waves), {1, neighbourhood(options)});
}

template <JumpFloodingVariant variant>
Plan plan_jump_flooding(const Window& window, int, const MethodOptions& options) {
  return jump_flooding_plan(window, variant, neighbourhood(options));
}

/// From seeds alone it runs JFA.
Plan plan_dynamic_jump_flooding(const Window& window, int, const MethodOptions& options) {
  const bool von_neumann = options.neighbourhood == NeighbourhoodMix::von_neumann;
  return jump_flooding_plan(window, JumpFloodingVariant::jfa,
                            von_neumann ? Neighbourhood::von_neumann : Neighbourhood::moore);
}

template <JumpFloodingVariant variant>
Method of_jump_flooding(const char* name) {
  return {name, false, false, false, true, run_jump_flooding<variant>, plan_jump_flooding<variant>};
}

}  // namespace

const std::vector<Method>& methods() {
  static const std::vector<Method> all = {
      {"standard-flooding", false, false, false, false, run_standard_flooding, plan_standard_flooding},
      of_jump_flooding<JumpFloodingVariant::jfa>("jfa"),
      of_jump_flooding<JumpFloodingVariant::jfa_plus_1>("jfa+1"),
      of_jump_flooding<JumpFloodingVariant::jfa_plus_2>("jfa+2"),
      of_jump_flooding<JumpFloodingVariant::one_plus_jfa>("1+jfa"),
      {"djfa", false, true, false, false, run_dynamic_jump_flooding, plan_dynamic_jump_flooding},
      {"low-resolution", false, false, false, false, run_low_resolution, nullptr},
      {"exact", true, false, true, true, run_exact, nullptr},
  };
  return all;
}

const Method& method(std::string_view name) {
  std::string names;
  for (const Method& method : methods()) {
    if (method.name == name) return method;
    names += (names.empty() ? "" : ", ") + method.name;
  }
  throw Error("there is no method \"" + std::string(name) + "\"; there are " + names);
}

void check_options(const Method& method, const MethodOptions& options) {
  if (!method.exact) refuse_great_circles(options.metric, method.name);
  if (!method.continues) refuse_mixed(options);
  if (method.run == run_low_resolution) check_low_resolution(options);
}

Simulation::Engine engine(const Method& method, const MethodOptions& options) {
  return [run = method.run, options](const Seeds& seeds, Diagram& diagram) {
    return run(seeds, diagram, options);
  };
}

void prepare(const Method& method, const Device& device, const Window& window, std::size_t seeds,
             const MethodOptions& options, Snap snap) {
  const Grid& grid = window.grid();
  const bool fits = has_voxels(grid) || fits_in_a_diagram(grid);
  const Grid pixels(fits ? grid : Grid(window.width(), window.height(), window.periodic()));
  Diagram diagram(device, fits ? window : Window(pixels));
  const Seeds random = Seeds::random(device, pixels, seeds, 1);
  method.run(
      snap == Snap::none ? Seeds(device, pixels, random.read(), {Outside::count, snap}) : random.clone(),
      diagram, options);
  if (method.continues) {
    // The second frame runs the longest plan and, because its seeds are others, the search for pixels without
    // a label; the third one starts from its labels: all need kernels that the first frame does not.
    const Seeds others = Seeds::random(device, pixels, seeds, 2);
    MethodOptions farthest = options;
    farthest.max_displacement = static_cast<double>(window.longest_side());
    method.run(others, diagram, farthest);
    method.run(others, diagram, options);
  }
  diagram.wait();
}

}  // namespace vorocl
