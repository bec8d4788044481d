// Plans of dynamic jump flooding whose reach follows from the last labels, and not from the seeds' mean
// density.
#pragma once

#include <cstddef>
#include <limits>

#include "vorocl/plan.hpp"

namespace vorocl {

/// What a diagram's labels say of a new frame of seeds.
struct LabelDistances {
  /// The greatest distance of a measured pixel from its label's seed, where that is now, in pixels; infinite
  /// if one has no label whose seed is there. No measured pixel is farther from its nearest seed.
  double greatest = std::numeric_limits<double>::infinity();

  /// The share of pixels that were far from their seed when the labels were made: farther than L, or in the
  /// Manhattan metric than the distance that as many pixels are within. exp(-pi) = 0.043 of them are, where
  /// seeds are spread evenly; 1 if it is not known.
  double far = 1;

  /// How much farther pixels may be that were not measured.
  double margin = 0;
};

/// Waves, and what they start from.
struct DynamicPlan {
  bool from_seeds;  ///< as JFA; else from the last labels, at the seeds' new pixels
  Plan waves;
};

/// The waves of dynamic jump flooding whose reach follows from the last labels. The paper's plan, where it
/// can be relied on: the square that it reaches holds the greatest distance, at most a tenth of the pixels
/// were far from their seeds, and seeds moved by less than 2 L, or by less than L / 2 if it begins with JFA's
/// first step. Else JFA's waves from the least step whose plan covers that distance, and the extra waves: as
/// good as JFA, and never longer. docs/moving_seeds.md says why old labels are no start there. Throws as
/// dynamic_jump_flooding_plan().
DynamicPlan reaching_plan(const Window& window, std::size_t seeds, double max_displacement,
                          const LabelDistances& distances, Metric metric,
                          const DynamicPlanOptions& options = {});

/// How far the waves of a plan carry a label along an axis: the sum of their steps.
int reach_of(const Plan& plan);

/// Appends a wave of step 1, or two of steps 2 and 1.
void append_extra_waves(Plan& plan, int waves, Neighbourhood neighbourhood);

}  // namespace vorocl
