// Seeds: making their packed positions, and stamping them where a wave starts from.

#include "core/philox.cl"
#include "core/position.cl"

// Points in pixel units to packed positions. Where seeds are marked, a mark of 0 says that the seed is absent, and
// its point is not looked at. `found` holds the least index of a bad point, the bits of its x and y, and how many are
// absent.
kernel void snap_points(global const float2* restrict points, global const uchar* restrict marks, int marked,
                        global uint* restrict positions, uint count, int width, int height,
                        global uint* restrict found) {
  const uint id = (uint)get_global_id(0);
  if (id > count) return;
  positions[id] = EMPTY;
  if (id == count) return;
  if (marked && marks[id] == 0) {
    atomic_inc(found + 3);
    return;
  }
  const float2 point = points[id];
  // Written so that a NaN fails.
  if (point.x >= 0.0f && point.x < (float)width && point.y >= 0.0f && point.y < (float)height) {
    positions[id] = pack((int)point.x, (int)point.y);
  } else {
    atomic_min(found, id);
  }
}

// Notes the coordinates of the bad point, for its buffer is the caller's and may change.
kernel void note_bad_point(global const float2* restrict points, global uint* restrict found) {
  if (get_global_id(0) > 0 || found[0] == NO_LABEL) return;
  found[1] = as_uint(points[found[0]].x);
  found[2] = as_uint(points[found[0]].y);
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

// An image of ids at the seeds' pixels (FIRST_ID + the pixel's index), in two steps: of the seeds on one pixel the
// lowest id stays. The other pixels are never looked up, so they keep what they held.
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
