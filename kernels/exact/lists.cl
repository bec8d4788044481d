// Lists of the places that may be nearest to a pixel of a box, and dropping those that another one beats
// everywhere.
//
// DOMINANCE. With the origin at the box's centre and w from its first pixel centre to its last along each
// axis, the least of "how much farther is c than d" over the box is, at one of its corners,
//   |c|^2 - |d|^2 - (wx |cx - dx| + wy |cy - dy| + wz |cz - dz|),
// where a lag counts as one more squared coordinate.
// Where that is above 0, c is nowhere nearest. By the Manhattan metric the least is at a corner, too. Floats
// compute it, with margins, so they drop places and decide nothing: docs/exact.md says why the margins are
// enough, however far places are.

#ifndef VOROCL_EXACT_LISTS
#define VOROCL_EXACT_LISTS

#include "exact/bins.cl"

#ifndef MOST_IN_LIST
#define MOST_IN_LIST 4000
#endif
#define LIST_ROOM (MOST_IN_LIST + 32)
#define FEW_PLACES (IS_VOLUME ? 12 : 16)  // are not looked through
#define MANY_PLACES (IS_MANHATTAN ? 64 : 128)  // are a crowd
#define NUMBERS 4096  // of places in a list, as the low bits of what says how near they are
#if LIST_ROOM > NUMBERS
#error "A place's number in its list takes more bits than it has"
#endif

typedef struct {
  int x[LIST_ROOM], y[LIST_ROOM];  // from the centre of a box
  uint at[LIST_ROOM];              // in the index
#if IS_VOLUME
  int z[LIST_ROOM];
#endif
#if IS_WEIGHTED
  int lag[LIST_ROOM];
#endif
} list_t;

typedef struct {
  int x, y, z, sx, sy, sz;  // first pixel and sides
} box_t;

typedef struct {
  bins_t bins;
  int4 size;      // the period along periodic axes
  int4 periodic;  // along which axes the grid is
  int4 tilts;     // core/lattice.cl
  global const uint* starts;
  global const int *x, *y, *z;
  global const uint* ids;
  global const int* lags;      // by place
  global const int* row_lags;  // the least of each row of bins; null in the group shape
  global const float* bounds;  // of blocks of places; null there, too
  global const int2*
      order;            // by id, if places may be images of seeds in a plane: what orders these; else null
  int4 first, last;     // the pixels that get labels; others of the grid get none
  global uint* labels;  // written
} scene_t;

// In programs of periodic grids a bit of size.w says of each axis whether it is periodic, as those of Axes do. (In the
// group shape build options say so: the argument takes registers.)
#define AXES_OF(size) ((int4)((size).w) >> (int4)(0, 1, 2, 3) & 1)
#ifdef VOROCL_PERIODIC
#define IS_PERIODIC(scene, axis) ((scene)->periodic.axis != 0)
#else
#define IS_PERIODIC(scene, axis) 0
#endif

static inline bool has_label(const scene_t* s, int x, int y, int z) {
  return x >= s->first.x && y >= s->first.y && z >= s->first.z && x <= s->last.x && y <= s->last.y &&
         z <= s->last.z;
}

// What orders the seed of a place along an axis, by its own position in the grid.
static inline int own_x(const scene_t* s, uint at) {
  return !IS_VOLUME && s->order ? s->order[s->ids[at]].x : s->x[at];
}
static inline int own_y(const scene_t* s, uint at) {
  return !IS_VOLUME && s->order ? s->order[s->ids[at]].y : s->y[at];
}
// Whether that may be another one than where the place is.
static inline bool has_images_of(const scene_t* s) {
  const bool is_periodic = IS_PERIODIC(s, x) || IS_PERIODIC(s, y) || IS_PERIODIC(s, z);
  return IS_VOLUME ? is_periodic : is_periodic || s->order != 0;
}
static inline bool comes_first(const scene_t* s, uint a, uint b) {
  if (IS_VOLUME && s->z[a] != s->z[b]) return s->z[a] < s->z[b];
  const int ya = own_y(s, a), yb = own_y(s, b), xa = own_x(s, a), xb = own_x(s, b);
  if (ya != yb) return ya < yb;
  if (xa != xb) return xa < xb;
  return s->ids[a] < s->ids[b];
}

