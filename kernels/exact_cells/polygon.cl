// A cell as a convex polygon, cut by one line after another. All is whole numbers: positions are in steps of the grid
// that the host rounds points to, at most 2^30 along a side, or 2^29 if the box is tilted. Seen from the site, in half
// steps, the bisector of a site that is (a, b) steps away is the line a x + b y = c with c = a^2 + b^2. So are the
// sides of the box. A cell is where a x + b y <= c for all its lines.
//
// A vertex is where two lines cross. Whether a third line cuts it off is the sign of a determinant, which is decided in
// doubles where their error leaves no doubt, else in 128 bits. To touch is not to cut: so no edge has the length 0.
//
// How large the numbers are: a site that may cut is at most R = 2^30.5 steps away, along the diagonal of the box or of
// half a period each way. |a|, |b| and the c of a side of the box are less than 2^31.5, c = a^2 + b^2 is at most 2^61,
// and of two lines a b' - a' b is at most |(a, b)| |(a', b')| <= 2^61. A determinant has three products of these two:
// less than 2^124. (The margins of the search add less than a thousandth.)
//
// In a tilted box cells begin with the bisectors of the images at +-u and +-v, two vectors that span the lattice, of
// which no sum is shorter: 2 |u.v| <= |u|^2 <= |v|^2. Such a vertex is at most |v| away, and |v| is at most sqrt(5) / 2
// of the longer side: so R is at most 2^30.2.

#ifndef VOROCL_EXACT_CELLS_POLYGON
#define VOROCL_EXACT_CELLS_POLYGON

#include "exact_cells/wide.cl"

// Where polygons lie: private for the many, global for those with more edges than that has room for.
#ifndef POLYGON_SPACE
#define POLYGON_SPACE private
#endif

#define NO_CELL 0xffffffffu  // behind a side of the box

// An edge of the polygon, and the vertex at its end, counter-clockwise where y points up.
typedef struct {
  long c;
  double x, y;          // the vertex, in half steps
  float rough_x, rough_y, reach;  // the same in steps; its squared distance with a margin; -1 of an unused edge
  int a, b;
  uint cell;            // behind the edge: a site
  int next, before;     // edges of the ring; of unused edges `next` makes a list
  int side;             // of the line that is being tried: -1 is inside, 0 on the line, 1 cut off
} edge_t;

typedef struct {
  POLYGON_SPACE edge_t* edges;
  int room;    // for edges
  int used;    // of these, with those that are unused again
  int unused;  // the first of them, or -1
  int first;   // an edge of the ring; -1: nothing is left
  float reach;  // the largest of the vertices
  bool is_full;
} polygon_t;

// a b' - a' b of two lines' directions.
static inline long cross_of(int a, int b, int other_a, int other_b) { return (long)a * other_b - (long)other_a * b; }

#define ROUGH_MARGIN 1.00001f  // floats make an error of less than a millionth in a squared distance

// c b - c' b', right but for 2^-51 of itself. A c of less than 2^53 is a double, and what it loses when it is
// multiplied is known; a greater one is of seeds that are far from each other, of which there are few.
static inline double difference(long c, int b, long other_c, int other_b) {
  const long most = 1L << 53;
  if (c > most || c < -most || other_c > most || other_c < -most)
    return to_double(sum(product(c, b), product(other_c, -(long)other_b)));
  const double p = convert_double(c), q = convert_double(b), r = convert_double(other_c), s = convert_double(other_b);
  const double rounded = r * s;
  return fma(p, q, -rounded) + fma(-r, s, rounded);
}

// Computes the vertex at the end of an edge. Both coordinates are right but for 2^-50 of themselves.
static inline void set_vertex(POLYGON_SPACE edge_t* edges, int k) {
  POLYGON_SPACE const edge_t* const p = edges + k;
  POLYGON_SPACE const edge_t* const q = edges + p->next;
  const double d = convert_double(cross_of(p->a, p->b, q->a, q->b));
  const double x = difference(p->c, q->b, q->c, p->b) / d, y = difference(q->c, p->a, p->c, q->a) / d;
  const float rough_x = convert_float(x) * 0.5f, rough_y = convert_float(y) * 0.5f;
  edges[k].x = x;
  edges[k].y = y;
  edges[k].rough_x = rough_x;
  edges[k].rough_y = rough_y;
  edges[k].reach = (rough_x * rough_x + rough_y * rough_y) * ROUGH_MARGIN;
}

// On which side of a line a vertex is, in whole numbers.
static inline int exact_side(POLYGON_SPACE const edge_t* edges, int k, int a, int b, long c) {
  const edge_t p = edges[k], q = edges[p.next];
  return -sign_of(sum(sum(product(p.c, cross_of(q.a, q.b, a, b)), product(q.c, cross_of(a, b, p.a, p.b))),
                      product(c, cross_of(p.a, p.b, q.a, q.b))));
}

