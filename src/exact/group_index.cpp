#include "exact/group_index.hpp"

#include <algorithm>

#include "runtime/buffer.hpp"
// Last: it defines macros.
#include "exact/group/sizes.cl"

namespace vorocl {

namespace {

constexpr std::size_t pixels_of_bin = std::size_t{1} << 2 * BIN_BITS;
constexpr std::size_t most_items_for_duplicates = 4096;  // there are seldom any seeds that share a pixel

std::size_t bins_along(int pixels, int level) {
  const int bits = BIN_BITS + FAN_BITS * level;
  return (static_cast<std::size_t>(pixels - 1) >> bits) + 1;
}

int frame_side(int side, bool periodic) { return side + (periodic ? 2 * MARGIN(side) : 0); }

/// The most seeds that the index lists: each with all its images, at most one in a pixel.
std::size_t most_listed(const PixelGrid& grid, const IndexFrame& frame, std::size_t seeds) {
  const auto pixels = static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
  const auto images = [](int of_frame, int side) {
    return static_cast<std::size_t>((of_frame - 1) / side) + 1;
  };
  const std::size_t of_a_seed = images(frame.width, grid.width()) * images(frame.height, grid.height());
  return std::min(seeds * of_a_seed, seeds + pixels - grid.pixels());
}

std::size_t bins(const IndexFrame& frame, int level) {
  return bins_along(frame.width, level) * bins_along(frame.height, level);
}

std::size_t bins_of_all_levels(const IndexFrame& frame) {
  std::size_t all = 0;
  for (int level = 0; level <= top_level(frame); ++level) all += bins(frame, level);
  return all;
}

}  // namespace

IndexFrame::IndexFrame(const PixelGrid& grid)
    : width(frame_side(grid.width(), grid.periodic_x())),
      height(frame_side(grid.height(), grid.periodic_y())) {}

int top_level(const IndexFrame& frame) {
  int level = 0;
  while (bins(frame, level) > TOP_BINS) ++level;
  return level;
}

cl::Event make_index(Filling& filling, DiagramState& state, const Device& device, IndexMemory& memory,
                     const char* file) {
  const PixelGrid& grid = filling.placement().grid;
  const cl::Buffer& positions = *filling.placement().positions;
  const std::size_t seeds = filling.seeds().size;
  const IndexFrame frame(grid);
  const int width = grid.width(), height = grid.height();
  const auto count = static_cast<cl_uint>(seeds);
  const std::size_t down = bins_along(frame.height, 0), bit_words = bins(frame, 0) * pixels_of_bin / 32;
  state.reserve(memory.bits, (bit_words + COUNTERS) * word);
  state.reserve(memory.word_starts, bit_words * word);
  state.reserve(memory.starts, (bins(frame, 0) + down) * word);
  const std::size_t list_room = most_listed(grid, frame, seeds);
  state.reserve(memory.list, list_room * word);
  state.reserve(memory.ids, list_room * word);
  state.reserve(memory.bit_of_seed, seeds * word);
  state.reserve(memory.duplicates, seeds * word);
  state.reserve(memory.pyramid, bins_of_all_levels(frame) * word);

  const auto counters = static_cast<cl_int>(bit_words);
  const Tuning& tuning = device.tuning();
  const auto kernel = [&](const char* name) -> Kernel& {
    return filling.kernel(device, file, name).in_groups_of(tuning.group_width * tuning.group_height);
  };
  const auto& [bits, word_starts, starts, list, ids, bit_of_seed, duplicates, pyramid] = memory;
  cl::Event first = fill(device, bits, cl_uint{0}, bit_words + COUNTERS);
  kernel("set_bits")
      .over_items(count, positions, count, bits, bit_of_seed, duplicates, counters, width, height);
  const int top = top_level(frame);
  const std::size_t items = tuning.patch_items;
  kernel("index_bins")
      .in_groups_of(items)
      .over_items(down * items, bits, pyramid, starts, word_starts, counters, width);
  for (int level = 1; level <= top; level += 2) {
    kernel("find_representatives")
        .in_groups_of(items)
        .over_items(bins(frame, level + 1) * items, pyramid, width, height, level, top);
  }
  kernel("list_seeds")
      .over_items(count, positions, bit_of_seed, count, bits, word_starts, list, ids, width, height);
  kernel("keep_lowest_ids")
      .over_items(std::min(seeds, most_items_for_duplicates), positions, duplicates, bits, word_starts, ids,
                  counters, width, height);
  return first;
}

}  // namespace vorocl
