// The pairs of cells of a volume that share voxel faces, found in a hash table; kernels/measures/adjacency.cl puts them
// in order.

#include "measures/pair_table.cl"
#include "measures/runs.cl"
#include "volumes/blocks.cl"
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

// Blocks are as deep as they are high, so that the pairs of a cell are found while they are in a cache.
kernel void find_faces(global const uint* restrict labels, uint count, int4 size, int4 bits, TABLE_PARAMETERS) {
  cuboid_t block;
  if (!take_cuboid(size, bits, &block)) return;
  const int left = block.first.x, right = block.end.x;
  for (int z = block.first.z; z < block.end.z; ++z) {
    const int next_z = z + 1 < size.z ? z + 1 : PERIODIC_Z ? 0 : z;
    for (int y = block.first.y; y < block.end.y; ++y) {
      const int next_y = y + 1 < size.y ? y + 1 : PERIODIC_Y ? 0 : y;
      global const uint* const row = row_of(labels, y, z, size);
      global const uint* const below = row_of(labels, next_y, z, size);
      global const uint* const behind = row_of(labels, y, next_z, size);
      add_faces(row, below, left, right, size.x, true, count, mask, slots_of_cell, table, overflow);
      add_faces(row, behind, left, right, size.x, false, count, mask, slots_of_cell, table, overflow);
    }
  }
}
