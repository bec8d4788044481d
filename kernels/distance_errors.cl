// Errors of labels: how much farther a pixel's seed is than the nearest one.

#include "position.cl"

// The distance from a pixel to a packed position; NO_DISTANCE without a seed.
static inline uint distance_to(uint position, int x, int y, int width, int height) {
  if (position & EMPTY_BIT) return NO_DISTANCE;
  const int along_x = shorter_way_x(packed_x(position) - x, width);
  return distance_of_offset(along_x, shorter_way_y(packed_y(position) - y, height));
}

// By how many pixels one distance is longer than another. The difference of two roots would lose its digits.
static inline float excess(uint distance, uint least) {
#ifdef VOROCL_EUCLIDEAN
  return (float)(distance - least) / (sqrt((float)distance) + sqrt((float)least));
#else
  return (float)(distance - least);
#endif
}

// Each work-item judges a chunk of pixels: how many are wrong, and how many of those have no seed; the sum and the
// greatest of the others' excess distances. Where labels are equal, nothing is looked up.
VECTOR_KERNEL void judge_labels(global const uint* restrict labels, global const uint* restrict exact,
                                global const uint* restrict positions, uint count, int width, int height, uint chunk,
                                global uint2* restrict wrong, global float2* restrict excesses) {
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
      const uint distance = distance_to(positions[min(labels[i], count)], x, y, width, height);
      const uint least = distance_to(positions[min(exact[i], count)], x, y, width, height);
      if (distance <= least) continue;
      found += (uint2)(1, distance == NO_DISTANCE);
      if (distance == NO_DISTANCE) continue;
      const float by = excess(distance, least);
      sum_and_greatest = (float2)(sum_and_greatest.s0 + by, fmax(sum_and_greatest.s1, by));
    }
  }
  wrong[item] = found;
  excesses[item] = sum_and_greatest;
}
