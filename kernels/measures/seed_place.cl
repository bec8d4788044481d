// Where the seeds of a diagram lie, as its measures see it. Seeds are packed positions of the window's pixels
// (core/position.cl); with the build option VOROCL_OUTER_SEEDS they are positions in the plane (core/plane.cl), some of
// them outside the pixels; with VOROCL_FRACTIONS besides, these are in fractions of a pixel (core/plane.cl).
//
// THE RULE OF PLACE. Along an axis of which the window shows one whole period (PERIODIC_X, PERIODIC_Y) a pixel lies the
// shorter way round from its seed, half a period away behind it: perhaps outside the window. Along other axes it lies
// where the window shows it. Distances go the shorter way round along every axis that has a period, shown whole or not.

#ifndef VOROCL_SEED_PLACE
#define VOROCL_SEED_PLACE

#include "core/plane.cl"

// The window: its pixels, and the periods that distances know, 0 along an axis without one.
typedef struct {
  int width, height, period_x, period_y;
} window_t;

#ifdef VOROCL_OUTER_SEEDS
typedef int2 seed_t;

static inline window_t window_of(int width, int height, uint2 periods) {
  const window_t window = {width, height, (int)periods.x, (int)periods.y};
  return window;
}

static inline bool is_there(seed_t seed) { return seed.x != ABSENT; }

// Its pixel: in the window, along an axis that is shown whole.
static inline int seed_x(seed_t seed, int width) { return wrapped_x(seed.x >> UNIT_BITS, width); }
static inline int seed_y(seed_t seed, int height) { return wrapped_y(seed.y >> UNIT_BITS, height); }

// How far behind a seed the centre of its own pixel is.
static inline int centre_behind_x(seed_t seed) { return CENTRE - (seed.x & (UNIT - 1)); }
static inline int centre_behind_y(seed_t seed) { return CENTRE - (seed.y & (UNIT - 1)); }

static inline int shorter_way_round(long way, long period) {
  if (period == 0) return (int)way;
  way %= period;
  if (2 * way > period) return (int)(way - period);
  return (int)(2 * way <= -period ? way + period : way);
}

// From a seed to a pixel's centre, along an axis, in units.
static inline int way_x(seed_t seed, int x, window_t window) {
  return shorter_way_round((long)x * UNIT + CENTRE - seed.x, (long)window.period_x * UNIT);
}
static inline int way_y(seed_t seed, int y, window_t window) {
  return shorter_way_round((long)y * UNIT + CENTRE - seed.y, (long)window.period_y * UNIT);
}
#else
typedef uint seed_t;

// No axis has a period but those that are shown whole: they are known when the kernel is built.
static inline window_t window_of(int width, int height, uint2 periods) {
  (void)periods;
  const window_t window = {width, height, PERIODIC_X ? width : 0, PERIODIC_Y ? height : 0};
  return window;
}

static inline bool is_there(seed_t seed) { return !(seed & EMPTY_BIT); }

static inline int seed_x(seed_t seed, int width) {
  (void)width;
  return packed_x(seed);
}
static inline int seed_y(seed_t seed, int height) {
  (void)height;
  return packed_y(seed);
}

static inline int centre_behind_x(seed_t seed) {
  (void)seed;
  return 0;
}
static inline int centre_behind_y(seed_t seed) {
  (void)seed;
  return 0;
}

static inline int way_x(seed_t seed, int x, window_t window) {
  return shorter_way_x(x - packed_x(seed), window.width);
}
static inline int way_y(seed_t seed, int y, window_t window) {
  return shorter_way_y(y - packed_y(seed), window.height);
}
#endif

// What kernels take of a diagram's seeds and its window; the list of seeds ends with one that is absent, and labels
// that are no seed's id are clamped to it.
#define SEED_PARAMETERS global const seed_t *restrict seeds, uint count, uint2 periods, int width, int height

// The pixel at the end of a way from a seed: where that is, as the rule of place says.
static inline int place_x(seed_t seed, int way, int width) {
  return seed_x(seed, width) + ((way - centre_behind_x(seed)) >> UNIT_BITS);
}
static inline int place_y(seed_t seed, int way, int height) {
  return seed_y(seed, height) + ((way - centre_behind_y(seed)) >> UNIT_BITS);
}

// The distance of ways along both axes, in units (squared, if Euclidean).
static inline LENGTH distance_of_ways(int along_x, int along_y) {
  const LENGTH dx = along_x, dy = along_y;
  return ALONG(dx) + ALONG(dy);
}

// The distance from a pixel to a seed; NO_SEED, which is more than any, to one that is absent.
#define NO_SEED MOST_LENGTH
static inline LENGTH distance_to(seed_t seed, int x, int y, window_t window) {
  return is_there(seed) ? distance_of_ways(way_x(seed, x, window), way_y(seed, y, window)) : NO_SEED;
}

// Ways go from just above -period / 2 to period / 2, where they jump. Whether a way goes on by a step of pixels without
// a jump.
static inline bool goes_on(int way, int step, int period) {
  const long round = (long)period * UNIT, next = (long)way + step * UNIT;
  return period == 0 || (next <= round / 2 && next >= -((round - 1) / 2));
}

// The end of the piece of pixels [from, to) that begins at `from`, which is `way` from the seed, and has no jump.
static inline int piece_end(int from, int to, int way, int period) {
  return period == 0 ? to : from + (int)min((long)(to - from), (((long)period * UNIT / 2 - way) >> UNIT_BITS) + 1);
}

#endif
