// Philox-4x32-10, a counter-based random number generator (Salmon et al. 2011, "Parallel random numbers: as easy as
// 1, 2, 3"): the numbers depend on counter and key alone, so they are the same on every device.

#include "core/vector.cl"

// What a counter is used for: its last word, so that no two uses share numbers.
#define PHILOX_POSITIONS 0u
#define PHILOX_MOTION 1u

// The high words of products, of pairs of lanes as 64 bits: a processor multiplies the low halves of these at once.
// (PoCL's mul_hi() widens each lane, to vectors that are longer than many processors' registers: random_step() took
// twice as long with it.)
#if VOROCL_WIDTH == 1
static inline uint high_words(uint a, uint b) { return mul_hi(a, b); }
#else
#if VOROCL_WIDTH == 2
typedef ulong pairs_t;
#define AS_PAIRS as_ulong
#elif VOROCL_WIDTH == 4
typedef ulong2 pairs_t;
#define AS_PAIRS as_ulong2
#elif VOROCL_WIDTH == 8
typedef ulong4 pairs_t;
#define AS_PAIRS as_ulong4
#else
typedef ulong8 pairs_t;
#define AS_PAIRS as_ulong8
#endif
static inline uint_v high_words(uint_v a, uint b) {
  const pairs_t pairs = AS_PAIRS(a), low = 0xffffffffu;
  const pairs_t even = (pairs & low) * (ulong)b, odd = (pairs >> 32) * (ulong)b;
  return AS_UINT_V((even >> 32) | (odd & ~low));
}
#endif

// The first two words for each counter (its first word's lanes, second, 0, use).
static inline void philox(uint_v first, uint second, uint use, uint2 key, uint_v* word_0, uint_v* word_1) {
  uint_v a = first, b = second, c = 0, d = use;
  uint key_0 = key.s0, key_1 = key.s1;
  for (int round = 0; round < 10; ++round) {
    const uint factor_0 = 0xd2511f53u, factor_1 = 0xcd9e8d57u;
    const uint_v high_0 = high_words(a, factor_0), low_0 = a * factor_0;
    const uint_v high_1 = high_words(c, factor_1), low_1 = c * factor_1;
    a = high_1 ^ b ^ key_0;
    b = low_1;
    c = high_0 ^ d ^ key_1;
    d = low_0;
    key_0 += 0x9e3779b9u;
    key_1 += 0xbb67ae85u;
  }
  *word_0 = a;
  *word_1 = b;
}

// Maps 32 random bits to 0 ... count - 1; the bias is below count / 2^32.
static inline uint_v uniform_below(uint_v bits, uint count) {
  return high_words(bits, count);
}
