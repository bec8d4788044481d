// Lists of the places that may be nearest to a voxel of a box, and dropping those that another one beats everywhere.
//
// DOMINANCE. With the origin at the box's centre and w from its first voxel centre to its last along each axis, the
// least of "how much farther is c than d" over the box is, at one of its corners,
//   |c|^2 - |d|^2 - (wx |cx - dx| + wy |cy - dy| + wz |cz - dz|).
// Where that is above 0, c is nowhere nearest. Floats compute it, with margins, so they drop places and decide nothing:
// docs/exact.md says why the margins are enough, however far places are.

#ifndef VOROCL_POINTS_LISTS
#define VOROCL_POINTS_LISTS

#include "points/index.cl"

#ifndef MOST_IN_LIST
#define MOST_IN_LIST 4000
#endif
#define LIST_ROOM (MOST_IN_LIST + 24)
#define FEW_PLACES 12    // are not looked through
#define MANY_PLACES 128  // are a crowd
#define NUMBERS 4096  // of places in a list, as the low bits of what says how near they are
#if LIST_ROOM > NUMBERS
#error "A place's number in its list takes more bits than it has"
#endif

typedef struct {
  int x[LIST_ROOM], y[LIST_ROOM], z[LIST_ROOM];  // from the centre of a box
  uint at[LIST_ROOM];                            // in the index
} list_t;

typedef struct {
  int x, y, z, sx, sy, sz;  // first voxel and sides
} box_t;

typedef struct {
  bins_t bins;
  int4 size;  // the period along periodic axes
  global const uint* starts;
  global const int *x, *y, *z;
  global const uint* ids;
  global uint* labels;
} scene_t;

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
} places8_t;
typedef struct {
  float8 x, y, z, n;  // and the squared distance
} floats8_t;

static inline floats8_t floats_of(places8_t p) {
  floats8_t f;
  f.x = convert_float8(p.x), f.y = convert_float8(p.y), f.z = convert_float8(p.z);
  f.n = fma(f.z, f.z, fma(f.x, f.x, f.y * f.y));
  return f;
}
static inline places8_t load_from_list(const list_t* list, int k) {
  const places8_t p = {vload8(0, list->x + k), vload8(0, list->y + k), vload8(0, list->z + k)};
  return p;
}
static inline places8_t load_from_index(const scene_t* scene, uint at, int4 centre) {
  const places8_t p = {vload8(0, scene->x + at) - centre.x, vload8(0, scene->y + at) - centre.y,
                       vload8(0, scene->z + at) - centre.z};
  return p;
}

// A place that drops others, and of a box the spans between its outer voxel centres, with margins.
typedef struct {
  float x, y, z, limit;
} rival_t;
typedef struct {
  float x, y, z, squares;
} spans_t;

#define MARGIN 0x1p-16f
#define SLICE_MARGIN 0x1p-20f
#define ONE_MORE (1 + MARGIN)
static inline spans_t spans_of(box_t b) {
  const float4 w = between_centres(b) * (float)ONE;
  const spans_t s = {w.x * ONE_MORE, w.y * ONE_MORE, w.z * ONE_MORE, (w.x * w.x + w.y * w.y + w.z * w.z) * MARGIN};
  return s;
}
static inline rival_t rival_at(float4 place, const spans_t* s) {
  const float n = place.x * place.x + place.y * place.y + place.z * place.z;
  const rival_t rival = {place.x, place.y, place.z, n * ONE_MORE + s->squares};
  return rival;
}
static inline int8 may_win(const floats8_t* f, const rival_t* rival, const spans_t* s) {
  float8 n = fma(fabs(f->x - rival->x), (float8)-s->x, f->n);
  n = fma(fabs(f->y - rival->y), (float8)-s->y, n);
  n = fma(fabs(f->z - rival->z), (float8)-s->z, n);
  return n <= rival->limit;
}
static inline float4 place_in(const list_t* list, int k) {
  return (float4)((float)list->x[k], (float)list->y[k], (float)list->z[k], 0);
}

