// Where the voxels of a cell lie, as the measures of volumes see it: THE RULE OF PLACE, as in
// kernels/measures/seed_place.cl. Along a periodic axis a voxel lies the shorter way round from its seed, half a period
// away behind it: perhaps outside the volume. Along other axes it lies where the volume has it.

#ifndef VOROCL_VOLUMES_PLACE
#define VOROCL_VOLUMES_PLACE

#include "volumes/position.cl"

// From a seed to a voxel along an axis. Ways go from -(period - 1) / 2 to period / 2, where they jump.
static inline int way_to(int at, int seed, int size, int periodic) {
  const int inside = at - seed;
  if (!periodic) return inside;
  if (2 * inside > size) return inside - size;
  return 2 * inside <= -size ? inside + size : inside;
}

// Whether the next voxel along an axis is there, and as far from the seed as its place says.
static inline bool goes_on(int at, int step, int way, int size, int periodic) {
  const int next = periodic ? way + step : at + step;
  return periodic ? next <= size / 2 && next >= -((size - 1) / 2) : next >= 0 && next < size;
}

// The end of the piece of voxels [from, to) that begins at `from`, which is `way` from the seed, and has no jump.
static inline int piece_end(int from, int to, int way, int size, int periodic) {
  return periodic ? min(to, from + size / 2 - way + 1) : to;
}

// How many periods the voxels [from, to) along a periodic axis are away, in sum, from where they lie by the rule.
static inline int periods_away(int from, int to, int seed, int size) {
  const int first = seed - (size - 1) / 2, end = seed + size / 2 + 1;
  return max(min(to, first) - from, 0) - max(to - max(from, end), 0);
}

#endif
