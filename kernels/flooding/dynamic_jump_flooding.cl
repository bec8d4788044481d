// Dynamic jump flooding: the start from the labels of the last frame.

#include "core/position.cl"

// Each pixel's label to the position that its seed has now; a seed that is there no more leaves its pixels empty.
VECTOR_KERNEL void advance_labels(global const uint* restrict labels, global const uint* restrict positions, uint count,
                                  global uint* restrict out, int width, int height) {
  if (!has_vector(width, height)) return;
  const int first = vector_y() * width + vector_x(width);
  const uint_v at = min(LOAD_VECTOR(labels + first), (uint_v)count);
  store_looked_up(positions, at, out, VOROCL_GUARD + first);
}

// How far pixels are from their labels' seeds, in every `row_interval`-th row: the greatest distance, and how many
// pixels are farther than `near`; both are left alone where none is. An empty label is farther than any seed.
VECTOR_KERNEL void measure_labels(global const uint* restrict labels, global const uint* restrict positions, uint count,
                                  int width, int height, int row_interval, uint near, global uint* restrict greatest,
                                  global uint* restrict far_pixels) {
  const int x = vector_x(width), row = vector_y(), y = row * row_interval;
  if (!has_vector(width, height) || y >= height) return;
  const uint_v position = look_up_positions(labels + y * width + x, positions, count);
  const uint_v distance = distance_to_label_in_grid(position, vector_positions(x, y), periods(width, height));
  const uint own = (uint)get_global_id(0) * VOROCL_WIDTH;  // pixels before it are another vector's too
  const uint found = lane_sum(select((uint_v)0, (uint_v)1, distance > near && (uint)x + LANES >= (uint_v)own));
  if (found == 0) return;
  atomic_max(greatest + row, ~lane_min(~distance));
  atomic_add(far_pixels + row, found);
}

// Stamps the seeds at their new pixels. Seeds on one pixel write the same value.
kernel void stamp_positions(global const uint* restrict positions, uint count, global uint* restrict out, int width) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || positions[id] & EMPTY_BIT) return;
  out[VOROCL_GUARD + packed_y(positions[id]) * width + packed_x(positions[id])] = positions[id];
}

// Reports whether a pixel has no label.
VECTOR_KERNEL void find_unlabelled(global const uint* restrict labels, int width, int height,
                                   global int* restrict found) {
  if (!has_vector(width, height)) return;
  if (ANY(LOAD_VECTOR(labels + vector_y() * width + vector_x(width)) == NO_LABEL)) atomic_or(found, 1);
}
