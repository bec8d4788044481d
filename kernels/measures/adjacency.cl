// The pairs of cells that share pixel edges, in a volume voxel faces: found in lists and a table, then put in order.

#include "measures/home.cl"
#include "measures/pair_table.cl"

// The home of a seed that is absent, whose cell has no borders, whatever labels name it.
#define NO_HOME 0xffffffffu

// A CELL while its borders are found has four words: its home, how many pairs its list has, how many pairs have it as
// the higher id, and its perimeter. What the home adds to it needs no atomics; what others add goes to `neighbours` and
// `perimeters`.
#define CELL_PARAMETERS \
  global uint *cells, global uint *neighbours, global uint *perimeters
#define CELL_ARGUMENTS cells, neighbours, perimeters
#define HOME_OF(id) cells[4 * (size_t)(id)]

kernel void clear_cells(global const seed_t* restrict seeds, uint count, int4 size, int4 bits, CELL_PARAMETERS) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  vstore4((uint4)(is_there(seeds[id]) ? block_with(seeds[id], size, bits) : NO_HOME, 0, 0, 0), id, cells);
  neighbours[id] = perimeters[id] = 0;
}

static inline void add_to_cell(uint id, uint new_pairs, uint size, bool at_home, CELL_PARAMETERS) {
  if (at_home) {
    global uint* const sums = cells + 4 * (size_t)id + 2;
    sums[0] += new_pairs;
    sums[1] += size;
    return;
  }
  if (new_pairs > 0) atomic_add(neighbours + id, new_pairs);
  atomic_add(perimeters + id, size);
}

// Adds to the border of the cells a and b, a < b, found by a block.
__attribute__((always_inline)) static inline void add_border(uint a, uint b, uint size, uint block, CELL_PARAMETERS,
                                                             PAIR_PARAMETERS) {
  const uint home_a = HOME_OF(a), home_b = HOME_OF(b);
  if (home_a == NO_HOME || home_b == NO_HOME) return;
  global uint* const listed = cells + 4 * (size_t)a + 1;
  const bool at_home = home_a == block;
  const uint place = at_home ? place_in_list(LIST_OF(a), b, *listed, LIST_SIZE) : LIST_SIZE;
  const bool is_new = place < LIST_SIZE && place == *listed;
  if (place < LIST_SIZE) {
    LIST_OF(a)[place] = b;
    add_to_list(LIST_OF(a), size, place, is_new);
    *listed += is_new;
  } else {
    add_to_table(a, b, size, PAIR_ARGUMENTS);
  }
  add_to_cell(a, 0, size, at_home, CELL_ARGUMENTS);
  add_to_cell(b, is_new, size, home_b == block, CELL_ARGUMENTS);
}

// GATHERED: on a CPU, whose work-items are alone in their groups, the borders between two cells come together in local
// memory first, for a brick of a block's pixels. So most of them wait for no other memory; and when the pairs go on
// from there, it is known which are next, and what they need is on its way. A slot has the number of a pair, or
// NO_NUMBER.
#define BRICK_WIDTH 32  // at most 32: a bit for each pixel
#define BRICK_ROWS (VOROCL_DIMENSIONS == 3 ? 8 : 32)
#define BRICK_SLICES 4
#define MOST_OF_ROW (3 * BRICK_WIDTH)  // pairs that it can add
#define MOST_GATHERED (VOROCL_WIDTH > 1 ? 1536 : 1)
#define GATHERED_SLOTS (VOROCL_WIDTH > 1 ? 4096 : 1)
#define NO_NUMBER 0xffff
#define PAIRS_AHEAD 16
typedef struct {
  local ushort* slots;
  local uint* pairs;  // three words each
  uint count;
  uint cells, block;  // how many cells there are, and where they are gathered
} gathered_t;

static inline void gather(gathered_t* gathered, uint p, uint q, uint size, CELL_PARAMETERS, PAIR_PARAMETERS) {
  const uint a = min(p, q), b = max(p, q);
  if (b >= gathered->cells) return;
  if (VOROCL_WIDTH == 1) {
    add_border(a, b, size, gathered->block, CELL_ARGUMENTS, PAIR_ARGUMENTS);
    return;
  }
  for (uint at = (a * 0x9e3779b1u + b * 0x85ebca77u) >> 16;; ++at) {
    local ushort* const slot = gathered->slots + (at & (GATHERED_SLOTS - 1));
    const uint number = *slot;
    local uint* const pair = gathered->pairs + 3 * (number == NO_NUMBER ? gathered->count : number);
    if (number == NO_NUMBER) {
      *slot = (ushort)gathered->count++;
      vstore3((uint3)(a, b, size), 0, pair);
      return;
    }
    if (pair[0] == a && pair[1] == b) {
      pair[2] += size;
      return;
    }
  }
}

