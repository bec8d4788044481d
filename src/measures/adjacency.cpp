#include "vorocl/adjacency.hpp"

#include <algorithm>
#include <atomic>

#include "measures/measurement.hpp"
#include "runtime/buffer.hpp"

namespace vorocl {

namespace {

constexpr const char* kernel_file = "measures/adjacency.cl";
constexpr std::size_t least_slots = 1024;
constexpr std::size_t most_slots = std::size_t{1} << 31;
constexpr std::size_t most_growth = 8;  // of a table that was too small
constexpr std::size_t words_per_pair = 3;
constexpr cl_uint no_pair = 0xffffffffu;  // NO_PAIR of pair_table.cl

/// How many slots cells have in their lists and in the first table. A planar graph has fewer than three edges
/// per vertex; in space random cells have 15.5 neighbours, which are 7.8 pairs per cell. Nearly all borders
/// of small cells are found at home, so that the table has little to take. Cells in many pieces may have more
/// neighbours; then it grows.
struct SlotsOfCell {
  explicit SlotsOfCell(const MeasuredDiagram& of, const Blocks& blocks) {
    const bool is_volume = of.grid.has_voxels();
    const std::size_t small = blocks.pixels() / (is_volume ? 4096 : 1024);
    list = is_volume ? 16 : 8;  // LIST_SIZE of pair_table.cl
    table = of.grid.pixels() <= small * of.count() ? list / 4 : list;
  }

  cl_uint list, table;
};

std::size_t slots_for(std::size_t wanted) {
  std::size_t slots = least_slots;
  while (slots < wanted && slots < most_slots) slots *= 2;
  return slots;
}

}  // namespace

/// The pairs are found, and what they say of single cells. Whether the table was large enough, and how many
/// pairs there are, the host asks when somebody reads.
struct AdjacencyState : Measured {
  cl::Buffer lists, table, overflow;                 // see pair_table.cl
  cl::Buffer cells;                                  // see adjacency.cl
  cl::Buffer neighbours, perimeters, pairs_of_cell;  // by cell
  cl::Buffer first, placed, pair_list;               // the list
  std::size_t slot_count = 0;
  bool large_enough = false, listed_all = false;  // as far as was asked
  bool lists_hold_all = false;                    // once it is known that the table was large enough
  std::size_t pairs = 0;                          // once they are listed

  // To find the pairs again:
  cl::Buffer labels, behind;
  std::shared_ptr<const std::atomic<std::uint64_t>> fills;
  std::uint64_t fill_measured = 0;

  /// Finds the pairs with a table of so many slots, or of the usual number. Returns the first command and the
  /// last one.
  std::pair<cl::Event, cl::Event> find(const MeasuredDiagram& diagram, std::size_t in_slots = 0);

  /// Sees to it that the table was large enough. Waits.
  void settle();

  /// Makes the list. Waits.
  void list();
};

std::pair<cl::Event, cl::Event> AdjacencyState::find(const MeasuredDiagram& diagram, std::size_t in_slots) {
  const Device& device = diagram.device;
  const cl_uint count = diagram.count();
  KernelOptions options = diagram.options_without_metric();
  options.tilted = diagram.is_shifted();
  const Blocks blocks(device, diagram.grid);
  const SlotsOfCell slots(diagram, blocks);
  slot_count = in_slots > 0 ? in_slots : slots_for(std::size_t{slots.table} * count);
  large_enough = listed_all = false;
  make_room(lists, device, std::size_t{2} * slots.list * count * word);
  make_room(table, device, slot_count * words_per_pair * word);
  make_room(overflow, device, 2 * word);
  make_room(cells, device, count * sizeof(cl_uint4));
  for (cl::Buffer* const numbers : {&neighbours, &perimeters, &pairs_of_cell}) {
    make_room(*numbers, device, count * word);
  }
  const cl::Event begun = fill(device, table, no_pair, slot_count * words_per_pair);
  fill(device, overflow, cl_uint{0}, 2);
  if (count > 0) fill(device, pairs_of_cell, cl_uint{0}, count);
  const auto run = [&](const char* name, std::size_t items, const auto&... arguments) {
    return kernels.get(device, kernel_file, name, diagram.grid, options).over_items(items, arguments...);
  };
  const auto mask = static_cast<cl_uint>(slot_count - 1);
  run("clear_cells", count, diagram.positions(), count, diagram.size(), blocks.bits(), cells, neighbours,
      perimeters);
  blocks.run(kernels, kernel_file, "find_borders", options, labels,
             rows_behind(diagram, kernels, labels, behind), count, diagram.size(), blocks.bits(), cells,
             neighbours, perimeters, lists, mask, slots.table, table, overflow);
  const cl::Event joined =
      run("join_pairs", slot_count, cells, neighbours, pairs_of_cell, lists, mask, table, overflow);
  const cl::Event counted = run("count_pairs", count, count, pairs_of_cell, cells, neighbours, perimeters);
  return {begun, count > 0 ? counted : joined};
}

void AdjacencyState::settle() {
  of->check();
  while (!large_enough) {
    const auto words = download<cl_uint>(of->device, overflow, 2);
    large_enough = words[0] == 0;
    lists_hold_all = words[1] == 0;
    if (large_enough) return;
    if (*fills != fill_measured) {
      throw Error(
          "the cells have more neighbours than a table of the usual size holds, and the diagram has been "
          "filled or written since, so that they cannot be found again; read them before");
    }
    if (slot_count == most_slots) {
      throw Error("the cells of the diagram have more neighbours than can be counted");
    }
    // Each piece of a border that found no room may be of another pair; no more pairs are possible than cells
    // squared.
    const std::size_t count = of->count(), wanted = std::min(slot_count + words[0], count * count);
    find(*of, slots_for(std::clamp(wanted, 2 * slot_count, most_growth * slot_count)));
  }
}

void AdjacencyState::list() {
  settle();
  if (listed_all) return;
  const Device& device = of->device;
  const std::size_t count = of->count();
  // The list's size must come to the host in any case, to allocate it: the running sum is made there too.
  std::vector<cl_uint> begins = download<cl_uint>(device, pairs_of_cell, count);
  begins.push_back(0);
  cl_uint sum = 0;
  for (cl_uint& entry : begins) {
    const cl_uint here = entry;
    entry = sum;
    sum += here;
  }
  make_room(first, device, begins.size() * word);
  make_room(placed, device, count * word);
  make_room(pair_list, device, sum * words_per_pair * word);
  upload(device, first, begins);
  const auto run = [&](const char* name, std::size_t items, const auto&... arguments) {
    kernels.get(device, kernel_file, name, of->grid, of->options_without_metric())
        .over_items(items, arguments...);
  };
  run("place_lists", count, of->count(), lists, first, placed, pair_list);
  if (!lists_hold_all) {
    run("place_pairs", slot_count, static_cast<cl_uint>(slot_count), table, first, placed, pair_list);
    run("sort_pairs", count, of->count(), first, pair_list);
  }
  pairs = sum;
  listed_all = true;
}

// --- AdjacencyResult ---

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
  MeasuredDiagram of = cells_of(diagram, OnGlobe::yes);
  found.labels = diagram.labels();
  found.fills = Internal::state(diagram).fills;
  found.fill_measured = *found.fills;
  const auto [first, last] = found.find(of);
  return measuring.commit(std::move(of), first, last);
}

}  // namespace vorocl
