// Seed positions, distances and the tie rule: what every engine must agree on, to the bit.
//
// A seed's position is packed as y << 16 | x. The sign bit says that there is no seed (EMPTY); real coordinates
// are at most 0x7fff.

#ifndef VOROCL_POSITION
#define VOROCL_POSITION

#include "vector.cl"

#define NO_LABEL 0xffffffffu
#define EMPTY_BIT 0x80000000u
#define EMPTY 0x80008000u
#define LAST_COORDINATE 0x7fff
#define NO_DISTANCE 0x7fffffffu  // what results say where there is no seed: more than any distance

static inline uint pack(int x, int y) { return (uint)y << 16 | (uint)x; }
static inline int packed_x(uint position) { return (int)(position & 0xffffu); }
static inline int packed_y(uint position) { return (int)(position >> 16); }

// Where a seed's pixel is in a row-major image.
static inline uint_v pixel_index(uint_v position, int width) {
  return (position >> 16) * (uint)width + (position & 0xffffu);
}

// The list of seed positions has one value more than there are seeds: EMPTY. A label that is no seed's id is clamped to
// it when its position is looked up.

// An image of ids starts with NO_LABEL, which is looked up for an empty label; the pixels follow.
#define FIRST_ID 1

// Packed positions of a vector's own pixels. No carry: x + VOROCL_WIDTH <= 32768.
static inline uint_v vector_positions(int x, int y) { return pack(x, y) + LANES; }

// DISTANCES. A distance is the sum of ALONG(offset) over both axes: the squared distance for VOROCL_EUCLIDEAN, else the
// Manhattan distance, both integers. ALONG(offset) is offset * FACTOR(offset). Both macros take numbers and vectors,
// FACTOR those of 16 bits.
#ifdef VOROCL_EUCLIDEAN
#define ALONG(offset) ((offset) * (offset))
#define FACTOR(offset) (offset)
#else
#define ALONG(offset) max(offset, -(offset))
#define FACTOR(offset) (((offset) >> (short)15) | (short)1)  // the sign: -1 or 1
#endif

#if 2 * LAST_COORDINATE * LAST_COORDINATE >= 0x80000000
#error "A distance uses the bit that makes an empty position farther than any seed"
#endif

// The distance of two pixels that are (dx, dy) apart.
static inline uint distance_of_offset(int dx, int dy) { return (uint)(ALONG(dx) + ALONG(dy)); }

// The distance between two packed positions, vectors of them. The coordinates are subtracted as 16-bit numbers, which
// cannot overflow for real positions. The distance is then the sum of two products of 16-bit numbers, a form that
// compilers turn into one multiply-add instruction (pmaddwd on x86).
#define DEFINE_DISTANCE_BETWEEN(name, uint_n, short_2n, as_uint_n, as_short_2n, convert_int_n)        \
  static inline uint_n name(uint_n a, uint_n b) {                                                     \
    const short_2n difference = as_short_2n(a) - as_short_2n(b);                                      \
    const short_2n factor = FACTOR(difference);                                                       \
    return as_uint_n(convert_int_n(difference.even) * convert_int_n(factor.even) +                    \
                     convert_int_n(difference.odd) * convert_int_n(factor.odd));                      \
  }

#if VOROCL_WIDTH == 1
DEFINE_DISTANCE_BETWEEN(distance_between, uint, short2, as_uint, as_short2, convert_int)
#elif VOROCL_WIDTH == 2
DEFINE_DISTANCE_BETWEEN(distance_between, uint2, short4, as_uint2, as_short4, convert_int2)
#elif VOROCL_WIDTH == 4
DEFINE_DISTANCE_BETWEEN(distance_between, uint4, short8, as_uint4, as_short8, convert_int4)
#elif VOROCL_WIDTH == 8
DEFINE_DISTANCE_BETWEEN(distance_between, uint8, short16, as_uint8, as_short16, convert_int8)
#else
// The vectors of OpenCL C end at 16 values. Those of clang do not, and the drivers of CPUs are built on clang. Two halves
// of 8 pixels that are joined afterwards become 17 instructions instead of 2 from LLVM 18 on, because it joins them
// before it looks for the multiply-add.
typedef short short32 __attribute__((ext_vector_type(32)));
#define as_short32(values) __builtin_astype(values, short32)
DEFINE_DISTANCE_BETWEEN(distance_between, uint16, short32, as_uint16, as_short32, convert_int16)
#endif

// As distance_between(), where the position may be empty: that is farther than any seed. The subtraction makes a
// meaningless number of an empty position, but the sign bit alone puts it past every real distance.
static inline uint_v distance_to_label(uint_v position, uint_v pixel) {
  return distance_between(position, pixel) | (position & EMPTY_BIT);
}

// THE TIE RULE: of the seeds at the least distance, the one that comes first in row-major order of position wins. That
// is the unsigned order of packed positions. The macros take numbers and vectors.
#define COMES_FIRST(seed, other) ((seed) < (other))
#define WINS(seed, distance, other, other_distance) \
  (((distance) < (other_distance)) | (((distance) == (other_distance)) & COMES_FIRST(seed, other)))

// One step of a search for the first of the nearest seeds where the least distance is known: takes a candidate that has
// it, if it comes first.
static inline uint_v first_of_nearest(uint_v best, uint_v candidate, uint_v distance, uint_v least) {
  return select(best, min(best, candidate), distance == least);
}

// The seed that wins among the lanes of a vector.
static inline uint winning_lane(uint_v seeds, uint_v distances) {
  return lane_min(select((uint_v)0xffffffffu, seeds, distances == lane_min(distances)));
}

#endif
