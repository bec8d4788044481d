// Places: where seeds lie, as whole numbers of 2^-FRACTION_BITS of a unit of the spacing. With the build
// option VOROCL_FRACTIONS they come as such (of 1/4096 pixel), else as packed pixels, at whose centres seeds
// are, and a bit is enough. A pixel is SPACING_X and its like units long, so that places of all grids are
// those of one metric. A plane is a volume of one slice whose places have no z.
//
// WEIGHTS, with the build option VOROCL_WEIGHTED: a seed's lag is the greatest weight less its own, a whole
// number of LAG_UNIT. Places are compared by |place - pixel|^2 + lag, as if the lag were the square of one
// more coordinate, which all pixels have at 0.
//
// THE TIE RULE. Of the seeds at the least distance the first by z, y and x of its own position wins, then the
// lowest id.

#ifndef VOROCL_EXACT_PLACE
#define VOROCL_EXACT_PLACE

#include "core/lattice.cl"
#include "core/metric.cl"
#include "core/periods.cl"
#include "core/position.cl"
#include "core/units.cl"
#include "core/vector.cl"
#include "exact/lanes.cl"
#include "exact/sizes.cl"

#define HAS_VOXELS (VOROCL_DIMENSIONS == 3)  // seeds come as those of volumes
#ifdef VOROCL_FLAT                           // there is one slice of voxels: a spaced plane
#define IS_VOLUME 0
#else
#define IS_VOLUME HAS_VOXELS
#endif
#define AXES_OF_PLACES (IS_VOLUME ? 3 : 2)
#ifdef VOROCL_MANHATTAN
#define IS_MANHATTAN 1
#else
#define IS_MANHATTAN 0
#endif
#if IS_MANHATTAN && IS_VOLUME
#error "Keys and dominance of volumes are those of Euclidean distances"
#endif

#ifdef VOROCL_WEIGHTED
#define IS_WEIGHTED 1
#else
#define IS_WEIGHTED 0
#endif

#ifdef VOROCL_FRACTIONS
#define FRACTION_BITS MOST_FRACTION_BITS
#else
#define FRACTION_BITS 1
#endif
#define ONE (1 << FRACTION_BITS)
#define HALF (ONE / 2)
#define LOW_BITS (FRACTION_BITS + 1)
#define LAG_UNIT (1 << LOW_BITS)  // so that lags leave the low bits of squares as they are
#if IS_WEIGHTED && (IS_MANHATTAN || LAG_BITS != 2 * FRACTION_BITS - LOW_BITS)
#error "Lags are whole numbers of 2^-LAG_BITS squared pixels, and have a place beside squares alone"
#endif
#define SPACINGS ((int4)(SPACING_X, SPACING_Y, SPACING_Z, 0))
#define IS_SPACED (SPACING_X != 1 || SPACING_Y != 1 || SPACING_Z != 1)
#define NO_PLACE 0xffffffffu
#if 2 * FRACTION_BITS + 2 > 31
#error "The sum of two squared fractions must fit in 31 bits"
#endif

#ifndef VOROCL_FRACTIONS
typedef uint given_t;
static inline bool is_given(given_t given) { return !(given & EMPTY_BIT); }
static inline int4 place_of(given_t given) {
  return (int4)(x_of(given), y_of(given), IS_VOLUME ? z_of(given) : 0, 0) * ONE +
         (int4)(HALF, HALF, IS_VOLUME ? HALF : 0, 0);
}
#elif HAS_VOXELS
typedef int4 given_t;
static inline bool is_given(given_t given) { return given.x != ABSENT; }
static inline int4 place_of(given_t given) { return given; }
#else
typedef int2 given_t;
static inline bool is_given(given_t given) { return given.x != ABSENT; }
static inline int4 place_of(given_t given) { return (int4)(given, 0, 0); }
#endif

#endif
