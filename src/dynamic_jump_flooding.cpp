#include "vorocl/dynamic_jump_flooding.hpp"

#include "buffer.hpp"
#include "flood.hpp"
#include "kernel.hpp"
#include "vorocl/jump_flooding.hpp"

namespace vorocl {

namespace {

/// A full JFA, with the neighbourhood of a plan that is not mixed.
Report full_jump_flooding(const Seeds& seeds, Diagram& diagram, const DynamicJumpFloodingOptions& options) {
  const bool von_neumann = options.plan.neighbourhood == NeighbourhoodMix::von_neumann;
  return jump_flooding(seeds, diagram,
                       {options.metric, von_neumann ? Neighbourhood::von_neumann : Neighbourhood::moore});
}

/// Whether a pixel has no label. Waits.
bool some_unlabelled(Diagram& diagram) {
  const Device& device = diagram.device();
  const Grid& grid = diagram.grid();
  const cl::Buffer& found = diagram.scratch(Diagram::Scratch::flags, sizeof(cl_int));
  fill(device, found, cl_int{0}, 1);
  Kernel(device, "dynamic_jump_flooding.cl", "find_unlabelled", grid)
      .over_grid(diagram.labels(), grid.width(), grid.height(), found);
  return download<cl_int>(device, found, 1).front() != 0;
}

Report flood_from_last_frame(const Seeds& seeds, Diagram& diagram, const Plan& plan, Metric metric) {
  Flood flood(seeds, diagram, metric);
  flood.advance_labels();
  for (std::size_t i = 0; i + 1 < plan.size(); ++i) flood.wave(plan[i]);
  flood.last_wave(plan.empty() ? Wave{flood.no_step(), Neighbourhood::von_neumann} : plan.back());
  return flood.report(static_cast<int>(plan.size()));
}

}  // namespace

Report dynamic_jump_flooding(const Seeds& seeds, Diagram& diagram,
                             const DynamicJumpFloodingOptions& options) {
  if (options.refresh_interval < 0) {
    throw Error("a refresh every " + std::to_string(options.refresh_interval) +
                " frames is not possible; give 0 or more");
  }
  const Plan plan = dynamic_jump_flooding_plan(diagram.grid(), seeds.alive(), options.plan);
  const int age = diagram.age() + 1;
  const bool refresh = options.refresh_interval > 0 && age >= options.refresh_interval;
  if (!diagram.filled() || refresh || seeds.alive() == 0) return full_jump_flooding(seeds, diagram, options);

  const bool all_labelled = diagram.holds_labels_of(seeds);
  Report report = flood_from_last_frame(seeds, diagram, plan, options.metric);
  if (!all_labelled && some_unlabelled(diagram)) return report + full_jump_flooding(seeds, diagram, options);
  diagram.set_age(age);
  return report;
}

}  // namespace vorocl
