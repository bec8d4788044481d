// A plan: the waves that a flooding algorithm runs, as plain data that can be printed and tested without a
// device.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "vorocl/export.h"
#include "vorocl/grid.hpp"

namespace vorocl {

/// One pass over all pixels with one step (in pixels, at least 1).
struct Wave {
  int step = 1;
  Neighbourhood neighbourhood = Neighbourhood::moore;

  friend bool operator==(const Wave& a, const Wave& b) {
    return a.step == b.step && a.neighbourhood == b.neighbourhood;
  }
};

using Plan = std::vector<Wave>;

/// The variants of jump flooding, by the waves they add to JFA's (Rong & Tan 2006, 2007).
enum class JumpFloodingVariant {
  jfa,           ///< k1, k1 / 2, ..., 1
  jfa_plus_1,    ///< JFA, then 1
  jfa_plus_2,    ///< JFA, then 2, 1
  one_plus_jfa,  ///< 1, then JFA
};

/// k1 = 2^(ceil(log2 N) - 1), the first step of JFA, with N the longest side (the paper's k_1). 0 for N = 1,
/// which needs no wave. A grid is the window that shows all of it. Throws Error if the window is larger than
/// a diagram can be.
VOROCL_API int first_step(const Window& window);

/// The waves of jump flooding: steps first_step(window), half of it, ..., 1, and the variant's extra waves. A
/// window of one pixel has an empty plan. Throws as first_step().
VOROCL_API Plan jump_flooding_plan(const Window& window,
                                   JumpFloodingVariant variant = JumpFloodingVariant::jfa,
                                   Neighbourhood neighbourhood = Neighbourhood::moore);

/// Which neighbourhoods the waves of dynamic jump flooding have.
enum class NeighbourhoodMix {
  mixed,        ///< von Neumann first, then Moore; the last wave is Moore (the paper's choice)
  moore,        ///< all Moore
  von_neumann,  ///< all von Neumann, which goes wrong, as the paper shows
};

struct DynamicPlanOptions {
  NeighbourhoodMix neighbourhood = NeighbourhoodMix::mixed;
  int von_neumann_waves = 2;  ///< 0, 1 or 2: how many waves of a mixed plan are von Neumann
  int extra_waves = 0;        ///< 0, 1 or 2: one more wave of step 1, or two of steps 2 and 1
};

/// Where the waves of dynamic jump flooding get their reach from, and what they start from.
enum class Reach {
  measured,  ///< how far the last labels are from their seeds; from the seeds: dynamic_jump_flooding()
  paper,     ///< the seeds' mean density and d_max alone, the paper's Eq. 4; from the last labels
  authors,   ///< the same, rounded down where Eq. 4 rounds up, as the program of the paper's authors does
};

/// The waves of dynamic jump flooding for a number of seeds that are alive and have moved by at most
/// `max_displacement` pixels along an axis (the paper's d_max): steps delta_1, half of it, ..., 1 and the
/// extra waves, with delta_1 = 2^ceil(log2(max(2 L, d_max))) (the paper's Eq. 4), L = sqrt(width * height /
/// seeds), from 1 to first_step(window). Of Reach::authors, delta_1 = 2^floor(log2(max(2 L, d_max))), so
/// there is a wave less, unless max(2 L, d_max) is a power of two or both steps are first_step(window):
/// docs/evaluation.md says what that is worth. Of Reach::measured no plan is known before the labels are: it
/// is the paper's. Throws Error if the displacement or an option is out of its range.
VOROCL_API Plan dynamic_jump_flooding_plan(const Window& window, std::size_t seeds, double max_displacement,
                                           const DynamicPlanOptions& options = {},
                                           Reach reach = Reach::paper);

/// The steps, each von Neumann wave marked: "32v 16v 8 4 2 1".
VOROCL_API std::string to_string(const Plan& plan);

}  // namespace vorocl
