// Seeds of planes and volumes: making their packed positions, and stamping them where waves start from and ids are
// looked up.

#include "core/philox.cl"
#include "core/position.cl"

// The greatest way of a seed along an axis between two lists of positions, the shorter way round; in a word of 0.
kernel void find_greatest_way(global const uint* restrict from, global const uint* restrict to, uint count, int4 size,
                              global uint* restrict greatest) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || (from[id] | to[id]) & EMPTY_BIT) return;
  const int x = x_of(from[id]) - x_of(to[id]), y = y_of(from[id]) - y_of(to[id]), z = z_of(from[id]) - z_of(to[id]);
  const uint in_plane = max(abs(SHORTER(x, size.x, PERIODIC_X)), abs(SHORTER(y, size.y, PERIODIC_Y)));
  const uint way = max(in_plane, abs(SHORTER(z, size.z, PERIODIC_Z)));
  if (way > 0) atomic_max(greatest, way);
}

// Each work-item makes a vector of them; EMPTY follows the last one. In volumes the second counter gives z.
VECTOR_KERNEL void random_positions(global uint* restrict positions, uint count, int4 size, uint2 key) {
  const uint first = (uint)get_global_id(0) * VOROCL_WIDTH;
  if (first > count) return;
  uint_v x, y;
  philox(first + LANES, 0, PHILOX_POSITIONS, key, &x, &y);
  uint_v position = uniform_below(y, (uint)size.y) << SHIFT_Y | uniform_below(x, (uint)size.x);
#if VOROCL_DIMENSIONS == 3
  uint_v z, unused;
  philox(first + LANES, 1, PHILOX_POSITIONS, key, &z, &unused);
  position |= uniform_below(z, (uint)size.z) << SHIFT_Z;
#endif
  store_some(position, positions + first, count - first);
  if (count - first < VOROCL_WIDTH) positions[count] = EMPTY;
}

// Marks the pixels that hold a seed, in a map of zeros. Seeds on one pixel write the same value, here and below.
kernel void mark_seeds(global const uint* restrict positions, uint count, global uchar* restrict seeded, int width) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || positions[id] & EMPTY_BIT) return;
  seeded[VOROCL_GUARD + index_of_seed(positions[id], width, 1)] = 1;
}

// An image of positions, where seeds are.
kernel void stamp_positions(global const uint* restrict positions, uint count, global uint* restrict image, int width,
                            int height) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || positions[id] & EMPTY_BIT) return;
  image[VOROCL_GUARD + index_of_seed(positions[id], width, height)] = positions[id];
}

// An image of ids at the seeds' pixels (FIRST_ID + the pixel's index), in two steps: of the seeds on one pixel the
// lowest id stays. The first value of all is the label of pixels without one: EMPTY, which follows the last position,
// clears it. The other pixels are never looked up, so they keep what they held.
kernel void clear_ids(global const uint* restrict positions, uint count, global uint* restrict ids, int width,
                      int height) {
  const uint id = (uint)get_global_id(0);
  if (id > count) return;
  const uint position = positions[id];
  ids[position & EMPTY_BIT ? 0 : FIRST_ID + index_of_seed(position, width, height)] = NO_LABEL;
}

kernel void stamp_ids(global const uint* restrict positions, uint count, global uint* restrict ids, int width,
                      int height) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || positions[id] & EMPTY_BIT) return;
  atomic_min(ids + FIRST_ID + index_of_seed(positions[id], width, height), id);
}
