// The pairs of cells that touch, while they are found. A pair is that of its lower id, and has one of two places.
//
// LISTS. Each cell has a short list of the cells with higher ids that it touches: LIST_SIZE ids, then by how much it
// touches each. The block that is the cell's home (see home.cl) alone adds to it, and needs no atomics.
//
// THE TABLE, in open addressing, takes what other blocks find, and what a list has no room for. A slot has three
// words: both ids, the lower one first, and by how much the cells touch. All begin as NO_PAIR, which is -1 for the
// third one: it says one too few. Without 64-bit atomics a pair takes a slot in two steps, first the word of the one id
// and then that of the other, and neither changes again. So whoever has the same pair goes past the same slots and
// finds the same one; a slot that has one id alone goes to whoever comes first with the other.
//
// When all are found, the table's pairs move into the lists that have room (join_pairs() of adjacency.cl).

#ifndef VOROCL_PAIR_TABLE
#define VOROCL_PAIR_TABLE

#include "core/vector.cl"

#define NO_PAIR 0xffffffffu
#define MOST_PROBES 64

// What kernels take of the lists, and of the table, which has mask + 1 slots, table_size of them for each cell. Both
// numbers of slots are powers of two.
#if VOROCL_DIMENSIONS == 3
#define LIST_SIZE 16
#else
#define LIST_SIZE 8
#endif
#define PAIR_PARAMETERS \
  global uint *lists, uint mask, uint table_size, global uint *table, global uint *overflow
#define PAIR_ARGUMENTS lists, mask, table_size, table, overflow
#define LIST_OF(id) (lists + (size_t)(id) * (2 * LIST_SIZE))

static inline uint hash_of(uint a, uint b) {
  uint hash = a * 0x9e3779b1u + b * 0x85ebca77u;
  hash = (hash ^ hash >> 15) * 0xc2b2ae3du;
  return hash ^ hash >> 13;
}

// Whether a word of a slot holds an id, which it takes if it is free.
static inline bool takes(global uint* word, uint id) {
  const uint holder = atomic_cmpxchg(word, NO_PAIR, id);
  return holder == NO_PAIR || holder == id;
}

// Adds to the pair of a and b, a < b, in the table. The pairs of one cell are side by side first, for its borders are
// found one soon after the other. Where these slots are taken the others are everywhere, and far apart: where few cells
// have many neighbours, all slots beside those are taken too.
// Once a pair has found no room, other places are not tried for the next ones, but they are counted: the host will find
// all of them again in a larger table.
static inline void add_to_table(uint a, uint b, uint size, PAIR_PARAMETERS) {
  (void)lists;
  const uint hash = hash_of(a, b), step = hash * 0x9e3779b1u | 1u;
  for (uint probe = 0; probe < MOST_PROBES; ++probe) {
    const uint beside = a * table_size + ((hash + probe) & (table_size - 1));
    global uint* const slot = table + 3 * (size_t)((probe < table_size ? beside : hash + probe * step) & mask);
    if (takes(slot, a) && takes(slot + 1, b)) {
      atomic_add(slot + 2, size);
      return;
    }
    if (probe == table_size && *overflow != 0) break;
  }
  atomic_inc(overflow);
}

// Where a list has the cell b among its first `count`; `count` if it has not. It looks at so many ids, or more.
static inline uint place_in_list(global const uint* list, uint b, uint count, uint looked_at) {
  uint same = 0;  // bit i: pair i; a CPU would mispredict a branch on each
  for (uint i = 0; i < looked_at; ++i) same |= (uint)(list[i] == b) << i;
  return min(lowest_bit(same), count);
}

// Adds to the size of the pair at a place. No two work-items may do so with one pair.
static inline void add_to_list(global uint* list, uint size, uint place, bool is_new) {
  list[LIST_SIZE + place] = size + (is_new ? 0 : list[LIST_SIZE + place]);
}

#endif
