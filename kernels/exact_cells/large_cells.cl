// The cells that had more edges than the first kernel has room for, in global memory.

#define POLYGON_SPACE global
#include "exact_cells/measure.cl"

kernel __attribute__((vec_type_hint(float8))) void cut_large_cells(SITE_PARAMETERS, MEASURE_PARAMETERS,
                                                                   global const uint* restrict large, uint from,
                                                                   uint to, global double* restrict memory, int room) {
  const uint i = (uint)get_global_id(0);
  if (i >= to - from) return;
  const tree_t tree = SITE_ARGUMENTS;
  const uint site = large[from + i];
  near_t near;
  find_near(&near, &tree, site >> FAN_BITS);
  measure_cell(&tree, &near, MEASURE_ARGUMENTS, site, memory + (size_t)i * (size_t)POLYGON_MEMORY(room), room);
}