static inline box_t box_at(int x, int y, int z, int sx, int sy, int sz) {
  const box_t box = {x, y, z, sx, sy, sz};
  return box;
}
static inline int4 centre_of(box_t b) {
  return (int4)(2 * b.x + b.sx, 2 * b.y + b.sy, 2 * b.z + b.sz, 0) * HALF * SPACINGS;
}
// From the first voxel centre to the last, in units of the spacing.
static inline float4 between_centres(box_t b) {
  return convert_float4((int4)(b.sx - 1, b.sy - 1, b.sz - 1, 0) * SPACINGS);
}
static inline bool is_in_grid(const scene_t* scene, box_t b) {
  return b.x < scene->size.x && b.y < scene->size.y && b.z < scene->size.z;
}

// Eight places, from a centre.
typedef struct {
  int8 x, y, z;
#if IS_WEIGHTED
  int8 lag;
#endif
} places8_t;
typedef struct {
  float8 x, y, z, n;  // and what orders them by distance: it, squared if Euclidean
} floats8_t;

static inline floats8_t floats_of(places8_t p) {
  floats8_t f;
  f.x = convert_float8(p.x), f.y = convert_float8(p.y), f.z = convert_float8(p.z);
#if IS_MANHATTAN
  f.n = fabs(f.x) + fabs(f.y);
#else
  f.n = fma(f.x, f.x, f.y * f.y);
  if (IS_VOLUME) f.n = fma(f.z, f.z, f.n);
#if IS_WEIGHTED
  f.n = fma(convert_float8(p.lag), (float8)LAG_UNIT, f.n);
#endif
#endif
  return f;
}
static inline places8_t load_from_list(const list_t* list, int k) {
  places8_t p;
  p.x = vload8(0, list->x + k), p.y = vload8(0, list->y + k), p.z = 0;
#if IS_VOLUME
  p.z = vload8(0, list->z + k);
#endif
#if IS_WEIGHTED
  p.lag = vload8(0, list->lag + k);
#endif
  return p;
}
static inline places8_t load_from_index(const scene_t* scene, uint at, int4 centre) {
  places8_t p;
  p.x = vload8(0, scene->x + at) - centre.x, p.y = vload8(0, scene->y + at) - centre.y, p.z = 0;
  if (IS_VOLUME) p.z = vload8(0, scene->z + at) - centre.z;
#if IS_WEIGHTED
  p.lag = vload8(0, scene->lags + at);
#endif
  return p;
}
static inline places8_t moved(places8_t p, int4 way) {
  p.x -= way.x, p.y -= way.y;
  if (IS_VOLUME) p.z -= way.z;
  return p;
}
static inline float distance_of(float4 way) {  // as `n` above; w is the lag, in units squared
  if (IS_MANHATTAN) return fabs(way.x) + fabs(way.y);
  const float n = way.x * way.x + way.y * way.y + way.z * way.z;
  return IS_WEIGHTED ? n + way.w : n;
}

// A place that drops others, and of a box the spans between its outer pixel centres (half of them by the
// Manhattan metric), with margins.
typedef struct {
  float x, y, z, limit;
} rival_t;
typedef struct {
  float x, y, z, more;
} spans_t;