static inline int keep(list_t* list, int kept, int8 stays, const places8_t* p, uint8 at) {
  const uint mask = mask_of(stays);
  const uint8 lanes = lanes_of(mask);
  store_ints(permuted_ints(p->x, lanes), list->x + kept);
  store_ints(permuted_ints(p->y, lanes), list->y + kept);
  store_ints(permuted_ints(p->z, lanes), list->z + kept);
  store_uints(permuted(at, lanes), list->at + kept);
  return kept + (int)popcount(mask);
}

// How near places are, roughly, with their numbers in the low bits: floats that are not below 0 are in the order of
// their bits.
static inline int8 nearness_of(float8 away, int first, int count) {
  const int8 number = EIGHT + first;
  return select((int8)INT_MAX, (as_int8(fmax(away, 0.f)) & ~(NUMBERS - 1)) | number, number < count);
}
static inline int number_of(int8 nearness) { return least_int(nearness) & (NUMBERS - 1); }

// Copies the places that a rival does not drop, relative to the centre of a box, which is so far from that of `from`.
NOINLINE static int drop_by(const list_t* from, int count, list_t* to, int4 way, float4 rival_place, box_t box) {
  const spans_t spans = spans_of(box);
  const rival_t rival = rival_at(rival_place, &spans);
  int kept = 0;
  for (int k = 0; k < count; k += 8) {
    places8_t p = load_from_list(from, k);
    p.x -= way.x, p.y -= way.y, p.z -= way.z;
    const floats8_t f = floats_of(p);
    kept = keep(to, kept, may_win(&f, &rival, &spans) & (EIGHT + k < count), &p, vload8(0, from->at + k));
  }
  return kept;
}

// Drops in place, by the places that are nearest to the corners.
NOINLINE static int drop_by_corners(list_t* list, int count, box_t box) {
  const spans_t spans = spans_of(box);
  const float4 w = between_centres(box) * (float)ONE;  // twice the way to a corner
  const float more = (w.x * w.x + w.y * w.y + w.z * w.z) / 4;
  int8 nearest[8];
#pragma unroll
  for (int i = 0; i < 8; ++i) nearest[i] = INT_MAX;
  for (int k = 0; k < count; k += 8) {
    const floats8_t f = floats_of(load_from_list(list, k));
    const float8 x = w.x * f.x, y = w.y * f.y, z = w.z * f.z, n = f.n + more;
    float8 to[8];
    to[0] = n - x, to[1] = n + x;
    to[2] = to[0] + y, to[3] = to[1] + y, to[0] -= y, to[1] -= y;
#pragma unroll
    for (int i = 0; i < 4; ++i) to[4 + i] = to[i] + z, to[i] -= z;
#pragma unroll
    for (int i = 0; i < 8; ++i) nearest[i] = min(nearest[i], nearness_of(to[i], k, count));
  }
  rival_t rivals[8];
  int numbers[8], some = 0;
  for (int i = 0; i < 8; ++i) {
    const int number = number_of(nearest[i]);
    bool is_known = false;
    for (int j = 0; j < some; ++j) is_known |= numbers[j] == number;
    if (is_known) continue;
    numbers[some] = number;
    rivals[some++] = rival_at(place_in(list, number), &spans);
  }
  int kept = 0;
  for (int k = 0; k < count; k += 8) {
    const places8_t p = load_from_list(list, k);
    const floats8_t f = floats_of(p);
    int8 stays = EIGHT + k < count;
    for (int i = 0; i < some; ++i) stays &= may_win(&f, &rivals[i], &spans);
    kept = keep(list, kept, stays, &p, vload8(0, list->at + k));
  }
  return kept;
}

