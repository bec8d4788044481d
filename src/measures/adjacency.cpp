#include "vorocl/adjacency.hpp"

#include <atomic>

#include "measures/measurement.hpp"
#include "runtime/buffer.hpp"

namespace vorocl {

namespace {

/// A planar graph has fewer than three edges per vertex: the first table is at most three eighths full. In
/// space random cells have 15.5 neighbours, which are 7.8 pairs per cell: half full. Cells in many pieces may
/// have more; then it grows.
std::size_t slots_of_cell(const PixelGrid& grid) { return grid.is_volume() ? 16 : 8; }
constexpr std::size_t least_slots = 1024;
constexpr std::size_t most_slots = std::size_t{1} << 31;
constexpr std::size_t words_per_pair = 3;
constexpr cl_uint no_pair = 0xffffffffu;  // NO_PAIR of pair_table.cl

std::size_t first_slots(const MeasuredDiagram& of) {
  const std::size_t wanted = slots_of_cell(of.grid) * of.count();
  std::size_t slots = least_slots;
  while (slots < wanted && slots < most_slots) slots *= 2;
  return slots;
}

}  // namespace

/// The table is made, and what it says of single cells. Whether it was large enough, and how many pairs it
/// holds, the host asks when somebody reads.
struct AdjacencyState : Measured {
  cl::Buffer table, overflow;                        // see pair_table.cl
  cl::Buffer neighbours, perimeters, pairs_of_cell;  // by cell
  cl::Buffer first, placed, pair_list;               // the list
  std::size_t slot_count = 0;
  bool large_enough = false, listed = false;  // as far as was asked
  std::size_t pairs = 0;                      // once they are listed

  // To find the pairs again:
  cl::Buffer labels, behind;
  std::shared_ptr<const std::atomic<std::uint64_t>> fills;
  std::uint64_t fill_measured = 0;

  /// Finds the pairs in a table of so many slots. Returns the first command and the last one.
  std::pair<cl::Event, cl::Event> find(const MeasuredDiagram& diagram, std::size_t in_slots);

  /// Sees to it that the table was large enough. Waits.
  void settle();

