// Lists of the places that may be nearest to a pixel of a box, and dropping those that another one dominates.
//
// DOMINANCE. What is nearer than a place at every pixel of a box drops it. A box is a square of pixel centres, and for
// both metrics the least of "how much farther is c than d" over it is at one of its corners (docs/exact.md): with the
// origin at the box's centre and w from its first pixel centre to its last, for the Euclidean metric
//   (cx - dx) (cx + dx) - w |cx - dx| + (cy - dy) (cy + dy) - w |cy - dy|.
// It is computed in float. A place stays unless that is above a margin which is greater than every error, so that
// floats drop places and decide nothing.

#ifndef VOROCL_EXACT_CANDIDATES
#define VOROCL_EXACT_CANDIDATES

#include "exact/index.cl"

#define EIGHT ((int8)(0, 1, 2, 3, 4, 5, 6, 7))
#ifndef MOST_IN_LIST
#define MOST_IN_LIST 1000  // places of a list
#endif
#define LIST_ROOM (MOST_IN_LIST + 3 * LANES_OF_POINTS)
#define NUMBERS 1024  // of the places of a list

#if MOST_IN_LIST < 2 * 8
#error "A list must hold eight places besides those that it is gathered by"
#endif
#if LIST_ROOM > NUMBERS
#error "The numbers of a list's places must fit beside their distances"
#endif

// In units from the centre of a box; and where the place stands in the index.
typedef struct {
  int x[LIST_ROOM], y[LIST_ROOM];
  uint at[LIST_ROOM];
} list_t;

// A place that drops others of a box.
typedef struct {
  float x, y;
  float w, limit;  // with the margins of docs/exact.md
} rival_t;

// The lanes of a mask, packed to the front: 4 bits each.
constant uint packed_lanes[256] = {
  0x00000000, 0x00000000, 0x00000001, 0x00000010, 0x00000002, 0x00000020, 0x00000021, 0x00000210,
  0x00000003, 0x00000030, 0x00000031, 0x00000310, 0x00000032, 0x00000320, 0x00000321, 0x00003210,
  0x00000004, 0x00000040, 0x00000041, 0x00000410, 0x00000042, 0x00000420, 0x00000421, 0x00004210,
  0x00000043, 0x00000430, 0x00000431, 0x00004310, 0x00000432, 0x00004320, 0x00004321, 0x00043210,
  0x00000005, 0x00000050, 0x00000051, 0x00000510, 0x00000052, 0x00000520, 0x00000521, 0x00005210,
  0x00000053, 0x00000530, 0x00000531, 0x00005310, 0x00000532, 0x00005320, 0x00005321, 0x00053210,
  0x00000054, 0x00000540, 0x00000541, 0x00005410, 0x00000542, 0x00005420, 0x00005421, 0x00054210,
  0x00000543, 0x00005430, 0x00005431, 0x00054310, 0x00005432, 0x00054320, 0x00054321, 0x00543210,
  0x00000006, 0x00000060, 0x00000061, 0x00000610, 0x00000062, 0x00000620, 0x00000621, 0x00006210,
  0x00000063, 0x00000630, 0x00000631, 0x00006310, 0x00000632, 0x00006320, 0x00006321, 0x00063210,
  0x00000064, 0x00000640, 0x00000641, 0x00006410, 0x00000642, 0x00006420, 0x00006421, 0x00064210,
  0x00000643, 0x00006430, 0x00006431, 0x00064310, 0x00006432, 0x00064320, 0x00064321, 0x00643210,
  0x00000065, 0x00000650, 0x00000651, 0x00006510, 0x00000652, 0x00006520, 0x00006521, 0x00065210,
  0x00000653, 0x00006530, 0x00006531, 0x00065310, 0x00006532, 0x00065320, 0x00065321, 0x00653210,
  0x00000654, 0x00006540, 0x00006541, 0x00065410, 0x00006542, 0x00065420, 0x00065421, 0x00654210,
  0x00006543, 0x00065430, 0x00065431, 0x00654310, 0x00065432, 0x00654320, 0x00654321, 0x06543210,
  0x00000007, 0x00000070, 0x00000071, 0x00000710, 0x00000072, 0x00000720, 0x00000721, 0x00007210,
  0x00000073, 0x00000730, 0x00000731, 0x00007310, 0x00000732, 0x00007320, 0x00007321, 0x00073210,
  0x00000074, 0x00000740, 0x00000741, 0x00007410, 0x00000742, 0x00007420, 0x00007421, 0x00074210,
  0x00000743, 0x00007430, 0x00007431, 0x00074310, 0x00007432, 0x00074320, 0x00074321, 0x00743210,
  0x00000075, 0x00000750, 0x00000751, 0x00007510, 0x00000752, 0x00007520, 0x00007521, 0x00075210,
  0x00000753, 0x00007530, 0x00007531, 0x00075310, 0x00007532, 0x00075320, 0x00075321, 0x00753210,
  0x00000754, 0x00007540, 0x00007541, 0x00075410, 0x00007542, 0x00075420, 0x00075421, 0x00754210,
  0x00007543, 0x00075430, 0x00075431, 0x00754310, 0x00075432, 0x00754320, 0x00754321, 0x07543210,
  0x00000076, 0x00000760, 0x00000761, 0x00007610, 0x00000762, 0x00007620, 0x00007621, 0x00076210,
  0x00000763, 0x00007630, 0x00007631, 0x00076310, 0x00007632, 0x00076320, 0x00076321, 0x00763210,
  0x00000764, 0x00007640, 0x00007641, 0x00076410, 0x00007642, 0x00076420, 0x00076421, 0x00764210,
  0x00007643, 0x00076430, 0x00076431, 0x00764310, 0x00076432, 0x00764320, 0x00764321, 0x07643210,
  0x00000765, 0x00007650, 0x00007651, 0x00076510, 0x00007652, 0x00076520, 0x00076521, 0x00765210,
  0x00007653, 0x00076530, 0x00076531, 0x00765310, 0x00076532, 0x00765320, 0x00765321, 0x07653210,
  0x00007654, 0x00076540, 0x00076541, 0x00765410, 0x00076542, 0x00765420, 0x00765421, 0x07654210,
  0x00076543, 0x00765430, 0x00765431, 0x07654310, 0x00765432, 0x07654320, 0x07654321, 0x76543210,
};

