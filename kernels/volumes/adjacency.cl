// The pairs of cells of a volume that share voxel faces, found in a hash table; kernels/measures/adjacency.cl puts them
// in order.

#include "measures/pair_table.cl"
#include "measures/runs.cl"
#include "volumes/position.cl"

// Adds the faces between a row and one beside it, and along the row those between its own runs if `along` says so. Of a
// row without one beside it, that one is the row itself. Across the ends of a periodic axis faces count as inside.
static inline void add_faces(global const uint* row, global const uint* beside, int left, int right, int width,
                             bool along, uint count, TABLE_PARAMETERS) {
  walk_t walk = begin_walk(row, beside, left, right);
  while (next_run(&walk)) {
    const int last = walk.to - 1;
    const int right_of_last = PERIODIC_X || walk.to < width ? wrapped(walk.to, width, PERIODIC_X) : last;
    const uint label = row[last], next = row[right_of_last], other = beside[last];
    if (label >= count) continue;
    if (along && next < count && next != label) add_border(label, next, 1u, mask, slots_of_cell, table, overflow);
    if (other < count && other != label) {
      add_border(label, other, (uint)(walk.to - walk.from), mask, slots_of_cell, table, overflow);
    }
  }
}

// The blocks are those of the image of all rows, slice after slice.
kernel void find_faces(global const uint* restrict labels, uint count, int width, int height, int rows, int wide,
                       int high, TABLE_PARAMETERS) {
  block_t block;
  if (!take_block(width, rows, wide, high, &block)) return;
  for (int y = block.top; y < block.bottom; ++y) {
    const size_t across = (size_t)width, slice = across * (size_t)height;
    global const uint* const row = labels + (size_t)y * across;
    global const uint* const below = (y + 1) % height != 0 ? row + across : PERIODIC_Y ? row + across - slice : row;
    global const uint* const behind =
        y + height < rows ? row + slice : PERIODIC_Z ? labels + (size_t)(y % height) * across : row;
    add_faces(row, below, block.left, block.right, width, true, count, mask, slots_of_cell, table, overflow);
    add_faces(row, behind, block.left, block.right, width, false, count, mask, slots_of_cell, table, overflow);
  }
}