// Adds what is gathered. Nothing is then.
static inline void add_gathered(gathered_t* gathered, CELL_PARAMETERS, PAIR_PARAMETERS) {
  if (VOROCL_WIDTH == 1) return;
  for (uint i = 0; i < gathered->count; ++i) {
    const uint3 pair = vload3(i, gathered->pairs);
    const uint3 next = vload3(min(i + PAIRS_AHEAD, gathered->count - 1), gathered->pairs);
    PREFETCH(cells + 4 * (size_t)next.s0);
    PREFETCH(cells + 4 * (size_t)next.s1);
    PREFETCH(LIST_OF(next.s0));
    PREFETCH(LIST_OF(next.s0) + LIST_SIZE);
    add_border(pair.s0, pair.s1, pair.s2, gathered->block, CELL_ARGUMENTS, PAIR_ARGUMENTS);
  }
  gathered->count = 0;
  for (uint i = 0; i < GATHERED_SLOTS; ++i) gathered->slots[i] = NO_NUMBER;
}

// Bit i: pixel from + i, of those up to `to`, has another label than the one before it.
static inline uint changes_along(global const uint* row, int from, int to, int width) {
  const int first = max(from, 1);
  const uint found = differences(row + first, row + first - 1, to - first) << (first - from);
  return found | (PERIODIC_X && from == 0 && row[0] != row[width - 1]);
}

// The row that follows one along y (side 0) or z (side 1); the row itself where there is none. `behind`: in grids that
// are tilted the rows behind the last ones (beyond.cl).
static inline global const uint* row_beside(global const uint* labels, global const uint* behind, int side, int y,
                                            int z, int4 size) {
  const bool is_last = side == 0 ? PERIODIC_Y && y + 1 == size.y : PERIODIC_Z && z + 1 == DEPTH(size);
  if (IS_TILTED && is_last) return behind + (size_t)(side == 0 ? z : DEPTH(size) + y) * (size_t)size.x;
  const int beside_y = side == 0 ? wrapped(y + 1, size.y, PERIODIC_Y) : y;
  const int beside_z = side == 0 ? z : wrapped(z + 1, DEPTH(size), PERIODIC_Z);
  return row_of(labels, beside_y < size.y ? beside_y : y, beside_z < DEPTH(size) ? beside_z : z, size);
}

// Adds the borders of a block's pixels with those before, below and behind them, where there are any. Of the last two
// those of a row are one piece where neither row changes. Across the ends of a periodic axis borders count as inside.
kernel void find_borders(global const uint* restrict labels, global const uint* restrict behind, uint count,
                         int4 size, int4 bits, CELL_PARAMETERS, PAIR_PARAMETERS) {
  local ushort slots[GATHERED_SLOTS];
  local uint pairs[3 * MOST_GATHERED];
  block_t block;
  if (!take_block(size, bits, &block)) return;
  gathered_t gathered = {slots, pairs, 0, count, block.index};
  block_t brick = block;
  for (brick.front = block.front; brick.front < block.back; brick.front = brick.back) {
    brick.back = min(brick.front + BRICK_SLICES, block.back);
    for (brick.top = block.top; brick.top < block.bottom; brick.top = brick.bottom) {
      brick.bottom = min(brick.top + BRICK_ROWS, block.bottom);
      for (brick.left = block.left; brick.left < block.right; brick.left = brick.right) {
        brick.right = min(brick.left + BRICK_WIDTH, block.right);
        add_gathered(&gathered, CELL_ARGUMENTS, PAIR_ARGUMENTS);
        FOR_EACH_ROW(y, z, brick) {
          if (gathered.count + MOST_OF_ROW > MOST_GATHERED)
            add_gathered(&gathered, CELL_ARGUMENTS, PAIR_ARGUMENTS);
          global const uint* const row = row_of(labels, y, z, size);
          const uint changes = changes_along(row, brick.left, brick.right, size.x);
          for (uint left = changes; left != 0; left &= left - 1) {
            const int x = brick.left + (int)lowest_bit(left);
            gather(&gathered, row[wrapped(x - 1, size.x, PERIODIC_X)], row[x], 1, CELL_ARGUMENTS, PAIR_ARGUMENTS);
          }
          for (int side = 0; side < 2; ++side) {
            global const uint* const beside = row_beside(labels, behind, side, y, z, size);
            if (beside == row) continue;
            const int pixels = brick.right - brick.left;
            const uint ends = changes | changes_along(beside, brick.left, brick.right, size.x) | 1u;
            uint left = ends & differences(row + brick.left, beside + brick.left, pixels);
            for (; left != 0; left &= left - 1) {
              const int at = (int)lowest_bit(left), x = brick.left + at;
              const uint length = min(lowest_bit(ends >> at >> 1) + 1, (uint)(pixels - at));
              gather(&gathered, row[x], beside[x], length, CELL_ARGUMENTS, PAIR_ARGUMENTS);
            }
          }
        }
      }
    }
  }
  add_gathered(&gathered, CELL_ARGUMENTS, PAIR_ARGUMENTS);
}

