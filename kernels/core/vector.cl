// Vectors: VOROCL_WIDTH neighbouring pixels of one row, which one work-item computes together.
//
// PoCL does not vectorise branchy per-pixel kernels, so kernels are written on explicit vectors; a GPU takes
// vectors of one pixel from the same source. VOROCL_WIDTH (1, 2, 4, 8 or 16) is a build option. A row always
// holds at least one whole vector: the host never builds for a width above that of the grid.

// Images that waves read at an offset have VOROCL_GUARD (a build option, at least VOROCL_WIDTH) spare values before and
// behind their pixels, so that a vector which sticks out of the grid can be loaded whole and its outer lanes masked.

#ifndef VOROCL_VECTOR
#define VOROCL_VECTOR

#include "core/abi.cl"

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

#if VOROCL_WIDTH == 1
typedef uint uint_v;
typedef int int_v;
#define LANES 0u
#define LOAD_VECTOR(pointer) (*(pointer))
#define STORE_VECTOR(values, pointer) (*(pointer) = (values))
#define LOAD_BYTES(pointer) ((uint)*(pointer))
#define AS_INT_V as_int
#define AS_UINT_V as_uint
#define CONVERT_INT_V convert_int
#define CONVERT_FLOAT_V convert_float
// any() of a scalar looks at the sign bit, and a scalar comparison gives 1, not -1.
#define ANY(condition) (condition)
#else
typedef JOIN(uint, VOROCL_WIDTH) uint_v;
typedef JOIN(int, VOROCL_WIDTH) int_v;
#define LOAD_VECTOR(pointer) JOIN(vload, VOROCL_WIDTH)(0, pointer)
#define STORE_VECTOR(values, pointer) JOIN(vstore, VOROCL_WIDTH)(values, 0, pointer)
#define LOAD_BYTES(pointer) JOIN(convert_uint, VOROCL_WIDTH)(JOIN(vload, VOROCL_WIDTH)(0, pointer))
#define AS_INT_V JOIN(as_int, VOROCL_WIDTH)
#define AS_UINT_V JOIN(as_uint, VOROCL_WIDTH)
#define CONVERT_INT_V JOIN(convert_int, VOROCL_WIDTH)
#define CONVERT_FLOAT_V JOIN(convert_float, VOROCL_WIDTH)
#define ANY(condition) SOME(condition)
#endif

// The index of the lowest bit that is set.
static inline uint lowest_bit(uint bits) { return popcount(~bits & (bits - 1)); }

// A kernel whose work-items compute whole vectors. The hint keeps compilers that make vectors of work-items from
// doing so.
#define VECTOR_KERNEL kernel __attribute__((vec_type_hint(uint_v)))

#if VOROCL_WIDTH == 2
#define LANES ((uint2)(0, 1))
#elif VOROCL_WIDTH == 4
#define LANES ((uint4)(0, 1, 2, 3))
#elif VOROCL_WIDTH == 8
#define LANES ((uint8)(0, 1, 2, 3, 4, 5, 6, 7))
#elif VOROCL_WIDTH == 16
#define LANES ((uint16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))
#endif

// Stores the table's values at a vector of indices, lane by lane: a CPU has them in scalar registers anyway. (Given a
// pointer instead of an index, PoCL's compiler builds a vector of them first, which costs a quarter of a wave.)
static inline void store_looked_up_1(global const uint* table, uint at, global uint* out, int first) {
  out[first] = table[at];
}
#define LANE(i) out[first + 0x##i] = table[at.s##i]
static inline void store_looked_up_2(global const uint* table, uint2 at, global uint* out, int first) {
  LANE(0), LANE(1);
}
static inline void store_looked_up_4(global const uint* table, uint4 at, global uint* out, int first) {
  LANE(0), LANE(1), LANE(2), LANE(3);
}
static inline void store_looked_up_8(global const uint* table, uint8 at, global uint* out, int first) {
  LANE(0), LANE(1), LANE(2), LANE(3), LANE(4), LANE(5), LANE(6), LANE(7);
}
static inline void store_looked_up_16(global const uint* table, uint16 at, global uint* out, int first) {
  LANE(0), LANE(1), LANE(2), LANE(3), LANE(4), LANE(5), LANE(6), LANE(7);
  LANE(8), LANE(9), LANE(a), LANE(b), LANE(c), LANE(d), LANE(e), LANE(f);
}
#undef LANE
#define store_looked_up JOIN(store_looked_up_, VOROCL_WIDTH)

