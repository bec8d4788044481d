// The labels of two diagrams, pixel by pixel: where they differ, where their seeds are not equally far away within a
// tolerance, and how much farther one diagram's seeds are than those of the exact one. Each work-item compares a chunk
// of pixels, so that few of them meet.

#include "measures/seed_place.cl"

// Counts the pixels whose labels differ.
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

// By how many pixels one distance is longer than another. The difference of two roots would lose its digits.
static inline float excess(LENGTH distance, LENGTH least) {
#ifdef VOROCL_EUCLIDEAN
  return (float)(distance - least) / (sqrt((float)distance) + sqrt((float)least)) / UNIT;
#else
  return (float)(distance - least) / UNIT;
#endif
}

// Judges labels by the exact ones: how many are wrong, and how many of those have no seed; the sum and the
// greatest of the others' excess distances. Where labels are equal, nothing is looked up.
VECTOR_KERNEL void judge_labels(global const uint* restrict labels, global const uint* restrict exact,
                                SEED_PARAMETERS, uint chunk, global uint2* restrict wrong,
                                global float2* restrict excesses) {
  const window_t window = window_of(width, height, periods);
  const uint item = (uint)get_global_id(0), pixels = (uint)(width * height);
  if (item >= (pixels + chunk - 1) / chunk) return;
  const uint end = min((item + 1) * chunk, pixels);
  uint2 found = (uint2)0;
  float2 sum_and_greatest = (float2)0;
  for (uint first = item * chunk; first < end; first += VOROCL_WIDTH) {
    const uint vector_end = min(first + VOROCL_WIDTH, end);
    const bool whole = vector_end == first + VOROCL_WIDTH;
    if (whole && !ANY(LOAD_VECTOR(labels + first) != LOAD_VECTOR(exact + first))) continue;
    for (uint i = first; i < vector_end; ++i) {
      const int x = (int)(i % (uint)width), y = (int)(i / (uint)width);
      const LENGTH distance = distance_to(seeds[min(labels[i], count)], x, y, window);
      const LENGTH least = distance_to(seeds[min(exact[i], count)], x, y, window);
      if (distance <= least) continue;
      found += (uint2)(1, distance == NO_SEED);
      if (distance == NO_SEED) continue;
      const float by = excess(distance, least);
      sum_and_greatest = (float2)(sum_and_greatest.s0 + by, fmax(sum_and_greatest.s1, by));
    }
  }
  wrong[item] = found;
  excesses[item] = sum_and_greatest;
}

// Adds the pixels whose two labels name seeds that are not equally far away, within a tolerance in pixels.
VECTOR_KERNEL void count_distant(global const uint* restrict a, global const uint* restrict b, SEED_PARAMETERS,
                                 uint chunk, float tolerance, global uint* restrict differences) {
  const window_t window = window_of(width, height, periods);
  const uint item = (uint)get_global_id(0), pixels = (uint)(width * height);
  if (item >= (pixels + chunk - 1) / chunk) return;
  const uint end = min((item + 1) * chunk, pixels);
  uint found = 0;
  for (uint i = item * chunk; i < end; ++i) {
    if (a[i] == b[i]) continue;
    const int x = (int)(i % (uint)width), y = (int)(i / (uint)width);
    const LENGTH of_a = distance_to(seeds[min(a[i], count)], x, y, window);
    const LENGTH of_b = distance_to(seeds[min(b[i], count)], x, y, window);
    if (of_a == of_b) continue;
    const LENGTH longer = max(of_a, of_b);
    found += longer == NO_SEED || excess(longer, min(of_a, of_b)) > tolerance;
  }
  if (found > 0) atomic_add(differences, found);
}
