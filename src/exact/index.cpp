#include "exact/index.hpp"

#include <algorithm>

#include "buffer.hpp"
#include "exact/sizes.cl"

namespace vorocl {

namespace {

constexpr std::size_t pixels_of_bin = std::size_t{1} << 2 * BIN_BITS;
constexpr std::size_t behind_list = 16;                  // lists are read in whole vectors
constexpr std::size_t most_items_for_duplicates = 4096;  // there are seldom any seeds that share a pixel
constexpr std::size_t word = sizeof(std::uint32_t);

std::size_t bins_along(int pixels, int level) {
  const int bits = BIN_BITS + FAN_BITS * level;
  return (static_cast<std::size_t>(pixels - 1) >> bits) + 1;
}

std::size_t bins(const Grid& grid, int level) {
  return bins_along(grid.width(), level) * bins_along(grid.height(), level);
}

std::size_t bins_of_all_levels(const Grid& grid) {
  std::size_t all = 0;
  for (int level = 0; level <= top_level(grid); ++level) all += bins(grid, level);
  return all;
}

}  // namespace

int top_level(const Grid& grid) {
  int level = 0;
  while (bins(grid, level) > TOP_BINS) ++level;
  return level;
}

cl::Event make_index(DiagramState& state, const Device& device, const Seeds& seeds, IndexMemory& memory,
                     const char* file, Metric metric) {
  const Grid& grid = state.grid;
  const int width = grid.width(), height = grid.height();
  const auto count = static_cast<cl_uint>(seeds.size());
  const std::size_t down = bins_along(height, 0), bit_words = bins(grid, 0) * pixels_of_bin / 32;
  state.reserve(memory.bits, bit_words * word);
  state.reserve(memory.word_starts, bit_words * word);
  state.reserve(memory.starts, (bins(grid, 0) + down) * word);
  state.reserve(memory.list, (seeds.size() + behind_list) * word);
  state.reserve(memory.ids, (seeds.size() + behind_list) * word);
  state.reserve(memory.list_end, word);
  state.reserve(memory.bit_of_seed, seeds.size() * word);
  state.reserve(memory.duplicates, seeds.size() * word);
  state.reserve(memory.duplicate_count, word);
  state.reserve(memory.pyramid, bins_of_all_levels(grid) * word);

  const Tuning& tuning = device.tuning();
  const auto kernel = [&](const char* name) -> Kernel& {
    return state.kernels.get(device, file, name, grid, {metric})
        .in_groups_of(tuning.group_width * tuning.group_height);
  };
  const auto& [bits, word_starts, starts, list, ids, list_end, bit_of_seed, duplicates, duplicate_count,
               pyramid] = memory;
  const cl::Event first = fill(device, bits, cl_uint{0}, bit_words);
  fill(device, duplicate_count, cl_uint{0}, 1);
  fill(device, list_end, cl_uint{0}, 1);
  kernel("set_bits")
      .over_items(count, seeds.positions(), count, bits, bit_of_seed, duplicates, duplicate_count, width);
  kernel("find_representatives").over_items(bins(grid, 0), bits, pyramid, starts, width, height);
  for (int level = 1; level <= top_level(grid); ++level) {
    kernel("find_representatives_above").over_items(bins(grid, level), pyramid, width, height, level);
  }
  kernel("share_out_list_in_groups")
      .in_groups_of(tuning.patch_items)
      .over_items(down * tuning.patch_items, starts, list_end, width);
  kernel("start_words").over_items(bins(grid, 0), bits, starts, word_starts, width, height);
  kernel("list_seeds").over_items(count, seeds.positions(), bit_of_seed, count, bits, word_starts, list, ids);
  kernel("keep_lowest_ids")
      .over_items(std::min(seeds.size(), most_items_for_duplicates), seeds.positions(), duplicates,
                  duplicate_count, bits, word_starts, ids, width);
  return first;
}

}  // namespace vorocl