#define MARGIN 0x1p-18f
#define SLICE_MARGIN 0x1p-20f
#define ONE_MORE (1 + MARGIN)
static inline spans_t spans_of(box_t b) {
  const float4 w = between_centres(b) * (float)ONE;
#if IS_MANHATTAN
  const spans_t s = {w.x / 2, w.y / 2, 0, ONE * 0x1p-9f};
#else
  const spans_t s = {w.x * ONE_MORE, w.y * ONE_MORE, w.z * ONE_MORE,
                     (w.x * w.x + w.y * w.y + w.z * w.z) * MARGIN};
#endif
  return s;
}
static inline rival_t rival_at(float4 place, const spans_t* s) {
  const float n = distance_of(place);
  const rival_t rival = {place.x, place.y, place.z, (IS_MANHATTAN ? n * 0x1p-19f : n * ONE_MORE) + s->more};
  return rival;
}
static inline int8 may_win(const floats8_t* f, const rival_t* rival, const spans_t* s) {
#if IS_MANHATTAN
  const float8 west = fabs(f->x + s->x) - fabs(rival->x + s->x),
               east = fabs(f->x - s->x) - fabs(rival->x - s->x);
  const float8 north = fabs(f->y + s->y) - fabs(rival->y + s->y),
               south = fabs(f->y - s->y) - fabs(rival->y - s->y);
  return fmin(west, east) + fmin(north, south) <= fma(f->n, (float8)0x1p-19f, (float8)rival->limit);
#else
  float8 n = fma(fabs(f->x - rival->x), (float8)-s->x, f->n);
  n = fma(fabs(f->y - rival->y), (float8)-s->y, n);
  if (IS_VOLUME) n = fma(fabs(f->z - rival->z), (float8)-s->z, n);
  return n <= rival->limit;
#endif
}
static inline float4 place_in(const list_t* list, int k) {
  float4 place = (float4)((float)list->x[k], (float)list->y[k], 0, 0);
#if IS_VOLUME
  place.z = (float)list->z[k];
#endif
#if IS_WEIGHTED
  place.w = (float)list->lag[k] * LAG_UNIT;
#endif
  return place;
}

static inline int keep(list_t* list, int kept, int8 stays, const places8_t* p, uint8 at) {
  const uint mask = mask_of(stays);
  const uint8 lanes = lanes_of(mask);
  store_ints(permuted_ints(p->x, lanes), list->x + kept);
  store_ints(permuted_ints(p->y, lanes), list->y + kept);
#if IS_VOLUME
  store_ints(permuted_ints(p->z, lanes), list->z + kept);
#endif
#if IS_WEIGHTED
  store_ints(permuted_ints(p->lag, lanes), list->lag + kept);
#endif
  store_uints(permuted(at, lanes), list->at + kept);
  return kept + (int)popcount(mask);
}

// How near places are, roughly, with their numbers in the low bits: floats that are not below 0 are in the
// order of their bits.
static inline int8 nearness_of(float8 away, int first, int count) {
  const int8 number = EIGHT + first;
  return select((int8)INT_MAX, (as_int8(fmax(away, 0.f)) & ~(NUMBERS - 1)) | number, number < count);
}
static inline int number_of(int8 nearness) { return least_int(nearness) & (NUMBERS - 1); }

// Copies the places that a rival does not drop, relative to the centre of a box, which is so far from that of
// `from`.
static inline int drop_by(const list_t* from, int count, list_t* to, int4 way, float4 rival_place,
                          box_t box) {
  const spans_t spans = spans_of(box);
  const rival_t rival = rival_at(rival_place, &spans);
  int kept = 0;
  for (int k = 0; k < count; k += 8) {
    const places8_t p = moved(load_from_list(from, k), way);
    const floats8_t f = floats_of(p);
    kept = keep(to, kept, may_win(&f, &rival, &spans) & (EIGHT + k < count), &p, vload8(0, from->at + k));
  }
  return kept;
}

