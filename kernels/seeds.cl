// Seeds: making their packed positions, and stamping them where a wave starts from.

#include "philox.cl"
#include "position.cl"

// Points in pixel units to packed positions. A bad point leaves its index, if it is the first one, and no seed.
kernel void snap_points(global const float2* restrict points, global uint* restrict positions, uint count,
                        int width, int height, global uint* restrict first_bad) {
  const uint id = (uint)get_global_id(0);
  if (id == count) positions[id] = EMPTY;
  if (id >= count) return;
  const float2 point = points[id];
  // Written so that a NaN fails.
  if (point.x >= 0.0f && point.x < (float)width && point.y >= 0.0f && point.y < (float)height) {
    positions[id] = pack((int)point.x, (int)point.y);
  } else {
    positions[id] = EMPTY;
    atomic_min(first_bad, id);
  }
}

// Keeps the first bad point of the first list that has one: 1, its index, and the bits of its x and y.
kernel void keep_bad_point(global const float2* restrict points, global const uint* restrict first_bad,
                           global uint* restrict kept) {
  if (get_global_id(0) > 0 || kept[0] != 0 || *first_bad == NO_LABEL) return;
  kept[0] = 1;
  kept[1] = *first_bad;
  kept[2] = as_uint(points[*first_bad].x);
  kept[3] = as_uint(points[*first_bad].y);
}

kernel void random_positions(global uint* restrict positions, uint count, int width, int height, uint2 key) {
  const uint id = (uint)get_global_id(0);
  if (id == count) positions[id] = EMPTY;
  if (id >= count) return;
  const uint4 bits = philox((uint4)(id, 0, 0, PHILOX_POSITIONS), key);
  positions[id] = pack((int)uniform_below(bits.s0, (uint)width), (int)uniform_below(bits.s1, (uint)height));
}

// Marks the pixels that hold a seed, in a map of zeros. Seeds on one pixel write the same value.
kernel void mark_seeds(global const uint* restrict positions, uint count, global uchar* restrict seeded, int width) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || positions[id] & EMPTY_BIT) return;
  seeded[VOROCL_GUARD + packed_y(positions[id]) * width + packed_x(positions[id])] = 1;
}

// An image of ids at the seeds' pixels (FIRST_ID + the pixel's index), in two steps: of the seeds on one pixel the lowest
// id stays. The other pixels are never looked up, so they keep what they held.
kernel void clear_ids(global const uint* restrict positions, uint count, global uint* restrict ids, int width) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || positions[id] & EMPTY_BIT) return;
  ids[FIRST_ID + packed_y(positions[id]) * width + packed_x(positions[id])] = NO_LABEL;
}

kernel void stamp_ids(global const uint* restrict positions, uint count, global uint* restrict ids, int width) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || positions[id] & EMPTY_BIT) return;
  atomic_min(ids + FIRST_ID + packed_y(positions[id]) * width + packed_x(positions[id]), id);
}
