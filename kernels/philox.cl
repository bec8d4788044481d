// Philox-4x32-10, a counter-based random number generator (Salmon et al. 2011, "Parallel random numbers: as easy as
// 1, 2, 3"): the numbers depend on counter and key alone, so they are the same on every device.

// What a counter is used for: its last word, so that no two uses share numbers.
#define PHILOX_POSITIONS 0u
#define PHILOX_MOTION 1u

inline uint4 philox(uint4 counter, uint2 key) {
  for (int round = 0; round < 10; ++round) {
    const uint high_0 = mul_hi(counter.s0, 0xd2511f53u), low_0 = counter.s0 * 0xd2511f53u;
    const uint high_1 = mul_hi(counter.s2, 0xcd9e8d57u), low_1 = counter.s2 * 0xcd9e8d57u;
    counter = (uint4)(high_1 ^ counter.s1 ^ key.s0, low_1, high_0 ^ counter.s3 ^ key.s1, low_0);
    key += (uint2)(0x9e3779b9u, 0xbb67ae85u);
  }
  return counter;
}

// Maps 32 random bits to 0 ... count - 1; the bias is below count / 2^32.
inline uint uniform_below(uint bits, uint count) { return mul_hi(bits, count); }