#define CORNERS (IS_VOLUME ? 8 : 4)
// Drops in place, by the places that are nearest to the corners.
NOINLINE static int drop_by_corners(list_t* list, int count, box_t box) {
  const spans_t spans = spans_of(box);
  const float4 w = between_centres(box) * (float)ONE;  // twice the way to a corner
  const float more = distance_of(w) / 4;
  int8 nearest[CORNERS];
#pragma unroll
  for (int i = 0; i < CORNERS; ++i) nearest[i] = INT_MAX;
  for (int k = 0; k < count; k += 8) {
    const floats8_t f = floats_of(load_from_list(list, k));
    float8 to[8];
#if IS_MANHATTAN
    const float8 west = fabs(f.x + spans.x), east = fabs(f.x - spans.x);
    const float8 north = fabs(f.y + spans.y), south = fabs(f.y - spans.y);
    to[0] = west + north, to[1] = east + north, to[2] = west + south, to[3] = east + south;
    (void)more;
#else
    const float8 x = w.x * f.x, y = w.y * f.y, n = f.n + more;
    to[0] = n - x, to[1] = n + x;
    to[2] = to[0] + y, to[3] = to[1] + y, to[0] -= y, to[1] -= y;
    if (IS_VOLUME) {
      const float8 z = w.z * f.z;
#pragma unroll
      for (int i = 0; i < 4; ++i) to[4 + i] = to[i] + z, to[i] -= z;
    }
#endif
#pragma unroll
    for (int i = 0; i < CORNERS; ++i) nearest[i] = min(nearest[i], nearness_of(to[i], k, count));
  }
  rival_t rivals[CORNERS];
  int numbers[CORNERS], some = 0;
#if !IS_VOLUME
#pragma unroll
#endif
  for (int i = 0; i < CORNERS; ++i) {
    const int number = number_of(nearest[i]);
    bool is_known = false;
    for (int j = 0; IS_VOLUME && j < some; ++j) is_known |= numbers[j] == number;
    if (is_known) continue;
    numbers[some] = number;
    rivals[some++] = rival_at(place_in(list, number), &spans);
  }
  int kept = 0;
  for (int k = 0; k < count; k += 8) {
    const places8_t p = load_from_list(list, k);
    const floats8_t f = floats_of(p);
    int8 stays = EIGHT + k < count;
#if !IS_VOLUME
#pragma unroll
#endif
    for (int i = 0; i < (IS_VOLUME ? some : CORNERS); ++i) stays &= may_win(&f, &rivals[i], &spans);
    kept = keep(list, kept, stays, &p, vload8(0, list->at + k));
  }
  return kept;
}

#if !IS_MANHATTAN
// Along one axis, the part (c - d) (c + d - 2 p) of |c - p|^2 - |d - p|^2 where p goes over a width around a
// middle: the least, and the sum of the terms that make it.
typedef struct {
  float8 least, terms;
} lead_t;
static inline lead_t lead_of(int8 c, int d, int twice_the_middle, float width) {
  const float8 way = convert_float8(c - d), sum = convert_float8(c + d - twice_the_middle);
  const float8 of_width = fabs(way) * width;
  lead_t lead;
  lead.least = way * sum - of_width;
  lead.terms = fabs(way) * fabs(sum) + of_width;
  return lead;
}

// The same of lags, which no pixel changes.
static inline lead_t lead_of_lags(const list_t* list, int k, int d) {
  lead_t lead = {0, 0};
#if IS_WEIGHTED
  lead.least = convert_float8(vload8(0, list->lag + k) - list->lag[d]) * LAG_UNIT;
  lead.terms = fabs(lead.least);
#else
  (void)list, (void)k, (void)d;
#endif
  return lead;
}

static inline lead_t sum_of_leads(lead_t a, lead_t b) {
  a.least += b.least, a.terms += b.terms;
  return a;
}

static inline int lane_of_least(float8 values, int8 numbers) {
  const float least = least_float(values);
  return least_int(select((int8)INT_MAX, numbers, values == least));
}