// The values of a table, itself a vector, at a vector of indices modulo VOROCL_WIDTH. (PoCL's shuffle() works lane by
// lane; its compiler makes a permutation of this.)
static inline uint permute_1(uint table, uint at) {
  (void)at;
  return table;
}
static inline uint2 permute_2(uint2 table, uint2 at) { at &= 1u; return (uint2)(table[at.s0], table[at.s1]); }
static inline uint4 permute_4(uint4 table, uint4 at) {
  at &= 3u;
  return (uint4)(table[at.s0], table[at.s1], table[at.s2], table[at.s3]);
}
static inline uint8 permute_8(uint8 table, uint8 at) {
  at &= 7u;
  return (uint8)(table[at.s0], table[at.s1], table[at.s2], table[at.s3], table[at.s4], table[at.s5], table[at.s6],
                 table[at.s7]);
}
static inline uint16 permute_16(uint16 table, uint16 at) {
  at &= 15u;
  return (uint16)(table[at.s0], table[at.s1], table[at.s2], table[at.s3], table[at.s4], table[at.s5], table[at.s6],
                  table[at.s7], table[at.s8], table[at.s9], table[at.sa], table[at.sb], table[at.sc], table[at.sd],
                  table[at.se], table[at.sf]);
}
#define permute JOIN(permute_, VOROCL_WIDTH)

// The values of a table at a vector of indices.
#define LANE(i) table[at.s##i]
static inline uint looked_up_1(global const uint* table, uint at) { return table[at]; }
static inline uint2 looked_up_2(global const uint* table, uint2 at) { return (uint2)(LANE(0), LANE(1)); }
static inline uint4 looked_up_4(global const uint* table, uint4 at) {
  return (uint4)(LANE(0), LANE(1), LANE(2), LANE(3));
}
static inline uint8 looked_up_8(global const uint* table, uint8 at) {
  return (uint8)(LANE(0), LANE(1), LANE(2), LANE(3), LANE(4), LANE(5), LANE(6), LANE(7));
}
static inline uint16 looked_up_16(global const uint* table, uint16 at) {
  return (uint16)(LANE(0), LANE(1), LANE(2), LANE(3), LANE(4), LANE(5), LANE(6), LANE(7), LANE(8), LANE(9), LANE(a),
                  LANE(b), LANE(c), LANE(d), LANE(e), LANE(f));
}
#undef LANE
#define looked_up JOIN(looked_up_, VOROCL_WIDTH)

// Of a list, the first so many values, at most a vector; the other lanes are 0, and are not stored.
static inline uint_v load_some(global const uint* from, uint some) {
  if (some >= VOROCL_WIDTH) return LOAD_VECTOR(from);
  uint lane[VOROCL_WIDTH];
  for (uint i = 0; i < VOROCL_WIDTH; ++i) lane[i] = i < some ? from[i] : 0;
  return LOAD_VECTOR(lane);
}
static inline void store_some(uint_v values, global uint* to, uint some) {
  if (some >= VOROCL_WIDTH) {
    STORE_VECTOR(values, to);
    return;
  }
  uint lane[VOROCL_WIDTH];
  STORE_VECTOR(values, lane);
  for (uint i = 0; i < some; ++i) to[i] = lane[i];
}

// The sum of a vector's lanes.
static inline uint lane_sum_1(uint values) { return values; }
static inline uint lane_sum_2(uint2 values) { return values.lo + values.hi; }
static inline uint lane_sum_4(uint4 values) { return lane_sum_2(values.lo + values.hi); }
static inline uint lane_sum_8(uint8 values) { return lane_sum_4(values.lo + values.hi); }
static inline uint lane_sum_16(uint16 values) { return lane_sum_8(values.lo + values.hi); }
#define lane_sum JOIN(lane_sum_, VOROCL_WIDTH)

// The least of a vector's lanes.
static inline uint lane_min_1(uint values) { return values; }
static inline uint lane_min_2(uint2 values) { return min(values.lo, values.hi); }
static inline uint lane_min_4(uint4 values) { return lane_min_2(min(values.lo, values.hi)); }
static inline uint lane_min_8(uint8 values) { return lane_min_4(min(values.lo, values.hi)); }
static inline uint lane_min_16(uint16 values) { return lane_min_8(min(values.lo, values.hi)); }
#define lane_min JOIN(lane_min_, VOROCL_WIDTH)

// Whether this work-item has a vector at all: the launch is rounded up to whole work-groups.
static inline bool has_vector(int width, int height) {
  return (int)get_global_id(0) * VOROCL_WIDTH < width && (int)get_global_id(1) < height;
}

// The first pixel of this work-item's vector. The last vector of a row is moved left so that it ends with the row:
// it computes some pixels a second time, to the same values.
static inline int vector_x(int width) { return min((int)get_global_id(0) * VOROCL_WIDTH, width - VOROCL_WIDTH); }
static inline int vector_y(void) { return (int)get_global_id(1); }

#endif
