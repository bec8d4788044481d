// Balls around the corners of a box, and which blocks of places they meet.
//
// BALLS. What is nearest at a corner of a box lies in the ball around it through any known place. What is
// nearest anywhere in the box lies in one of these balls: a ball around a pixel centre of the box, through
// the same place, lies in their union. (By the Manhattan metric balls are diamonds, and so it is with them.)
// Lags make balls smaller: those of the places of a row of bins, or of a block, are at least the least one there.

#ifndef VOROCL_EXACT_BALLS
#define VOROCL_EXACT_BALLS

#include "exact/lists.cl"

// A value for each corner of a box.
#if IS_VOLUME
typedef float8 corners_t;
typedef int8 int_corners_t;
#define EAST ((corners_t)(-1, 1, -1, 1, -1, 1, -1, 1))
#define SOUTH ((corners_t)(-1, -1, 1, 1, -1, -1, 1, 1))
#define BELOW ((corners_t)(-1, -1, -1, -1, 1, 1, 1, 1))
static inline float least_of_corners(corners_t v) { return least_float(v); }
#else
typedef float4 corners_t;
typedef int4 int_corners_t;
#define EAST ((corners_t)(-1, 1, -1, 1))
#define SOUTH ((corners_t)(-1, -1, 1, 1))
#define BELOW ((corners_t)(0))
static inline float least_of_corners(corners_t v) { return fmin(fmin(v.x, v.y), fmin(v.z, v.w)); }
#endif

// Centres and radii, squared if Euclidean and the known place's lag added, in units of the spacing.
typedef struct {
  corners_t x, y, z, n;
} balls_t;

static inline corners_t with_margin(corners_t n) { return n * (1 + 0x1p-16f) + 0x1p-4f; }
#define SQUARED_UNIT (1.f / ((float)ONE * (float)ONE))
static inline corners_t radius_of(corners_t n) { return IS_MANHATTAN ? n : sqrt(n); }

static inline balls_t balls_around(box_t b, float4 place) {
  const float4 half_way = between_centres(b) / 2, centre = convert_float4(centre_of(b)) * (1.f / ONE);
  const corners_t sides_x = EAST * half_way.x, sides_y = SOUTH * half_way.y, sides_z = BELOW * half_way.z;
  const corners_t x = sides_x - place.x * (1.f / ONE), y = sides_y - place.y * (1.f / ONE);
  balls_t balls;
  balls.x = sides_x + centre.x, balls.y = sides_y + centre.y, balls.z = sides_z + centre.z;
#if IS_MANHATTAN
  balls.n = with_margin(fabs(x) + fabs(y));
#else
  const corners_t z = sides_z - place.z * (1.f / ONE);
  const corners_t n = x * x + y * y + (IS_VOLUME ? z * z : 0);
  balls.n = with_margin(IS_WEIGHTED ? n + place.w * SQUARED_UNIT : n);
#endif
  return balls;
}
// One ball, in each lane.
static inline corners_t radius_of_ball(float distance) {
  return with_margin((corners_t)(distance * (IS_MANHATTAN ? 1.f / ONE : SQUARED_UNIT)));
}
static inline balls_t ball_around(int4 centre, float4 place) {
  const float4 middle = convert_float4(centre) * (1.f / ONE);
  balls_t ball;
  ball.x = middle.x, ball.y = middle.y, ball.z = middle.z;
  ball.n = radius_of_ball(distance_of(place));
  return ball;
}

// Of BLOCKS_AT_ONCE blocks: their ends along each axis, and their least lags, in squared units.
typedef struct {
  float8 west, east, north, south, above, below, lag;
} bounds8_t;
#define DEFINE_BOUNDS(name, space)                                           \
  static inline bounds8_t name(space const float* own) {                     \
    bounds8_t b;                                                             \
    b.west = vload8(0, own), b.east = vload8(1, own);                        \
    b.north = vload8(2, own), b.south = vload8(3, own);                      \
    b.above = b.below = b.lag = 0;                                           \
    if (IS_VOLUME) b.above = vload8(4, own), b.below = vload8(5, own);       \
    if (IS_WEIGHTED) b.lag = vload8(2 * AXES_OF_PLACES, own);                \
    return b;                                                                \
  }
DEFINE_BOUNDS(bounds_in_index, global)
DEFINE_BOUNDS(bounds_in_list, private)

// How far outside a range a corner is, along an axis; squared if Euclidean.
static inline float8 outside_by(float8 from, float8 to, float at) {
  const float8 way = fmax(fmax(from - at, at - to), 0.f);
  return IS_MANHATTAN ? way : way * way;
}
// Which of the blocks the balls meet, as bits. Corners share their coordinates.
static inline uint blocks_in_balls(bounds8_t b, const balls_t* balls) {
  const float8 x[2] = {outside_by(b.west, b.east, balls->x[0]), outside_by(b.west, b.east, balls->x[1])};
  const float8 y[2] = {outside_by(b.north, b.south, balls->y[0]), outside_by(b.north, b.south, balls->y[2])};
  float8 z[2] = {b.lag, b.lag};
#if IS_VOLUME
  z[0] += outside_by(b.above, b.below, balls->z[0]), z[1] += outside_by(b.above, b.below, balls->z[4]);
#endif
  int8 meets = 0;
#pragma unroll
  for (int i = 0; i < CORNERS; ++i) meets |= x[i % 2] + y[i / 2 % 2] + z[i / 4] <= balls->n[i];
  return mask_of(meets);
}

// In a crowd a list of blocks, or of parts of them, takes the place of the index: their bounds where their images lie,
// and the origins that images subtract from places. A smaller box has fewer of them, behind the list of its outer box.
#ifndef MOST_BLOCKS
#define MOST_BLOCKS 4096
#endif
#if MOST_BLOCKS % BLOCKS_AT_ONCE != 0
#error "Bounds of a list are read in whole vectors"
#endif
typedef struct {
  float bounds[MOST_BLOCKS * BOUNDS_OF_BLOCK];
  uint from[MOST_BLOCKS], to[MOST_BLOCKS];
  int x[MOST_BLOCKS], y[MOST_BLOCKS], z[MOST_BLOCKS];
} blocks_t;
typedef struct {
  blocks_t* blocks;  // or null: all that is in the index
  int begin, end;
} source_t;
#define THE_INDEX ((source_t){0, 0, 0})

#endif
