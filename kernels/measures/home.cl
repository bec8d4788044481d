// Homes: the block that holds a cell's seed holds most of its pixels. What those add to the cell needs no atomics, for
// no other work-item adds to the same place: it is kept apart, and joined with the rest at the end.
//
// With many cells the time goes into waiting for memory: so homes are kept by themselves, and of a block's index 16
// bits. With small blocks on a large grid they may belong to another block; then that one is the cell's home: the
// results stay right, but fewer atomics are saved.

#ifndef VOROCL_HOME
#define VOROCL_HOME

#include "measures/seed_place.cl"

// The block that holds a seed; of one outside the window, the block that is nearest to it.
static inline uint block_with(seed_t seed, int4 size, int4 bits) {
  const int x = clamp(seed_x(seed, size.x), 0, size.x - 1), y = clamp(seed_y(seed, size.y), 0, size.y - 1);
  return block_of(x, y, min(seed_z(seed), DEPTH(size) - 1), size, bits);
}

static inline ushort home_of(seed_t seed, int4 size, int4 bits) { return (ushort)block_with(seed, size, bits); }

#endif
