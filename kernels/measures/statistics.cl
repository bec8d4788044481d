// Statistics of the areas of all cells, as partial sums over parts of the list of cells.

#include "core/position.cl"

kernel void sum_areas(global const uint* restrict area, uint count, uint cells_per_item, uint items,
                      global ulong4* restrict partial) {
  const uint item = (uint)get_global_id(0);
  if (item >= items) return;
  const uint end = min((item + 1) * cells_per_item, count);
  ulong4 sums = (ulong4)0;  // cells with pixels, areas, squares of areas
  for (uint id = item * cells_per_item; id < end; ++id) {
    const ulong pixels = area[id];
    sums += (ulong4)(pixels != 0, pixels, pixels * pixels, 0);
  }
  partial[item] = sums;
}
