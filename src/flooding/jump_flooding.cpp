#include "vorocl/jump_flooding.hpp"

#include <string>

#include "flooding/flood.hpp"
#include "volumes/jump_flooding.hpp"

namespace vorocl {

namespace {

void check_steps(const Plan& plan) {
  for (const Wave& wave : plan) {
    if (wave.step >= 1 && wave.step <= Window::max_side) continue;
    throw Error("a wave's step is " + std::to_string(wave.step) + "; it must be from 1 to " +
                std::to_string(Window::max_side));
  }
}

Report run_plan(const Seeds& seeds, Diagram& diagram, const Plan& plan, Metric metric, const char* method) {
  if (has_voxels(diagram.window().grid())) {
    Filling filling(seeds, diagram, metric, method);
    refuse_seeds_beyond(filling.placement(), filling.seeds(), "flooding");
    check_steps(plan);
    return flood_volume(filling, Internal::state(diagram), plan);
  }
  Flood flood(seeds, diagram, metric, method);
  check_steps(plan);
  flood.run(plan);
  return flood.commit(plan.size());
}

const char* name_of(JumpFloodingVariant variant) {
  switch (variant) {
    case JumpFloodingVariant::jfa:
      return "jfa";
    case JumpFloodingVariant::jfa_plus_1:
      return "jfa+1";
    case JumpFloodingVariant::jfa_plus_2:
      return "jfa+2";
    case JumpFloodingVariant::one_plus_jfa:
      return "1+jfa";
  }
  return "";
}

}  // namespace

Report flood(const Seeds& seeds, Diagram& diagram, const Plan& plan, Metric metric) {
  return run_plan(seeds, diagram, plan, metric, "flood");
}

Report jump_flooding(const Seeds& seeds, Diagram& diagram, const JumpFloodingOptions& options) {
  return run_plan(seeds, diagram,
                  jump_flooding_plan(diagram.window(), options.variant, options.neighbourhood),
                  options.metric, name_of(options.variant));
}

}  // namespace vorocl
