#include "flooding/reaching_plan.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include "runtime/metric.hpp"

namespace vorocl {

namespace {

/// How far a pixel of a measured row may be from its nearest seed, in pixels. A pixel without a label is no
/// farther from one with a label than the radius of a quarter disc, in a corner, that has as many pixels.
double farthest(const LabelDistances& distances, const Window& window, Metric metric) {
  if (distances.missing == 0) return distances.greatest;
  constexpr double pi = 3.14159265358979323846;
  const double missing = static_cast<double>(distances.missing) * distances.row_interval;
  const double hole = in_pixels(metric, radius_of_area(metric, 4 / pi * missing));
  // A narrower strip has no such quarter.
  if (hole > static_cast<double>(std::min(window.width(), window.height()))) {
    return std::numeric_limits<double>::infinity();
  }
  return distances.greatest + hole + distances.row_interval;
}

/// Whether the waves of a plan, from the labels, leave no pixel without one. Less than a row interval above
/// or below a pixel is a measured one, and in its row a label, no more columns away than labels are missing.
/// Steps along rows take any wave; those along columns the Moore waves behind them, for both at once.
bool fills(const Plan& plan, const LabelDistances& distances) {
  const int between = distances.row_interval - 1;
  if (distances.missing == 0) return reach_of(plan) >= between;
  Plan moore;
  std::copy_if(plan.begin(), plan.end(), std::back_inserter(moore),
               [](const Wave& wave) { return wave.neighbourhood == Neighbourhood::moore; });
  return reach_of(moore) >= between && distances.missing <= static_cast<std::size_t>(reach_of(plan));
}

/// Whether the paper's plan can be relied on: the reasons are in docs/moving_seeds.md.
bool is_reliable(const Plan& plan, const Window& window, std::size_t seeds, double max_displacement,
                 const LabelDistances& distances, Metric metric) {
  constexpr double most_far = 0.1, most_farther = 0.01;
  constexpr std::size_t per_born = 1000;
  const double to_corner = reach_of(plan) * to_corner_of_square(metric);
  const double length = std::sqrt(static_cast<double>(window.pixels()) / static_cast<double>(seeds));
  const bool shorter_than_jfa = !plan.empty() && plan.front().step < first_step(window);
  const bool labels_help = max_displacement < (shorter_than_jfa ? 2 : 0.5) * length;
  return farthest(distances, window, metric) <= to_corner && distances.far <= most_far &&
         distances.farther <= most_farther && distances.born <= seeds / per_born && labels_help;
}

}  // namespace

DynamicPlan reaching_plan(const Window& window, std::size_t seeds, double max_displacement,
                          const LabelDistances& distances, Metric metric, const DynamicPlanOptions& options) {
  const Plan paper = dynamic_jump_flooding_plan(window, seeds, max_displacement, options);
  if (is_reliable(paper, window, seeds, max_displacement, distances, metric)) {
    return {false, fills(paper, distances), paper};
  }
  const bool von_neumann = options.neighbourhood == NeighbourhoodMix::von_neumann;
  const Neighbourhood neighbourhood = von_neumann ? Neighbourhood::von_neumann : Neighbourhood::moore;
  const double needed = farthest(distances, window, metric) + distances.row_interval - 1;
  Plan plan = jump_flooding_plan(window, JumpFloodingVariant::jfa, neighbourhood);
  // Without its first wave, JFA's plan still reaches the sum of the other steps.
  while (plan.size() > 1 && reach_of(plan) - plan.front().step >= needed) plan.erase(plan.begin());
  if (!plan.empty()) append_extra_waves(plan, options.extra_waves, neighbourhood);
  return {true, true, plan};
}

int reach_of(const Plan& plan) {
  return std::accumulate(plan.begin(), plan.end(), 0,
                         [](int sum, const Wave& wave) { return sum + wave.step; });
}

}  // namespace vorocl
