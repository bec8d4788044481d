#include "methods.hpp"

#include "vorocl/dynamic_jump_flooding.hpp"
#include "vorocl/error.hpp"
#include "vorocl/exact_diagram.hpp"
#include "vorocl/jump_flooding.hpp"
#include "vorocl/standard_flooding.hpp"

namespace vorocl::command {

namespace {

/// For methods all of whose waves are alike; a mix is what djfa makes of them.
Neighbourhood neighbourhood(const MethodOptions& options) {
  return options.neighbourhood == NeighbourhoodMix::von_neumann ? Neighbourhood::von_neumann
                                                                : Neighbourhood::moore;
}

Report run_standard_flooding(const Seeds& seeds, Diagram& diagram, double, const MethodOptions& options) {
  return standard_flooding(seeds, diagram, {options.metric, neighbourhood(options)});
}

template <JumpFloodingVariant variant>
Report run_jump_flooding(const Seeds& seeds, Diagram& diagram, double, const MethodOptions& options) {
  return jump_flooding(seeds, diagram, {options.metric, neighbourhood(options), variant});
}

Plan plan_standard_flooding(const Grid&, int waves, const MethodOptions& options) {
  return Plan(static_cast<std::size_t>(waves), {1, neighbourhood(options)});
}

template <JumpFloodingVariant variant>
Plan plan_jump_flooding(const Grid& grid, int, const MethodOptions& options) {
  return jump_flooding_plan(grid, variant, neighbourhood(options));
}

Report run_dynamic_jump_flooding(const Seeds& seeds, Diagram& diagram, double d_max,
                                 const MethodOptions& options) {
  const DynamicPlanOptions plan = {d_max, options.neighbourhood.value_or(NeighbourhoodMix::mixed),
                                   options.von_neumann_waves, options.extra_waves};
  return dynamic_jump_flooding(seeds, diagram, {options.metric, plan, options.refresh_interval});
}

Report run_exact(const Seeds& seeds, Diagram& diagram, double, const MethodOptions& options) {
  return exact_diagram(seeds, diagram, {options.metric});
}

template <JumpFloodingVariant variant>
Method of_jump_flooding(const char* name) {
  return {name, false, run_jump_flooding<variant>, false, plan_jump_flooding<variant>};
}

}  // namespace

const std::vector<Method>& methods() {
  static const std::vector<Method> all = {
      {"standard-flooding", false, run_standard_flooding, false, plan_standard_flooding},
      of_jump_flooding<JumpFloodingVariant::jfa>("jfa"),
      of_jump_flooding<JumpFloodingVariant::jfa_plus_1>("jfa+1"),
      of_jump_flooding<JumpFloodingVariant::jfa_plus_2>("jfa+2"),
      of_jump_flooding<JumpFloodingVariant::one_plus_jfa>("1+jfa"),
      {"djfa", true, run_dynamic_jump_flooding, false, plan_jump_flooding<JumpFloodingVariant::jfa>},
      {"exact", false, run_exact, true},
  };
  return all;
}

Simulation::Engine engine(const Method& method, const MethodOptions& options) {
  return [run = method.run, options](const Seeds& seeds, Diagram& diagram, double d_max) {
    return run(seeds, diagram, d_max, options);
  };
}

const Method& method(const std::string& name) {
  for (const Method& method : methods()) {
    if (method.name == name) return method;
  }
  throw Error("there is no method " + name);
}

std::string to_string(Metric metric) { return metric == Metric::euclidean ? "euclidean" : "manhattan"; }

}  // namespace vorocl::command
