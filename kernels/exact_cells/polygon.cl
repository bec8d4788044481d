// A cell as a convex polygon, cut by one line after another. All is whole numbers: positions are in steps of
// the grid that the host rounds points to, at most 2^30 along a side, or 2^29 if the box is tilted. Seen from
// the site, in half steps, the bisector of a site that is (a, b) steps away is the line a x + b y = c with c
// = a^2 + b^2. So are the sides of the box. A cell is where a x + b y <= c for all its lines.
//
// A vertex is where two lines cross. Whether a third line cuts it off is the sign of a determinant, which is
// decided in doubles where their error leaves no doubt, else in 128 bits. To touch is not to cut: so no edge
// has the length 0.
//
// How large the numbers are: a site that may cut is at most R = 2^30.5 steps away, along the diagonal of the
// box or of half a period each way. |a|, |b| and the c of a side of the box are less than 2^31.5, a^2 + b^2
// is at most 2^61, and of two lines a b' - a' b is at most |(a, b)| |(a', b')| <= 2^61. A determinant has
// three products of this and a c: less than 2^124. With weights c = a^2 + b^2 + the other's lag - the own one
// (see lanes.cl), and a lag is at most 2^62, beyond which a cell is empty: |c| is at most 2^62.6, and a
// determinant less than 2^126. (The margins of the search add less than a thousandth.)
//
// In a tilted box a cell begins as a square with half of the box's diagonal each way, which is at most 2^28.5 steps:
// its vertices are at most 2^29 away, and so R is at most 2^30.

#if !defined(VOROCL_EXACT_CELLS_POLYGON) && DIMENSIONS != 3  // whose cells are volumes/polyhedron.cl's
#define VOROCL_EXACT_CELLS_POLYGON

#define DIMENSIONS 2

#include "exact_cells/lanes.cl"
#include "exact_cells/wide.cl"

#define CELL_VECTOR float8
#define CELL_BYTES POLYGON_BYTES
#define PRIVATE_ROOM 24  // for edges: cells of random points have 6 in the mean, and one in 10^10 as many as 20
#define LANES 8          // vertices that a line is tried against at once

#define MOST_NEAR 24  // of uniform points there are some 16

// The boxes of near leaves, as seen from the leaf's first site, and the least lag in each.
#define NEAR_LISTS                                                           \
  int left[MOST_NEAR], right[MOST_NEAR], lower[MOST_NEAR], upper[MOST_NEAR]; \
  double lags[MOST_NEAR];

// A line a x + b y = c, with the site behind it. `image` says which of its images, or which side of the box this is.
typedef struct {
  long c;
  int a, b;
  uint site;
  int image;
} line_t;

// A ring of edges, counter-clockwise where y points up, as lists, POLYGON_BYTES of sizes.cl in all: vertices in half
// steps; lines; vertices in steps, and their squared distances, with a margin. Vertex k is where edge k ends, and edge
// k + 1 begins. Behind the last one come vertices that are the site itself, which do not count.
#define CELL_LISTS(LIST)              \
  LIST(double, x, ROOM + LANES)       \
  LIST(double, y, ROOM + LANES)       \
  LIST(long, c, ROOM + LANES)         \
  LIST(int, a, ROOM + LANES)          \
  LIST(int, b, ROOM + LANES)          \
  LIST(uint, sites, ROOM + LANES)     \
  LIST(int, images, ROOM + LANES)     \
  LIST(float, rough_x, ROOM + LANES)  \
  LIST(float, rough_y, ROOM + LANES)  \
  LIST(float, reaches, ROOM + LANES)

typedef struct {
  CELL_LISTS(DECLARED_LIST)
  int room, size;  // in edges
  global const double* lags;  // of sites; null without weights
  double lag;      // of the site
  float reach;     // the largest; 0 if nothing is left to be cut
  bool is_full;
} cell_t;

static inline line_t line_of(const cell_t* cell, int k) {
  const line_t line = {cell->c[k], cell->a[k], cell->b[k], cell->sites[k], cell->images[k]};
  return line;
}

static inline void set_line(cell_t* cell, int k, line_t line) {
  cell->c[k] = line.c;
  cell->a[k] = line.a;
  cell->b[k] = line.b;
  cell->sites[k] = line.site;
  cell->images[k] = line.image;
}

// a b' - a' b of two lines' directions.
static inline long cross_of(line_t p, line_t q) { return (long)p.a * q.b - (long)q.a * p.b; }

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

// Where two lines cross. Both coordinates are right but for 2^-50 of themselves.
static inline double2 crossing(line_t p, line_t q) {
  const double d = convert_double(cross_of(p, q));
  return (double2)(difference(p.c, q.b, q.c, p.b) / d, difference(q.c, p.a, p.c, q.a) / d);
}