// Stores eight values in one piece: PoCL's vstore8() makes two, and its compiler then makes the values lane by lane.
typedef struct __attribute__((packed)) {
  int8 values;
} ints_t;
typedef struct __attribute__((packed)) {
  uint8 values;
} uints_t;
static inline void store_ints(int8 values, int* to) { ((ints_t*)to)->values = values; }
static inline void store_uints(uint8 values, uint* to) { ((uints_t*)to)->values = values; }

static inline uint8 permuted(uint8 values, uint8 lanes) {
  return (uint8)(values[lanes.s0], values[lanes.s1], values[lanes.s2], values[lanes.s3], values[lanes.s4],
                 values[lanes.s5], values[lanes.s6], values[lanes.s7]);
}

static inline uint mask_of(int8 condition) {
  const ulong bits = as_ulong(convert_char8(condition)) & 0x8040201008040201ul;
  return (uint)((bits * 0x0101010101010101ul) >> 56);
}

static inline int least_of(int8 values) {
  const int4 a = min(values.lo, values.hi);
  const int2 b = min(a.lo, a.hi);
  return min(b.x, b.y);
}

// Writes the lanes that stay behind the list's first `kept` places; the others' lanes are overwritten later.
static inline int keep(list_t* list, int kept, int8 stays, int8 x, int8 y, uint8 at) {
  const uint mask = mask_of(stays);
  const uint8 lanes = ((uint8)packed_lanes[mask] >> (uint8)(0, 4, 8, 12, 16, 20, 24, 28)) & 7u;
  store_ints(as_int8(permuted(as_uint8(x), lanes)), list->x + kept);
  store_ints(as_int8(permuted(as_uint8(y), lanes)), list->y + kept);
  store_uints(permuted(at, lanes), list->at + kept);
  return kept + (int)popcount(mask);
}

// What orders places by their distance from the origin.
static inline float8 away_from(float8 x, float8 y) {
#ifdef VOROCL_EUCLIDEAN
  return fma(x, x, y * y);
#else
  return fabs(x) + fabs(y);
#endif
}

// In units from the centre of a box of `side` pixels.
static inline rival_t rival_at(int2 place, int side) {
  const float x = (float)place.x, y = (float)place.y, w = (float)((side - 1) * ONE_PIXEL);
#ifdef VOROCL_EUCLIDEAN
  const rival_t rival = {x, y, w * (1 + 0x1p-20f), fma(x, x, y * y) * (1 + 0x1p-20f) + w * w * 0x1p-22f};
#else
  const rival_t rival = {x, y, w / 2, (fabs(x) + fabs(y)) * 0x1p-19f + ONE_PIXEL * 0x1p-9f};
#endif
  return rival;
}

