// Seeds: making their packed positions, and stamping them where a wave starts from.

#include "core/philox.cl"
#include "core/position.cl"

// The greatest way of a seed along an axis between two lists of positions, the shorter way round; in a word of 0.
kernel void find_greatest_way(global const uint* restrict from, global const uint* restrict to, uint count, int width,
                              int height, global uint* restrict greatest) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || (from[id] | to[id]) & EMPTY_BIT) return;
  const int dx = shorter_way_x(packed_x(to[id]) - packed_x(from[id]), width);
  const int dy = shorter_way_y(packed_y(to[id]) - packed_y(from[id]), height);
  const uint way = max(abs(dx), abs(dy));
  if (way > 0) atomic_max(greatest, way);
}

// Each work-item makes a vector of them; EMPTY follows the last one.
VECTOR_KERNEL void random_positions(global uint* restrict positions, uint count, int width, int height, uint2 key) {
  const uint first = (uint)get_global_id(0) * VOROCL_WIDTH;
  if (first > count) return;
  uint_v x, y;
  philox(first + LANES, 0, PHILOX_POSITIONS, key, &x, &y);
  x = uniform_below(x, (uint)width);
  y = uniform_below(y, (uint)height);
  store_some(y << 16 | x, positions + first, count - first);
  if (count - first < VOROCL_WIDTH) positions[count] = EMPTY;
}

// Marks the pixels that hold a seed, in a map of zeros. Seeds on one pixel write the same value.
kernel void mark_seeds(global const uint* restrict positions, uint count, global uchar* restrict seeded, int width) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || positions[id] & EMPTY_BIT) return;
  seeded[VOROCL_GUARD + packed_y(positions[id]) * width + packed_x(positions[id])] = 1;
}

// An image of ids at the seeds' pixels (FIRST_ID + the pixel's index), in two steps: of the seeds on one pixel the
// lowest id stays. The first value of all is the label of pixels without one: EMPTY, which follows the last position,
// clears it. The other pixels are never looked up, so they keep what they held.
kernel void clear_ids(global const uint* restrict positions, uint count, global uint* restrict ids, int width) {
  const uint id = (uint)get_global_id(0);
  if (id > count) return;
  const uint position = positions[id];
  const int pixel = packed_y(position) * width + packed_x(position);
  ids[position & EMPTY_BIT ? 0 : FIRST_ID + pixel] = NO_LABEL;
}

kernel void stamp_ids(global const uint* restrict positions, uint count, global uint* restrict ids, int width) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || positions[id] & EMPTY_BIT) return;
  atomic_min(ids + FIRST_ID + packed_y(positions[id]) * width + packed_x(positions[id]), id);
}
