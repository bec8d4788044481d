// The pairs of cells that share pixel edges: found in a hash table, then put in order.

#include "measures/pair_table.cl"
#include "measures/runs.cl"
#include "measures/seed_place.cl"

// Two rows are walked at once, so that along a run the border with the row below is one piece.
kernel void find_borders(global const uint* restrict labels, global const uint* restrict row_behind, uint count,
                         int width, int height, int wide, int high, TABLE_PARAMETERS) {
  block_t block;
  if (!take_block(width, height, wide, high, &block)) return;
  for (int y = block.top; y < block.bottom; ++y) {
    global const uint* const row = labels + y * width;
    global const uint* const below = y + 1 < height ? row + width : PERIODIC_Y ? row_behind : row;
    walk_t walk = begin_walk(row, below, block.left, block.right);
    while (next_run(&walk)) {
      const int last = walk.to - 1;
      const uint label = row[last];
      if (label >= count) continue;
      const uint right = row[PERIODIC_X || walk.to < width ? wrapped_x(walk.to, width) : last];
      if (right < count && right != label) {
        add_border(label, right, 1u, mask, slots_of_cell, table, overflow);
      }
      if (below[last] < count && below[last] != label) {
        add_border(label, below[last], (uint)(walk.to - walk.from), mask, slots_of_cell, table, overflow);
      }
    }
  }
}

// Counts each cell's neighbours, and those of them with a higher id, which are the pairs that begin with the cell.
// Seeds that are absent own nothing: their pairs leave the table.
kernel void count_pairs(global const seed_t* restrict seeds, uint slot_count, global uint* restrict table,
                        global uint* restrict pairs, global uint* restrict neighbours,
                        global uint* restrict perimeters) {
  const uint at = (uint)get_global_id(0);
  if (at >= slot_count) return;
  const uint3 slot = vload3(at, table);
  if (slot.s0 == NO_PAIR) return;
  if (!is_there(seeds[slot.s0]) || !is_there(seeds[slot.s1])) {
    table[3 * (size_t)at] = NO_PAIR;
    return;
  }
  const uint size = slot.s2 + 1;
  atomic_inc(pairs + slot.s0);
  atomic_inc(neighbours + slot.s0);
  atomic_inc(neighbours + slot.s1);
  atomic_add(perimeters + slot.s0, size);
  atomic_add(perimeters + slot.s1, size);
}

// Puts each pair into the place of its first cell's pairs; `first` is where that begins in the list.
kernel void place_pairs(uint slot_count, global const uint* restrict table, global const uint* restrict first,
                        global uint* restrict placed, global uint* restrict pair_list) {
  const uint at = (uint)get_global_id(0);
  if (at >= slot_count) return;
  const uint3 slot = vload3(at, table);
  if (slot.s0 == NO_PAIR) return;
  const uint place = first[slot.s0] + atomic_inc(placed + slot.s0);
  vstore3((uint3)(slot.s0, slot.s1, slot.s2 + 1), place, pair_list);
}

// The second cell of a pair of the list.
static inline uint second_of(global const uint* pair_list, uint at) { return pair_list[(size_t)at * 3 + 1]; }

// Sinks a pair in the heap of the pairs from `begin` on, so that the one with the greatest second cell is on top.
static inline void sink(global uint* pair_list, uint begin, uint size, uint hole, uint3 pair) {
  for (uint child = 2 * hole + 1; child < size; child = 2 * hole + 1) {
    if (child + 1 < size && second_of(pair_list, begin + child + 1) > second_of(pair_list, begin + child)) ++child;
    if (second_of(pair_list, begin + child) <= pair.s1) break;
    vstore3(vload3(begin + child, pair_list), begin + hole, pair_list);
    hole = child;
  }
  vstore3(pair, begin + hole, pair_list);
}

// Sorts the pairs of each cell by their second cell. Most cells have few neighbours; a heap sort is for the one that
// may have all others around it.
kernel void sort_pairs(uint count, global const uint* restrict first, global uint* restrict pair_list) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  const uint begin = first[id], size = first[id + 1] - begin;
  for (uint i = size / 2; i-- > 0;) sink(pair_list, begin, size, i, vload3(begin + i, pair_list));
  for (uint last = size; last-- > 1;) {
    const uint3 pair = vload3(begin + last, pair_list);
    vstore3(vload3(begin, pair_list), begin + last, pair_list);
    sink(pair_list, begin, last, 0, pair);
  }
}
