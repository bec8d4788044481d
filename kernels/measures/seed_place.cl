// Where the seeds of a diagram lie, as its measures see it. Seeds are packed positions of the window's pixels
// (core/position.cl) or of a volume's voxels (volumes/position.cl). With the build option VOROCL_FAR they are
// coordinates, and some in a plane lie outside the pixels: whole pixels, or with VOROCL_FRACTIONS fractions of them
// (core/units.cl).
//
// THE RULE OF PLACE. Where the window shows one whole period of an axis (PERIODIC_X and its like), a pixel lies the
// shorter way round from its seed, perhaps outside the window; half a period away it is behind the seed. Along other
// axes it lies where the window shows it. Distances go the shorter way round along every axis that has a period, shown
// whole or not.
//
// In TILTED GRIDS (core/lattice.cl) a pixel lies the shortest of all ways from its seed. Of equally short ones it is
// that to the nearest slice and row of images, and of two equally near the one above the pixel. Images may lie between
// pixels: then a pixel's place is the pixel that holds its centre.

#ifndef VOROCL_SEED_PLACE
#define VOROCL_SEED_PLACE

// What both kinds of positions need comes first, for a file is included once, whichever branch that is in.
#include "core/lattice.cl"
#include "core/metric.cl"
#include "core/position.cl"
#include "core/units.cl"
#include "measures/runs.cl"

// The window: its pixels, the periods that distances know, 0 along an axis without one, and the tilts.
typedef struct {
  int width, height, depth, period_x, period_y, period_z;
  int4 tilts;
} window_t;

// From a seed to a pixel's centre along x, y and z, in units; then 0. (A struct of three numbers would go through
// memory.)
typedef int4 way_t;

#ifdef VOROCL_FAR
#if VOROCL_DIMENSIONS == 3
typedef int4 seed_t;
#define Z_OF(seed) ((seed).z)
#else
typedef int2 seed_t;
#define Z_OF(seed) 0
#endif

static inline window_t window_of(int4 size, int8 lattice) {
  const int period_z = VOROCL_DIMENSIONS == 3 ? lattice.s2 : 0;
  const window_t window = {size.x, size.y, DEPTH(size), lattice.s0, lattice.s1, period_z, lattice.hi};
  return window;
}

static inline bool is_there(seed_t seed) { return seed.x != ABSENT; }

// Its pixel: in the window, along an axis that is shown whole.
static inline int seed_x(seed_t seed, int width) { return wrapped(seed.x >> UNIT_BITS, width, PERIODIC_X); }
static inline int seed_y(seed_t seed, int height) { return wrapped(seed.y >> UNIT_BITS, height, PERIODIC_Y); }
static inline int seed_z(seed_t seed) {
  (void)seed;
  return Z_OF(seed) >> UNIT_BITS;
}

// How far behind a seed the centre of its own pixel is.
static inline int centre_behind_x(seed_t seed) { return CENTRE - (seed.x & (UNIT - 1)); }
static inline int centre_behind_y(seed_t seed) { return CENTRE - (seed.y & (UNIT - 1)); }
static inline int centre_behind_z(seed_t seed) {
  (void)seed;
  return CENTRE - (Z_OF(seed) & (UNIT - 1));
}

// From a seed to a pixel along one axis, in the grid; and the shorter way.
static inline long inside_x(seed_t seed, int x) { return (long)x * UNIT + CENTRE - seed.x; }
static inline long inside_y(seed_t seed, int y) { return (long)y * UNIT + CENTRE - seed.y; }
static inline long inside_z(seed_t seed, int z) {
  (void)seed, (void)z;
  return VOROCL_DIMENSIONS == 3 ? (long)z * UNIT + CENTRE - Z_OF(seed) : 0;
}
static inline int way_x(seed_t seed, int x, window_t window) {
  return (int)shorter_way_of(inside_x(seed, x), (long)window.period_x * UNIT);
}
static inline int way_y(seed_t seed, int y, window_t window) {
  return (int)shorter_way_of(inside_y(seed, y), (long)window.period_y * UNIT);
}
static inline int way_z(seed_t seed, int z, window_t window) {
  return (int)shorter_way_of(inside_z(seed, z), (long)window.period_z * UNIT);
}
#else
typedef uint seed_t;

// No axis has a period but those that are shown whole: they are known when the kernel is built.
static inline window_t window_of(int4 size, int8 lattice) {
  (void)lattice;
  const window_t window = {size.x,
                           size.y,
                           DEPTH(size),
                           PERIODIC_X ? size.x : 0,
                           PERIODIC_Y ? size.y : 0,
                           PERIODIC_Z ? DEPTH(size) : 0,
                           0};  // no tilts
  return window;
}

static inline bool is_there(seed_t seed) { return !(seed & EMPTY_BIT); }

static inline int seed_z(seed_t seed) { return z_of(seed); }
static inline int seed_x(seed_t seed, int width) {
  (void)width;
  return x_of(seed);
}
static inline int seed_y(seed_t seed, int height) {
  (void)height;
  return y_of(seed);
}

