// The pairs of cells that touch, while they are found. A pair is that of its lower id, and has one of two places.
//
// LISTS. Each cell has a short list of the cells with higher ids that it touches, and by how much, in open
// addressing. While pairs are found, the block that is the cell's home (see home.cl) alone adds to its list, and needs
// no atomics.
//
// THE TABLE, also in open addressing, takes what other blocks find, and what a list has no room for. A slot has three
// words: both ids, the lower one first, and by how much the cells touch. All begin as NO_PAIR, which is -1 for the
// third one: it says one too few. Without 64-bit atomics a pair takes a slot in two steps, first the word of the one id
// and then that of the other, and neither changes again. So whoever has the same pair goes past the same slots and
// finds the same one; a slot that has one id alone goes to whoever comes first with the other.
//
// When all are found, the table's pairs move into the lists that have room (join_pairs() of adjacency.cl).

#ifndef VOROCL_PAIR_TABLE
#define VOROCL_PAIR_TABLE

#define NO_PAIR 0xffffffffu
#define MOST_PROBES 64

// What kernels take of the lists, which have LIST_SIZE slots each, and of the table, which has mask + 1 slots,
// table_size of them for each cell. All three numbers of slots are powers of two.
#if VOROCL_DIMENSIONS == 3
#define LIST_SIZE 16
#else
#define LIST_SIZE 8
#endif
#define PAIR_PARAMETERS \
  global uint2 *lists, uint mask, uint table_size, global uint *table, global uint *overflow
#define PAIR_ARGUMENTS lists, mask, table_size, table, overflow

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
  }
  atomic_or(overflow, 1u);  // the host will find all of them again in a larger table
}

// What became of an addition to a list.
typedef enum { NO_ROOM, KNOWN_PAIR, NEW_PAIR } addition_t;

// Adds to the pair of a and b in the list of a, which no other work-item may touch meanwhile.
static inline addition_t add_to_list(uint a, uint b, uint size, PAIR_PARAMETERS) {
  (void)mask, (void)table_size, (void)table, (void)overflow;
  global uint2* const list = lists + (size_t)a * LIST_SIZE;
  for (uint probe = 0, hash = hash_of(a, b); probe < LIST_SIZE; ++probe) {
    global uint2* const slot = list + ((hash + probe) & (LIST_SIZE - 1));
    const uint2 found = *slot;
    if (found.s0 == b || found.s0 == NO_PAIR) {
      *slot = (uint2)(b, found.s0 == b ? found.s1 + size : size);
      return found.s0 == b ? KNOWN_PAIR : NEW_PAIR;
    }
  }
  return NO_ROOM;
}

// The same where others add to the list too, of pairs that each come once.
static inline addition_t add_to_shared_list(uint a, uint b, uint size, PAIR_PARAMETERS) {
  (void)mask, (void)table_size, (void)table, (void)overflow;
  global uint* const list = (global uint*)(lists + (size_t)a * LIST_SIZE);
  for (uint probe = 0, hash = hash_of(a, b); probe < LIST_SIZE; ++probe) {
    global uint* const slot = list + 2 * ((hash + probe) & (LIST_SIZE - 1));
    const uint holder = atomic_cmpxchg(slot, NO_PAIR, b);
    if (holder != b && holder != NO_PAIR) continue;
    slot[1] = holder == b ? slot[1] + size : size;
    return holder == b ? KNOWN_PAIR : NEW_PAIR;
  }
  return NO_ROOM;
}

#endif
