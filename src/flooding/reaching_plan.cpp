#include "flooding/reaching_plan.hpp"

#include <cmath>
#include <numeric>

#include "runtime/metric.hpp"

namespace vorocl {

namespace {

/// Whether the paper's plan can be relied on: the reasons are in docs/moving_seeds.md.
bool is_reliable(const Plan& plan, const Window& window, std::size_t seeds, double max_displacement,
                 const LabelDistances& distances, Metric metric) {
  constexpr double most_far = 0.1;
  const double to_corner = reach_of(plan) * to_corner_of_square(metric);
  const double length = std::sqrt(static_cast<double>(window.pixels()) / static_cast<double>(seeds));
  const bool shorter_than_jfa = !plan.empty() && plan.front().step < first_step(window);
  const bool labels_help = max_displacement < (shorter_than_jfa ? 2 : 0.5) * length;
  return distances.greatest <= to_corner && distances.far <= most_far && labels_help;
}

}  // namespace

DynamicPlan reaching_plan(const Window& window, std::size_t seeds, double max_displacement,
                          const LabelDistances& distances, Metric metric, const DynamicPlanOptions& options) {
  const Plan paper = dynamic_jump_flooding_plan(window, seeds, max_displacement, options);
  if (is_reliable(paper, window, seeds, max_displacement, distances, metric)) return {false, paper};
  const bool von_neumann = options.neighbourhood == NeighbourhoodMix::von_neumann;
  const Neighbourhood neighbourhood = von_neumann ? Neighbourhood::von_neumann : Neighbourhood::moore;
  Plan plan = jump_flooding_plan(window, JumpFloodingVariant::jfa, neighbourhood);
  // Without its first wave, JFA's plan still reaches the sum of the other steps.
  while (plan.size() > 1 && reach_of(plan) - plan.front().step >= distances.greatest + distances.margin)
    plan.erase(plan.begin());
  if (!plan.empty()) append_extra_waves(plan, options.extra_waves, neighbourhood);
  return {true, plan};
}

int reach_of(const Plan& plan) {
  return std::accumulate(plan.begin(), plan.end(), 0,
                         [](int sum, const Wave& wave) { return sum + wave.step; });
}

}  // namespace vorocl
