// Exact cells of volumes: cut out of the box in private memory.

#include "exact_cells/volumes/measure.cl"

// As cut_cells() of the cells of planes.
kernel __attribute__((vec_type_hint(double8))) void cut_cells(SITE_PARAMETERS, MEASURE_PARAMETERS, uint of_item) {
  const uint first = (uint)get_global_id(0) * of_item;
  if (first >= count) return;
  const tree_t tree = SITE_ARGUMENTS;
  near_t near;
  find_near(&near, &tree, first >> FAN_BITS);
  cell_t cell;
  for (uint site = first; site < min(first + of_item, count); ++site)
    measure_cell(&cell, &tree, &near, MEASURE_ARGUMENTS, site);
}

kernel __attribute__((vec_type_hint(double8))) void outline_cells(SITE_PARAMETERS, OUTLINE_PARAMETERS, uint of_item) {
  const uint first = (uint)get_global_id(0) * of_item;
  if (first >= count) return;
  const tree_t tree = SITE_ARGUMENTS;
  near_t near;
  find_near(&near, &tree, first >> FAN_BITS);
  cell_t cell;
  for (uint site = first; site < min(first + of_item, count); ++site)
    outline_cell(&cell, &tree, &near, OUTLINE_ARGUMENTS, site);
}

// Puts the faces of each cell where they belong, by the caller's ids.
kernel void place_faces(uint count, global const uint* restrict ids, global const uint* restrict begins,
                        global const uint4* restrict found, global const uint* restrict offsets,
                        global uint* restrict cells, global double* restrict areas, global ushort* restrict images) {
  const uint site = (uint)get_global_id(0);
  if (site >= count) return;
  const uint begin = begins[site], offset = offsets[ids[site]], size = offsets[ids[site] + 1] - offset;
  for (uint i = 0; i < size; ++i) {
    const uint4 face = found[begin + i];
    cells[offset + i] = face.s0;
    images[offset + i] = (ushort)face.s1;
    areas[offset + i] = as_double(face.s23);
  }
}
