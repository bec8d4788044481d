#include "exact/group_shape.hpp"

#include <algorithm>

#include "exact/group_index.hpp"
#include "runtime/buffer.hpp"
#include "runtime/device_state.hpp"
#include "runtime/opencl_info.hpp"
// Last: it defines macros.
#include "exact/group/sizes.cl"

namespace vorocl {

namespace {

std::size_t patches_along(int pixels) { return (static_cast<std::size_t>(pixels - 1) >> PATCH_BITS) + 1; }

struct GroupWorkspace {
  IndexMemory index;
  cl::Buffer pending;  // by patch, whether it has no labels yet
  cl::Buffer queue;    // of patches for the search: how many, and of each the number and a seed near it
};

/// A work-group of the search has more items than others: it may have all seeds as candidates of one patch
/// while most of the device has nothing to do.
std::size_t items_of_search(const Device& device) {
  const std::size_t most = std::min<std::size_t>(Internal::state(device).limits.items, MOST_ITEMS);
  std::size_t items = device.tuning().patch_items;
  while (items * 2 <= most) items *= 2;
  return items;
}

/// More work-groups than a device runs at a time, but few, as mostly there is nothing for them to do.
std::size_t groups_of_search(const Device& device, std::size_t patches) {
  const std::size_t units = device_info<cl_uint>(device.cl_device()(), CL_DEVICE_MAX_COMPUTE_UNITS);
  return std::min(patches, 8 * units);
}

}  // namespace

bool labels_in_groups(const Filling& filling, const DiagramState& state) {
  const PixelGrid& grid = filling.placement().grid;
  const bool index_holds_images = (!grid.periodic_x() || grid.width() <= MOST_PERIOD_OF_GROUPS) &&
                                  (!grid.periodic_y() || grid.height() <= MOST_PERIOD_OF_GROUPS);
  return state.device.tuning().shape == Shape::group && !filling.takes_places() && index_holds_images;
}

Report exact_diagram_in_groups(Filling& filling, DiagramState& state) {
  const PixelGrid& grid = filling.placement().grid;
  const int width = grid.width(), height = grid.height();
  const std::size_t patches = patches_along(width) * patches_along(height);
  GroupWorkspace& memory = state.workspace<GroupWorkspace>();
  state.reserve(memory.pending, patches * word);
  state.reserve(memory.queue, (1 + 2 * patches) * word);

  const char* const file = "exact/group/diagram.cl";
  const Device device = without_vectors(state.device);
  const std::size_t items = device.tuning().patch_items;
  const std::size_t of_search = items_of_search(device);
  const auto kernel = [&](const char* name, std::size_t items_of_group) -> Kernel& {
    return filling.kernel(device, file, name).in_groups_of(items_of_group);
  };
  const cl::Event first = make_index(filling, state, device, memory.index, file);
  const auto& [bits, word_starts, starts, list, ids, bit_of_seed, duplicates, pyramid] = memory.index;
  const int top = top_level(IndexFrame(grid));
  kernel("label_dense_patches", items)
      .over_items(patches * items, bits, starts, word_starts, list, ids, width, height, state.labels,
                  memory.pending, memory.queue);
  kernel("label_patches", items)
      .over_items(patches * items, bits, starts, word_starts, list, ids, width, height, pyramid, top,
                  memory.pending, state.labels, memory.queue);
  const cl::Event last =
      kernel("search_patches", of_search)
          .over_items(groups_of_search(device, patches) * of_search, bits, starts, word_starts, list, ids,
                      width, height, pyramid, top, memory.queue, state.labels);
  return filling.commit(0, first, last);
}

}  // namespace vorocl
