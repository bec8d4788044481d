#include "vorocl/exact_diagram.hpp"

#include <algorithm>

#include "core/diagram_state.hpp"
#include "exact/group_shape.hpp"
#include "exact/index.hpp"
#include "exact/outer.hpp"
#include "exact/points.hpp"
#include "masks/exact_diagram.hpp"
#include "points/exact_diagram.hpp"
#include "runtime/buffer.hpp"
// Last: it defines macros.
#include "exact/sizes.cl"

namespace vorocl {

namespace {

constexpr std::size_t most_lanes = 16;
static_assert(MOST_CANDIDATES % most_lanes == 0, "the last list is read in whole vectors");

/// The engine's working memory.
struct ExactWorkspace {
  IndexMemory index;
  cl::Buffer labelled, lists, counts;  // what is labelled already, and the candidates of what is not
};

}  // namespace

Report exact_diagram(const Seeds& seeds, Diagram& diagram, const ExactOptions& options) {
  Filling filling(seeds, diagram, options.metric, "exact");
  DiagramState& state = Internal::state(diagram);
  if (state.grid.is_volume()) check_exact_volume(filling, state);
  if (labels_by_passes(filling, state)) return exact_diagram_by_passes(filling, state);
  if (state.grid.is_volume()) return exact_diagram_of_volume(filling, state);
  if (filling.seeds().are_points) return exact_diagram_of_points(filling, state);
  const Device& device = state.device;
  if (device.tuning().shape == Shape::group) return exact_diagram_in_groups(filling, state);
  const PixelGrid& grid = filling.placement().grid;
  const IndexFrame frame(grid, Shape::vector);
  const int width = grid.width(), height = grid.height();
  const std::size_t pairs = bins_across(frame, 0) * ((bins_down(frame, 0) - 1) / PAIR + 1);

  ExactWorkspace& memory = state.workspace<ExactWorkspace>();
  const std::size_t list_count = bins(frame, TILE) + bins(frame, REGION);
  state.reserve(memory.labelled, pairs * word);
  state.reserve(memory.lists, list_count * MOST_CANDIDATES * word);
  state.reserve(memory.counts, list_count * word);

  const char* const file = "exact/diagram.cl";
  const std::size_t group = device.tuning().group_width * device.tuning().group_height;
  // Work-items that do much each: small groups spread them over the compute units.
  const auto heavy = [&](const char* name, std::size_t most) -> Kernel& {
    return filling.kernel(file, name).in_groups_of(std::min(group, most));
  };
  const cl::Event first = make_index(filling, state, device, memory.index, Shape::vector, file);
  const auto& [bits, word_starts, starts, list, ids, bit_of_seed, duplicates, pyramid] = memory.index;
  const auto& [index, labelled, lists, counts] = memory;
  const int top = top_level(frame);
  heavy("label_near", 64)
      .over_items(pairs, bits, starts, word_starts, list, ids, width, height, state.labels, labelled);
  for (const int level : {REGION, TILE}) {
    heavy("list_candidates", 8)
        .over_items(bins(frame, level), bits, starts, word_starts, list, ids, width, height, level, labelled,
                    pyramid, top, lists, counts, state.labels);
  }
  const cl::Event last = heavy("label_far", 64)
                             .over_items(pairs, bits, starts, word_starts, list, ids, width, height, labelled,
                                         pyramid, top, lists, counts, state.labels);
  return filling.commit(0, first, add_outer_seeds(filling, state, last));
}

}  // namespace vorocl
