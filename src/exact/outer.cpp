#include "exact/outer.hpp"

#include <algorithm>

#include "core/seeds_state.hpp"
#include "runtime/buffer.hpp"
// Last: it defines macros.
#include "exact/sizes.cl"

namespace vorocl {

namespace {

struct OuterWorkspace {
  cl::Buffer lists, counts;  // by box of pixels
};

std::size_t boxes_along(int pixels) { return (static_cast<std::size_t>(pixels - 1) >> OUTER_BOX_BITS) + 1; }

}  // namespace

cl::Event add_outer_seeds(const Filling& filling, DiagramState& state, const cl::Event& last) {
  const std::shared_ptr<const OuterSeeds>& outer = filling.placement().outer;
  if (!outer) return last;
  const PixelGrid& grid = filling.placement().grid;
  const int width = grid.width(), height = grid.height();
  const cl_int4& region = outer->region;
  const auto kernel = [&](const char* name) -> Kernel& {
    return state.kernels.get(state.device, "exact/outer.cl", name, grid,
                             {filling.metric(), Neighbourhood::moore, outer->extent});
  };
  cl::Event event = last;
  if (outer->count > 0) {
    const std::size_t boxes = boxes_along(width) * boxes_along(height);
    OuterWorkspace& memory = state.workspace<OuterWorkspace>();
    state.reserve(memory.lists, boxes * OUTER_LIST * word);
    state.reserve(memory.counts, boxes * 2 * word);
    // Work-items that do much each: small groups spread them over the compute units.
    const std::size_t group = state.device.tuning().group_width * state.device.tuning().group_height;
    kernel("list_outer_seeds")
        .in_groups_of(std::min<std::size_t>(group, 64))
        .over_items(boxes, outer->places, outer->nodes, outer->count, outer->top, outer->top_start,
                    state.labels, outer->seeds, region, outer->home, width, height, memory.lists,
                    memory.counts);
    Kernel& compare = kernel("compare_outer_seeds");
    const std::size_t squares_of_row = OUTER_BOX / compare.vector_width();
    event = compare.over_items(boxes * squares_of_row * squares_of_row, outer->places, outer->nodes,
                               outer->count, outer->top, outer->top_start, state.labels, outer->seeds,
                               outer->ids, region, width, height, memory.lists, memory.counts);
  }
  if (!outer->labels_all(grid)) {
    event = kernel("clear_outside_region").over_grid(state.labels, region, width, height);
  }
  return event;
}

}  // namespace vorocl
