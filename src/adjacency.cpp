#include "vorocl/adjacency.hpp"

#include <algorithm>

#include "buffer.hpp"
#include "measurement.hpp"

namespace vorocl {

namespace {

/// A planar graph has fewer than three edges a vertex: the first table is at most three eighths full. Cells
/// in many pieces may have more neighbours; then it grows.
constexpr std::size_t slots_per_seed = 8;
constexpr std::size_t least_slots = 1024;
constexpr std::size_t most_slots = std::size_t{1} << 31;
constexpr std::size_t words_per_pair = 3;
constexpr cl_uint empty_slot = 0xffffffffu;  // EMPTY_SLOT of adjacency.cl
constexpr cl_uint corners_per_item = 1024;

std::size_t first_slots(std::size_t seeds) {
  std::size_t slots = least_slots;
  while (slots < slots_per_seed * seeds && slots < most_slots) slots *= 2;
  return slots;
}

}  // namespace

void adjacency(const Seeds& seeds, const Diagram& diagram, AdjacencyResult& result) {
  diagram.check_fits(seeds);
  const Device& device = diagram.device();
  const Grid& grid = diagram.grid();
  const std::size_t cells = seeds.size(), word = sizeof(cl_uint);
  const auto count = static_cast<cl_uint>(cells);
  const auto run = [&](const char* name, std::size_t items, const auto&... arguments) {
    Kernel(device, "adjacency.cl", name, grid).over_items(items, arguments...);
  };

  make_room(result.overflow_, device, word);
  const Blocks blocks(device, grid);
  std::size_t slots = first_slots(cells);
  for (;; slots *= 2) {
    make_room(result.slots_, device, slots * word);
    make_room(result.lengths_, device, slots * word);
    fill(device, result.slots_, empty_slot, slots);
    fill(device, result.lengths_, cl_uint{0}, slots);
    fill(device, result.overflow_, cl_uint{0}, 1);
    blocks.run("adjacency.cl", "find_borders", diagram.labels(), count, grid.width(), grid.height(),
               blocks.wide(), blocks.high(), static_cast<cl_uint>(slots - 1), result.slots_, result.lengths_,
               result.overflow_);
    if (download<cl_uint>(device, result.overflow_, 1).front() == 0) break;
    if (slots == most_slots) throw Error("the cells of the diagram have more neighbours than can be counted");
  }

  make_room(result.neighbours_, device, cells * word);
  make_room(result.perimeters_, device, cells * word);
  make_room(result.placed_, device, cells * word);
  make_room(result.first_, device, (cells + 1) * word);
  const cl::Buffer* const zeros[] = {&result.neighbours_, &result.perimeters_, &result.placed_};
  if (cells > 0) {
    for (const cl::Buffer* const buffer : zeros) fill(device, *buffer, cl_uint{0}, cells);
  }
  fill(device, result.first_, cl_uint{0}, cells + 1);
  const auto slot_count = static_cast<cl_uint>(slots);
  run("count_neighbours", slots, diagram.labels(), grid.width(), slot_count, result.slots_, result.lengths_,
      result.first_, result.neighbours_, result.perimeters_);

  // The list's size must come to the host in any case, to allocate it: the running sum is made there too.
  std::vector<cl_uint> first = download<cl_uint>(device, result.first_, cells + 1);
  cl_uint pairs = 0;
  for (cl_uint& entry : first) {
    const cl_uint here = entry;
    entry = pairs;
    pairs += here;
  }
  upload(device, result.first_, first);
  make_room(result.pair_list_, device, pairs * words_per_pair * word);
  run("place_pairs", slots, diagram.labels(), grid.width(), slot_count, result.slots_, result.lengths_,
      result.first_, result.placed_, result.pair_list_);
  run("sort_pairs", cells, count, result.first_, result.pair_list_);
  diagram.wait();
  seeds.check();
  result.pairs_ = pairs;
  result.seeds_ = seeds;
}

std::vector<CellPair> AdjacencyResult::read_pairs() const {
  if (!seeds_) return {};
  const auto words = download<cl_uint>(seeds_->device(), pair_list_, pairs_ * words_per_pair);
  std::vector<CellPair> pairs;
  pairs.reserve(pairs_);
  for (std::size_t i = 0; i < words.size(); i += words_per_pair) {
    pairs.push_back({words[i], words[i + 1], words[i + 2]});
  }
  return pairs;
}

std::vector<std::uint32_t> AdjacencyResult::read_neighbours() const {
  if (!seeds_) return {};
  return download<std::uint32_t>(seeds_->device(), neighbours_, seeds_->size());
}

std::vector<std::uint32_t> AdjacencyResult::read_perimeters() const {
  if (!seeds_) return {};
  return download<std::uint32_t>(seeds_->device(), perimeters_, seeds_->size());
}

std::size_t count_vertices(const Diagram& diagram) {
  const Device& device = diagram.device();
  const Grid& grid = diagram.grid();
  if (grid.width() == 1 || grid.height() == 1) return 0;
  const cl::Buffer vertices = allocate(device, sizeof(cl_uint), "the vertices");
  fill(device, vertices, cl_uint{0}, 1);
  const std::size_t across = (static_cast<std::size_t>(grid.width()) - 2) / corners_per_item + 1;
  Kernel(device, "vertices.cl", "find_vertices", grid)
      .over_items(across * static_cast<std::size_t>(grid.height() - 1), diagram.labels(), grid.width(),
                  grid.height(), corners_per_item, vertices);
  diagram.wait();
  return download<cl_uint>(device, vertices, 1).front();
}

}  // namespace vorocl
