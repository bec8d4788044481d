// What is measured of a cell, and its edges, as they are found.

#ifndef VOROCL_EXACT_CELLS_MEASURE
#define VOROCL_EXACT_CELLS_MEASURE

#include "exact_cells/search.cl"

#define TOUCHES_BORDER 1u
#define CERTIFIED 2u

// Which sites there are, what they are called in the caller's list, and the rectangle: left, lower, right and upper
// sides, in steps; the periods along x and y, 0 along an axis without, and how far the images above are shifted in x;
// two short vectors of that lattice, or zeros; and where step 0 is, and how long one, in the units of the data.
#define SITE_PARAMETERS \
  uint count, global const int *sites, global const int *boxes, \
      global const uint *levels, int top, global const uint *ids, int4 rectangle, int4 periods, \
      int4 lattice, double2 origin, double step

// By the caller's ids. `begins` is by site: where its edges lie among the found ones, which come in the order in which
// cells are done. `counters`: the edges found; the cells in the queue of those with more edges than there is room for.
#define MEASURE_PARAMETERS \
  global double *areas, global double2 *centroids, global double *perimeters, \
      global uint *edge_counts, global uint *neighbours, global uchar *flags, \
      global uint *begins, global uint *found_cells, global double2 *found_vertices, \
      uint room_for_edges, global uint *counters, global uint *queue

#define SITE_ARGUMENTS count, sites, boxes, levels, top, ids, rectangle, periods, lattice, origin, step
#define MEASURE_ARGUMENTS \
  areas, centroids, perimeters, edge_counts, neighbours, flags, begins, found_cells, found_vertices, room_for_edges, \
      counters, queue

static inline int2 site_at(global const int* sites, uint site) {
  const size_t at = (size_t)(site >> FAN_BITS) * (2 * FAN) + (site & (FAN - 1));
  return (int2)(sites[at], sites[at + FAN]);
}

// Sums are taken in half steps from the site, where they lose least.
static inline void measure_cell(SITE_PARAMETERS, MEASURE_PARAMETERS, uint site, POLYGON_SPACE edge_t* edges, int room) {
  const tree_t tree = {sites, boxes, levels, count, top};
  const int2 at = site_at(sites, site);
  polygon_t polygon;
  polygon.edges = edges;
  polygon.room = room;
  begin_polygon(&polygon, (int4)(at - rectangle.s01, rectangle.s23 - at), lattice, site);
  cut_by_all(&polygon, &tree, site, at, rectangle, periods);
  if (polygon.is_full) {
    queue[atomic_inc(counters + 1)] = site;
    return;
  }
  const uint id = ids[site];
  uint edge_count = 0, touching = 0;
  if (polygon.first >= 0) {
    int k = polygon.first;
    do {
      ++edge_count;
      touching += edges[k].cell == NO_CELL ? 1u : 0u;
      k = edges[k].next;
    } while (k != polygon.first);
  }
  const uint begin = atomic_add(counters, edge_count);
  begins[site] = begin;
  edge_counts[id] = edge_count;
  neighbours[id] = edge_count - touching;
  flags[id] = (uchar)((touching > 0 ? TOUCHES_BORDER : 0u) | CERTIFIED);
  if (edge_count == 0 || begin + edge_count > room_for_edges) return;
  double area = 0, perimeter = 0;
  double2 moment = 0;
  int k = polygon.first;
  double2 from = (double2)(edges[edges[k].before].x, edges[edges[k].before].y);
  for (uint i = 0; i < edge_count; ++i) {
    const double2 to = (double2)(edges[k].x, edges[k].y), way = to - from;
    const double part = from.s0 * to.s1 - to.s0 * from.s1;
    area += part;
    moment += part * (from + to);
    perimeter += sqrt(way.s0 * way.s0 + way.s1 * way.s1);
    found_vertices[begin + i] = from;
    found_cells[begin + i] = edges[k].cell;
    from = to;
    k = edges[k].next;
  }
  areas[id] = area / 8 * step * step;
  perimeters[id] = perimeter / 2 * step;
  centroids[id] = origin + (convert_double2(at) + moment / (3 * area) / 2) * step;
}

#endif
