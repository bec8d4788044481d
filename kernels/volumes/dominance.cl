// Which seeds can win in a box of voxels.
//
// A seed d rules out a seed s in a box if it is nearer at all 8 corners. The least lag over the corners,
// |s - c|^2 - |d - c|^2, is a sum of least lags along the axes: with coordinates from the box's first corner and h its
// last one, |s|^2 - |d|^2 - sum of max(0, 2 h (s - d)). So a corner costs nothing: 10 operations for all 8.
// Equal distances rule nothing out, so no proof needs the tie rule.

#ifndef VOROCL_VOLUMES_DOMINANCE
#define VOROCL_VOLUMES_DOMINANCE

#include "volumes/images.cl"

#define PLACES 9  // the centre and the corners of a box

// Coordinates from a box's first corner, and its last corner, in units of distances.
static inline iv from_x(box_t b, uv p) { return (xs_of(p) - b.x) * SPACING_X; }
static inline iv from_y(box_t b, uv p) { return (ys_of(p) - b.y) * SPACING_Y; }
static inline iv from_z(box_t b, uv p) { return (zs_of(p) - b.z) * SPACING_Z; }
static inline int last_x(box_t b) { return b.hx * SPACING_X; }
static inline int last_y(box_t b) { return b.hy * SPACING_Y; }
static inline int last_z(box_t b) { return b.hz * SPACING_Z; }

// The seed nearest to each place, as far as known.
typedef struct {
  box_t box;
  int distance[PLACES];
  uint seed[PLACES];
  // The different ones among them, relative to the box's first corner.
  int count;
  int n[PLACES], x[PLACES], y[PLACES], z[PLACES];
} dominators_t;

static inline void begin_dominators(dominators_t* d, box_t box) {
  d->box = box;
  d->count = 0;
#pragma unroll
  for (int i = 0; i < PLACES; ++i) d->distance[i] = INT_MAX, d->seed[i] = EMPTY;
}

// Distances to the places, less what is the same for all seeds. The centre is half way to the last corner.
typedef struct {
  iv best[PLACES];
  uv seed[PLACES];
} nearest_t;

static inline void begin_nearest(nearest_t* nearest, const dominators_t* d) {
#pragma unroll
  for (int i = 0; i < PLACES; ++i) nearest->best[i] = (iv)d->distance[i], nearest->seed[i] = (uv)d->seed[i];
}

static inline void take_nearest(nearest_t* nearest, box_t b, uv seed) {
  const iv x = from_x(b, seed), y = from_y(b, seed), z = from_z(b, seed);
  const iv n = (x * x + y * y + z * z) | (is_empty(seed) & 0x3fffffff);  // the squared sides are below that
  const iv x2 = x * (2 * last_x(b)), y2 = y * (2 * last_y(b)), z2 = z * (2 * last_z(b));
  iv to[PLACES];
  to[1] = n;
  to[2] = n - x2;
  to[3] = to[1] - y2;
  to[4] = to[2] - y2;
#pragma unroll
  for (int i = 1; i < 5; ++i) to[4 + i] = to[i] - z2;
  to[0] = n - ((x2 + y2 + z2) >> 1);
#pragma unroll
  for (int i = 0; i < PLACES; ++i) {
    nearest->seed[i] = select(nearest->seed[i], seed, to[i] < nearest->best[i]);
    nearest->best[i] = min(nearest->best[i], to[i]);
  }
}

static inline void end_nearest(const nearest_t* nearest, dominators_t* d) {
#pragma unroll
  for (int i = 0; i < PLACES; ++i) {
    const int least = least_lane(nearest->best[i]);
    d->distance[i] = least;
    d->seed[i] = least_lane_u(select((uv)0xffffffffu, nearest->seed[i], nearest->best[i] == least));
  }
  d->count = 0;
  for (int i = 0; i < PLACES; ++i) {
    const uint s = d->seed[i];
    if (s & EMPTY) continue;
    bool known = false;
    for (int j = 0; j < i; ++j) known |= d->seed[j] == s;
    if (known) continue;
    const int x = (x_of(s) - d->box.x) * SPACING_X, y = (y_of(s) - d->box.y) * SPACING_Y;
    const int z = (z_of(s) - d->box.z) * SPACING_Z;
    d->x[d->count] = x, d->y[d->count] = y, d->z[d->count] = z, d->n[d->count] = x * x + y * y + z * z;
    ++d->count;
  }
}

