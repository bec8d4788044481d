// Sums that many work-items add to.

#ifndef VOROCL_SUMS
#define VOROCL_SUMS

// 64-bit sums without 64-bit atomics, which OpenCL C 1.2 leaves to chance: a pair (low word, high word) and a carry.
static inline void add_to_pair(global uint* pair, uint value) {
  if (atomic_add(pair, value) > 0xffffffffu - value) atomic_inc(pair + 1);
}

#endif