static inline int centre_behind_x(seed_t seed) {
  (void)seed;
  return 0;
}
static inline int centre_behind_y(seed_t seed) {
  (void)seed;
  return 0;
}
static inline int centre_behind_z(seed_t seed) {
  (void)seed;
  return 0;
}

static inline int way_x(seed_t seed, int x, window_t window) {
  return shorter_way(x - x_of(seed), window.width, PERIODIC_X);
}
static inline int way_y(seed_t seed, int y, window_t window) {
  return shorter_way(y - y_of(seed), window.height, PERIODIC_Y);
}
static inline int way_z(seed_t seed, int z, window_t window) {
  return shorter_way(z - seed_z(seed), window.depth, PERIODIC_Z);
}
#endif

// What kernels take of a diagram's seeds and its window; the list of seeds ends with one that is absent, and labels
// that are no seed's id are clamped to it.
#define SEED_PARAMETERS global const seed_t *restrict seeds, uint count, int8 lattice, int4 size

// The pixel at the end of a way from a seed: where that is, as the rule of place says.
static inline int place_x(seed_t seed, int way, int width) {
  return seed_x(seed, width) + ((way - centre_behind_x(seed) + UNIT / 2) >> UNIT_BITS);
}
static inline int place_y(seed_t seed, int way, int height) {
  return seed_y(seed, height) + ((way - centre_behind_y(seed) + UNIT / 2) >> UNIT_BITS);
}

static inline int place_z(seed_t seed, int way) {
  return seed_z(seed) + ((way - centre_behind_z(seed)) >> UNIT_BITS);
}

// The distance of a way, in units (squared, if Euclidean).
static inline LENGTH length_of(way_t way) {
  const LENGTH x = way.x, y = way.y, z = way.z;
  return ALONG_X(x) + ALONG_Y(y) + ALONG_Z(z);
}

#ifdef VOROCL_FRACTIONS
static inline bool is_tilted(window_t window) { return any(window.tilts.xyz != 0); }
#else
static inline bool is_tilted(window_t window) {
  (void)window;
  return false;
}
#endif

static inline way_t way_to(seed_t seed, int x, int y, int z, window_t window) {
#ifdef VOROCL_FRACTIONS
  if (is_tilted(window)) {
    const lattice_t lattice = lattice_of(window.period_x, window.period_y, window.period_z, window.tilts, UNIT);
    const way_t spacings = (way_t)(SPACING_X, SPACING_Y, SPACING_Z, 1);
    return shortest_way_round(&lattice, inside_x(seed, x) * SPACING_X, inside_y(seed, y) * SPACING_Y,
                              inside_z(seed, z) * SPACING_Z) / spacings;
  }
#endif
  return (way_t)(way_x(seed, x, window), way_y(seed, y, window), way_z(seed, z, window), 0);
}

// The distance from a pixel to a seed; NO_SEED, which is more than any, to one that is absent.
#define NO_SEED MOST_LENGTH
static inline LENGTH distance_to(seed_t seed, int x, int y, int z, window_t window) {
  return is_there(seed) ? length_of(way_to(seed, x, y, z, window)) : NO_SEED;
}

// Ways go from just above -period / 2 to period / 2, where they jump. Whether a way goes on by a step of pixels without
// a jump.
static inline bool goes_on(int way, int step, int period) {
  const LENGTH round = (LENGTH)period * UNIT, next = (LENGTH)way + step * UNIT;
  return period == 0 || (next <= round / 2 && next >= -((round - 1) / 2));
}

// The end of the piece of pixels [from, to) that begins at `from`, which is `way` from the seed, and has no jump.
static inline int piece_end(int from, int to, int way, int period) {
  return period == 0 ? to : from + (int)min((LENGTH)(to - from), (((LENGTH)period * UNIT / 2 - way) >> UNIT_BITS) + 1);
}

// Pixels of one row from the beginning of a piece to its end, and the way from their seed to the first of them. To the
// others the way goes on along x.
typedef struct {
  int end;
  way_t way;
} piece_t;

// The piece of pixels [from, to) of a row that begins at `from`. In a tilted grid the pixels of a row that are nearest
// to an image follow each other, for along the row the image's lead on another one grows or falls: its end is found
// between such a pixel and one that is not.
static inline piece_t piece_from(seed_t seed, int from, int to, int y, int z, window_t window) {
  piece_t piece = {to, way_to(seed, from, y, z, window)};
  if (!is_tilted(window)) {
    piece.end = piece_end(from, to, piece.way.x, window.period_x);
    return piece;
  }
  int inside = from, outside = to;
  for (int at = to - 1; outside - inside > 1; at = (inside + outside) / 2) {
    const way_t way = way_to(seed, at, y, z, window);
    if (way.x - piece.way.x == (at - from) * UNIT && way.y == piece.way.y && way.z == piece.way.z) {
      inside = at;
    } else {
      outside = at;
    }
  }
  piece.end = outside;
  return piece;
}

#endif
