// Philox-4x32-10, a counter-based random number generator (Salmon et al. 2011, "Parallel random numbers: as easy as
// 1, 2, 3"): the numbers depend on counter and key alone, so they are the same on every device.

// What a counter is used for: its last word, so that no two uses share numbers.
#define PHILOX_POSITIONS 0u
#define PHILOX_MOTION 1u

// (In scalars, as compilers for CPUs make a vector of a uint4 and pick it apart in every round; and by 64-bit products,
// which give both halves at once.)
static inline uint4 philox(uint4 counter, uint2 key) {
  uint a = counter.s0, b = counter.s1, c = counter.s2, d = counter.s3, key_0 = key.s0, key_1 = key.s1;
  for (int round = 0; round < 10; ++round) {
    const ulong product_0 = (ulong)a * 0xd2511f53u, product_1 = (ulong)c * 0xcd9e8d57u;
    a = (uint)(product_1 >> 32) ^ b ^ key_0;
    b = (uint)product_1;
    c = (uint)(product_0 >> 32) ^ d ^ key_1;
    d = (uint)product_0;
    key_0 += 0x9e3779b9u;
    key_1 += 0xbb67ae85u;
  }
  return (uint4)(a, b, c, d);
}

// Maps 32 random bits to 0 ... count - 1; the bias is below count / 2^32.
static inline uint uniform_below(uint bits, uint count) { return (uint)((ulong)bits * count >> 32); }
