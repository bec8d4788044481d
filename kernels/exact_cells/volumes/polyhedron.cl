// A cell as a convex polyhedron, cut by one plane after another. Positions are whole numbers of steps of the
// grid that the host rounds points to, at most 2^40 along a side, kept in doubles. Seen from the site, in
// half steps, the bisector of a site that is n away is the plane n.v = c with c = |n|^2, and with weights
// + the other's lag - the own one (see lanes.cl). So are the sides of the box. A cell is where n.v <= c for
// all its planes. A c is wrong by at most 2^-51 of |n|^2 and the lags' difference, which together are at most
// |c| and `slack`.
//
// A vertex is where three planes cross, always three (sides.cl says how ties are broken), with the three
// vertices at the other ends of its edges: a triangle of the dual. A plane is tried against eight vertices at
// once; 64 vertices give a word of bits. The edges from vertices that go to vertices that stay are the new
// ring: nothing is walked, as each plane begins one edge.

#ifndef VOROCL_EXACT_CELLS_POLYHEDRON
#define VOROCL_EXACT_CELLS_POLYHEDRON

#include "exact_cells/volumes/cell.cl"
#include "exact_cells/volumes/sides.cl"

// Which vertices of a word may have n.v > c, as bits, and which have for sure.
static inline ulong beyond(const cell_t* cell, int word, double3 n, double c, double slack, ulong8* sure) {
  const double norm = norm_of(n), doubt = 0x1p-50 * (fabs(c) + slack);
  ulong8 found = 0, certain = 0, bits = (ulong8)(1, 2, 4, 8, 16, 32, 64, 128);
  const int end = ONE_WORD ? cell->top : min(cell->top, word * 64 + 64);
  for (int k = word * 64; k < end; k += 8) {
    const double8 error = fma((double8)(norm), vload8(0, cell->error + k), (double8)(doubt));
    const double8 over =
        fma((double8)(n.x), vload8(0, cell->x + k),
            fma((double8)(n.y), vload8(0, cell->y + k), fma((double8)(n.z), vload8(0, cell->z + k), (double8)(-c))));
    found |= as_ulong8(~(over <= -error)) & bits;
    certain |= as_ulong8(over > error) & bits;
    bits <<= 8;
  }
  *sure = certain;
  return or_of(found) & cell->alive[word];
}

// Beyond which squared distance, in steps, no site cuts the cell: half steps, squared, are four steps.
static inline float end_of(const cell_t* cell) {
  double8 most = 0;
  for (int k = 0; k < cell->top; k += 8) {
    const double8 x = vload8(0, cell->x + k), y = vload8(0, cell->y + k), z = vload8(0, cell->z + k);
    most = fmax(most, fma(x, x, fma(y, y, z * z)));  // of those that are gone too: they are 0
  }
  return convert_float(greatest_of(most)) * 1.0001f;
}

// Vertices as the search takes them, in steps, and their squared distances, with a margin.
static inline int vertices_of(const cell_t* cell) { return cell->top; }
static inline float3 vertex_of(const cell_t* cell, int k, float* reach) {
  const float3 v = 0.5f * convert_float3((double3)(cell->x[k], cell->y[k], cell->z[k]));
  *reach = (v.x * v.x + v.y * v.y + v.z * v.z) * 1.00001f;
  return v;
}

static inline void transpose(const cell_t* cell, CELL_SPACE const index_t* p, double8* x, double8* y, double8* z,
                             double8* c) {
  CELL_SPACE const double4* const planes = cell->planes;
  const double8 ab = (double8)(planes[p[0]], planes[p[1]]), cd = (double8)(planes[p[2]], planes[p[3]]);
  const double8 ef = (double8)(planes[p[4]], planes[p[5]]), gh = (double8)(planes[p[6]], planes[p[7]]);
  *x = (double8)(ab.s04, cd.s04, ef.s04, gh.s04);
  *y = (double8)(ab.s15, cd.s15, ef.s15, gh.s15);
  *z = (double8)(ab.s26, cd.s26, ef.s26, gh.s26);
  *c = (double8)(ab.s37, cd.s37, ef.s37, gh.s37);
}