// Moves the table's pairs into the lists. Those that find no room stay: the second word of `overflow` says so. `pairs`
// counts those that are new.
kernel void join_pairs(global const uint* restrict cells, global uint* restrict neighbours,
                       global uint* restrict pairs, global uint* restrict lists, uint mask,
                       global uint* restrict table, global uint* restrict overflow) {
  const uint at = (uint)get_global_id(0);
  if (at > mask) return;
  const uint3 slot = vload3(at, table);
  if (slot.s0 == NO_PAIR) return;
  const uint listed = cells[4 * (size_t)slot.s0 + 1];
  uint place = place_in_list(LIST_OF(slot.s0), slot.s1, listed, listed);
  const bool is_new = place == listed;
  if (is_new) {
    place += atomic_inc(pairs + slot.s0);
    atomic_inc(neighbours + slot.s1);
  }
  if (place < LIST_SIZE) {
    if (is_new) LIST_OF(slot.s0)[place] = slot.s1;  // others read the list
    add_to_list(LIST_OF(slot.s0), slot.s2 + 1, place, is_new);
    table[3 * (size_t)at] = NO_PAIR;
  } else {
    atomic_or(overflow + 1, 1u);
  }
}

// Counts each cell's pairs, in which its id is the lower one; and joins what its home and others have added.
kernel void count_pairs(uint count, global uint* restrict pairs, CELL_PARAMETERS) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  const uint4 cell = vload4(id, cells);
  pairs[id] += cell.s1;
  neighbours[id] += pairs[id] + cell.s2;
  perimeters[id] += cell.s3;
}

// Puts the pairs of each cell's list into the cell's place, sorted; `first` is where that begins in the list of all.
kernel void place_lists(uint count, global const uint* restrict lists, global const uint* restrict first,
                        global uint* restrict placed, global uint* restrict pair_list) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  global const uint* const list = LIST_OF(id);
  const uint listed = min(first[id + 1] - first[id], (uint)LIST_SIZE);
  placed[id] = listed;
  for (uint i = 0; i < listed; ++i) {
    uint before = 0;
    for (uint j = 0; j < LIST_SIZE; ++j) before += j < listed && list[j] < list[i];
    vstore3((uint3)(id, list[i], list[LIST_SIZE + i]), first[id] + before, pair_list);
  }
}

// The same of the table's pairs, which come behind those of the lists.
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

// Sorts the pairs of each cell by their second cell, where some are the table's. Most cells have few neighbours; a heap
// sort is for the one that may have all others around it; nothing is done where they are sorted.
kernel void sort_pairs(uint count, global const uint* restrict first, global uint* restrict pair_list) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  const uint begin = first[id], size = first[id + 1] - begin;
  uint sorted = 1;
  while (sorted < size && second_of(pair_list, begin + sorted - 1) < second_of(pair_list, begin + sorted)) ++sorted;
  if (sorted >= size) return;
  for (uint i = size / 2; i-- > 0;) sink(pair_list, begin, size, i, vload3(begin + i, pair_list));
  for (uint last = size; last-- > 1;) {
    const uint3 pair = vload3(begin + last, pair_list);
    vstore3(vload3(begin, pair_list), begin + last, pair_list);
    sink(pair_list, begin, last, 0, pair);
  }
}
