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

  /// The shares of measured pixels that were farther from their seed than L, and than 1.5 L, when the labels
  /// were made; in the Manhattan metric than the distance that as many pixels are within. Where seeds are
  /// spread evenly, exp(-pi) = 0.043 and exp(-1.5^2 pi) = 0.0009 of them are.
  static constexpr double far_lengths = 1, farther_lengths = 1.5;
  double far = 0, farther = 0;

  /// How many measured pixels have no label whose seed is there now.
  std::size_t missing = 0;

  /// One row in so many was measured, from the first on.
  int row_interval = 1;

  /// How many seeds have appeared since the labels were made.
  std::size_t born = 0;
};

/// Waves, and what they start from.
struct DynamicPlan {
  bool from_seeds;  ///< as JFA; else from the last labels, at the seeds' new pixels
  bool fills;       ///< no pixel of the last labels can be left without one
  Plan waves;
};

/// The waves of dynamic jump flooding whose reach follows from the last labels. The paper's plan, where it
/// can be relied on: the square that it reaches holds the greatest distance, at most a tenth of the pixels
/// were farther than L and a hundredth farther than 1.5 L from their seeds, at most a thousandth of the seeds
/// have appeared, and seeds moved by less than 2 L, or by less than L / 2 if it begins with JFA's first step.
/// Else JFA's waves from the least step whose plan covers that distance, and the extra waves.
/// docs/moving_seeds.md gives the reasons. Throws as dynamic_jump_flooding_plan().
DynamicPlan reaching_plan(const Window& window, std::size_t seeds, double max_displacement,
                          const LabelDistances& distances, Metric metric,
                          const DynamicPlanOptions& options = {});

/// How far the waves of a plan carry a label along an axis: the sum of their steps.
int reach_of(const Plan& plan);

/// Appends a wave of step 1, or two of steps 2 and 1.
void append_extra_waves(Plan& plan, int waves, Neighbourhood neighbourhood);

}  // namespace vorocl