static inline void scatter(double8 v, CELL_SPACE double* to, CELL_SPACE const index_t* slots) {
  to[slots[0]] = v.s0;
  to[slots[1]] = v.s1;
  to[slots[2]] = v.s2;
  to[slots[3]] = v.s3;
  to[slots[4]] = v.s4;
  to[slots[5]] = v.s5;
  to[slots[6]] = v.s6;
  to[slots[7]] = v.s7;
}

// Eight vertices of the new ring, from edge i on, by Cramer's rule, and by how much they may be wrong: each
// product of three factors, and the determinant d, by less than 2^-50 of the products' sizes.
static inline void place_vertices(cell_t* cell, int i, double4 n) {
  CELL_SPACE const index_t* const slots = cell->slots + i;
  double8 ax, ay, az, ac, bx, by, bz, bc;
  transpose(cell, cell->ring_p + i, &ax, &ay, &az, &ac);
  transpose(cell, cell->ring_q + i, &bx, &by, &bz, &bc);
  const double8 mx = ay * bz - az * by, my = az * bx - ax * bz, mz = ax * by - ay * bx;
  const double8 d = n.x * mx + n.y * my + n.z * mz;
  const double8 ux = ac * bx - bc * ax, uy = ac * by - bc * ay, uz = ac * bz - bc * az;
  const double8 one = 1 / d;
  const double8 x = (n.w * mx + (uy * n.z - uz * n.y)) * one;
  const double8 y = (n.w * my + (uz * n.x - ux * n.z)) * one;
  const double8 z = (n.w * mz + (ux * n.y - uy * n.x)) * one;
  const double8 a = fabs(ax) + fabs(ay) + fabs(az), b = fabs(bx) + fabs(by) + fabs(bz);
  const double g = norm_of(n.xyz);
  const double8 far = fabs(x) + fabs(y) + fabs(z);
  const double slack = cell->slack;
  const double8 sizes = g * ((fabs(ac) + slack) * b + (fabs(bc) + slack) * a) + (fabs(n.w) + slack + far * g) * (a * b);
  const double8 error = fma((double8)0x1p-48, sizes * fabs(one), 0x1p-50 * far);
  scatter(x, cell->x, slots);
  scatter(y, cell->y, slots);
  scatter(z, cell->z, slots);
  scatter(error, cell->error, slots);
  if (or_of(as_ulong8(~(error <= 0x1p-36 * (far + g)))) == 0) return;
  for (int k = 0; k < 8; ++k) {
    const int v = slots[k];
    const double size = fabs(cell->x[v]) + fabs(cell->y[v]) + fabs(cell->z[v]) + g;
    if (!(cell->error[v] <= 0x1p-36 * size)) place_exactly(cell, v);
  }
}

// Forgets planes that no vertex has.
static inline void forget_planes(cell_t* cell) {
  for (int p = 0; p < cell->count; ++p) cell->at[p] = 0;
  EACH_VERTEX(v, cell->alive) {
    const indices_t t = cell->triples[v];
    cell->at[t.s0] = cell->at[t.s1] = cell->at[t.s2] = 1;
  }
  int kept = 0;
  for (int p = 0; p < cell->count; ++p) {
    if (cell->at[p] == 0) continue;
    cell->planes[kept] = cell->planes[p];
    cell->sites[kept] = cell->sites[p];
    cell->images[kept] = cell->images[p];
    cell->at[p] = (index_t)kept++;
  }
  EACH_VERTEX(v, cell->alive) {
    CELL_SPACE indices_t* const t = &cell->triples[v];
    *t = (indices_t)(cell->at[t->s0], cell->at[t->s1], cell->at[t->s2], 0);
  }
  cell->count = kept;
}

// Leaves nothing: the cell is empty, has no room (`is_full`) or is `is_broken`.
static inline bool end_cell(cell_t* cell) {
  for (int w = 0; w < WORDS; ++w) cell->alive[w] = 0;
  cell->top = 0;
  return true;
}

// Whether the edges are one ring. Uses `at`.
static inline bool is_ring(cell_t* cell, int edges) {
  for (int i = 0; i < edges; ++i) cell->at[cell->ring_q[i]] = (index_t)~0u;
  for (int i = 0; i < edges; ++i) cell->at[cell->ring_p[i]] = (index_t)i;
  int i = 0, length = 0;
  do {
    i = (int)cell->at[cell->ring_q[i]];
    ++length;
  } while (i > 0 && i < edges && length < edges);
  return i == 0 && length == edges;
}