static inline int side_of(POLYGON_SPACE const edge_t* edges, int k, int a, int b, long c) {
  const double ax = a * edges[k].x, by = b * edges[k].y, to = convert_double(c);
  const double over = ax + by - to;
  const double doubt = 0x1p-49 * (fabs(ax) + fabs(by) + fabs(to));
  if (!(fabs(over) > doubt)) return exact_side(edges, k, a, b, c);
  return (over > 0) * 2 - 1;  // without a branch, which processors would often guess wrong
}

static inline void find_reach(polygon_t* polygon) {
  float reach = 0;
  for (int k = 0; k < polygon->used; ++k) reach = max(reach, polygon->edges[k].reach);
  polygon->reach = reach;
}

static inline void set_line(POLYGON_SPACE edge_t* edge, int a, int b, long c, uint cell) {
  edge->a = a;
  edge->b = b;
  edge->c = c;
  edge->cell = cell;
}

// An edge that is not in the ring; -1 if there is no room.
static inline int new_edge(polygon_t* polygon) {
  if (polygon->unused >= 0) {
    const int k = polygon->unused;
    polygon->unused = polygon->edges[k].next;
    return k;
  }
  return polygon->used < polygon->room ? polygon->used++ : -1;
}

// Out of the ring: a vertex that no line cuts off and no site is near enough to.
static inline void discard_edge(polygon_t* polygon, int k) {
  POLYGON_SPACE edge_t* const edge = polygon->edges + k;
  edge->x = edge->y = 0;
  edge->rough_x = edge->rough_y = 0;
  edge->reach = -1;
  edge->next = polygon->unused;
  polygon->unused = k;
}

// Cuts off what lies beyond a line.
static inline void cut(polygon_t* polygon, int a, int b, uint cell) {
  POLYGON_SPACE edge_t* const edges = polygon->edges;
  const long c = (long)a * a + (long)b * b;
  int beyond = -1;
  for (int k = 0; k < polygon->used; ++k) {
    const int side = side_of(edges, k, a, b, c);
    edges[k].side = side;
    if (side > 0) beyond = k;
  }
  if (beyond < 0) return;
  // From the first to the last vertex that goes. Those on the line go with them, and new ones take their places.
  int first = beyond, last = beyond;
  while (edges[edges[first].before].side >= 0 && edges[first].before != beyond) first = edges[first].before;
  while (edges[edges[last].next].side >= 0 && edges[last].next != first) last = edges[last].next;
  if (edges[last].next == first) {
    polygon->first = -1;
    return;
  }
  const int after = edges[last].next;
  int made = last;
  if (first == last) {
    made = new_edge(polygon);
    if (made < 0) {
      polygon->is_full = true;
      return;
    }
  } else {
    for (int k = edges[first].next; k != last;) {
      const int next = edges[k].next;
      discard_edge(polygon, k);
      k = next;
    }
  }
  set_line(edges + made, a, b, c, cell);
  edges[first].next = made;
  edges[made].before = first;
  edges[made].next = after;
  edges[after].before = made;
  set_vertex(edges, first);
  set_vertex(edges, made);
  polygon->first = first;
  find_reach(polygon);
}

static inline long square_of(int2 vector) { return (long)vector.s0 * vector.s0 + (long)vector.s1 * vector.s1; }

// The box around a site, counter-clockwise from its lower side: `sides` says how far its left, lower, right and upper
// sides are. Where a vector of the lattice is given, u = lattice.s01 or v = lattice.s23, it ends at the bisectors with
// the site's own images there.
static inline void begin_polygon(polygon_t* polygon, int4 sides, int4 lattice, uint site) {
  POLYGON_SPACE edge_t* const edges = polygon->edges;
  const long square_u = square_of(lattice.s01), square_v = square_of(lattice.s23);
  const int2 u = square_u > 0 ? lattice.s01 : (int2)(1, 0), v = square_v > 0 ? lattice.s23 : (int2)(0, 1);
  const uint behind_u = square_u > 0 ? site : NO_CELL, behind_v = square_v > 0 ? site : NO_CELL;
  set_line(edges, -v.s0, -v.s1, square_v > 0 ? square_v : 2 * (long)sides.s1, behind_v);
  set_line(edges + 1, u.s0, u.s1, square_u > 0 ? square_u : 2 * (long)sides.s2, behind_u);
  set_line(edges + 2, v.s0, v.s1, square_v > 0 ? square_v : 2 * (long)sides.s3, behind_v);
  set_line(edges + 3, -u.s0, -u.s1, square_u > 0 ? square_u : 2 * (long)sides.s0, behind_u);
  for (int k = 0; k < 4; ++k) {
    edges[k].next = (k + 1) & 3;
    edges[k].before = (k + 3) & 3;
  }
  for (int k = 0; k < 4; ++k) set_vertex(edges, k);
  polygon->used = 4;
  polygon->unused = -1;
  polygon->first = 0;
  polygon->is_full = false;
  find_reach(polygon);
}

#endif
