// The pairs of cells that share pixel edges, in a volume voxel faces: found in lists and a table, then put in order.

#include "measures/home.cl"
#include "measures/pair_table.cl"

// The home of a seed that is absent, whose cell has no borders, whatever labels name it.
#define NO_HOME 0xffffffffu

// A CELL while its borders are found has four words: its home, 0, how many pairs have it as the higher id, and its
// perimeter. What the home adds to it needs no atomics; what others add goes to `neighbours` and `perimeters`.
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

// Adds to the border of the cells p and q, found by a block.
__attribute__((always_inline)) static inline void add_border(uint p, uint q, uint size, uint block, CELL_PARAMETERS,
                                                             PAIR_PARAMETERS) {
  const uint a = min(p, q), b = max(p, q);
  const uint home_a = HOME_OF(a), home_b = HOME_OF(b);
  if (home_a == NO_HOME || home_b == NO_HOME) return;
  const addition_t added = home_a == block ? add_to_list(a, b, size, PAIR_ARGUMENTS) : NO_ROOM;
  if (added == NO_ROOM) add_to_table(a, b, size, PAIR_ARGUMENTS);
  add_to_cell(a, 0, size, home_a == block, CELL_ARGUMENTS);
  add_to_cell(b, added == NEW_PAIR, size, home_b == block, CELL_ARGUMENTS);
}

// GATHERED: on a CPU, whose work-items are alone in their groups, the borders between two cells come together in local
// memory first, for a brick of a block's rows. So most of them wait for no other memory; and when the pairs go on from
// there, it is known which are next, and what they need is on its way. A slot has the number of a pair, or NO_NUMBER.
#define BRICK 4  // rows and slices
#if VOROCL_WIDTH > 1
#define MOST_GATHERED 1536
#define GATHERED_SLOTS 4096
#else
#define MOST_GATHERED 1
#define GATHERED_SLOTS 1
#endif
#define NO_NUMBER 0xffff
#define PAIRS_AHEAD 16
typedef struct {
  local ushort* slots;
  local uint* pairs;  // three words each
  uint count;
} gathered_t;

static inline void begin_gathering(gathered_t* gathered) {
  gathered->count = 0;
  if (VOROCL_WIDTH == 1) return;
  for (uint i = 0; i < GATHERED_SLOTS; ++i) gathered->slots[i] = NO_NUMBER;
}