// The axis along which the places of a list lie farthest apart.
static inline int longest_axis(const list_t* list, int count) {
  int8 least_x = INT_MAX, least_y = INT_MAX, least_z = INT_MAX, most_x = INT_MIN, most_y = INT_MIN, most_z = INT_MIN;
  for (int k = 0; k < count; k += 8) {
    const places8_t p = load_from_list(list, k);
    const int8 is_place = EIGHT + k < count, first = (int8)INT_MAX, last = (int8)INT_MIN;
    least_x = min(least_x, select(first, p.x, is_place)), most_x = max(most_x, select(last, p.x, is_place));
    least_y = min(least_y, select(first, p.y, is_place)), most_y = max(most_y, select(last, p.y, is_place));
    least_z = min(least_z, select(first, p.z, is_place)), most_z = max(most_z, select(last, p.z, is_place));
  }
  const int x = ~least_int(~most_x) - least_int(least_x), y = ~least_int(~most_y) - least_int(least_y);
  const int z = ~least_int(~most_z) - least_int(least_z);
  return x >= max(y, z) ? 0 : y >= z ? 1 : 2;
}

// Along one axis, the part (c - d) (c + d - 2 p) of |c - p|^2 - |d - p|^2 where p goes over a width around a middle:
// the least, and the sum of the terms that make it.
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

static inline int lane_of_least(float8 values, int8 numbers) {
  const float least = least_float(values);
  return least_int(select((int8)INT_MAX, numbers, values == least));
}

// Drops in place those that win in no slice of voxels across that axis: the place d that is nearest to a slice's middle
// beats another place c everywhere in the slice if the least of |c - p|^2 - |d - p|^2 is above 0. So few stay of many
// places next to each other along the axis, for no voxel lies between two slices. The differences and sums are whole
// numbers: floats of near places keep their digits.
NOINLINE static int drop_by_slices(list_t* list, int count, box_t box) {
  const int axis = longest_axis(list, count);
  const int *const own = axis == 0 ? list->x : axis == 1 ? list->y : list->z, *const a = axis == 0 ? list->y : list->x,
                   *const b = axis == 2 ? list->y : list->z;
  const float4 w = between_centres(box) * (float)ONE;
  const float w_a = axis == 0 ? w.y : w.x, w_b = axis == 2 ? w.y : w.z;
  const int slices = axis == 0 ? box.sx : axis == 1 ? box.sy : box.sz;
  const int step = ONE * (axis == 0 ? SPACING_X : axis == 1 ? SPACING_Y : SPACING_Z);
  int stays[LIST_ROOM];
  for (int k = 0; k < count; k += 8) store_ints(0, stays + k);
  for (int i = 0; i < slices; ++i) {
    const int twice = (2 * i + 1 - slices) * step;  // the slice's middle
    float8 least = INFINITY;
    int8 nearest = 0;
    for (int k = 0; k < count; k += 8) {
      const lead_t lead = lead_of(vload8(0, own + k), own[0], twice, 0);
      const lead_t lead_a = lead_of(vload8(0, a + k), a[0], 0, 0), lead_b = lead_of(vload8(0, b + k), b[0], 0, 0);
      const float8 away = lead.least + lead_a.least + lead_b.least;
      const int8 is_nearer = (away < least) & (EIGHT + k < count);
      least = select(least, away, is_nearer), nearest = select(nearest, EIGHT + k, is_nearer);
    }
    const int rival = lane_of_least(least, nearest);
    for (int k = 0; k < count; k += 8) {
      const lead_t lead = lead_of(vload8(0, own + k), own[rival], twice, 0);
      const lead_t lead_a = lead_of(vload8(0, a + k), a[rival], 0, w_a);
      const lead_t lead_b = lead_of(vload8(0, b + k), b[rival], 0, w_b);
      const float8 limit = (lead.terms + lead_a.terms + lead_b.terms) * SLICE_MARGIN;
      const int8 wins = lead.least + lead_a.least + lead_b.least <= limit;
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

// Drops in place what another place is seen to beat; crowds are looked at slice by slice.
static inline int drop_beaten(list_t* list, int count, box_t box) {
  if (count > FEW_PLACES) count = drop_by_corners(list, count, box);
  return count > MANY_PLACES ? drop_by_slices(list, count, box) : count;
}

#endif
