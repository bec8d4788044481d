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

// How far pixels are from where their labels' seeds are now, in the middle row of every `row_interval` rows, or the
// last of fewer. A work-item takes a vector of each such row among `rows`. In `found`: the greatest distance, if it is
// more than `enough`, and how many pixels have no label whose seed is there.
VECTOR_KERNEL void measure_labels(global const uint* restrict labels, global const uint* restrict positions, uint count,
                                  int width, int height, int row_interval, int rows, uint enough,
                                  global uint* restrict found) {
  const int wide = (width + VOROCL_WIDTH - 1) / VOROCL_WIDTH, item = (int)get_global_id(0);
  const int own = item % wide * VOROCL_WIDTH, x = min(own, width - VOROCL_WIDTH);
  const int first = item / wide * rows, end = min(first + rows, height);
  const uint_v once = select((uint_v)0, (uint_v)1, (uint)x + LANES >= (uint_v)(uint)own);  // the rest is another's too
  uint_v greatest = (uint_v)enough, missing = (uint_v)0;
  for (int of_row = first; of_row < end; of_row += row_interval) {
    const int y = min(of_row + row_interval / 2, height - 1);
    const uint_v position = look_up_positions(labels + y * width + x, positions, count);
    const uint_v distance =
        distance_to_label_in_grid(position, vector_positions(x, y), periods(width, height));
    greatest = max(greatest, select(distance, (uint_v)0, (distance & EMPTY_BIT) != 0));
    missing += select((uint_v)0, once, (position & EMPTY_BIT) != 0);
  }
  if (ANY(greatest > enough)) atomic_max(found, ~lane_min(~greatest));
  if (ANY(missing > 0)) atomic_add(found + 1, lane_sum(missing));
}

// Reports whether a pixel has no label.
VECTOR_KERNEL void find_unlabelled(global const uint* restrict labels, int width, int height,
                                   global int* restrict found) {
  if (!has_vector(width, height)) return;
  if (ANY(LOAD_VECTOR(labels + vector_y() * width + vector_x(width)) == NO_LABEL)) atomic_or(found, 1);
}
