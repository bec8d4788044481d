// Statistics of the areas of all cells, as partial sums of stretches of the list of cells.

#include "position.cl"

kernel void sum_areas(global const uint* restrict area, global const uint* restrict positions, uint count, uint stretch,
                      uint items, global ulong4* restrict partial) {
  const uint item = (uint)get_global_id(0);
  if (item >= items) return;
  const uint end = min((item + 1) * stretch, count);
  ulong4 sums = (ulong4)0;  // cells, cells without pixels, areas, squares of areas
  for (uint id = item * stretch; id < end; ++id) {
    const ulong pixels = area[id];
    if (!(positions[id] & EMPTY_BIT)) sums += (ulong4)(1, pixels == 0, pixels, pixels * pixels);
  }
  partial[item] = sums;
}
