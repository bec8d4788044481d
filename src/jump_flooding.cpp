#include "vorocl/jump_flooding.hpp"

#include <string>

#include "flood.hpp"
#include "vorocl/error.hpp"

namespace vorocl {

Report flood(const Seeds& seeds, Diagram& diagram, const Plan& plan, Metric metric) {
  for (const Wave& wave : plan) {
    if (wave.step < 1 || wave.step > Grid::max_side) {
      throw Error("a wave's step is " + std::to_string(wave.step) + "; it must be from 1 to " +
                  std::to_string(Grid::max_side));
    }
  }
  Flood flood(seeds, diagram, metric);
  // A plan of less than two waves has none to fuse the stamping or the ids with.
  const Wave none = {flood.no_step(), Neighbourhood::von_neumann};
  const std::size_t waves = plan.size();
  flood.first_wave(waves > 0 ? plan.front() : none);
  for (std::size_t i = 1; i + 1 < waves; ++i) flood.wave(plan[i]);
  flood.last_wave(waves > 1 ? plan.back() : none);
  return flood.report(static_cast<int>(waves));
}

Report jump_flooding(const Seeds& seeds, Diagram& diagram, const JumpFloodingOptions& options) {
  return flood(seeds, diagram, jump_flooding_plan(diagram.grid(), options.variant, options.neighbourhood),
               options.metric);
}

}  // namespace vorocl
