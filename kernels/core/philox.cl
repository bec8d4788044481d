// Philox-4x32-10, a counter-based random number generator (Salmon et al. 2011, "Parallel random numbers: as easy as
// 1, 2, 3"): the numbers depend on counter and key alone, so they are the same on every device.

#include "core/vector.cl"

// What a counter is used for: its last word, so that no two uses share numbers.
#define PHILOX_POSITIONS 0u
#define PHILOX_MOTION 1u

// The first two words for each counter (its first word's lanes, second, 0, use). (64-bit products give both halves at
// once.)
static inline void philox(uint_v first, uint second, uint use, uint2 key, uint_v* word_0, uint_v* word_1) {
  uint_v a = first, b = second, c = 0, d = use;
  uint key_0 = key.s0, key_1 = key.s1;
  for (int round = 0; round < 10; ++round) {
    const ulong_v product_0 = CONVERT_ULONG_V(a) * 0xd2511f53ul, product_1 = CONVERT_ULONG_V(c) * 0xcd9e8d57ul;
    a = CONVERT_UINT_V(product_1 >> 32ul) ^ b ^ key_0;
    b = CONVERT_UINT_V(product_1);
    c = CONVERT_UINT_V(product_0 >> 32ul) ^ d ^ key_1;
    d = CONVERT_UINT_V(product_0);
    key_0 += 0x9e3779b9u;
    key_1 += 0xbb67ae85u;
  }
  *word_0 = a;
  *word_1 = b;
}

// Maps 32 random bits to 0 ... count - 1; the bias is below count / 2^32.
static inline uint_v uniform_below(uint_v bits, uint count) {
  return CONVERT_UINT_V(CONVERT_ULONG_V(bits) * (ulong)count >> 32ul);
}
