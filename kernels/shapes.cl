// The extent of each cell: bounding box and largest distance to the seed.

#include "runs.cl"

// A box is left, top, right, bottom.
kernel void clear_shapes(uint count, global int4* restrict boxes, global int* restrict largest) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  boxes[id] = (int4)(INT_MAX, INT_MAX, -1, -1);
  largest[id] = -1;
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
      const int first = walk.from, last = walk.to - 1;
      const bool above = y > 0, below = y + 1 < height;
      global int* const box = boxes + 4 * (size_t)label;
      if (!(first > 0 && ((row[first - 1] == label) || (above && row[first - 1 - width] == label) ||
                          (below && row[first - 1 + width] == label)))) {
        atomic_min(box, first);
      }
      if (!(last + 1 < width && ((row[last + 1] == label) || (above && row[last + 1 - width] == label) ||
                                 (below && row[last + 1 + width] == label)))) {
        atomic_max(box + 2, last);
      }
      if (!(above && row[first - width] == label)) atomic_min(box + 1, y);
      if (!(below && row[first + width] == label)) atomic_max(box + 3, y);

      const int seed_x = packed_x(positions[label]), seed_y = packed_y(positions[label]);
      const int away = y < seed_y ? -width : width;
      const bool ends = y < seed_y ? !above : !below;
      if (ends || row[first + away] != label) {
        atomic_max(largest + label, (int)distance_of_offset(first - seed_x, y - seed_y));
      }
      if (ends || row[last + away] != label) {
        atomic_max(largest + label, (int)distance_of_offset(last - seed_x, y - seed_y));
      }
    }
  }
}
