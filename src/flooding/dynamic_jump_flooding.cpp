#include "vorocl/dynamic_jump_flooding.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "core/seeds_state.hpp"
#include "flooding/flood.hpp"

namespace vorocl {

namespace {

/// Whether waves may start from what the diagram held: it was filled, and from no bad point, which would have
/// left holes. Waits for the check of points that came in the caller's buffer.
bool is_sound(const std::optional<DiagramContents>& contents) {
  if (!contents) return false;
  const SeedsFrame* const seeds = contents->seeds.get();
  return seeds == nullptr || !seeds->points || !seeds->points->bad_point();
}

/// How far seeds went since the diagram was filled; as far as they can where the diagram does not know.
double way_since(const std::optional<DiagramContents>& previous, const SeedsFrame& now) {
  if (!previous) return 0;
  if (previous->seeds) return now.way_from(*previous->seeds);
  return static_cast<double>(std::max(now.grid.width(), now.grid.height()));
}

/// Whether every label names a seed that is still there.
bool all_labels_live(const DiagramContents& contents, const SeedsFrame& now) {
  return contents.seeds && contents.seeds->owner == now.owner && contents.seeds->losses == now.losses &&
         contents.seeds->alive() > 0;
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
  const std::optional<DiagramContents>& previous = flood.previous();
  const std::size_t alive = seeds.alive();
  const double max_displacement =
      options.max_displacement ? *options.max_displacement : way_since(previous, flood.seeds());
  const Plan plan = dynamic_jump_flooding_plan(window, alive, max_displacement, options.plan, options.reach);
  // A full JFA has the neighbourhood of a plan that is not mixed.
  const bool von_neumann = options.plan.neighbourhood == NeighbourhoodMix::von_neumann;
  const Plan full = jump_flooding_plan(window, JumpFloodingVariant::jfa,
                                       von_neumann ? Neighbourhood::von_neumann : Neighbourhood::moore);

  const bool refresh =
      options.refresh_interval > 0 && previous && previous->age + 1 >= options.refresh_interval;
  const bool measured = options.reach == Reach::measured;
  const auto commit = [&](std::size_t waves, int age) {
    if (measured && alive > 0) flood.count_far_pixels();
    return flood.commit(waves, age);
  };
  if (refresh || alive == 0 || !is_sound(previous)) {
    flood.run(full);
    return commit(full.size(), 0);
  }
  if (measured) {
    const DynamicPlan reaching = reaching_plan(
        window, alive, max_displacement, flood.label_distances(reach_of(plan)), options.metric, options.plan);
    if (reaching.from_seeds) {
      flood.run(reaching.waves);
      return commit(reaching.waves.size(), previous->age + 1);
    }
  }
  flood.run_from_labels(plan);
  const bool all_labelled = all_labels_live(*previous, flood.seeds());
  if (!all_labelled && flood.some_unlabelled()) {
    flood.run(full);
    return commit(plan.size() + full.size(), 0);
  }
  return commit(plan.size(), previous->age + 1);
}

}  // namespace vorocl
