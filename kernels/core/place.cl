// Placing points on the device: which pixel of a grid each falls in, where in it, and which are absent,
// outside or bad.

#include "core/place_sizes.cl"
#if VOROCL_WIDTH > MOST_POINTS_OF_ITEM
#undef VOROCL_WIDTH
#define VOROCL_WIDTH MOST_POINTS_OF_ITEM
#endif
#include "core/axis.cl"

// What a list has at a vector of indices, and the lanes of two vectors in turn.
#if VOROCL_WIDTH == 1
#define GATHERED(list, at) (list)[at]
#define CONVERT_FLAGS(condition) (condition)
#define IN_TURN(x, y) (int2)(x, y)
#define PLACES_WIDTH 2
#elif VOROCL_WIDTH == 2
#define GATHERED(list, at) (list)[at.s0], (list)[at.s1]
#define CONVERT_FLAGS convert_int2
#define IN_TURN(x, y) (int4)(x.s0, y.s0, x.s1, y.s1)
#define PLACES_WIDTH 4
#else
#define GATHERED(list, at) (list)[at.s0], (list)[at.s1], (list)[at.s2], (list)[at.s3]
#define CONVERT_FLAGS convert_int4
#define IN_TURN(x, y) (int8)(x.s0, y.s0, x.s1, y.s1, x.s2, y.s2, x.s3, y.s3)
#define PLACES_WIDTH 8
#endif

// Past it a position leaves 32 bits.
#define TOO_FAR 2147483648.0

// A grid: its axes, and how far along x it repeats a period of y onward, and along x and y a period of z onward.
typedef struct {
  axis_t x, y, z;
  double4 tilts;
} grid_t;

static inline flags is_on(axis_t axis, double_v pixel) { return pixel >= 0 && pixel < axis.count; }
static inline flags is_near(axis_t axis, double_v pixel) {
  return pixel >= axis.count - TOO_FAR && pixel < TOO_FAR;
}

// A vector of points, some of which count.
typedef struct {
  double_v x, y, z;
} points_t;

typedef struct {
  uint_v positions;  // packed
  int_v x, y, z;     // in 1/4096 pixel
  int_v is_absent, is_outside, is_bad;
} places_t;

static inline places_t places_of(const grid_t* grid, points_t at, int has_z, int_v counts, int outside,
                                 int2 bits, uint empty) {
  const flags is_finite = isfinite(at.x) && isfinite(at.y) && isfinite(at.z);
  spots_t x, y, z = {0, PARTS_OF_PIXEL / 2};
  if (has_z) find_spots(grid->z, at.z, &z);
  if (grid->z.count == 1) z.part = PARTS_OF_PIXEL / 2;  // a plane
  const flags is_on_z = is_finite && is_on(grid->z, z.pixel);
  const int_v along_z = CONVERT_INT_V(IF(is_on_z, z.pixel, (double_v)0)) * PARTS_OF_PIXEL + CONVERT_INT_V(z.part);
  if (grid->tilts.s1 != 0 || grid->tilts.s2 != 0) {
    const double_v periods = periods_beyond(grid->z, at.z);
    at.x -= grid->tilts.s1 * periods;
    at.y -= grid->tilts.s2 * periods;
  }
  if (grid->tilts.s0 != 0) at.x -= grid->tilts.s0 * periods_beyond(grid->y, at.y);
  find_spots(grid->x, at.x, &x), find_spots(grid->y, at.y, &y);
  const flags is_on_all = is_on_z && is_on(grid->x, x.pixel) && is_on(grid->y, y.pixel);
  const int_v is_inside = counts && CONVERT_FLAGS(is_on_all), is_beyond = counts && !is_inside;
  const int_v column = CONVERT_INT_V(IF(is_on_all, x.pixel, (double_v)0));
  const int_v row = CONVERT_INT_V(IF(is_on_all, y.pixel, (double_v)0));
  const uint_v packed = AS_UINT_V(along_z / PARTS_OF_PIXEL << (bits.x + bits.y) | row << bits.x | column);
  const flags is_near_all = is_on_z && is_near(grid->x, x.pixel) && is_near(grid->y, y.pixel);
  places_t places;
  places.positions = IF(is_inside, packed, (uint_v)empty);
  places.x = IF(is_inside, column * PARTS_OF_PIXEL + CONVERT_INT_V(x.part), (int_v)INT_MIN);
  places.y = IF(is_inside, row * PARTS_OF_PIXEL + CONVERT_INT_V(y.part), (int_v)0);
  places.z = IF(is_inside, along_z, (int_v)0);
  places.is_absent = outside == OUTSIDE_IS_ABSENT ? is_beyond && CONVERT_FLAGS(is_finite) : (int_v)0;
  places.is_outside = outside == OUTSIDE_COUNTS ? is_beyond && CONVERT_FLAGS(is_near_all) : (int_v)0;
  places.is_bad = is_beyond && !places.is_absent && !places.is_outside;
  return places;
}

