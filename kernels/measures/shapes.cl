// The extent of each cell: bounding box and largest distance to the seed. Along a periodic axis a pixel is where it
// lies the shorter way round from the seed, so a box may reach out of the grid.

#include "measures/runs.cl"

// A box is left, top, right, bottom.
kernel void clear_shapes(uint count, global int4* restrict boxes, global int* restrict largest) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  boxes[id] = (int4)(INT_MAX, INT_MAX, INT_MIN, INT_MIN);
  largest[id] = -1;
}

// Whether the next pixel along an axis is there, and as far from the seed as its place says: along a periodic axis the
// way from the seed jumps half a period away from it.
static inline bool goes_on_x(int x, int step, int seed_x, int width) {
  if (!PERIODIC_X) return x + step >= 0 && x + step < width;
  return shorter_way_x(wrapped_x(x + step, width) - seed_x, width) == shorter_way_x(x - seed_x, width) + step;
}
static inline bool goes_on_y(int y, int step, int seed_y, int height) {
  if (!PERIODIC_Y) return y + step >= 0 && y + step < height;
  return shorter_way_y(wrapped_y(y + step, height) - seed_y, height) == shorter_way_y(y - seed_y, height) + step;
}

static inline bool in_one_of(global const uint* row, global const uint* above, global const uint* below, int x,
                             uint label) {
  return row[x] == label || above[x] == label || below[x] == label;
}

// What a row cannot decide is left to the others: a run adds to a side of its cell's box, or to the largest
// distance, only if the pixel next to its end in the row above or below, which would add more, is not in the cell.
// That leaves a few atomics of the many that the cells' borders would need.
kernel void add_shapes(global const uint* restrict labels, global const uint* restrict positions, uint count, int width,
                       int height, int wide, int high, global int* restrict boxes, global int* restrict largest) {
  block_t block;
  if (!take_block(width, height, wide, high, &block)) return;
  for (int y = block.top; y < block.bottom; ++y) {
    global const uint* const row = labels + y * width;
    walk_t walk = begin_walk(row, row, block.left, block.right);
    while (next_run(&walk)) {
      const uint label = run_label(&walk);
      if (label >= count) continue;
      const int seed_x = packed_x(positions[label]), seed_y = packed_y(positions[label]);
      const int way_y = shorter_way_y(y - seed_y, height);
      const bool above = goes_on_y(y, -1, seed_y, height), below = goes_on_y(y, 1, seed_y, height);
      global const uint* const row_above = labels + (above ? wrapped_y(y - 1, height) : y) * width;
      global const uint* const row_below = labels + (below ? wrapped_y(y + 1, height) : y) * width;
      global int* const box = boxes + 4 * (size_t)label;
      for (int from = walk.from, to; from < walk.to; from = to) {
        to = piece_end(from, walk.to, seed_x, width);
        const int first = from, last = to - 1, way_x = shorter_way_x(first - seed_x, width);
        const int way_of_last = way_x + last - first;
        if (!(goes_on_x(first, -1, seed_x, width) &&
              in_one_of(row, row_above, row_below, wrapped_x(first - 1, width), label))) {
          atomic_min(box, seed_x + way_x);
        }
        if (!(goes_on_x(last, 1, seed_x, width) &&
              in_one_of(row, row_above, row_below, wrapped_x(last + 1, width), label))) {
          atomic_max(box + 2, seed_x + way_of_last);
        }
        if (!(above && row_above[first] == label)) atomic_min(box + 1, seed_y + way_y);
        if (!(below && row_below[first] == label)) atomic_max(box + 3, seed_y + way_y);

        const bool ends = way_y < 0 ? !above : !below;
        global const uint* const away = way_y < 0 ? row_above : row_below;
        if (ends || away[first] != label) atomic_max(largest + label, (int)distance_of_offset(way_x, way_y));
        if (ends || away[last] != label) atomic_max(largest + label, (int)distance_of_offset(way_of_last, way_y));
      }
    }
  }
}