// Where a line crosses the one before it (s01) and the one behind it (s23): the same bits, computed at once.
static inline double4 crossings(line_t before, line_t line, line_t after) {
  const ulong most = 1UL << 53;
  if (abs(before.c) > most || abs(line.c) > most || abs(after.c) > most)
    return (double4)(crossing(before, line), crossing(line, after));
  const double4 c = convert_double4((long4)(before.c, line.c, line.c, after.c)), other_c = c.s1032;
  const double4 across = convert_double4((int4)(line.b, before.a, after.b, line.a));
  const double4 other_across = convert_double4((int4)(before.b, line.a, line.b, after.a));
  const double4 rounded = other_c * other_across;
  const double2 d = convert_double2((long2)(cross_of(before, line), cross_of(line, after)));
  return (fma(c, across, -rounded) + fma(-other_c, other_across, rounded)) / d.s0011;
}

// Floats make an error of less than a millionth in a squared distance (16 x 2^-24), and numbers of an order lose
// another 2^-20 of it.
#define ROUGH_MARGIN 1.000002f

// Returns its squared distance, with the margin.
static inline float set_vertex(cell_t* cell, int k, double2 vertex) {
  const float rough_x = convert_float(vertex.s0) * 0.5f, rough_y = convert_float(vertex.s1) * 0.5f;
  cell->x[k] = vertex.s0;
  cell->y[k] = vertex.s1;
  cell->rough_x[k] = rough_x;
  cell->rough_y[k] = rough_y;
  const float reach = (rough_x * rough_x + rough_y * rough_y) * ROUGH_MARGIN;
  cell->reaches[k] = reach;
  return reach;
}

// On which side of a line a vertex is, in whole numbers: 1 is beyond it, 0 on it.
static inline int exact_side(const cell_t* cell, int k, line_t line) {
  const line_t p = line_of(cell, k), q = line_of(cell, k + 1 < cell->size ? k + 1 : 0);
  return -sign_of(
      sum(sum(product(p.c, cross_of(q, line)), product(q.c, cross_of(line, p))), product(line.c, cross_of(p, q))));
}

static inline int bits_of_longs(long8 lanes) {
  return (int)or_of(as_ulong8(lanes) & (ulong8)(1, 2, 4, 8, 16, 32, 64, 128));
}

static inline int highest_bit(int bits) { return 31 - (int)clz(bits); }

// Which of the vertices from k on, as bits, are beyond a line (s0), and which are beyond or on it (s1).
static inline int2 beyond(const cell_t* cell, int k, line_t line) {
  const double8 ax = convert_double(line.a) * vload8(0, cell->x + k);
  const double8 by = convert_double(line.b) * vload8(0, cell->y + k);
  const double c = convert_double(line.c);
  const double8 over = ax + by - c;
  const double8 doubt = 0x1p-49 * (fabs(ax) + fabs(by) + fabs(c));
  int is_beyond = bits_of_longs(over > doubt), is_or_on = is_beyond;
  for (int unsure = bits_of_longs(!(fabs(over) > doubt)); unsure != 0; unsure &= unsure - 1) {
    const int lane = LOWEST_BIT(unsure), side = exact_side(cell, k + lane, line);
    is_beyond |= (side > 0) << lane;
    is_or_on |= (side >= 0) << lane;
  }
  return (int2)(is_beyond, is_or_on);
}

// Moves the edges from `from` on, and what is behind them.
static inline void move_edges(cell_t* cell, int from, int to, int count) {
  const int last = (count - 1) & ~(LANES - 1), step = to < from ? LANES : -LANES;
#define MOVE_EIGHT(type, name, length) vstore8(vload8(0, cell->name + from + k), 0, cell->name + to + k);
  for (int k = to < from ? 0 : last; k >= 0 && k <= last; k += step) { CELL_LISTS(MOVE_EIGHT) }
}

// Sets how many edges there are. Behind the last one come vertices that are the site itself, as far as
// vectors reach.
static inline void end_edges(cell_t* cell, int size) {
  cell->size = size;
  vstore8((double8)0, 0, cell->x + size);
  vstore8((double8)0, 0, cell->y + size);
  vstore8((float8)0, 0, cell->reaches + size);
}

// Weights may put bisectors of several sites on one line. What lies behind it is the farthest one's.
static inline void take_edge(cell_t* cell, line_t line) {
  for (int k = 0; k < cell->size; ++k) {
    const line_t edge = line_of(cell, k);
    const bool is_longer = abs(line.a) > abs(edge.a) || abs(line.b) > abs(edge.b);
    const bool is_parallel = cross_of(edge, line) == 0 && (long)edge.a * line.a + (long)edge.b * line.b > 0;
    if (edge.site == NO_CELL || !is_longer || !is_parallel) continue;
    const bool is_steep = edge.a != 0;
    const long of_edge = is_steep ? edge.a : edge.b, of_line = is_steep ? line.a : line.b;
    if (sign_of(sum(product(edge.c, of_line), product(line.c, -of_edge))) == 0) set_line(cell, k, line);
  }
}

// The bisector of a site with this lag and another one that is so far away.
static inline line_t line_towards(global const double* lags, double lag, int2 way, uint site, int image) {
  const long more = (long)lag_of(lags, site) - (long)lag, a = way.s0, b = way.s1;
  const line_t line = {a * a + b * b + more, way.s0, way.s1, site, image};
  return line;
}

