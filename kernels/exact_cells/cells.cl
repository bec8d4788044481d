// Exact cells: one work-item cuts one out of the box, in private memory.

#define POLYGON_SPACE private
#include "exact_cells/measure.cl"

#define ROOM 20  // cells of random points have 6 edges in the mean, and one in 10^10 as many as 20

// Cells of coincident points but the first, and of points that are not there, are empty.
kernel void clear_cells(uint cells, global double* restrict areas, global double2* restrict centroids,
                        global double* restrict perimeters, global uint* restrict edge_counts,
                        global uint* restrict neighbours, global uchar* restrict flags) {
  const uint id = (uint)get_global_id(0);
  if (id >= cells) return;
  areas[id] = perimeters[id] = 0;
  centroids[id] = (double2)NAN;
  edge_counts[id] = neighbours[id] = 0;
  flags[id] = CERTIFIED;
}

kernel __attribute__((vec_type_hint(float8))) void cut_cells(SITE_PARAMETERS, MEASURE_PARAMETERS) {
  const uint site = (uint)get_global_id(0);
  if (site >= count) return;
  edge_t edges[ROOM];
  measure_cell(SITE_ARGUMENTS, MEASURE_ARGUMENTS, site, edges, ROOM);
}

// Puts the edges of each cell where they belong: by the caller's ids, in the units of the data.
kernel void place_edges(uint count, global const int* restrict sites, global const uint* restrict ids, double2 origin,
                        double step, global const uint* restrict begins, global const uint* restrict edge_counts,
                        global const uint* restrict found_cells, global const double2* restrict found_vertices,
                        global const uint* restrict offsets, global uint* restrict cells,
                        global double* restrict lengths, global double2* restrict vertices) {
  const uint site = (uint)get_global_id(0);
  if (site >= count) return;
  const double2 at = convert_double2(site_at(sites, site));
  const uint id = ids[site], begin = begins[site], size = edge_counts[id], offset = offsets[id];
  for (uint i = 0; i < size; ++i) {
    const double2 from = found_vertices[begin + i], way = found_vertices[begin + (i + 1 < size ? i + 1 : 0)] - from;
    const uint cell = found_cells[begin + i];
    cells[offset + i] = cell == NO_CELL ? NO_CELL : ids[cell];
    lengths[offset + i] = sqrt(way.s0 * way.s0 + way.s1 * way.s1) / 2 * step;
    vertices[offset + i] = origin + (at + from / 2) * step;
  }
}