// Lists are read in whole vectors, so they are padded with positions that are empty.
static inline uv load_seeds(const ulong* list) {
  const uint16 both = vload16(0, (const uint*)list);
  return both.even;
}
static inline void pad(ulong* list, int count) { vstore8((ulong8)EMPTY, 0, list + count); }

// How far a seed is behind the one that rules it out the most; above 0: it wins nowhere in the box.
static inline iv greatest_lag(const dominators_t* d, uv seed) {
  const box_t b = d->box;
  const iv x = from_x(b, seed), y = from_y(b, seed), z = from_z(b, seed);
  const iv n = x * x + y * y + z * z;
  iv lag = select((iv)INT_MIN, (iv)1, is_empty(seed));
  const int hx = 2 * last_x(b), hy = 2 * last_y(b), hz = 2 * last_z(b);
  const iv x2 = x * hx, y2 = y * hy, z2 = z * hz;
  for (int i = 0; i < d->count; ++i) {
    lag = max(lag, n - d->n[i] - max(x2 - d->x[i] * hx, (iv)0) - max(y2 - d->y[i] * hy, (iv)0) -
                       max(z2 - d->z[i] * hz, (iv)0));
  }
  return lag;
}

// Copies the seeds of a padded list that are not ruled out (in place where the lists are one), and pads.
static inline int filter(const dominators_t* d, const ulong* from, int count, ulong* to) {
  int kept = 0;
  for (int i = 0; i < count; i += 8) {
    int keep[8];
    vstore8(greatest_lag(d, load_seeds(from + i)) <= 0, 0, keep);
#pragma unroll
    for (int lane = 0; lane < 8; ++lane) {
      to[kept] = from[i + lane];
      kept += keep[lane] & 1;
    }
  }
  pad(to, kept);
  return kept;
}

static inline void improve(dominators_t* d, const ulong* list, int count) {
  nearest_t nearest;
  begin_nearest(&nearest, d);
  for (int i = 0; i < count; i += 8) take_nearest(&nearest, d->box, load_seeds(list + i));
  end_nearest(&nearest, d);
}

// Of 8 nodes, by their boxes: which may hold a seed that wins. Along an axis a node's least lag is that of its point
// nearest to either end.
static inline iv nodes_left(const dominators_t* d, uv low, uv high) {
  const box_t b = d->box;
  const iv lx = from_x(b, low), hx = from_x(b, high), ly = from_y(b, low), hy = from_y(b, high);
  const iv lz = from_z(b, low), hz = from_z(b, high);
  const int ex = last_x(b), ey = last_y(b), ez = last_z(b);
#define TO(at, l, h) max(max(l - (at), (at) - h), (iv)0)
  iv x0 = TO(0, lx, hx), x1 = TO(ex, lx, hx), y0 = TO(0, ly, hy), y1 = TO(ey, ly, hy);
  iv z0 = TO(0, lz, hz), z1 = TO(ez, lz, hz);
#undef TO
  x0 *= x0, x1 *= x1, y0 *= y0, y1 *= y1, z0 *= z0, z1 *= z1;
  iv lag = select((iv)INT_MIN, (iv)1, is_empty(low));
  for (int i = 0; i < d->count; ++i) {
    const int x = d->x[i], y = d->y[i], z = d->z[i];
    lag = max(lag, min(x0 - x * x, x1 - (ex - x) * (ex - x)) + min(y0 - y * y, y1 - (ey - y) * (ey - y)) +
                       min(z0 - z * z, z1 - (ez - z) * (ez - z)));
  }
  return lag <= 0;
}

#endif
