#include "vorocl/exact_diagram.hpp"

#include <algorithm>
#include <chrono>
#include <string>

#include "buffer.hpp"
#include "exact_lists.hpp"
#include "kernel.hpp"

namespace vorocl {

namespace {

// As in the kernels.
constexpr int cell_bits = 4;                   // a cell has 16 x 16 pixels, ...
constexpr int fan_bits = 2;                    // ... a cell of the next level 4 x 4 of those
constexpr std::size_t top_cells = 64;          // the search begins with a level of at most so many cells
constexpr std::size_t most_candidates = 1024;  // of a tile, which is a cell of level 1
constexpr std::size_t pixels_of_cell = 256;
constexpr std::size_t most_lanes = 16;
constexpr int tile = 1, region = 2;  // levels that have lists of candidates
constexpr int pair = 2;              // cells that are labelled together, one above the other

std::size_t cells_along(int pixels, int level) {
  const int bits = cell_bits + fan_bits * level;
  return (static_cast<std::size_t>(pixels - 1) >> bits) + 1;
}

std::size_t cells(const Grid& grid, int level) {
  return cells_along(grid.width(), level) * cells_along(grid.height(), level);
}

int top_level(const Grid& grid) {
  int level = 0;
  while (cells(grid, level) > top_cells) ++level;
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
  const std::size_t pairs = across * ((down - 1) / pair + 1);
  const std::size_t list_count = cells(grid, tile) + cells(grid, region);
  // Lists are read in whole runs.
  const std::size_t list_room = seeds.size() + most_lanes;
  const cl::Buffer bits = diagram.scratch(Scratch::exact_bits, bit_words * word);
  const cl::Buffer word_starts = diagram.scratch(Scratch::exact_word_starts, bit_words * word);
  const cl::Buffer starts = diagram.scratch(Scratch::exact_starts, starts_count * word);
  const cl::Buffer list = diagram.scratch(Scratch::exact_list, list_room * word);
  const cl::Buffer ids = diagram.scratch(Scratch::exact_ids, list_room * word);
  const cl::Buffer places = diagram.scratch(Scratch::exact_places, (seeds.size() + 1) * word);
  const cl::Buffer late = diagram.scratch(Scratch::exact_late, seeds.size() * word);
  const cl::Buffer late_count = diagram.scratch(Scratch::flags, word);
  const cl::Buffer listed = diagram.scratch(Scratch::exact_listed, word);
  const cl::Buffer pyramid = diagram.scratch(Scratch::exact_pyramid, all_cells * word);
  const cl::Buffer labelled = diagram.scratch(Scratch::exact_labelled, pairs * word);
  const cl::Buffer lists = diagram.scratch(Scratch::exact_candidates, list_count * most_candidates * word);
  const cl::Buffer counts = diagram.scratch(Scratch::exact_counts, list_count * word);

  const std::string file = length == ListLength::full ? "exact_diagram.cl" : "exact_short_lists.cl";
  const auto kernel = [&](const char* name) { return Kernel(device, file, name, grid, {options.metric}); };
  // Smaller work-groups than the usual ones would make PoCL compile the kernel again.
  const std::size_t least = device.tuning().group_width * device.tuning().group_height;
  const auto run = [&](const char* name, std::size_t items, const auto&... arguments) {
    return kernel(name).over_items(std::max(items, least), arguments...);
  };
  const auto count = static_cast<cl_uint>(seeds.size());
  const auto lanes = static_cast<std::size_t>(device.tuning().vector_width);
  const int width = grid.width(), height = grid.height();

  const cl::Event first = fill(device, bits, cl_uint{0}, bit_words);
  fill(device, late_count, cl_uint{0}, 1);
  fill(device, listed, cl_uint{0}, 1);
  run("set_bits", (seeds.size() - 1) / lanes + 1, seeds.positions(), count, bits, places, late, late_count, width);
  run("name_seeds", cells(grid, 0), bits, pyramid, starts, width, height);
  for (int level = 1; level <= top; ++level) {
    run("name_seeds_above", cells(grid, level), pyramid, width, height, level);
  }
  run("share_out_list", cells_along(grid.height(), 0), starts, listed, width, height);
  run("start_words", cells(grid, 0), bits, starts, word_starts, width, height);
  run("list_seeds", count, seeds.positions(), places, count, bits, word_starts, list, ids);
  run("keep_lowest_ids", count, seeds.positions(), late, late_count, bits, word_starts, ids, width);
  run("label_near", pairs, bits, starts, word_starts, list, ids, width, height, diagram.labels(), labelled);
  for (const int level : {region, tile}) {
    kernel("list_candidates")
        .in_small_groups()
        .over_items(std::max(cells(grid, level), least), bits, starts, word_starts, list, ids, width, height,
                    level, labelled, pyramid, top, lists, counts, diagram.labels());
  }
  const cl::Event last = run("label_far", pairs, bits, starts, word_starts, list, ids, width, height,
                             labelled, pyramid, top, lists, counts, diagram.labels());
  check(clFlush(device.queue()()), "starting the diagram");
  const std::chrono::duration<double, std::milli> host = std::chrono::steady_clock::now() - started;
  return {0, first, last, host.count()};
}

}  // namespace vorocl
