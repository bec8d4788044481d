#include "vorocl/exact_diagram.hpp"

#include <algorithm>
#include <chrono>
#include <string>

#include "buffer.hpp"
#include "exact/lists.hpp"
#include "kernel.hpp"
// Last: it defines macros.
#include "exact/sizes.cl"

namespace vorocl {

namespace {

constexpr std::size_t pixels_of_cell = std::size_t{1} << 2 * CELL_BITS;
constexpr std::size_t most_lanes = 16;
constexpr std::size_t most_items_for_late = 4096;  // there are seldom any seeds that share a pixel

std::size_t cells_along(int pixels, int level) {
  const int bits = CELL_BITS + FAN_BITS * level;
  return (static_cast<std::size_t>(pixels - 1) >> bits) + 1;
}

std::size_t cells(const Grid& grid, int level) {
  return cells_along(grid.width(), level) * cells_along(grid.height(), level);
}

int top_level(const Grid& grid) {
  int level = 0;
  while (cells(grid, level) > TOP_CELLS) ++level;
  return level;
}

}  // namespace

Report exact_diagram(const Seeds& seeds, Diagram& diagram, const ExactOptions& options) {
  return exact_diagram_with_lists(seeds, diagram, options, ListLength::full);
}

Report exact_diagram_with_lists(const Seeds& seeds, Diagram& diagram, const ExactOptions& options,
                                ListLength length) {
  const auto started = std::chrono::steady_clock::now();
  diagram.begin(seeds);
  const Device& device = diagram.device();
  const Grid& grid = diagram.grid();
  const int top = top_level(grid);
  std::size_t all_cells = 0;
  for (int level = 0; level <= top; ++level) all_cells += cells(grid, level);

  using Scratch = Diagram::Scratch;
  constexpr std::size_t word = sizeof(std::uint32_t);
  const std::size_t bit_words = cells(grid, 0) * pixels_of_cell / 32;
  const std::size_t starts_count = cells(grid, 0) + cells_along(grid.height(), 0);
  const std::size_t across = cells_along(grid.width(), 0), down = cells_along(grid.height(), 0);
  const std::size_t pairs = across * ((down - 1) / PAIR + 1);
  const std::size_t list_count = cells(grid, TILE) + cells(grid, REGION);
  // Lists are read in whole runs, ids in rows of a cell.
  const std::size_t list_room = seeds.size() + most_lanes;
  const cl::Buffer bits = diagram.scratch(Scratch::exact_bits, bit_words * word);
  const cl::Buffer word_starts = diagram.scratch(Scratch::exact_word_starts, bit_words * word);
  const cl::Buffer starts = diagram.scratch(Scratch::exact_starts, starts_count * word);
  const cl::Buffer list = diagram.scratch(Scratch::exact_list, list_room * word);
  const cl::Buffer ids = diagram.scratch(Scratch::exact_ids, list_room * word);
  const cl::Buffer places = diagram.scratch(Scratch::exact_places, seeds.size() * word);
  const cl::Buffer late = diagram.scratch(Scratch::exact_late, seeds.size() * word);
  const cl::Buffer late_count = diagram.scratch(Scratch::flags, word);
  const cl::Buffer listed = diagram.scratch(Scratch::exact_listed, word);
  const cl::Buffer pyramid = diagram.scratch(Scratch::exact_pyramid, all_cells * word);
  const cl::Buffer labelled = diagram.scratch(Scratch::exact_labelled, pairs * word);
  const cl::Buffer lists = diagram.scratch(Scratch::exact_candidates, list_count * MOST_CANDIDATES * word);
  const cl::Buffer counts = diagram.scratch(Scratch::exact_counts, list_count * word);

  const std::string file = length == ListLength::full ? "exact/diagram.cl" : "exact/short_lists.cl";
  const std::size_t group = device.tuning().group_width * device.tuning().group_height;
  const auto kernel = [&](const char* name) {
    return Kernel(device, file, name, grid, {options.metric}).in_groups_of(group);
  };
  const auto count = static_cast<cl_uint>(seeds.size());
  const int width = grid.width(), height = grid.height();

  const cl::Event first = fill(device, bits, cl_uint{0}, bit_words);
  fill(device, late_count, cl_uint{0}, 1);
  fill(device, listed, cl_uint{0}, 1);
  kernel("set_bits").over_items(count, seeds.positions(), count, bits, places, late, late_count, width);
  kernel("name_seeds").over_items(cells(grid, 0), bits, pyramid, starts, width, height);
  for (int level = 1; level <= top; ++level) {
    kernel("name_seeds_above").over_items(cells(grid, level), pyramid, width, height, level);
  }
  kernel("share_out_list").over_items(down, starts, listed, width, height);
  kernel("start_words").over_items(cells(grid, 0), bits, starts, word_starts, width, height);
  kernel("list_seeds").over_items(count, seeds.positions(), places, count, bits, word_starts, list, ids);
  kernel("keep_lowest_ids")
      .over_items(std::min(seeds.size(), most_items_for_late), seeds.positions(), late, late_count, bits,
                  word_starts, ids, width);
  // Work-items that do much each: small groups spread them over the compute units.
  const auto heavy = [&](const char* name, std::size_t most) {
    return kernel(name).in_groups_of(std::min(group, most));
  };
  heavy("label_near", 64)
      .over_items(pairs, bits, starts, word_starts, list, ids, width, height, diagram.labels(), labelled);
  for (const int level : {REGION, TILE}) {
    heavy("list_candidates", 8)
        .over_items(cells(grid, level), bits, starts, word_starts, list, ids, width, height, level, labelled,
                    pyramid, top, lists, counts, diagram.labels());
  }
  const cl::Event last = heavy("label_far", 64)
                             .over_items(pairs, bits, starts, word_starts, list, ids, width, height, labelled,
                                         pyramid, top, lists, counts, diagram.labels());
  check(clFlush(device.queue()()), "starting the diagram");
  const std::chrono::duration<double, std::milli> host = std::chrono::steady_clock::now() - started;
  return {0, first, last, host.count()};
}

}  // namespace vorocl
