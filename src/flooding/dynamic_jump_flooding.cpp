#include "vorocl/dynamic_jump_flooding.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "core/seeds_state.hpp"
#include "flooding/flood.hpp"

namespace vorocl {

namespace {

/// How far seeds went since the diagram was filled; as far as they can where the diagram does not know.
double way_since(const std::optional<DiagramContents>& previous, const SeedsFrame& now) {
  if (!previous) return 0;
  if (previous->seeds) return now.way_from(*previous->seeds);
  return static_cast<double>(std::max(now.grid.width(), now.grid.height()));
}

/// Whether every pixel has the label of a seed that is still there. Waits for the check of points that came
/// in the caller's buffer: a bad one may have left pixels without a label.
bool all_labels_live(const DiagramContents& contents, const SeedsFrame& now) {
  const SeedsFrame* const seeds = contents.seeds.get();
  return seeds != nullptr && seeds->owner == now.owner && seeds->losses == now.losses && seeds->alive() > 0 &&
         !(seeds->points && seeds->points->bad_point());
}

}  // namespace

Report dynamic_jump_flooding(const Seeds& seeds, Diagram& diagram,
                             const DynamicJumpFloodingOptions& options) {
  Flood flood(seeds, diagram, options.metric, "djfa");
  const Window& window = diagram.window();
  if (options.refresh_interval < 0) {
    throw Error("a refresh every " + std::to_string(options.refresh_interval) +
                " frames is not possible; give 0 or more");
  }
  check_dynamic_plan(window, options.max_displacement.value_or(0), options.plan);
  const std::optional<DiagramContents>& previous = flood.previous();
  // A full JFA has the neighbourhood of a plan that is not mixed.
  const bool von_neumann = options.plan.neighbourhood == NeighbourhoodMix::von_neumann;
  const Plan full = jump_flooding_plan(window, JumpFloodingVariant::jfa,
                                       von_neumann ? Neighbourhood::von_neumann : Neighbourhood::moore);
  const bool measured = options.reach == Reach::measured;
  const std::size_t alive = options.alive ? *options.alive : measured ? seeds.size() : seeds.alive();

  const bool refresh =
      options.refresh_interval > 0 && previous && previous->age + 1 >= options.refresh_interval;
  if (refresh || alive == 0 || !previous) {
    flood.run(full);
    return flood.commit(full.size());
  }
  const int age = previous->age + 1;
  if (measured) {
    const Plan plan = reaching_plan(window, alive, flood.label_distances(), options.metric, options.plan);
    flood.run(plan);
    return flood.commit(plan.size(), age);
  }
  const double max_displacement =
      options.max_displacement ? *options.max_displacement : way_since(previous, flood.seeds());
  const Plan plan = dynamic_jump_flooding_plan(window, alive, max_displacement, options.plan, options.reach);
  const bool fills = options.alive || all_labels_live(*previous, flood.seeds());
  flood.run_from_labels(plan);
  if (!fills && flood.some_unlabelled()) {
    flood.run(full);
    return flood.commit(plan.size() + full.size());
  }
  return flood.commit(plan.size(), age);
}

}  // namespace vorocl
