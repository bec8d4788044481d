// Seed positions, distances and the tie rule: what every engine must agree on, to the bit.
//
// A seed's position is packed as y << 16 | x, in volumes as volumes/position.cl says. The sign bit says that there is
// no seed (EMPTY); real coordinates are at most 0x7fff.

#ifndef VOROCL_POSITION
#define VOROCL_POSITION

#include "core/metric.cl"
#include "core/periods.cl"
#include "core/vector.cl"

#if VOROCL_DIMENSIONS == 3
#include "volumes/position.cl"
#else

#define EMPTY 0x80008000u
#define LAST_COORDINATE 0x7fff

#define SHIFT_Y 16
static inline uint pack(int x, int y) { return (uint)y << SHIFT_Y | (uint)x; }
static inline uint packed(int3 at) { return pack(at.x, at.y); }
static inline int x_of(uint position) { return (int)(position & 0xffffu); }
static inline int y_of(uint position) { return (int)(position >> SHIFT_Y); }
static inline int z_of(uint position) {
  (void)position;
  return 0;
}

// Where a seed's pixel is in a row-major image.
static inline uint index_of_seed(uint position, int width, int height) {
  (void)height;
  return (uint)(y_of(position) * width + x_of(position));
}
static inline uint_v pixel_index(uint_v position, int width) {
  return (position >> 16) * (uint)width + (position & 0xffffu);
}

// The list of seed positions has one value more than there are seeds: EMPTY. A label that is no seed's id is clamped to
// it when its position is looked up.

static inline uint_v look_up_positions(global const uint* labels, global const uint* positions, uint count) {
  uint lane[VOROCL_WIDTH];
  STORE_VECTOR(min(LOAD_VECTOR(labels), (uint_v)count), lane);
  for (int i = 0; i < VOROCL_WIDTH; ++i) lane[i] = positions[lane[i]];
  return LOAD_VECTOR(lane);
}

// Packed positions of a vector's own pixels. No carry: x + VOROCL_WIDTH <= 32768.
static inline uint_v vector_positions(int x, int y) { return pack(x, y) + LANES; }

#if 2 * LAST_COORDINATE * LAST_COORDINATE >= 0x80000000
#error "A distance uses the bit that makes an empty position farther than any seed"
#endif

// The distance of two pixels that are (dx, dy) apart.
static inline uint distance_of_offset(int dx, int dy) { return (uint)(ALONG(dx) + ALONG(dy)); }

// The periods of both axes, packed; on an axis that is not periodic it is too long for a way round.
#define NO_PERIOD 0xffffu
static inline uint periods(int width, int height) {
  return (PERIODIC_X ? (uint)width : NO_PERIOD) | (PERIODIC_Y ? (uint)height : NO_PERIOD) << 16;
}

// The way between two coordinates of an axis, given the way inside the grid.
static inline int shorter_way_x(int inside, int width) { return shorter_way(inside, width, PERIODIC_X); }
static inline int shorter_way_y(int inside, int height) { return shorter_way(inside, height, PERIODIC_Y); }

static inline int wrapped_x(int x, int width) { return wrapped(x, width, PERIODIC_X); }
static inline int wrapped_y(int y, int height) { return wrapped(y, height, PERIODIC_Y); }

// The packed positions of the pixels that a vector has whose first pixel is at (x, y), less than a period outside the
// grid.
static inline uint_v positions_in_grid(int x, int y, int width, int height) {
  x = wrapped_x(x, width);
  const uint_v position = pack(0, wrapped_y(y, height)) + ((uint)x + LANES);  // x may be below 0
  if (!PERIODIC_X || x + VOROCL_WIDTH <= width) return position;
  return select(position - (uint)width, position, (uint)x + LANES < (uint_v)(uint)width);
}

// Two numbers per lane: the coordinates of a vector of positions, of 16 bits. A GPU, which takes pairs of such numbers
// apart, gets 32 bits: a wave of jump flooding takes an eighth fewer instructions.
#if VOROCL_WIDTH == 1
typedef int2 coordinates_v;
#define AS_COORDINATES_V(positions) ((int2)((int)((positions) & 0xffffu), (int)((positions) >> 16)))
#elif VOROCL_WIDTH == 16
// The vectors of OpenCL C end at 16 values. Those of clang do not, and the drivers of CPUs are built on clang. Two
// halves of 8 pixels that are joined afterwards become 17 instructions instead of 2 from LLVM 18 on, because it joins
// them before it looks for the multiply-add.
typedef short coordinates_v __attribute__((ext_vector_type(32)));
#define AS_COORDINATES_V(positions) __builtin_astype(positions, coordinates_v)
#else
#if VOROCL_WIDTH == 8
#define COORDINATES 16
#elif VOROCL_WIDTH == 4
#define COORDINATES 8
#else
#define COORDINATES 4
#endif
typedef JOIN(short, COORDINATES) coordinates_v;
#define AS_COORDINATES_V JOIN(as_short, COORDINATES)
#endif

// The distance between two packed positions, vectors of them. The coordinates are subtracted as 16-bit numbers, which
// cannot overflow for real positions. The distance is then the sum of two products of 16-bit numbers, a form that
// compilers turn into one multiply-add instruction (pmaddwd on x86).
static inline uint_v distance_between_by_offset(coordinates_v offset) {
  const coordinates_v factor = FACTOR(offset);
  return AS_UINT_V(CONVERT_INT_V(offset.even) * CONVERT_INT_V(factor.even) +
                   CONVERT_INT_V(offset.odd) * CONVERT_INT_V(factor.odd));
}
static inline uint_v distance_between(uint_v a, uint_v b) {
  return distance_between_by_offset(AS_COORDINATES_V(a) - AS_COORDINATES_V(b));
}

// The distance between two packed positions of the grid, the shorter way round along periodic axes; `period` is that of
// periods().
static inline uint_v distance_in_grid(uint_v a, uint_v b, uint period) {
#ifdef VOROCL_PERIODIC
  const coordinates_v offset = AS_COORDINATES_V(a) - AS_COORDINATES_V(b), whole = AS_COORDINATES_V((uint_v)period);
  const coordinates_v half_of_it = AS_COORDINATES_V((uint_v)(period >> 1 & 0x7fff7fffu));
  return distance_between_by_offset(offset - (whole & (offset > half_of_it)) + (whole & (offset < -half_of_it)));
#else
  (void)period;
  return distance_between(a, b);
#endif
}

// As distance_in_grid(), where the position may be empty: that is farther than any seed. The subtraction makes a
// meaningless number of an empty position, but the sign bit alone puts it past every real distance.
static inline uint_v distance_to_label_in_grid(uint_v position, uint_v pixel, uint period) {
  return distance_in_grid(position, pixel, period) | (position & EMPTY_BIT);
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

#endif
#endif