// Lists the edges from vertices that go to vertices that stay. Returns how many.
static inline int list_ring(cell_t* cell) {
  int edges = 0;
  EACH_VERTEX(v, cell->gone) {
    const indices_t t = cell->triples[v], to = cell->neighbours[v];
#define LIST_EDGE(p, q, vertex) \
  cell->ring_p[edges] = p;      \
  cell->ring_q[edges] = q;      \
  cell->stays[edges] = vertex;  \
  edges += (int)(~(cell->gone[ONE_WORD ? 0 : vertex >> 6] >> (vertex & 63)) & 1);
    LIST_EDGE(t.s0, t.s1, to.s0)
    LIST_EDGE(t.s1, t.s2, to.s1)
    LIST_EDGE(t.s2, t.s0, to.s2)
    edges = min(edges, ROOM + 8);
  }
  return edges;
}

// Finds places for the new vertices, and clears those of vertices that are gone.
static inline void find_slots(cell_t* cell, int edges) {
  int word = 0;
  ulong empty = ~cell->alive[0];
  for (int i = 0; i < edges; ++i) {
    while (!ONE_WORD && empty == 0) {
      cell->alive[word] = ~0UL;
      empty = ~cell->alive[++word];
    }
    const int slot = word * 64 + LOWEST_BIT(empty);
    empty &= empty - 1;
    cell->slots[i] = (index_t)slot;
  }
  cell->alive[word] = ~empty;
  for (int w = 0; w < WORDS; ++w) {
    if (ONE_WORD || cell->alive[w] != 0) cell->top = w * 64 + 64 - (int)clz(cell->alive[w]);
  }
  EACH_VERTEX(v, cell->gone) { cell->x[v] = cell->y[v] = cell->z[v] = cell->error[v] = 0; }
}

// Whether none of the vertices that are `unsure` is beyond a plane, as of many planes in lattices. Such a plane has no
// face, unless weights put it where another one is.
static inline bool only_touches(const cell_t* cell, double4 plane, uint site) {
  if (cell->lags != 0) return false;
  EACH_VERTEX(v, cell->unsure) {
    if (side_of(cell, v, plane, site, true) > 0) return false;
  }
  return true;
}

// Cuts off what lies beyond the bisector of a site that is n away. Returns whether that is anything.
static inline bool cut(cell_t* cell, double3 n, uint site, int image) {
  const double more = lag_of(cell->lags, site) - cell->lag, slack = 2 * fabs(more);
  const double c = n.x * n.x + n.y * n.y + n.z * n.z + more;
  ulong any = 0, sure = 0;
  for (int w = 0; w < WORDS; ++w) {
    ulong8 certain;
    const ulong may = beyond(cell, w, n, c, slack, &certain);
    cell->gone[w] = may == 0 ? 0 : or_of(certain) & may;
    cell->unsure[w] = may & ~cell->gone[w];
    any |= may;
    sure |= cell->gone[w];
    cell->is_doubtful |= cell->unsure[w] != 0;
  }
  if (any == 0 || (sure == 0 && only_touches(cell, (double4)(n, c), site))) return false;
  if (cell->count == MOST_PLANES) forget_planes(cell);
  any = 0;
  int kept = 0;
  for (int w = 0; w < WORDS; ++w) {
    for (ulong left = cell->unsure[w]; left != 0; left &= left - 1) {
      const int k = LOWEST_BIT(left);
      if (side_of(cell, w * 64 + k, (double4)(n, c), site, false) > 0) cell->gone[w] |= 1UL << k;
    }
    any |= cell->gone[w];
    kept += (int)popcount(cell->alive[w] & ~cell->gone[w]);
  }
  if (any == 0) return false;
  const int edges = list_ring(cell);
  for (int w = 0; w < WORDS; ++w) cell->alive[w] &= ~cell->gone[w];
  if (edges < 3) cell->is_broken |= edges > 0 || kept > 0;
  if (edges > ROOM - kept || cell->count == MOST_PLANES) cell->is_full = edges >= 3;
  if (edges < 3 || cell->is_full) return end_cell(cell);
  cell->slack = fmax(cell->slack, slack);
  const int plane = cell->count++;
  cell->planes[plane] = (double4)(n, c);
  cell->sites[plane] = site;
  cell->images[plane] = (ushort)image;
  find_slots(cell, edges);
  if (cell->is_doubtful && !is_ring(cell, edges)) {
    cell->is_broken = true;
    return end_cell(cell);
  }
  for (int i = 0; i < edges; ++i) {
    cell->at[cell->ring_p[i]] = cell->slots[i];
    cell->before[cell->ring_q[i]] = cell->slots[i];
  }
  for (int i = 0; i < edges; ++i) {
    const index_t p = cell->ring_p[i], q = cell->ring_q[i], slot = cell->slots[i], stays = cell->stays[i];
    cell->triples[slot] = (indices_t)(p, q, (index_t)plane, 0);
    cell->neighbours[slot] = (indices_t)(stays, cell->at[q], cell->before[p], 0);
    const indices_t t = cell->triples[stays];
    const int side = t.s0 == q ? 0 : t.s1 == q ? 1 : 2;
    ((CELL_SPACE index_t*)&cell->neighbours[stays])[side] = slot;
  }
  for (int i = edges; (i & 7) != 0; ++i) {
    cell->ring_p[i] = cell->ring_p[0];
    cell->ring_q[i] = cell->ring_q[0];
    cell->slots[i] = cell->slots[0];
  }
  for (int i = 0; i < edges; i += 8) place_vertices(cell, i, (double4)(n, c));
  return true;
}