// One that drops nothing.
static inline rival_t no_rival(void) {
  const rival_t rival = {0, 0, 0, INFINITY};
  return rival;
}

// Whether a rival may not drop places.
static inline int8 may_win(float8 x, float8 y, rival_t rival) {
#ifdef VOROCL_EUCLIDEAN
  return fma(fabs(x - rival.x) + fabs(y - rival.y), (float8)-rival.w, away_from(x, y)) <= rival.limit;
#else
  const float w = rival.w;
  const float8 west = fabs(x + w) - fabs(rival.x + w), east = fabs(x - w) - fabs(rival.x - w);
  const float8 north = fabs(y + w) - fabs(rival.y + w), south = fabs(y - w) - fabs(rival.y - w);
  return fmin(west, east) + fmin(north, south) <= fma(fabs(x) + fabs(y), (float8)0x1p-19f, (float8)rival.limit);
#endif
}

// A number that is least for the nearest of a list's places, or for one that is farther by some parts in 2^13, and
// names it.
static inline int8 nearness_of(float8 away, int first, int count) {
  const int8 number = EIGHT + first;
  return select((int8)INT_MAX, (as_int8(away) & ~(NUMBERS - 1)) | number, number < count);
}
static inline int number_of(int8 nearness) { return least_of(nearness) & (NUMBERS - 1); }

static inline void load_floats(const list_t* list, int k, float8* x, float8* y) {
  *x = convert_float8(vload8(0, list->x + k));
  *y = convert_float8(vload8(0, list->y + k));
}

// The number of a place that is nearest to a point, or nearly so.
static inline int nearest_of(const list_t* list, int count, int2 point) {
  int8 nearest = INT_MAX;
  for (int k = 0; k < count; k += 8) {
    float8 x, y;
    load_floats(list, k, &x, &y);
    nearest = min(nearest, nearness_of(away_from(x - (float)point.x, y - (float)point.y), k, count));
  }
  return number_of(nearest);
}

// Copies the places that stay, relative to the centre of a box; so is the rival.
static inline int drop_by(const list_t* from, int count, list_t* to, int2 centre, rival_t rival) {
  int kept = 0;
  for (int k = 0; k < count; k += 8) {
    const int8 x = vload8(0, from->x + k) - centre.x, y = vload8(0, from->y + k) - centre.y;
    const int8 stays = may_win(convert_float8(x), convert_float8(y), rival) & (EIGHT + k < count);
    kept = keep(to, kept, stays, x, y, vload8(0, from->at + k));
  }
  return kept;
}

// The same in place, by the places that are nearest to the four corners.
static inline int drop_by_corners(list_t* list, int count, int side) {
  const float corner = (float)((side - 1) * HALF_PIXEL);
  int8 nearest[4] = {INT_MAX, INT_MAX, INT_MAX, INT_MAX};
  for (int k = 0; k < count; k += 8) {
    float8 x, y;
    load_floats(list, k, &x, &y);
    nearest[0] = min(nearest[0], nearness_of(away_from(x + corner, y + corner), k, count));
    nearest[1] = min(nearest[1], nearness_of(away_from(x - corner, y + corner), k, count));
    nearest[2] = min(nearest[2], nearness_of(away_from(x + corner, y - corner), k, count));
    nearest[3] = min(nearest[3], nearness_of(away_from(x - corner, y - corner), k, count));
  }
  rival_t rivals[4];
#pragma unroll
  for (int i = 0; i < 4; ++i) {
    const int number = number_of(nearest[i]);
    rivals[i] = rival_at((int2)(list->x[number], list->y[number]), side);
  }
  int kept = 0;
  for (int k = 0; k < count; k += 8) {
    float8 x, y;
    load_floats(list, k, &x, &y);
    int8 stays = EIGHT + k < count;
#pragma unroll
    for (int i = 0; i < 4; ++i) stays &= may_win(x, y, rivals[i]);
    kept = keep(list, kept, stays, vload8(0, list->x + k), vload8(0, list->y + k), vload8(0, list->at + k));
  }
  return kept;
}

#endif
