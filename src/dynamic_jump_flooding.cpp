#include "vorocl/dynamic_jump_flooding.hpp"

#include <optional>
#include <string>

#include "flood.hpp"
#include "seeds_state.hpp"

namespace vorocl {

namespace {

/// Whether waves may start from what the diagram held: it was filled, and from no bad point, which would have
/// left holes. Waits for the check of points that came in the caller's buffer.
bool is_sound(const std::optional<DiagramContents>& contents) {
  if (!contents) return false;
  const SeedsFrame* const seeds = contents->seeds.get();
  return seeds == nullptr || !seeds->points || !seeds->points->bad_point();
}

/// Whether every label names a seed that is still there.
bool all_labels_live(const DiagramContents& contents, const SeedsFrame& now) {
  return contents.seeds && contents.seeds->owner == now.owner &&
         contents.seeds->vanishings == now.vanishings && contents.seeds->alive() > 0;
}

}  // namespace

Report dynamic_jump_flooding(const Seeds& seeds, Diagram& diagram, double max_displacement,
                             const DynamicJumpFloodingOptions& options) {
  Flood flood(seeds, diagram, options.metric);
  if (options.refresh_interval < 0) {
    throw Error("a refresh every " + std::to_string(options.refresh_interval) +
                " frames is not possible; give 0 or more");
  }
  const Plan plan = dynamic_jump_flooding_plan(diagram.grid(), seeds.alive(), max_displacement, options.plan);
  // A full JFA has the neighbourhood of a plan that is not mixed.
  const bool von_neumann = options.plan.neighbourhood == NeighbourhoodMix::von_neumann;
  const Plan full = jump_flooding_plan(diagram.grid(), JumpFloodingVariant::jfa,
                                       von_neumann ? Neighbourhood::von_neumann : Neighbourhood::moore);

  const std::optional<DiagramContents>& previous = flood.previous();
  const bool refresh =
      options.refresh_interval > 0 && previous && previous->age + 1 >= options.refresh_interval;
  const bool measured = options.reach == Reach::measured;
  const auto start_anew = [&](std::size_t waves_before) {
    if (measured) flood.count_far_pixels();
    flood.run(full);
    return flood.commit(waves_before + full.size());
  };
  if (refresh || seeds.alive() == 0 || !is_sound(previous)) return start_anew(0);

  if (measured) {
    const LabelDistances distances = flood.measure_labels(reach_of(plan));
    const DynamicPlan reaching = reaching_plan(diagram.grid(), seeds.alive(), max_displacement, distances,
                                               options.metric, options.plan);
    flood.count_far_pixels();
    if (reaching.from_seeds) {
      flood.run(reaching.waves);
    } else {
      flood.run_from_labels(reaching.waves);
    }
    return flood.commit(reaching.waves.size(), previous->age + 1);
  }
  flood.advance_labels();
  flood.run_from_labels(plan);
  const bool all_labelled = all_labels_live(*previous, *Internal::state(seeds).frame());
  if (!all_labelled && flood.some_unlabelled()) return start_anew(plan.size());
  return flood.commit(plan.size(), previous->age + 1);
}

}  // namespace vorocl
