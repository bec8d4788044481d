// Plans of dynamic jump flooding whose reach follows from the last labels, and not from the seeds' mean
// density.
#pragma once

#include <cstddef>

#include "vorocl/plan.hpp"

namespace vorocl {

/// What a diagram's labels say of a new frame of seeds.
struct LabelDistances {
  /// The greatest distance of a measured pixel from its label's seed, where that is now, in pixels. No such
  /// pixel is farther from its nearest seed.
  double greatest = 0;

  /// How many measured pixels have no label whose seed is there now.
  std::size_t missing = 0;

  /// One row in so many was measured, so that none is farther than half of it from a measured one.
  int row_interval = 1;
};

/// The waves of dynamic jump flooding whose reach follows from the last labels: JFA's, from the least step
/// whose plan covers the greatest distance, and the extra waves. If none was asked for, one of step 1 follows
/// where the paper's plan for so many seeds that stand still has a wave more, and on periodic grids where
/// JFA's has. docs/moving_seeds.md gives the reasons.
Plan reaching_plan(const Window& window, std::size_t seeds, const LabelDistances& distances, Metric metric,
                   const DynamicPlanOptions& options = {});

/// How far the waves of a plan carry a label along an axis: the sum of their steps.
int reach_of(const Plan& plan);

/// Throws Error if the displacement or an option is out of its range, or the grid is a volume.
void check_dynamic_plan(const Window& window, double max_displacement, const DynamicPlanOptions& options);

/// Appends a wave of step 1, or two of steps 2 and 1.
void append_extra_waves(Plan& plan, int waves, Neighbourhood neighbourhood);

}  // namespace vorocl