// Drops in place those that win in no slice of voxels across that axis: the place d that is nearest to a
// slice's middle beats another place c everywhere in the slice if the least of |c - p|^2 - |d - p|^2 is above
// 0. So few stay of many places next to each other along the axis, for no voxel lies between two slices. The
// differences and sums are whole numbers: floats of near places keep their digits. (Lists of places that are
// too far for such sums stay as they are.)
#define MOST_OF_SUMS (1 << 29)
#define MOST_SLICES 64
NOINLINE static int drop_by_slices(list_t* list, int count, box_t box) {
  const int sides[3] = {box.sx, box.sy, box.sz},
            units[3] = {ONE * SPACING_X, ONE * SPACING_Y, ONE * SPACING_Z};
#if IS_VOLUME
  const int* const along[3] = {list->x, list->y, list->z};
#else
  const int* const along[3] = {list->x, list->y, list->x};
#endif
  // The axis along which the places lie farthest apart: this pays where they lie along an axis.
  int axis = 0, longest = -1, next = -1;
  for (int i = 0; i < AXES_OF_PLACES; ++i) {
    const extent_t extent = extent_of(along[i], count);
    if (extent.first < -MOST_OF_SUMS || extent.last > MOST_OF_SUMS) return count;
    const int length = extent.last - extent.first;
    if (length > longest) {
      axis = i, next = longest, longest = length;
    } else {
      next = max(next, length);
    }
  }
  if (next > longest / 32) return count;
  const int at_a = axis == 0 ? 1 : 0, at_b = axis == 2 ? 1 : 2, slices = min(sides[axis], MOST_SLICES);
  const int thickness = sides[axis] / slices, step = units[axis] * thickness;
  const float w_own = (float)(thickness - 1) * (float)units[axis];
  const int *const own = along[axis], *const a = along[at_a], *const b = along[at_b];
  const float w_a = (float)(sides[at_a] - 1) * (float)units[at_a],
              w_b = (float)(sides[at_b] - 1) * (float)units[at_b];
  int stays[LIST_ROOM];
  for (int k = 0; k < count; k += 8) store_ints(0, stays + k);
  for (int i = 0; i < slices; ++i) {
    const int twice = (2 * i + 1 - slices) * step;  // the slice's middle
    float8 least = INFINITY;
    int8 nearest = 0;
    for (int k = 0; k < count; k += 8) {
      const lead_t lead = lead_of(vload8(0, own + k), own[0], twice, 0);
      float8 away = lead.least + lead_of(vload8(0, a + k), a[0], 0, 0).least;
      if (IS_VOLUME) away += lead_of(vload8(0, b + k), b[0], 0, 0).least;
      if (IS_WEIGHTED) away += lead_of_lags(list, k, 0).least;
      const int8 is_nearer = (away < least) & (EIGHT + k < count);
      least = select(least, away, is_nearer), nearest = select(nearest, EIGHT + k, is_nearer);
    }
    const int rival = lane_of_least(least, nearest);
    for (int k = 0; k < count; k += 8) {
      lead_t lead = lead_of(vload8(0, own + k), own[rival], twice, w_own);
      lead = sum_of_leads(lead, lead_of(vload8(0, a + k), a[rival], 0, w_a));
      if (IS_VOLUME) lead = sum_of_leads(lead, lead_of(vload8(0, b + k), b[rival], 0, w_b));
      if (IS_WEIGHTED) lead = sum_of_leads(lead, lead_of_lags(list, k, rival));
      const int8 wins = lead.least <= lead.terms * SLICE_MARGIN;
      store_ints(vload8(0, stays + k) | wins, stays + k);
    }
  }
  int kept = 0;
  for (int k = 0; k < count; k += 8) {
    const places8_t p = load_from_list(list, k);
    kept = keep(list, kept, vload8(0, stays + k) & (EIGHT + k < count), &p, vload8(0, list->at + k));
  }
  return kept;
}

#else

// By the Manhattan metric all pixels of a box can be as near to one place as to another one, and so to thousands of a
// diagonal line: the first by the tie rule beats the others. So places drop others in whole numbers: those that are
// nearest to the corners, and first among these. Leads along each axis fit in an int; their sum is not made.

