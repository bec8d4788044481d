// Places: where seeds lie, as whole numbers of 2^-FRACTION_BITS of a unit of the spacing. With the build option
// VOROCL_FRACTIONS they come as such (of 1/4096 voxel), else as packed voxels, at whose centres seeds are, and a bit
// is enough. A voxel is SPACING_X and its like units long, so that places of all grids are those of one metric.
//
// THE TIE RULE. Of the seeds at the least distance the first by z, y and x of its own position wins, then the lowest
// id.

#ifndef VOROCL_POINTS_PLACE
#define VOROCL_POINTS_PLACE

#include "points/lanes.cl"
#include "points/sizes.cl"
#include "volumes/position.cl"

#ifdef VOROCL_MANHATTAN
#error "The keys and the dominance of places are those of Euclidean distances"
#endif

#define ABSENT INT_MIN
#ifdef VOROCL_FRACTIONS
#define FRACTION_BITS 12
typedef int4 given_t;
#else
#define FRACTION_BITS 1
typedef uint given_t;
#endif
#define ONE (1 << FRACTION_BITS)
#define HALF (ONE / 2)
#define LOW_BITS (FRACTION_BITS + 1)
#define SPACINGS ((int4)(SPACING_X, SPACING_Y, SPACING_Z, 0))
#define IS_SPACED (SPACING_X != 1 || SPACING_Y != 1 || SPACING_Z != 1)
#define NO_PLACE 0xffffffffu

#ifdef VOROCL_FRACTIONS
static inline bool is_given(given_t given) { return given.x != ABSENT; }
static inline int4 place_of(given_t given) { return given; }
#else
static inline bool is_given(given_t given) { return !(given & EMPTY); }
static inline int4 place_of(given_t given) {
  return (int4)(x_of(given), y_of(given), z_of(given), 0) * ONE + (int4)(HALF, HALF, HALF, 0);
}
#endif

#endif
