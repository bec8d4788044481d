#include "exact/group_shape.hpp"

#include "exact/index.hpp"
#include "exact/outer.hpp"
// Last: it defines macros.
#include "exact/group/sizes.cl"

namespace vorocl {

namespace {

constexpr std::size_t word = sizeof(std::uint32_t);

std::size_t patches_along(int pixels) { return (static_cast<std::size_t>(pixels - 1) >> PATCH_BITS) + 1; }

struct GroupWorkspace {
  IndexMemory index;
  cl::Buffer pending;  // by patch, whether it has no labels yet
  cl::Buffer queue;    // of patches for the search: how many, and of each the number and a seed near it
};

/// The kernels have no vectors, so that one program serves every width.
Device without_vectors(const Device& device) {
  Tuning tuning = device.tuning();
  tuning.vector_width = 1;
  return device.with_tuning(tuning);
}

}  // namespace

bool fits_in_groups(const Grid& grid) {
  return (!grid.periodic_x() || grid.width() <= MOST_PERIOD_OF_GROUPS) &&
         (!grid.periodic_y() || grid.height() <= MOST_PERIOD_OF_GROUPS);
}

Report exact_diagram_in_groups(const Seeds& seeds, Diagram& diagram, const ExactOptions& options,
                               ListLength length) {
  Filling filling(seeds, diagram);
  DiagramState& state = Internal::state(diagram);
  const int width = state.grid.width(), height = state.grid.height();
  const std::size_t patches = patches_along(width) * patches_along(height);
  GroupWorkspace& memory = state.workspace<GroupWorkspace>();
  state.reserve(memory.pending, patches * word);
  state.reserve(memory.queue, (1 + 2 * patches) * word);

  const char* const file =
      length == ListLength::full ? "exact/group/diagram.cl" : "exact/group/short_lists.cl";
  const Device device = without_vectors(state.device);
  const std::size_t items = device.tuning().patch_items;
  const auto kernel = [&](const char* name) -> Kernel& {
    return state.kernels.get(device, file, name, state.grid, {options.metric}).in_groups_of(items);
  };
  const cl::Event first = make_index(state, device, seeds, memory.index, Shape::group, file, options.metric);
  const auto& [bits, word_starts, starts, list, ids, list_end, bit_of_seed, duplicates, duplicate_count,
               pyramid] = memory.index;
  const int top = top_level(IndexFrame(state.grid, Shape::group));
  kernel("label_dense_patches")
      .over_items(patches * items, bits, starts, word_starts, list, ids, width, height, state.labels,
                  memory.pending, memory.queue);
  kernel("label_patches")
      .over_items(patches * items, bits, starts, word_starts, list, ids, width, height, pyramid, top,
                  memory.pending, state.labels, memory.queue);
  const cl::Event last = kernel("search_patches")
                             .over_items(patches * items, bits, starts, word_starts, list, ids, width, height,
                                         pyramid, top, memory.queue, state.labels);
  return filling.commit(0, first, add_outer_seeds(state, seeds, options.metric, length, last));
}

}  // namespace vorocl