static inline void note_bad(global uint* found, uint_v ids, int_v is_bad) {
  if (ANY(is_bad)) atomic_min(found, lane_min(IF(is_bad, ids, (uint_v)UINT_MAX)));
}

static inline void count_in(global uint* found, int_v are) {
  if (ANY(are)) atomic_add(found, lane_sum(IF(are, (uint_v)1, (uint_v)0)));
}

// Places of so many numbers each: (x, y), or (x, y, z, 0).
static inline void store_places(places_t places, int numbers, global int* to, uint some) {
  const JOIN(int, PLACES_WIDTH) in_turn = IN_TURN(places.x, places.y);
  if (numbers == 2 && some >= VOROCL_WIDTH) {
    JOIN(vstore, PLACES_WIDTH)(in_turn, 0, to);
    return;
  }
  int2 lane[VOROCL_WIDTH];
  int z[VOROCL_WIDTH];
  JOIN(vstore, PLACES_WIDTH)(in_turn, 0, (int*)lane);
  STORE_VECTOR(places.z, z);
  for (uint i = 0; i < min(some, (uint)VOROCL_WIDTH); ++i) {
    if (numbers == 2) vstore2(lane[i], i, to);
    if (numbers == 4) vstore4((int4)(lane[i], z[i], 0), i, to);
  }
}

// Points of `dimensions` numbers each: two, or three if they have a z, which is in the grid's first slice
// else. What follows the last one is empty.
#define DEFINE_PLACE(number)                                                                                 \
  static inline double_v number##s_along(global const number* points, int dimensions, uint_v ids, int axis) {\
    points += axis;                                                                                          \
    ids *= (uint)dimensions;                                                                                 \
    return (double_v)(GATHERED(points, ids));                                                                \
  }                                                                                                          \
                                                                                                             \
  kernel void place_##number##s(                                                                             \
      global const number* restrict points, int dimensions, global const uchar* restrict marks,              \
      int absent_by, double2 ends_x, double2 ends_y, double2 ends_z, int4 pixels, int4 kinds, double4 tilts, \
      int outside, uint count, int2 bits, uint empty, global uint* restrict positions, int of_place,         \
      global int* restrict places, global uint* restrict found) {                                            \
    const uint first = (uint)get_global_id(0) * VOROCL_WIDTH;                                                \
    if (first > count) return;                                                                               \
    places_t placed = {empty, INT_MIN, 0, 0, 0, 0, 0};                                                       \
    if (first < count) {                                                                                     \
      const uint_v own = first + LANES, ids = min(own, (uint_v)(count - 1));                                 \
      const int_v is_seed = AS_INT_V(own < count);                                                           \
      const grid_t grid = {axis_of(ends_x, pixels.x, kinds.x), axis_of(ends_y, pixels.y, kinds.y),           \
                           axis_of(ends_z, pixels.z, kinds.z), tilts};                                       \
      points_t at = {number##s_along(points, dimensions, ids, 0),                                            \
                     number##s_along(points, dimensions, ids, 1), 0};                                        \
      if (dimensions > 2) at.z = number##s_along(points, dimensions, ids, 2);                                \
      int_v is_absent = 0;                                                                                   \
      if (absent_by == MARKED_BY_BYTES) is_absent = (int_v)(GATHERED(marks, ids)) == 0;                      \
      if (absent_by == MARKED_BY_POINTS) is_absent = CONVERT_FLAGS(isnan(at.x));                             \
      placed = places_of(&grid, at, dimensions > 2, is_seed && !is_absent, outside, bits, empty);            \
      is_absent = is_seed && (is_absent || placed.is_absent);                                                \
      if (ANY(is_absent || placed.is_outside || placed.is_bad)) {                                            \
        count_in(found + FOUND_ABSENT, is_absent);                                                           \
        count_in(found + FOUND_OUTSIDE, placed.is_outside);                                                  \
        note_bad(found + FOUND_BAD, own, placed.is_bad);                                                     \
      }                                                                                                      \
    }                                                                                                        \
    const uint some = count + 1 - first;                                                                     \
    store_some(placed.positions, positions + first, some);                                                   \
    if (of_place != 0) store_places(placed, of_place, places + (size_t)first * (size_t)of_place, some);      \
  }

DEFINE_PLACE(float)
DEFINE_PLACE(double)
