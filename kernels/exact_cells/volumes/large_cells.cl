// The cells that had more faces than the first kernel has room for, in global memory.

#define LARGE_CELLS
#include "exact_cells/volumes/measure.cl"

kernel __attribute__((vec_type_hint(double8))) void cut_large_cells(SITE_PARAMETERS, MEASURE_PARAMETERS,
                                                                    global const uint* restrict large, uint from,
                                                                    uint to, global uchar* restrict memory, int room) {
  const uint i = (uint)get_global_id(0);
  if (i >= to - from) return;
  const tree_t tree = SITE_ARGUMENTS;
  const uint site = large[from + i];
  near_t near;
  find_near(&near, &tree, site >> FAN_BITS);
  cell_t cell;
  place_cell(&cell, memory + (size_t)i * CELL_BYTES((size_t)room), room);
  measure_cell(&cell, &tree, &near, MEASURE_ARGUMENTS, site);
}

kernel __attribute__((vec_type_hint(double8))) void outline_large_cells(SITE_PARAMETERS, OUTLINE_PARAMETERS,
                                                                        global const uint* restrict large, uint from,
                                                                        uint to, global uchar* restrict memory,
                                                                        int room) {
  const uint i = (uint)get_global_id(0);
  if (i >= to - from) return;
  const tree_t tree = SITE_ARGUMENTS;
  const uint site = large[from + i];
  near_t near;
  find_near(&near, &tree, site >> FAN_BITS);
  cell_t cell;
  place_cell(&cell, memory + (size_t)i * CELL_BYTES((size_t)room), room);
  outline_cell(&cell, &tree, &near, OUTLINE_ARGUMENTS, site);
}
