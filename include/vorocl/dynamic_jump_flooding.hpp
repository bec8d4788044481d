// Dynamic jump flooding (dJFA): the diagram of seeds that moved, from the one they had before.
#pragma once

#include <cstddef>
#include <optional>

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"
#include "vorocl/plan.hpp"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

struct DynamicJumpFloodingOptions {
  Metric metric = Metric::euclidean;  ///< Euclidean is the paper's dJFAe, Manhattan its dJFAm
  DynamicPlanOptions plan = {};       ///< the waves
  int refresh_interval = 0;           ///< every how many frames a full JFA runs instead; 0: only for frame 0
  Reach reach = Reach::measured;      ///< whether the plan follows from the labels, or is fixed

  /// Of Reach::paper: no seed has moved farther along an axis since the diagram was last filled, in pixels:
  /// the paper's d_max. None: what the seeds know of it (Seeds::displacement(), over all frames since then).
  /// A seed that is reborn under its id is a new one, which has not moved; but if the diagram was not filled
  /// while it was away, it has moved from where it was then.
  std::optional<double> max_displacement = {};

  /// How many seeds are there: for points in the caller's buffer, so that the device is not asked. The waves
  /// depend on it, and Reach::paper then does not look whether they reach all pixels. None: Seeds::alive().
  std::optional<std::size_t> alive = {};
};

/// Fills the diagram with the help of the labels that it holds. A diagram that counts as never filled gets a
/// JFA.
///
/// Reach::measured: JFA's waves without the first ones. One row in eight of the labels shows
/// how far they are from where their seeds are now, and no pixel is farther from its nearest seed. The waves
/// begin with the least step whose plan covers that distance. If the paper's plan for so many seeds that
/// stand still has a wave more, or on a periodic grid JFA's, one of step 1 follows. So for any seeds and any
/// motion it is as close to the exact diagram as JFA (docs/moving_seeds.md). Cost: at most JFA's waves, and
/// the extra ones. Waits, once the labels are measured: each frame is enqueued when the device has come to
/// it. `max_displacement` does not matter, nor do von Neumann waves of a mixed plan.
///
/// Reach::paper: the paper's Algorithm 1, with waves that gather, and with seeds that are stamped at their
/// new pixels, which that algorithm does not say. Each label's seed is looked up at its new position, and
/// waves from a step that covers a cell and the motion mend the rest. Close to JFA where seeds are spread
/// evenly and move little (the paper's assumption), worse, without a word, where they are not. A label of a
/// vanished seed counts as none, and if a pixel is left without a label a full JFA follows. Cost: log2(step)
/// + 1 waves and a pass over the labels. Enqueues and returns, with exceptions for points of the caller's
/// and for seeds that vanish, in which it waits for all that was enqueued before:
/// - Unless it is told `max_displacement`, it asks how far the points have moved.
/// - Unless it is told how many seeds are `alive`, it asks so where a buffer said which are present, and
///   whether the last frame had a bad point. If it had, if a seed may have vanished, or if the labels are of
///   other seeds or were written by the caller, it looks whether pixels are left.
///
/// Reach::authors: the same with a wave less in most cases, and several times as many wrong pixels.
///
/// 13 bytes of device memory per pixel. Throws as jump_flooding(), and if an option is out of its range.
VOROCL_API Report dynamic_jump_flooding(const Seeds& seeds, Diagram& diagram,
                                        const DynamicJumpFloodingOptions& options = {});

}  // namespace vorocl
