#include "vorocl/jump_flooding.hpp"

#include <string>

#include "flooding/flood.hpp"

namespace vorocl {

Report flood(const Seeds& seeds, Diagram& diagram, const Plan& plan, Metric metric) {
  Flood flood(seeds, diagram, metric);
  for (const Wave& wave : plan) {
    if (wave.step < 1 || wave.step > Grid::max_side) {
      throw Error("a wave's step is " + std::to_string(wave.step) + "; it must be from 1 to " +
                  std::to_string(Grid::max_side));
    }
  }
  flood.run(plan);
  return flood.commit(plan.size());
}

Report jump_flooding(const Seeds& seeds, Diagram& diagram, const JumpFloodingOptions& options) {
  return flood(seeds, diagram, jump_flooding_plan(diagram.grid(), options.variant, options.neighbourhood),
               options.metric);
}

}  // namespace vorocl
