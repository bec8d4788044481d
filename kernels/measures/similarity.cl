// Similarity: counts the pixels whose labels differ.

#include "core/vector.cl"

// Each work-item counts a chunk of pixels, so that few of them meet at the counter.
VECTOR_KERNEL void count_differences(global const uint* restrict a, global const uint* restrict b, uint pixels,
                                     uint chunk, global uint* restrict differences) {
  const uint begin = (uint)get_global_id(0) * chunk;
  if (begin >= pixels) return;
  const uint end = min(begin + chunk, pixels);
  uint_v per_lane = (uint_v)0;
  uint i = begin;
  for (; i + VOROCL_WIDTH <= end; i += VOROCL_WIDTH) {
    per_lane += select((uint_v)0, (uint_v)1, LOAD_VECTOR(a + i) != LOAD_VECTOR(b + i));
  }
  uint found = lane_sum(per_lane);
  for (; i < end; ++i) found += a[i] != b[i];
  if (found > 0) atomic_add(differences, found);
}
