#include "vorocl/adjacency.hpp"

#include <utility>

#include "measures/measurement.hpp"
#include "runtime/buffer.hpp"

namespace vorocl {

namespace {

/// A planar graph has fewer than three edges per vertex: the first table is at most three eighths full. Cells
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

struct AdjacencyState : Measured {
  std::size_t pairs = 0;
  cl::Buffer pair_list, neighbours, perimeters;
  cl::Buffer slots, lengths, overflow, first, placed;  // while they are made: see adjacency.cl
};

AdjacencyResult::AdjacencyResult() = default;
AdjacencyResult::~AdjacencyResult() = default;
AdjacencyResult::AdjacencyResult(AdjacencyResult&& other) noexcept = default;
AdjacencyResult& AdjacencyResult::operator=(AdjacencyResult&& other) noexcept = default;
std::size_t AdjacencyResult::pairs() const { return state_ && !state_->empty() ? state_->pairs : 0; }
const cl::Buffer& AdjacencyResult::pair_list() const { return buffer_of(state_, &AdjacencyState::pair_list); }
const cl::Buffer& AdjacencyResult::neighbours() const {
  return buffer_of(state_, &AdjacencyState::neighbours);
}
const cl::Buffer& AdjacencyResult::perimeters() const {
  return buffer_of(state_, &AdjacencyState::perimeters);
}

void adjacency(const Seeds& seeds, const Diagram& diagram, AdjacencyResult& result) {
  AdjacencyState& found = Internal::result(result);
  found.frames = {};
  auto measured = frames_of(seeds, diagram);
  const Device& device = diagram.device();
  const Grid& grid = diagram.grid();
  const std::size_t cells = seeds.size(), word = sizeof(cl_uint);
  const auto count = static_cast<cl_uint>(cells);
  const auto run = [&](const char* name, std::size_t items, const auto&... arguments) {
    found.kernels.get(device, "measures/adjacency.cl", name, grid).over_items(items, arguments...);
  };

  make_room(found.overflow, device, word);
  const Blocks blocks(device, grid);
  std::size_t slots = first_slots(cells);
  for (;; slots *= 2) {
    make_room(found.slots, device, slots * word);
    make_room(found.lengths, device, slots * word);
    fill(device, found.slots, empty_slot, slots);
    fill(device, found.lengths, cl_uint{0}, slots);
    fill(device, found.overflow, cl_uint{0}, 1);
    blocks.run(found.kernels, "measures/adjacency.cl", "find_borders", {}, diagram.labels(), count,
               grid.width(), grid.height(), blocks.wide(), blocks.high(), static_cast<cl_uint>(slots - 1),
               found.slots, found.lengths, found.overflow);
    if (download<cl_uint>(device, found.overflow, 1).front() == 0) break;
    if (slots == most_slots) throw Error("the cells of the diagram have more neighbours than can be counted");
  }

  make_room(found.neighbours, device, cells * word);
  make_room(found.perimeters, device, cells * word);
  make_room(found.placed, device, cells * word);
  make_room(found.first, device, (cells + 1) * word);
  const cl::Buffer* const zeros[] = {&found.neighbours, &found.perimeters, &found.placed};
  if (cells > 0) {
    for (const cl::Buffer* const buffer : zeros) fill(device, *buffer, cl_uint{0}, cells);
  }
  fill(device, found.first, cl_uint{0}, cells + 1);
  const auto slot_count = static_cast<cl_uint>(slots);
  run("count_neighbours", slots, diagram.labels(), grid.width(), grid.height(), slot_count, found.slots,
      found.lengths, found.first, found.neighbours, found.perimeters);

  // The list's size must come to the host in any case, to allocate it: the running sum is made there too.
  std::vector<cl_uint> first = download<cl_uint>(device, found.first, cells + 1);
  cl_uint pairs = 0;
  for (cl_uint& entry : first) {
    const cl_uint here = entry;
    entry = pairs;
    pairs += here;
  }
  upload(device, found.first, first);
  make_room(found.pair_list, device, pairs * words_per_pair * word);
  run("place_pairs", slots, diagram.labels(), grid.width(), grid.height(), slot_count, found.slots,
      found.lengths, found.first, found.placed, found.pair_list);
  run("sort_pairs", cells, count, found.first, found.pair_list);
  diagram.wait();
  measured.check();
  found.pairs = pairs;
  found.frames = std::move(measured);
}

std::vector<CellPair> AdjacencyResult::read_pairs() const {
  if (pairs() == 0) return {};
  const auto words =
      download<cl_uint>(state_->frames.seeds->device, state_->pair_list, pairs() * words_per_pair);
  std::vector<CellPair> list;
  list.reserve(pairs());
  for (std::size_t i = 0; i < words.size(); i += words_per_pair) {
    list.push_back({words[i], words[i + 1], words[i + 2]});
  }
  return list;
}

std::vector<std::uint32_t> AdjacencyResult::read_neighbours() const {
  if (!state_ || state_->size() == 0) return {};
  return download<std::uint32_t>(state_->frames.seeds->device, state_->neighbours, state_->size());
}

std::vector<std::uint32_t> AdjacencyResult::read_perimeters() const {
  if (!state_ || state_->size() == 0) return {};
  return download<std::uint32_t>(state_->frames.seeds->device, state_->perimeters, state_->size());
}

std::size_t count_vertices(const Diagram& diagram) {
  const Device& device = diagram.device();
  const Grid& grid = diagram.grid();
  if (grid.width() == 1 || grid.height() == 1) return 0;
  const cl::Buffer vertices = allocate(device, sizeof(cl_uint), "the vertices");
  fill(device, vertices, cl_uint{0}, 1);
  const auto columns = static_cast<std::size_t>(grid.periodic_x() ? grid.width() : grid.width() - 1);
  const auto rows = static_cast<std::size_t>(grid.periodic_y() ? grid.height() : grid.height() - 1);
  const std::size_t across = (columns - 1) / corners_per_item + 1;
  Kernel(device, "measures/vertices.cl", "find_vertices", grid)
      .over_items(across * rows, diagram.labels(), grid.width(), grid.height(), corners_per_item, vertices);
  diagram.wait();
  return download<cl_uint>(device, vertices, 1).front();
}

}  // namespace vorocl
