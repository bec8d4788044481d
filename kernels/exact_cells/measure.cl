// What is measured of a cell, and the lines of its edges, as they are found.

#ifndef VOROCL_EXACT_CELLS_MEASURE
#define VOROCL_EXACT_CELLS_MEASURE

#define FOUND_EDGE uint2

#include "exact_cells/search.cl"

#include "exact_cells/each_cell.cl"
#include "exact_cells/found.cl"

// The edge that begins in the lowest vertex, and of two in the left one.
static inline int first_edge(const cell_t* cell) {
  int lowest = 0;
  for (int k = 1; k < cell->size; ++k) {
    const double y = cell->y[k], least = cell->y[lowest];
    lowest = y < least || (y == least && cell->x[k] < cell->x[lowest]) ? k : lowest;
  }
  return lowest + 1 < cell->size ? lowest + 1 : 0;
}

// Sums are taken in half steps from the site, or with weights, which may put a cell far from its site, from a
// vertex: where they lose least.
static inline void measure_cell(const cell_t* cell, const tree_t* tree, uint site, MEASURE_PARAMETERS,
                                global uint* counters) {
  const int2 at = site_at(tree, site);
  const uint id = ids[site], edge_count = (uint)cell->size;
  const uint begin = atomic_add(counters, edge_count);
  begins[site] = begin;
  edge_counts[id] = edge_count;
  if (edge_count == 0 || begin + edge_count > room_for_edges) return;
  uint touching = 0;
  double area = 0, perimeter = 0;
  double2 moment = 0;
  int k = first_edge(cell);
  const int before = (k > 0 ? k : cell->size) - 1;
  double2 from = (double2)(cell->x[before], cell->y[before]);
  const double2 base = tree->lags != 0 ? from : 0;
  from -= base;
  for (uint i = 0; i < edge_count; ++i) {
    const double2 to = (double2)(cell->x[k], cell->y[k]) - base, way = to - from;
    const double part = from.s0 * to.s1 - to.s0 * from.s1;
    area += part;
    moment += part * (from + to);
    perimeter += sqrt(way.s0 * way.s0 + way.s1 * way.s1);
    touching += cell->sites[k] == NO_CELL ? 1u : 0u;
    found[begin + i] = (uint2)(cell->sites[k], as_uint(cell->images[k]));
    from = to;
    k = k + 1 < cell->size ? k + 1 : 0;
  }
  neighbours[id] = edge_count - touching;
  flags[id] = (uchar)((touching > 0 ? TOUCHES_BORDER : 0u) | CERTIFIED);
  areas[id] = area / 8 * step * step;
  perimeters[id] = perimeter / 2 * step;
  vstore2(origin.xy + (convert_double2(at) + (base + moment / (3 * area)) / 2) * step, id, centroids);
}

CELL_KERNEL(cut, MEASURE_PARAMETERS) { EACH_CELL(measure_cell(&cell, &tree, site, MEASURE_ARGUMENTS)) }

#endif