static inline void gather(gathered_t* gathered, uint p, uint q, uint size, uint block, CELL_PARAMETERS,
                          PAIR_PARAMETERS) {
  if (VOROCL_WIDTH == 1) {
    add_border(p, q, size, block, CELL_ARGUMENTS, PAIR_ARGUMENTS);
    return;
  }
  const uint a = min(p, q), b = max(p, q);
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

static inline void add_gathered(gathered_t* gathered, uint block, CELL_PARAMETERS, PAIR_PARAMETERS) {
  if (VOROCL_WIDTH == 1) return;
  for (uint i = 0; i < gathered->count; ++i) {
    const uint3 pair = vload3(i, gathered->pairs);
    const uint3 next = vload3(min(i + PAIRS_AHEAD, gathered->count - 1), gathered->pairs);
    PREFETCH(cells + 4 * (size_t)next.s0);
    PREFETCH(cells + 4 * (size_t)next.s1);
    PREFETCH(lists + (size_t)next.s0 * LIST_SIZE + (hash_of(next.s0, next.s1) & (LIST_SIZE - 1)));
    add_border(pair.s0, pair.s1, pair.s2, block, CELL_ARGUMENTS, PAIR_ARGUMENTS);
  }
  begin_gathering(gathered);
}

// Adds the borders between a row and one beside it, and along the row those between its own runs if `along` says so.
// Two rows are walked at once, so that along a run the border with the row beside is one piece. Of a row without one
// beside it, that one is the row itself. Across the ends of a periodic axis borders count as inside.
__attribute__((always_inline)) static inline void add_borders(global const uint* row, global const uint* beside,
                                                              block_t block, int width, bool along, uint count,
                                                              gathered_t* gathered, CELL_PARAMETERS,
                                                              PAIR_PARAMETERS) {
  walk_t walk = begin_walk(row, beside, block.left, block.right);
  while (next_run(&walk)) {
    const int last = walk.to - 1;
    const uint label = row[last], other = beside[last], length = (uint)(walk.to - walk.from);
    if (label >= count) continue;
    const uint right = along && (PERIODIC_X || walk.to < width) ? row[wrapped(walk.to, width, PERIODIC_X)] : label;
    if (right < count && right != label)
      gather(gathered, label, right, 1u, block.index, CELL_ARGUMENTS, PAIR_ARGUMENTS);
    if (other < count && other != label)
      gather(gathered, label, other, length, block.index, CELL_ARGUMENTS, PAIR_ARGUMENTS);
  }
}

// `row_behind` has the row that follows the last one along a periodic y, in a volume each slice's.
kernel void find_borders(global const uint* restrict labels, global const uint* restrict row_behind, uint count,
                         int4 size, int4 bits, CELL_PARAMETERS, PAIR_PARAMETERS) {
  local ushort slots[GATHERED_SLOTS];
  local uint pairs[3 * MOST_GATHERED];
  gathered_t gathered = {slots, pairs, 0};
  const uint most_of_row = 3u << bits.x;  // pairs that it can add
  block_t block;
  if (!take_block(size, bits, &block)) return;
  begin_gathering(&gathered);
  block_t brick = block;
  for (brick.front = block.front; brick.front < block.back; brick.front += BRICK) {
    brick.back = min(brick.front + BRICK, block.back);
    for (brick.top = block.top; brick.top < block.bottom; brick.top += BRICK) {
      brick.bottom = min(brick.top + BRICK, block.bottom);
      FOR_EACH_ROW(y, z, brick) {
        global const uint* const row = row_of(labels, y, z, size);
        global const uint* const below =
            y + 1 < size.y ? row + size.x : PERIODIC_Y ? row_of(row_behind, 0, z, size) : row;
        const int z_behind = wrapped(z + 1, DEPTH(size), PERIODIC_Z);
        global const uint* const behind = z_behind < DEPTH(size) ? row_of(labels, y, z_behind, size) : row;
        if (gathered.count + most_of_row > MOST_GATHERED)
          add_gathered(&gathered, block.index, CELL_ARGUMENTS, PAIR_ARGUMENTS);
        add_borders(row, below, block, size.x, true, count, &gathered, CELL_ARGUMENTS, PAIR_ARGUMENTS);
        if (behind != row)
          add_borders(row, behind, block, size.x, false, count, &gathered, CELL_ARGUMENTS, PAIR_ARGUMENTS);
      }
      add_gathered(&gathered, block.index, CELL_ARGUMENTS, PAIR_ARGUMENTS);
    }
  }
}

// Moves the table's pairs into the lists. Those that find no room stay: the second word of `overflow` says so.
kernel void join_pairs(global uint* restrict neighbours, global uint* restrict pairs, PAIR_PARAMETERS) {
  const uint at = (uint)get_global_id(0);
  if (at > mask) return;
  const uint3 slot = vload3(at, table);
  if (slot.s0 == NO_PAIR) return;
  const addition_t added = add_to_shared_list(slot.s0, slot.s1, slot.s2 + 1, PAIR_ARGUMENTS);
  if (added != KNOWN_PAIR) atomic_inc(neighbours + slot.s1);
  if (added != NO_ROOM) {
    table[3 * (size_t)at] = NO_PAIR;
  } else {
    atomic_inc(pairs + slot.s0);
    atomic_or(overflow + 1, 1u);
  }
}

// Counts each cell's pairs, in which its id is the lower one; and joins what its home and others have added.
kernel void count_pairs(uint count, global const uint2* restrict lists, global uint* restrict pairs,
                        CELL_PARAMETERS) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  uint own = pairs[id];
  for (uint i = 0; i < LIST_SIZE; ++i) own += lists[(size_t)id * LIST_SIZE + i].s0 != NO_PAIR;
  pairs[id] = own;
  neighbours[id] += own + cells[4 * (size_t)id + 2];
  perimeters[id] += cells[4 * (size_t)id + 3];
}

// Puts the pairs of each cell's list into the cell's place, sorted; `first` is where that begins in the list of all.
kernel void place_lists(uint count, global const uint2* restrict lists,
                        global const uint* restrict first, global uint* restrict placed,
                        global uint* restrict pair_list) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  global const uint2* const list = lists + (size_t)id * LIST_SIZE;
  uint taken = 0;  // bit i: slot i has a pair; a branch on each slot would be mispredicted
  for (uint i = 0; i < LIST_SIZE; ++i) taken |= (uint)(list[i].s0 != NO_PAIR) << i;
  placed[id] = popcount(taken);
  for (; taken != 0; taken &= taken - 1) {
    const uint2 slot = list[lowest_bit(taken)];
    uint before = 0;
    for (uint j = 0; j < LIST_SIZE; ++j) before += list[j].s0 < slot.s0;
    vstore3((uint3)(id, slot), first[id] + before, pair_list);
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
