// Philox-4x32-10, a counter-based random number generator (Salmon et al. 2011, "Parallel random numbers: as easy as
// 1, 2, 3"): the numbers depend on counter and key alone, so they are the same on every device.

#include "core/vector.cl"

// What a counter is used for: its last word, so that no two uses share numbers.
#define PHILOX_POSITIONS 0u
#define PHILOX_MOTION 1u

// The first two words for each counter (its first word's lanes, second, 0, use). (Vectors of 64-bit products would be
// longer than many processors' registers, of which drivers warn.)
static inline void philox(uint_v first, uint second, uint use, uint2 key, uint_v* word_0, uint_v* word_1) {
  uint_v a = first, b = second, c = 0, d = use;
  uint key_0 = key.s0, key_1 = key.s1;
  for (int round = 0; round < 10; ++round) {
    const uint_v factor_0 = (uint_v)0xd2511f53u, factor_1 = (uint_v)0xcd9e8d57u;
    const uint_v high_0 = mul_hi(a, factor_0), low_0 = a * factor_0;
    const uint_v high_1 = mul_hi(c, factor_1), low_1 = c * factor_1;
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
  return mul_hi(bits, (uint_v)count);
}
