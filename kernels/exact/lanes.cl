// Vectors of eight, in which places, keys and rows of voxels are taken.

#ifndef VOROCL_EXACT_LANES
#define VOROCL_EXACT_LANES

#define EIGHT ((int8)(0, 1, 2, 3, 4, 5, 6, 7))
#define NOINLINE __attribute__((noinline))
#define INLINE __attribute__((always_inline)) static inline

// PoCL makes vstore8() of private arrays in halves: these are one instruction.
typedef struct __attribute__((packed)) {
  int8 v;
} unaligned_ints;
typedef struct __attribute__((packed)) {
  uint8 v;
} unaligned_uints;
static inline void store_ints(int8 v, int* to) { ((unaligned_ints*)to)->v = v; }
static inline void store_uints(uint8 v, uint* to) { ((unaligned_uints*)to)->v = v; }

static inline uint8 absolute(int8 v) { return as_uint8(max(v, -v)); }  // PoCL takes abs() apart
static inline int least_int(int8 v) {
  const int4 a = min(v.lo, v.hi);
  const int2 b = min(a.lo, a.hi);
  return min(b.x, b.y);
}
static inline float least_float(float8 v) {
  const float4 a = fmin(v.lo, v.hi);
  const float2 b = fmin(a.lo, a.hi);
  return fmin(b.x, b.y);
}
static inline int sum_of(int8 v) {
  const int4 a = v.lo + v.hi;
  return a.x + a.y + a.z + a.w;
}

// The least and the greatest of a list of numbers.
typedef struct {
  int first, last;
} extent_t;
#define DEFINE_EXTENT(name, space)                                                       \
  static inline extent_t name(space const int* values, int count) {                      \
    int8 least = INT_MAX, most = INT_MIN;                                                \
    for (int k = 0; k < count; k += 8) {                                                 \
      const int8 some = vload8(0, values + k), is_there = EIGHT + k < count;             \
      least = min(least, select((int8)INT_MAX, some, is_there));                         \
      most = max(most, select((int8)INT_MIN, some, is_there));                           \
    }                                                                                    \
    const extent_t extent = {least_int(least), ~least_int(~most)};                       \
    return extent;                                                                       \
  }
DEFINE_EXTENT(extent_of, private)
DEFINE_EXTENT(extent_in_index, global)

// The lanes whose condition holds, as bits.
static inline uint mask_of(int8 condition) {
  const ulong bits = as_ulong(convert_char8(condition)) & 0x8040201008040201ul;
  return (uint)((bits * 0x0101010101010101ul) >> 56);
}

// For each mask its lanes from the lowest on, of four bits each.
#define SET_BITS(mask) ((((mask)*0x200040008001ul & 0x111111111111111ul) % 15) * 4)
#define PACKED(mask, lane) \
  (((mask) >> (lane)&1u) * ((uint)(lane) << SET_BITS((mask) & ((1ul << (lane)) - 1))))
#define LANES_IN(mask)                                                                       \
  (PACKED(mask, 1) | PACKED(mask, 2) | PACKED(mask, 3) | PACKED(mask, 4) | PACKED(mask, 5) | \
   PACKED(mask, 6) | PACKED(mask, 7))
#define LANES_IN_4(m) LANES_IN(m), LANES_IN(m + 1), LANES_IN(m + 2), LANES_IN(m + 3)
#define LANES_IN_16(m) LANES_IN_4(m), LANES_IN_4(m + 4), LANES_IN_4(m + 8), LANES_IN_4(m + 12)
#define LANES_IN_64(m) LANES_IN_16(m), LANES_IN_16(m + 16), LANES_IN_16(m + 32), LANES_IN_16(m + 48)
constant uint packed_lanes[256] = {LANES_IN_64(0), LANES_IN_64(64), LANES_IN_64(128), LANES_IN_64(192)};

// The lanes of a mask first, in their order.
static inline uint8 lanes_of(uint mask) { return (uint8)packed_lanes[mask] >> (as_uint8(EIGHT) * 4u) & 7u; }
static inline uint8 permuted(uint8 v, uint8 lanes) {
  return (uint8)(v[lanes.s0], v[lanes.s1], v[lanes.s2], v[lanes.s3],  //
                 v[lanes.s4], v[lanes.s5], v[lanes.s6], v[lanes.s7]);
}
static inline int8 permuted_ints(int8 v, uint8 lanes) { return as_int8(permuted(as_uint8(v), lanes)); }

#endif
