// What a polyhedron holds, in private memory or, as LARGE_CELLS, in global memory.

#ifndef VOROCL_EXACT_CELLS_CELL
#define VOROCL_EXACT_CELLS_CELL

#define DIMENSIONS 3
#define CELL_VECTOR double8
#define CELL_BYTES POLYHEDRON_BYTES
#define PRIVATE_ROOM 64  // for vertices; in global memory a multiple

#include "exact_cells/lanes.cl"
#include "exact_cells/wide.cl"

#ifdef LARGE_CELLS
#define MOST_PLANES ROOM
typedef int index_t;
typedef int4 indices_t;
#else
#define MOST_PLANES 250  // that ever cut a cell: those without a vertex are forgotten when it is full
typedef uchar index_t;
typedef uchar4 indices_t;
#endif
#define WORDS (ROOM / 64)
#define ONE_WORD (sizeof(index_t) == 1)  // as the compiler knows

#define MOST_NEAR 112  // of uniform points there are some 76

// The sites of near leaves, as seen from the leaf's first one.
#define NEAR_LISTS                                                     \
  float x[MOST_NEAR * FAN], y[MOST_NEAR * FAN], z[MOST_NEAR * FAN];    \
  double exact_x[MOST_NEAR * FAN], exact_y[MOST_NEAR * FAN], exact_z[MOST_NEAR * FAN];

// The lists of a cell, POLYHEDRON_BYTES of sizes.cl in all: planes (n and c), with the site behind each and its
// image; the planes p0, p1, p2 of each vertex, and the vertices at the other ends of the edges between p0 and
// p1, p1 and p2, p2 and p0; the vertices, in half steps, and how wrong they may be. Then scratch: of the ring
// that is cut, its edges between planes, the vertices they go to and the places of the new ones; the new
// vertices whose first, and second, plane this is; and what measure.cl finds of planes and edges.
#define CELL_LISTS(LIST)                   \
  LIST(double4, planes, MOST_PLANES)       \
  LIST(indices_t, triples, ROOM)           \
  LIST(indices_t, neighbours, ROOM)        \
  LIST(indices_t, edges, 3 * ROOM / 2 + 4) \
  LIST(double, x, ROOM)                    \
  LIST(double, y, ROOM)                    \
  LIST(double, z, ROOM)                    \
  LIST(double, error, ROOM)                \
  LIST(double, scales, MOST_PLANES)        \
  LIST(double, sums, MOST_PLANES)          \
  LIST(ulong, alive, WORDS)                \
  LIST(ulong, gone, WORDS)                 \
  LIST(ulong, unsure, WORDS)               \
  LIST(uint, sites, MOST_PLANES)           \
  LIST(ushort, images, MOST_PLANES)        \
  LIST(index_t, ring_p, ROOM + 16)         \
  LIST(index_t, ring_q, ROOM + 16)         \
  LIST(index_t, stays, ROOM + 16)          \
  LIST(index_t, slots, ROOM + 16)          \
  LIST(index_t, at, MOST_PLANES)           \
  LIST(index_t, before, MOST_PLANES)       \
  LIST(index_t, corners, MOST_PLANES)

typedef struct {
  CELL_LISTS(DECLARED_LIST)
  int room;
  int top, count;             // vertices lie before top; planes
  uint site;                  // whose cell this is
  global const double* lags;  // of sites; null without weights
  double lag;                 // of the site
  double slack;               // by how much, twice, lags differ from that of a site behind a plane
  bool is_full, is_broken, is_doubtful;
} __attribute__((aligned(64))) cell_t;

// Goes through the vertices of which words have the bits: `v` is each of them, in order.
#define EACH_VERTEX(v, words)        \
  for (int w = 0, v; w < WORDS; ++w) \
    for (ulong left = (words)[w]; v = w * 64 + LOWEST_BIT(left), left != 0; left &= left - 1)

static inline double norm_of(double3 n) { return fabs(n.x) + fabs(n.y) + fabs(n.z); }

#endif