// Cuts off what lies beyond the bisector of a site that is so far away. Returns whether that is anything.
static inline bool cut(cell_t* cell, int2 way, uint site, int image) {
  const line_t line = line_towards(cell->lags, cell->lag, way, site, image);
  const int size = cell->size;
  float8 reaches = 0;  // of the vertices that are kept
  int is_cut = 0, on = 0, first_gone = size, last_gone = -1, first_kept = size, last_kept = -1;
  for (int k = 0; k < size; k += LANES) {
    const int2 sides = beyond(cell, k, line);
    const int there = (1 << min(size - k, LANES)) - 1, gone = sides.s1 & there, kept = ~sides.s1 & there;
    is_cut |= sides.s0 & there;
    on += (int)popcount((uint)(gone & ~sides.s0));
    first_gone = gone != 0 ? min(first_gone, k + LOWEST_BIT(gone)) : first_gone;
    last_gone = gone != 0 ? k + highest_bit(gone) : last_gone;
    first_kept = kept != 0 ? min(first_kept, k + LOWEST_BIT(kept)) : first_kept;
    last_kept = kept != 0 ? k + highest_bit(kept) : last_kept;
    reaches = max(reaches, select(vload8(0, cell->reaches + k), (float8)0, lanes_of(gone)));
  }
  if (is_cut == 0 && on > 1) take_edge(cell, line);
  if (is_cut == 0) return false;
  if (last_kept < 0) {
    cell->size = 0;
    cell->reach = 0;
    return true;
  }
  // From the first to the last vertex that goes. Those on the line go with them, and new ones take their
  // places: one more edge, less the edges between two vertices that go.
  const bool is_split = first_gone == 0 && last_gone == size - 1;  // by the end of the lists
  const int first = is_split ? last_kept + 1 : first_gone, last = is_split ? first_kept - 1 : last_gone;
  const int after = last + 1 < size ? last + 1 : 0;
  const int kept = last_kept - first_kept + 1;
  const int new_size = (is_split ? kept : size - (last - first + 1)) + 2;
  if (new_size > ROOM) {
    cell->is_full = true;
    cell->reach = 0;
    return true;
  }
  const line_t before_line = line_of(cell, first), after_line = line_of(cell, after);
  const double4 ends = crossings(before_line, line, after_line);
  const int at = is_split ? kept : first;
  if (is_split) {
    move_edges(cell, first_kept, 0, kept);
    set_line(cell, at, before_line);
  } else if (last + 1 != first + 2) {
    move_edges(cell, last + 1, first + 2, size - (last + 1));
  }
  end_edges(cell, new_size);
  set_line(cell, at + 1, line);
  const float begin_reach = set_vertex(cell, at, ends.lo), end_reach = set_vertex(cell, at + 1, ends.hi);
  cell->reach = max(greatest_of_floats(reaches), max(begin_reach, end_reach));
  return true;
}

// What a cell begins with: how far its lower, right, upper and left sides are.
static inline long4 first_sides(const tree_t* tree, long2 at) {
  const long x[2] = {FIRST_SIDES(tree, at, x)}, y[2] = {FIRST_SIDES(tree, at, y)};
  return (long4)(y[0], x[1], y[1], x[0]);
}

static inline line_t first_line(long4 sides, int k) {
  const long side = k == 0 ? sides.s0 : k == 1 ? sides.s1 : k == 2 ? sides.s2 : sides.s3;
  const int is_level = (k & 1) == 0, way = k == 0 || k == 3 ? -1 : 1;
  const line_t line = {way * side, is_level ? 0 : way, is_level ? way : 0, NO_CELL, k};
  return line;
}

static inline void begin_cell(cell_t* cell, const tree_t* tree, int2 at, uint site) {
  const long4 sides = first_sides(tree, convert_long2(at));
  const double4 ends = convert_double4(sides);
  cell->lags = tree->lags;
  cell->lag = lag_of(tree->lags, site);
  cell->is_full = false;
  end_edges(cell, 4);
  for (int k = 0; k < 4; ++k) set_line(cell, k, first_line(sides, k));
  const float4 reaches = {set_vertex(cell, 0, ends.s10), set_vertex(cell, 1, ends.s12),
                          set_vertex(cell, 2, ends.s32), set_vertex(cell, 3, ends.s30)};
  cell->reach = max(max(reaches.s0, reaches.s1), max(reaches.s2, reaches.s3));
}

// Behind which squared distance, in steps, no site cuts the cell.
static inline float end_of(const cell_t* cell) { return 4 * cell->reach; }

// Vertices as the search takes them.
static inline int vertices_of(const cell_t* cell) { return cell->size; }
static inline float2 vertex_of(const cell_t* cell, int k, float* reach) {
  *reach = cell->reaches[k];
  return (float2)(cell->rough_x[k], cell->rough_y[k]);
}

#endif
