// What is measured of a polyhedron, and its faces, as they are found; and its outline.

#ifndef VOROCL_EXACT_CELLS_VOLUME_MEASURE
#define VOROCL_EXACT_CELLS_VOLUME_MEASURE

#define FOUND_EDGE uint4

#include "exact_cells/volumes/near.cl"
#include "exact_cells/search.cl"

#include "exact_cells/each_cell.cl"
#include "exact_cells/found.cl"

// Lists the edges of a cell, each once: two vertices, and the planes on both sides. Returns how many. And
// says that planes with vertices have corners.
static inline int list_edges(cell_t* cell) {
  int edges = 0;
  for (int p = 0; p < cell->count; ++p) cell->corners[p] = 0;
  EACH_VERTEX(v, cell->alive) {
    const indices_t t = cell->triples[v], to = cell->neighbours[v];
    cell->corners[t.s0] = cell->corners[t.s1] = cell->corners[t.s2] = 3;
    cell->edges[edges] = (indices_t)((index_t)v, to.s0, t.s0, t.s1);
    edges += to.s0 > v;
    cell->edges[edges] = (indices_t)((index_t)v, to.s1, t.s1, t.s2);
    edges += to.s1 > v;
    cell->edges[edges] = (indices_t)((index_t)v, to.s2, t.s2, t.s0);
    edges += to.s2 > v;
  }
  return edges;
}

// Whether an edge has no length: ties were broken between its ends.
static inline bool is_point(const cell_t* cell, indices_t edge) {
  const indices_t t = cell->triples[edge.s1];
  const int p = t.s0 != edge.s2 && t.s0 != edge.s3 ? t.s0 : t.s1 != edge.s2 && t.s1 != edge.s3 ? t.s1 : t.s2;
  const double4 plane = cell->planes[p];
  const int v = edge.s0;
  const double over = plane.x * cell->x[v] + plane.y * cell->y[v] + plane.z * cell->z[v] - plane.w;
  if (fabs(over) > norm_of(plane.xyz) * cell->error[v] + 0x1p-50 * fabs(plane.w)) return false;
  return side_of(cell, v, plane, cell->sites[p], true) == 0;
}

// Counts the corners of each face. One with fewer than three has no area, which only ties make.
static inline void count_corners(cell_t* cell, int edges) {
  for (int p = 0; p < cell->count; ++p) cell->corners[p] = 0;
  for (int i = 0; i < edges; ++i) {
    const indices_t edge = cell->edges[i];
    if (cell->is_doubtful && is_point(cell, edge)) continue;
    ++cell->corners[edge.s2];
    ++cell->corners[edge.s3];
  }
}

// Where ties were broken, and with weights, planes that are almost parallel may cross: their vertices are computed from
// whole numbers.
static inline void place_rough(cell_t* cell) {
  EACH_VERTEX(v, cell->alive) {
    const double far = norm_of((double3)(cell->x[v], cell->y[v], cell->z[v]));
    if (!(cell->error[v] <= 0x1p-42 * far)) place_exactly(cell, v);
  }
}

// Lists the edges of a cell that has been cut. Returns how many.
static inline int finish_cell(cell_t* cell) {
  const int edges = list_edges(cell);
  if (cell->is_doubtful || cell->lags != 0) place_rough(cell);
  if (cell->is_doubtful) count_corners(cell, edges);
  return edges;
}

