// Seeds of a volume: making them, and stamping them where waves start from and ids are looked up.

#include "core/philox.cl"
#include "volumes/position.cl"

// Each work-item makes a vector of them; EMPTY follows the last one. The second counter gives z.
VECTOR_KERNEL void random_voxels(global uint* restrict positions, uint count, int width, int height, int depth,
                                 uint2 key) {
  const uint first = (uint)get_global_id(0) * VOROCL_WIDTH;
  if (first > count) return;
  uint_v x, y, z, unused;
  philox(first + LANES, 0, PHILOX_POSITIONS, key, &x, &y);
  philox(first + LANES, 1, PHILOX_POSITIONS, key, &z, &unused);
  x = uniform_below(x, (uint)width);
  y = uniform_below(y, (uint)height);
  z = uniform_below(z, (uint)depth);
  store_some(z << SHIFT_Z | y << VOROCL_BITS_X | x, positions + first, count - first);
  if (count - first < VOROCL_WIDTH) positions[count] = EMPTY;
}

// The greatest way of a seed along an axis between two lists of positions; in a word of 0.
kernel void find_greatest_way(global const uint* restrict from, global const uint* restrict to, uint count, int width,
                              int height, int depth, global uint* restrict greatest) {
  const uint id = (uint)get_global_id(0);
  (void)width, (void)height, (void)depth;  // of periodic axes alone
  if (id >= count || (from[id] | to[id]) & EMPTY) return;
  const int x = x_of(from[id]) - x_of(to[id]), y = y_of(from[id]) - y_of(to[id]), z = z_of(from[id]) - z_of(to[id]);
  const uint in_plane = max(abs(SHORTER(x, width, PERIODIC_X)), abs(SHORTER(y, height, PERIODIC_Y)));
  const uint way = max(in_plane, abs(SHORTER(z, depth, PERIODIC_Z)));
  if (way > 0) atomic_max(greatest, way);
}

// An image of positions, where seeds are. Those on one voxel write the same value.
kernel void stamp_positions(global const uint* restrict positions, uint count, global uint* restrict image, int width,
                            int height) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || positions[id] & EMPTY) return;
  image[VOROCL_GUARD + voxel_index(positions[id], width, height)] = positions[id];
}

// An image of ids at the seeds' voxels, in two steps: of the seeds on one voxel the lowest id stays. The other voxels
// are never looked up, so they keep what they held.
kernel void clear_ids(global const uint* restrict positions, uint count, global uint* restrict ids, int width,
                      int height) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || positions[id] & EMPTY) return;
  ids[FIRST_ID + voxel_index(positions[id], width, height)] = NO_LABEL;
}

kernel void stamp_ids(global const uint* restrict positions, uint count, global uint* restrict ids, int width,
                      int height) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || positions[id] & EMPTY) return;
  atomic_min(ids + FIRST_ID + voxel_index(positions[id], width, height), id);
}
