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

/// The index has a margin along periodic axes: see exact/seed_index.cl.
int frame_width(const Grid& grid) { return grid.width() + (grid.periodic_x() ? 2 * MARGIN : 0); }
int frame_height(const Grid& grid) { return grid.height() + (grid.periodic_y() ? 2 * MARGIN : 0); }

/// The most seeds that the index lists: each with all its images, of which a pixel has one.
std::size_t most_listed(const Grid& grid, std::size_t seeds) {
  const auto frame =
      static_cast<std::size_t>(frame_width(grid)) * static_cast<std::size_t>(frame_height(grid));
  const auto images = [](int frame_side, int side) {
    return static_cast<std::size_t>((frame_side - 1) / side) + 1;
  };
  const std::size_t of_a_seed =
      images(frame_width(grid), grid.width()) * images(frame_height(grid), grid.height());
  return std::min(seeds * of_a_seed, seeds + frame - grid.pixels());
}

}  // namespace

std::size_t bins_across(const Grid& grid, int level) { return bins_along(frame_width(grid), level); }
std::size_t bins_down(const Grid& grid, int level) { return bins_along(frame_height(grid), level); }
std::size_t bins(const Grid& grid, int level) { return bins_across(grid, level) * bins_down(grid, level); }

int top_level(const Grid& grid) {
  int level = 0;
  while (bins(grid, level) > TOP_BINS) ++level;
  return level;
}

namespace {
std::size_t bins_of_all_levels(const Grid& grid) {
  std::size_t all = 0;
  for (int level = 0; level <= top_level(grid); ++level) all += bins(grid, level);
  return all;
}
}  // namespace

cl::Event make_index(DiagramState& state, const Device& device, const Seeds& seeds, IndexMemory& memory,
                     Shape shape, const char* file, Metric metric) {
  const Grid& grid = state.grid;
  const int width = grid.width(), height = grid.height();
  const auto count = static_cast<cl_uint>(seeds.size());
  const std::size_t down = bins_down(grid, 0), bit_words = bins(grid, 0) * pixels_of_bin / 32;
  state.reserve(memory.bits, bit_words * word);
  state.reserve(memory.word_starts, bit_words * word);
  state.reserve(memory.starts, (bins(grid, 0) + down) * word);
  const std::size_t list_room = most_listed(grid, seeds.size()) + behind_list;
  state.reserve(memory.list, list_room * word);
  state.reserve(memory.ids, list_room * word);
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
  cl::Event first = fill(device, bits, cl_uint{0}, bit_words);
  fill(device, duplicate_count, cl_uint{0}, 1);
  fill(device, list_end, cl_uint{0}, 1);
  kernel("set_bits")
      .over_items(count, seeds.positions(), count, bits, bit_of_seed, duplicates, duplicate_count, width,
                  height);
  kernel("find_representatives").over_items(bins(grid, 0), bits, pyramid, starts, width, height);
  for (int level = 1; level <= top_level(grid); ++level) {
    kernel("find_representatives_above").over_items(bins(grid, level), pyramid, width, height, level);
  }
  if (shape == Shape::group) {
    kernel("share_out_list_in_groups")
        .in_groups_of(tuning.patch_items)
        .over_items(down * tuning.patch_items, starts, list_end, width);
  } else {
    kernel("share_out_list").over_items(down, starts, list_end, width, height);
  }
  kernel("start_words").over_items(bins(grid, 0), bits, starts, word_starts, width, height);
  kernel("list_seeds")
      .over_items(count, seeds.positions(), bit_of_seed, count, bits, word_starts, list, ids, width, height);
  kernel("keep_lowest_ids")
      .over_items(std::min(seeds.size(), most_items_for_duplicates), seeds.positions(), duplicates,
                  duplicate_count, bits, word_starts, ids, width, height);
  return first;
}

}  // namespace vorocl
