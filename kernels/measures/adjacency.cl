// The pairs of cells that share pixel edges: found in a hash table, then put in order.

#include "measures/runs.cl"
#include "measures/seed_place.cl"

#define EMPTY_SLOT 0xffffffffu
#define MOST_PROBES 64
#define SLOTS_OF_CELL 8u  // slots_per_seed of the host

// A pixel edge: the pixel above or left of it, and whether it lies below that pixel or right of it. A slot of the
// table holds one of the edges that its two cells share, so that one 32-bit atomic takes it: the cells' ids
// themselves are two 32-bit numbers.
static inline uint edge_of(uint pixel, uint is_below) { return pixel << 1 | is_below; }

// The labels, and those of the row behind the last one: along a periodic y the first row, in a tilted grid shifted.
typedef struct {
  global const uint* at;
  global const uint* behind;
  int width, height;
} labels_t;

// The ids of the cells on both sides of an edge, the lower one first.
static inline uint2 pair_at(labels_t labels, uint edge) {
  const uint width = (uint)labels.width, pixels = width * (uint)labels.height, pixel = edge >> 1, is_below = edge & 1;
  uint other = pixel + (is_below ? width : 1u);
  if (PERIODIC_X && !is_below && other % width == 0) other -= width;
  const uint p = labels.at[pixel], q = PERIODIC_Y && other >= pixels ? labels.behind[other - pixels] : labels.at[other];
  return (uint2)(min(p, q), max(p, q));
}

static inline uint hash_of(uint2 pair) {
  uint hash = pair.s0 * 0x9e3779b1u + pair.s1 * 0x85ebca77u;
  hash = (hash ^ hash >> 15) * 0xc2b2ae3du;
  return hash ^ hash >> 13;
}

// Adds to the length of the border that an edge belongs to. The table has 2^bits slots, of which most stay free. The
// pairs of one cell are side by side first, for the edges of a cell are found one soon after the other; where these
// slots are taken the others are everywhere.
static inline void add_border(labels_t labels, uint edge, uint length, uint mask, global uint* slots,
                              global uint* lengths, global uint* overflow) {
  const uint2 pair = pair_at(labels, edge);
  const uint hash = hash_of(pair);
  for (uint probe = 0; probe < MOST_PROBES; ++probe) {
    const uint beside = pair.s0 * SLOTS_OF_CELL + (hash + probe) % SLOTS_OF_CELL;
    const uint at = (probe < SLOTS_OF_CELL ? beside : hash + probe) & mask;
    const uint holder = atomic_cmpxchg(slots + at, EMPTY_SLOT, edge);
    if (holder == EMPTY_SLOT || all(pair_at(labels, holder) == pair)) {
      atomic_add(lengths + at, length);
      return;
    }
  }
  atomic_or(overflow, 1u);  // the host will find all of them again in a larger table
}

// Two rows are walked at once, so that along a run the border with the row below is one piece.
kernel void find_borders(global const uint* restrict labels, global const uint* restrict row_behind, uint count,
                         int width, int height, int wide, int high, uint mask, global uint* restrict slots,
                         global uint* restrict lengths, global uint* restrict overflow) {
  const labels_t all_labels = {labels, row_behind, width, height};
  block_t block;
  if (!take_block(width, height, wide, high, &block)) return;
  for (int y = block.top; y < block.bottom; ++y) {
    global const uint* const row = labels + y * width;
    global const uint* const below = y + 1 < height ? row + width : PERIODIC_Y ? row_behind : row;
    walk_t walk = begin_walk(row, below, block.left, block.right);
    while (next_run(&walk)) {
      const int last = walk.to - 1;
      const uint pixel = (uint)(y * width + last), label = row[last];
      if (label >= count) continue;
      const int right = PERIODIC_X || walk.to < width ? wrapped_x(walk.to, width) : last;
      if (row[right] < count && row[right] != label) {
        add_border(all_labels, edge_of(pixel, 0), 1u, mask, slots, lengths, overflow);
      }
      if (below[last] < count && below[last] != label) {
        add_border(all_labels, edge_of(pixel, 1), (uint)(walk.to - walk.from), mask, slots, lengths, overflow);
      }
    }
  }
}

// Writes each pair's cells into the table, the first one in place of the edge, for the labels may change later. Counts
// each cell's neighbours, and those of them with a higher id, which are the pairs that begin with the cell. Seeds that
// are absent own nothing: their pairs leave the table.
kernel void name_pairs(global const uint* restrict labels, global const uint* restrict row_behind,
                       global const seed_t* restrict seeds, int width, int height, uint slot_count,
                       global uint* restrict slots, global uint* restrict seconds, global const uint* restrict lengths,
                       global uint* restrict pairs, global uint* restrict neighbours,
                       global uint* restrict perimeters) {
  const labels_t all_labels = {labels, row_behind, width, height};
  const uint at = (uint)get_global_id(0);
  if (at >= slot_count || slots[at] == EMPTY_SLOT) return;
  const uint2 pair = pair_at(all_labels, slots[at]);
  const bool is_pair = is_there(seeds[pair.s0]) && is_there(seeds[pair.s1]);
  slots[at] = is_pair ? pair.s0 : EMPTY_SLOT;
  if (!is_pair) return;
  seconds[at] = pair.s1;
  atomic_inc(pairs + pair.s0);
  atomic_inc(neighbours + pair.s0);
  atomic_inc(neighbours + pair.s1);
  atomic_add(perimeters + pair.s0, lengths[at]);
  atomic_add(perimeters + pair.s1, lengths[at]);
}

// Puts each pair into the place of its first cell's pairs; `first` is where that begins in the list.
kernel void place_pairs(uint slot_count, global const uint* restrict slots, global const uint* restrict seconds,
                        global const uint* restrict lengths, global const uint* restrict first,
                        global uint* restrict placed, global uint* restrict pair_list) {
  const uint at = (uint)get_global_id(0);
  if (at >= slot_count || slots[at] == EMPTY_SLOT) return;
  const uint cell = slots[at], place = first[cell] + atomic_inc(placed + cell);
  vstore3((uint3)(cell, seconds[at], lengths[at]), place, pair_list);
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
