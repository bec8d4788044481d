// The table of the pairs of cells that touch, while they are found: a hash table with open addressing.
//
// A slot has three words: both ids, the lower one first, and by how much the cells touch. All begin as NO_PAIR, which
// is -1 for the third one: it says one too few. Without 64-bit atomics a pair takes a slot in two steps, first the word
// of the one id and then that of the other, and neither changes again. So whoever has the same pair goes past the same
// slots and finds the same one; a slot that has one id alone goes to whoever comes first with the other.

#ifndef VOROCL_PAIR_TABLE
#define VOROCL_PAIR_TABLE

#define NO_PAIR 0xffffffffu
#define MOST_PROBES 64

// What kernels take of the table: it has mask + 1 slots, so many of them for each cell. Both are powers of two.
#define TABLE_PARAMETERS uint mask, uint slots_of_cell, global uint *restrict table, global uint *restrict overflow

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

// Adds to the border of the cells p and q. The pairs of one cell are side by side first, for its borders are found one
// soon after the other. Where these slots are taken the others are everywhere, and far apart: where few cells have many
// neighbours, all slots beside those are taken too.
static inline void add_border(uint p, uint q, uint size, TABLE_PARAMETERS) {
  const uint a = min(p, q), b = max(p, q), hash = hash_of(a, b), step = hash * 0x9e3779b1u | 1u;
  for (uint probe = 0; probe < MOST_PROBES; ++probe) {
    const uint beside = a * slots_of_cell + ((hash + probe) & (slots_of_cell - 1));
    global uint* const slot = table + 3 * (size_t)((probe < slots_of_cell ? beside : hash + probe * step) & mask);
    if (takes(slot, a) && takes(slot + 1, b)) {
      atomic_add(slot + 2, size);
      return;
    }
  }
  atomic_or(overflow, 1u);  // the host will find all of them again in a larger table
}

#endif