// The place of a list that wins at a pixel centre, which is (x, y) from the centre of its box. Where seeds have images
// it is one of those that are as near: it drops fewer others.
typedef struct {
  int x, y;
  uint at;
} first_t;
static inline first_t first_near(const scene_t* scene, const list_t* list, int count, int x, int y) {
  const bool by_place = !has_images_of(scene);  // as the tie rule goes
  uint8 least = UINT_MAX;
  int8 best_y = 0, best_x = 0, number = 0;
  for (int k = 0; k < count; k += 8) {
    const int8 px = vload8(0, list->x + k), py = vload8(0, list->y + k);
    const uint8 distance = select((uint8)UINT_MAX, absolute(px - x) + absolute(py - y), as_uint8(EIGHT + k < count));
    int8 wins = distance < least;
    if (by_place) wins |= (distance == least) & ((py < best_y) | ((py == best_y) & (px < best_x)));
    least = select(least, distance, as_uint8(wins)), number = select(number, EIGHT + k, wins);
    best_y = select(best_y, py, wins), best_x = select(best_x, px, wins);
  }
  uint distance[8];
  int numbers[8], lane = 0;
  store_uints(least, distance), store_ints(number, numbers);
  for (int i = 1; i < 8; ++i) {
    if (distance[i] > distance[lane] || distance[i] == UINT_MAX) continue;
    const bool is_first = comes_first(scene, list->at[numbers[i]], list->at[numbers[lane]]);
    if (distance[i] < distance[lane] || is_first) lane = i;
  }
  const int found = numbers[lane];
  const first_t first = {list->x[found], list->y[found], list->at[found]};
  return first;
}

NOINLINE static int drop_by_firsts(const scene_t* scene, list_t* list, int count, box_t box) {
  const int sx = (box.sx - 1) * HALF, sy = (box.sy - 1) * HALF;
  for (int corner = 0; corner < CORNERS; ++corner) {
    const first_t rival = first_near(scene, list, count, corner % 2 ? sx : -sx, corner / 2 ? sy : -sy);
    const int west = (int)abs(rival.x + sx), east = (int)abs(rival.x - sx);
    const int north = (int)abs(rival.y + sy), south = (int)abs(rival.y - sy);
    int kept = 0;
    for (int k = 0; k < count; k += 8) {
      const places8_t p = load_from_list(list, k);
      const uint8 at = vload8(0, list->at + k);
      const int8 along_x = min(as_int8(absolute(p.x + sx)) - west, as_int8(absolute(p.x - sx)) - east);
      const int8 along_y = -min(as_int8(absolute(p.y + sy)) - north, as_int8(absolute(p.y - sy)) - south);
      uint stays = mask_of((along_x <= along_y) & (EIGHT + k < count));
      uint ties = stays & mask_of(along_x == along_y);
      if (!has_images_of(scene)) {  // places are in the order of the tie rule
        const uint later = mask_of((p.y > rival.y) | ((p.y == rival.y) & (p.x > rival.x)));
        stays &= ~(ties & later);
        ties &= mask_of((p.y == rival.y) & (p.x == rival.x));
      }
      for (; ties != 0; ties &= ties - 1) {
        const uint other = list->at[k + (int)lowest_bit(ties)];
        if (other != rival.at && comes_first(scene, rival.at, other)) stays ^= ties & (0 - ties);
      }
      kept = keep(list, kept, -((int8)(int)stays >> EIGHT & 1), &p, at);
    }
    count = kept;
  }
  return count;
}

#endif

// Drops in place what another place is seen to beat; crowds are looked at once more.
static inline int drop_beaten(const scene_t* scene, list_t* list, int count, box_t box) {
  if (count > FEW_PLACES) count = drop_by_corners(list, count, box);
  if (count <= MANY_PLACES) return count;
#if IS_MANHATTAN
  count = drop_by_firsts(scene, list, count, box);
#else
  count = drop_by_slices(list, count, box);
  (void)scene;
#endif
  return count;
}

#endif
