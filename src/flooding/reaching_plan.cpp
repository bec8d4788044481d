#include "flooding/reaching_plan.hpp"

#include <algorithm>
#include <cmath>
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

}  // namespace

Plan reaching_plan(const Window& window, std::size_t seeds, const LabelDistances& distances, Metric metric,
                   const DynamicPlanOptions& options) {
  const bool von_neumann = options.neighbourhood == NeighbourhoodMix::von_neumann;
  const Neighbourhood neighbourhood = von_neumann ? Neighbourhood::von_neumann : Neighbourhood::moore;
  const int rows_between = distances.row_interval / 2;
  const double needed = farthest(distances, window, metric) + rows_between;
  const Plan full = jump_flooding_plan(window, JumpFloodingVariant::jfa, neighbourhood);
  Plan plan = full;
  // Without its first wave, JFA's plan still reaches the sum of the other steps.
  while (plan.size() > 1 && reach_of(plan) - plan.front().step >= needed) plan.erase(plan.begin());
  // Around a period JFA's longer waves come back, and carry labels by more ways.
  const bool lacks_ways = window.periodic() != Axes::none && plan.size() < full.size();
  const bool spare = lacks_ways || plan.size() < dynamic_jump_flooding_plan(window, seeds, 0).size();
  if (!plan.empty()) append_extra_waves(plan, std::max(options.extra_waves, spare ? 1 : 0), neighbourhood);
  return plan;
}

int reach_of(const Plan& plan) {
  return std::accumulate(plan.begin(), plan.end(), 0,
                         [](int sum, const Wave& wave) { return sum + wave.step; });
}

}  // namespace vorocl