// Begins a cell as a box around its site: plane 2 k and the next one are its ends along axis k, whose `sides` are so
// far away, in half steps. They are as long as those of sites, so that `slack` does no more to them.
static inline void begin_cell(cell_t* cell, const tree_t* tree, double3 at, uint site) {
  const double sides[6] = {FIRST_SIDES(tree, at, x), FIRST_SIDES(tree, at, y), FIRST_SIDES(tree, at, z)};
  for (int k = 0; k < ROOM; k += 8) {
    vstore8((double8)0, 0, cell->x + k);
    vstore8((double8)0, 0, cell->y + k);
    vstore8((double8)0, 0, cell->z + k);
    vstore8((double8)0, 0, cell->error + k);
  }
  for (int w = 0; w < WORDS; ++w) cell->alive[w] = 0;
  cell->alive[0] = 0xff;
  cell->top = 8;
  cell->site = site;
  cell->lags = tree->lags;
  cell->lag = lag_of(tree->lags, site);
  cell->slack = 0;
  cell->count = 6;
  cell->is_full = cell->is_broken = cell->is_doubtful = false;
  for (int p = 0; p < 6; ++p) {
    const double way = (p & 1) != 0 ? WALL : -WALL;
    cell->planes[p] = (double4)(p < 2 ? way : 0, p / 2 == 1 ? way : 0, p > 3 ? way : 0, way * sides[p]);
    cell->sites[p] = NO_CELL;
    cell->images[p] = 0;
  }
  for (int v = 0; v < 8; ++v) {
    const int i = v & 1, j = v >> 1 & 1, k = v >> 2;
    cell->x[v] = sides[i];
    cell->y[v] = sides[2 + j];
    cell->z[v] = sides[4 + k];
    cell->error[v] = 0x1p-50 * (fabs(cell->x[v]) + fabs(cell->y[v]) + fabs(cell->z[v]));
    const bool is_odd = ((i + j + k) & 1) == 1;  // mirrored
    const index_t px = (index_t)i, py = (index_t)(2 + j), pz = (index_t)(4 + k);
    const index_t along_x = (index_t)(v ^ 1), along_y = (index_t)(v ^ 2), along_z = (index_t)(v ^ 4);
    cell->triples[v] = is_odd ? (indices_t)(px, py, pz, 0) : (indices_t)(py, px, pz, 0);
    cell->neighbours[v] =
        is_odd ? (indices_t)(along_z, along_x, along_y, 0) : (indices_t)(along_z, along_y, along_x, 0);
  }
}

#endif
