#include "vorocl/exact_diagram.hpp"

#include <algorithm>

#include "buffer.hpp"
#include "diagram_state.hpp"
#include "exact/group_shape.hpp"
#include "exact/lists.hpp"
// Last: it defines macros.
#include "exact/sizes.cl"

namespace vorocl {

namespace {

constexpr std::size_t pixels_of_bin = std::size_t{1} << 2 * BIN_BITS;
constexpr std::size_t most_lanes = 16;
constexpr std::size_t most_items_for_duplicates = 4096;  // there are seldom any seeds that share a pixel
static_assert(MOST_CANDIDATES % most_lanes == 0, "the last list is read in whole vectors");
constexpr std::size_t word = sizeof(std::uint32_t);

std::size_t bins_along(int pixels, int level) {
  const int bits = BIN_BITS + FAN_BITS * level;
  return (static_cast<std::size_t>(pixels - 1) >> bits) + 1;
}

std::size_t bins(const Grid& grid, int level) {
  return bins_along(grid.width(), level) * bins_along(grid.height(), level);
}

int top_level(const Grid& grid) {
  int level = 0;
  while (bins(grid, level) > TOP_BINS) ++level;
  return level;
}

std::size_t bins_of_all_levels(const Grid& grid) {
  std::size_t all = 0;
  for (int level = 0; level <= top_level(grid); ++level) all += bins(grid, level);
  return all;
}

/// The engine's working memory.
struct ExactWorkspace {
  // the index of the seeds
  cl::Buffer bits, word_starts, starts, list, ids, list_end;
  cl::Buffer bit_of_seed, duplicates, duplicate_count;  // while the index is made
  cl::Buffer pyramid;
  // what is labelled already, and the candidates of what is not
  cl::Buffer labelled, lists, counts;
};

}  // namespace

Report exact_diagram(const Seeds& seeds, Diagram& diagram, const ExactOptions& options) {
  return exact_diagram_with_lists(seeds, diagram, options, ListLength::full);
}

Report exact_diagram_with_lists(const Seeds& seeds, Diagram& diagram, const ExactOptions& options,
                                ListLength length) {
  if (Internal::state(diagram).device.tuning().shape == Shape::group) {
    return exact_diagram_in_groups(seeds, diagram, options, length);
  }
  Filling filling(seeds, diagram);
  DiagramState& state = Internal::state(diagram);
  const Device& device = state.device;
  const Grid& grid = state.grid;
  const int width = grid.width(), height = grid.height();
  const int top = top_level(grid);
  const auto count = static_cast<cl_uint>(seeds.size());
  const std::size_t across = bins_along(width, 0), down = bins_along(height, 0);
  const std::size_t pairs = across * ((down - 1) / PAIR + 1);

  ExactWorkspace& memory = state.workspace<ExactWorkspace>();
  const std::size_t bit_words = bins(grid, 0) * pixels_of_bin / 32;
  const std::size_t list_count = bins(grid, TILE) + bins(grid, REGION);
  // Lists are read in whole vectors, ids in rows of a bin.
  const std::size_t list_room = seeds.size() + most_lanes;
  state.reserve(memory.bits, bit_words * word);
  state.reserve(memory.word_starts, bit_words * word);
  state.reserve(memory.starts, (bins(grid, 0) + down) * word);
  state.reserve(memory.list, list_room * word);
  state.reserve(memory.ids, list_room * word);
  state.reserve(memory.list_end, word);
  state.reserve(memory.bit_of_seed, seeds.size() * word);
  state.reserve(memory.duplicates, seeds.size() * word);
  state.reserve(memory.duplicate_count, word);
  state.reserve(memory.pyramid, bins_of_all_levels(grid) * word);
  state.reserve(memory.labelled, pairs * word);
  state.reserve(memory.lists, list_count * MOST_CANDIDATES * word);
  state.reserve(memory.counts, list_count * word);

  const char* const file = length == ListLength::full ? "exact/diagram.cl" : "exact/short_lists.cl";
  const std::size_t group = device.tuning().group_width * device.tuning().group_height;
  const auto kernel = [&](const char* name) -> Kernel& {
    return state.kernel(file, name, {options.metric}).in_groups_of(group);
  };
  // Work-items that do much each: small groups spread them over the compute units.
  const auto heavy = [&](const char* name, std::size_t most) -> Kernel& {
    return kernel(name).in_groups_of(std::min(group, most));
  };
  const auto& [bits, word_starts, starts, list, ids, list_end, bit_of_seed, duplicates, duplicate_count,
               pyramid, labelled, lists, counts] = memory;

  const cl::Event first = fill(device, bits, cl_uint{0}, bit_words);
  fill(device, duplicate_count, cl_uint{0}, 1);
  fill(device, list_end, cl_uint{0}, 1);
  kernel("set_bits")
      .over_items(count, seeds.positions(), count, bits, bit_of_seed, duplicates, duplicate_count, width);
  kernel("find_representatives").over_items(bins(grid, 0), bits, pyramid, starts, width, height);
  for (int level = 1; level <= top; ++level) {
    kernel("find_representatives_above").over_items(bins(grid, level), pyramid, width, height, level);
  }
  kernel("share_out_list").over_items(down, starts, list_end, width, height);
  kernel("start_words").over_items(bins(grid, 0), bits, starts, word_starts, width, height);
  kernel("list_seeds").over_items(count, seeds.positions(), bit_of_seed, count, bits, word_starts, list, ids);
  kernel("keep_lowest_ids")
      .over_items(std::min(seeds.size(), most_items_for_duplicates), seeds.positions(), duplicates,
                  duplicate_count, bits, word_starts, ids, width);
  heavy("label_near", 64)
      .over_items(pairs, bits, starts, word_starts, list, ids, width, height, state.labels, labelled);
  for (const int level : {REGION, TILE}) {
    heavy("list_candidates", 8)
        .over_items(bins(grid, level), bits, starts, word_starts, list, ids, width, height, level, labelled,
                    pyramid, top, lists, counts, state.labels);
  }
  const cl::Event last = heavy("label_far", 64)
                             .over_items(pairs, bits, starts, word_starts, list, ids, width, height, labelled,
                                         pyramid, top, lists, counts, state.labels);
  return filling.commit(0, first, last);
}

}  // namespace vorocl