  /// Makes the list. Waits.
  void list();
};

std::pair<cl::Event, cl::Event> AdjacencyState::find(const MeasuredDiagram& diagram, std::size_t in_slots) {
  const Device& device = diagram.device;
  const cl_uint count = diagram.count();
  const PixelGrid& grid = diagram.grid;
  const char* const file = "measures/adjacency.cl";
  const KernelOptions options = diagram.options_without_metric();
  slot_count = in_slots;
  large_enough = listed = false;
  make_room(table, device, slot_count * words_per_pair * word);
  make_room(overflow, device, word);
  const cl::Event begun = fill(device, table, no_pair, slot_count * words_per_pair);
  fill(device, overflow, cl_uint{0}, 1);
  for (cl::Buffer* const numbers : {&neighbours, &perimeters, &pairs_of_cell}) {
    make_room(*numbers, device, count * word);
    if (count > 0) fill(device, *numbers, cl_uint{0}, count);
  }
  const Blocks blocks(device, grid);
  const auto mask = static_cast<cl_uint>(slot_count - 1), of_cell = static_cast<cl_uint>(slots_of_cell(grid));
  if (grid.is_volume()) {
    blocks.run(kernels, "volumes/adjacency.cl", "find_faces", options, labels, count, grid.width(),
               grid.height(), static_cast<cl_int>(grid.rows()), blocks.wide(), blocks.high(), mask, of_cell,
               table, overflow);
  } else {
    blocks.run(kernels, file, "find_borders", options, labels, row_behind(diagram, labels, behind), count,
               grid.width(), grid.height(), blocks.wide(), blocks.high(), mask, of_cell, table, overflow);
  }
  const cl::Event ended = kernels.get(device, file, "count_pairs", grid, options)
                              .over_items(slot_count, diagram.positions(), static_cast<cl_uint>(slot_count),
                                          table, pairs_of_cell, neighbours, perimeters);
  return {begun, ended};
}

void AdjacencyState::settle() {
  of->check();
  while (!large_enough) {
    large_enough = download<cl_uint>(of->device, overflow, 1).front() == 0;
    if (large_enough) return;
    if (*fills != fill_measured) {
      throw Error(
          "the cells have more neighbours than a table of the usual size holds, and the diagram has been "
          "filled or written since, so that they cannot be found again; read them before");
    }
    if (slot_count == most_slots) {
      throw Error("the cells of the diagram have more neighbours than can be counted");
    }
    find(*of, 2 * slot_count);
  }
}

void AdjacencyState::list() {
  settle();
  if (listed) return;
  const Device& device = of->device;
  const std::size_t cells = of->count();
  // The list's size must come to the host in any case, to allocate it: the running sum is made there too.
  std::vector<cl_uint> begins = download<cl_uint>(device, pairs_of_cell, cells);
  begins.push_back(0);
  cl_uint sum = 0;
  for (cl_uint& entry : begins) {
    const cl_uint here = entry;
    entry = sum;
    sum += here;
  }
  make_room(first, device, begins.size() * word);
  make_room(placed, device, cells * word);
  make_room(pair_list, device, sum * words_per_pair * word);
  upload(device, first, begins);
  if (cells > 0) fill(device, placed, cl_uint{0}, cells);
  const auto run = [&](const char* name, std::size_t items, const auto&... arguments) {
    kernels.get(device, "measures/adjacency.cl", name, of->grid, of->options_without_metric())
        .over_items(items, arguments...);
  };
  run("place_pairs", slot_count, static_cast<cl_uint>(slot_count), table, first, placed, pair_list);
  run("sort_pairs", cells, of->count(), first, pair_list);
  pairs = sum;
  listed = true;
}

// --- AdjacencyResult ---

AdjacencyResult::AdjacencyResult() = default;
AdjacencyResult::~AdjacencyResult() = default;
AdjacencyResult::AdjacencyResult(AdjacencyResult&& other) noexcept = default;
AdjacencyResult& AdjacencyResult::operator=(AdjacencyResult&& other) noexcept = default;

std::size_t AdjacencyResult::pairs() const {
  if (!state_ || state_->empty()) return 0;
  state_->list();
  return state_->pairs;
}

const cl::Buffer& AdjacencyResult::pair_list() const {
  if (state_ && !state_->empty()) state_->list();
  return buffer_of(state_, &AdjacencyState::pair_list);
}

const cl::Buffer& AdjacencyResult::neighbours() const {
  if (state_ && !state_->empty()) state_->settle();
  return buffer_of(state_, &AdjacencyState::neighbours);
}

const cl::Buffer& AdjacencyResult::perimeters() const {
  if (state_ && !state_->empty()) state_->settle();
  return buffer_of(state_, &AdjacencyState::perimeters);
}

std::vector<CellPair> AdjacencyResult::read_pairs() const {
  if (pairs() == 0) return {};
  const auto words = download<cl_uint>(state_->of->device, state_->pair_list, pairs() * words_per_pair);
  std::vector<CellPair> list;
  list.reserve(pairs());
  for (std::size_t i = 0; i < words.size(); i += words_per_pair) {
    list.push_back({words[i], words[i + 1], words[i + 2]});
  }
  return list;
}

std::vector<std::uint32_t> AdjacencyResult::read_neighbours() const {
  if (!state_ || state_->size() == 0) return {};
  return download<std::uint32_t>(state_->of->device, neighbours(), state_->size());
}

std::vector<std::uint32_t> AdjacencyResult::read_perimeters() const {
  if (!state_ || state_->size() == 0) return {};
  return download<std::uint32_t>(state_->of->device, perimeters(), state_->size());
}

Report adjacency(const Diagram& diagram, AdjacencyResult& result) {
  Measuring<AdjacencyState> measuring(result);
  AdjacencyState& found = measuring.state();
  MeasuredDiagram of = cells_of(diagram, Volumes::taken);
  found.labels = diagram.labels();
  found.fills = Internal::state(diagram).fills;
  found.fill_measured = *found.fills;
  const auto [first, last] = found.find(of, first_slots(of));
  return measuring.commit(std::move(of), first, last);
}

}  // namespace vorocl