// An edge between u and v gives n.(u x v) to the faces on both sides: areas, volume and centroid. Sums are
// taken in half steps from the site, or with weights, which may put a cell far from its site, from a vertex:
// where they lose least.
static inline void measure_cell(cell_t* cell, const tree_t* tree, uint site, MEASURE_PARAMETERS,
                                global uint* counters) {
  const uint id = ids[site];
  const int edges = finish_cell(cell);
  double3 base = 0;
  for (int w = 0; w < WORDS && cell->lags != 0; ++w) {
    const int v = w * 64 + LOWEST_BIT(cell->alive[w]);
    if (cell->alive[w] != 0) base = (double3)(cell->x[v], cell->y[v], cell->z[v]);
  }
  for (int p = 0; p < cell->count; ++p) {
    const double4 plane = cell->planes[p];
    const double square = plane.x * plane.x + plane.y * plane.y + plane.z * plane.z;
    cell->sums[p] = 0;
    cell->scales[p] = (plane.w - (plane.x * base.x + plane.y * base.y + plane.z * base.z)) / square;  // c / |n|^2
  }
  double3 moment = 0;
  for (int i = 0; i < edges; ++i) {
    const indices_t edge = cell->edges[i];
    const int v = edge.s0, u = edge.s1, p = edge.s2, q = edge.s3;
    const double vx = cell->x[v] - base.x, vy = cell->y[v] - base.y, vz = cell->z[v] - base.z;
    const double ux = cell->x[u] - base.x, uy = cell->y[u] - base.y, uz = cell->z[u] - base.z;
    const double x = vy * uz - vz * uy, y = vz * ux - vx * uz, z = vx * uy - vy * ux;
    const double4 of_p = cell->planes[p], of_q = cell->planes[q];
    const double part_p = -(of_p.x * x + of_p.y * y + of_p.z * z), part_q = of_q.x * x + of_q.y * y + of_q.z * z;
    cell->sums[p] += part_p;
    cell->sums[q] += part_q;
    const double share = cell->scales[p] * part_p + cell->scales[q] * part_q;
    moment += share * (double3)(vx + ux, vy + uy, vz + uz);
  }
  uint faces = 0, touching = 0;
  for (int p = 0; p < cell->count; ++p) faces += cell->corners[p] > 2;
  const uint begin = atomic_add(counters, faces);
  double volume = 0, surface = 0;
  for (int p = 0, face = 0; p < cell->count; ++p) {
    if (cell->corners[p] < 3) continue;
    const double3 n = cell->planes[p].xyz;
    const double part = cell->scales[p] * cell->sums[p];
    const double exactly = cell->sums[p] / sqrt(n.x * n.x + n.y * n.y + n.z * n.z) / 8 * step * step;
    const double area = fmax(exactly, DBL_MIN);  // a tiny one may be lost to rounding
    volume += part;
    moment += part * cell->scales[p] * n;
    surface += area;
    touching += cell->sites[p] == NO_CELL;
    if (begin + faces <= room_for_edges) {
      const uint other = cell->sites[p] == NO_CELL ? NO_CELL : ids[cell->sites[p]];
      const uint2 words = as_uint2(area);
      found[begin + (uint)face] = (uint4)(other, (uint)cell->images[p], words.s0, words.s1);
    }
    ++face;
  }
  begins[site] = begin;
  edge_counts[id] = faces;
  neighbours[id] = faces - touching;
  flags[id] = (uchar)((touching > 0 ? TOUCHES_BORDER : 0u) | (cell->is_broken ? 0u : CERTIFIED));
  areas[id] = volume / 48 * step * step * step;
  perimeters[id] = surface;
  const double3 centroid =
      faces == 0 ? (double3)NAN : origin.xyz + (site_at(tree, site) + (base + moment / (4 * volume)) / 2) * step;
  vstore3(centroid, id, centroids);
}

// The corners of each face, counter-clockwise as seen from outside, and the vertices, in the units of the
// data; those at one place are one. A polyhedron with F faces has at most 2 F - 4 vertices, and 6 F - 12
// corners: so those of a cell begin at 2 and 6 times its offset.
#define OUTLINE_PARAMETERS                                                                                  \
  global const uint *ids, double4 origin, double step, global const uint *offsets, global double *vertices, \
      global uint *vertex_counts, global uint *corner_counts, global uint *corners
#define OUTLINE_ARGUMENTS ids, origin, step, offsets, vertices, vertex_counts, corner_counts, corners

static inline void outline_cell(cell_t* cell, const tree_t* tree, uint site, OUTLINE_PARAMETERS) {
  const uint id = ids[site], offset = offsets[id];
  const int edges = finish_cell(cell);
  // Vertices at one place get the number of one: `slots` of the least of those that edges without length
  // join.
  CELL_SPACE index_t* const numbers = cell->slots;
  for (int v = 0; v < cell->top; ++v) numbers[v] = (index_t)v;
  for (bool is_changed = cell->is_doubtful; is_changed;) {
    is_changed = false;
    for (int i = 0; i < edges; ++i) {
      const indices_t edge = cell->edges[i];
      const index_t least = min(numbers[edge.s0], numbers[edge.s1]);
      if (numbers[edge.s0] == numbers[edge.s1] || !is_point(cell, edge)) continue;
      numbers[edge.s0] = numbers[edge.s1] = least;
      is_changed = true;
    }
  }
  const double3 at = site_at(tree, site);
  uint vertex_count = 0;
  EACH_VERTEX(v, cell->alive) {
    const indices_t t = cell->triples[v];
    cell->at[t.s0] = cell->at[t.s1] = cell->at[t.s2] = (index_t)v;
    if (numbers[v] != v) {
      cell->stays[v] = cell->stays[numbers[v]];  // a lesser vertex
      continue;
    }
    cell->stays[v] = (index_t)vertex_count;
    const double3 from_site = (double3)(cell->x[v], cell->y[v], cell->z[v]) / 2;
    vstore3(origin.xyz + (at + from_site) * step, 2 * (size_t)offset + vertex_count++, vertices);
  }
  vertex_counts[id] = vertex_count;
  uint face = offset;
  size_t corner = 6 * (size_t)offset;
  for (int p = 0; p < cell->count; ++p) {
    if (cell->corners[p] < 3) continue;
    const size_t first = corner;
    int v = cell->at[p];
    do {
      const indices_t t = cell->triples[v], to = cell->neighbours[v];
      const int next = t.s0 == p ? to.s2 : t.s1 == p ? to.s0 : to.s1;
      if (cell->stays[next] != cell->stays[v]) corners[corner++] = (uint)cell->stays[next];
      v = next;
    } while (v != cell->at[p]);
    corner_counts[face++] = (uint)(corner - first);
  }
}

CELL_KERNEL(cut, MEASURE_PARAMETERS) { EACH_CELL(measure_cell(&cell, &tree, site, MEASURE_ARGUMENTS)) }

CELL_KERNEL(outline, OUTLINE_PARAMETERS) { EACH_CELL(outline_cell(&cell, &tree, site, OUTLINE_ARGUMENTS)) }

#endif
