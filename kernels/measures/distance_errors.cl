// What labels say by the distances of their seeds: how much farther a pixel's seed is than the nearest one, and where
// two diagrams are equal within a tolerance.

#include "core/plane.cl"

// The distance from a pixel to a seed's position; NO_SEED without one.
#ifdef VOROCL_OUTER_SEEDS
typedef int2 position_t;
typedef LENGTH distance_t;
#define NO_SEED MOST_LENGTH
static inline distance_t distance_to(position_t seed, int x, int y, int width, int height, uint2 periods) {
  (void)width, (void)height;
  return seed.x == ABSENT ? NO_SEED : plane_distance(seed, x, y, periods);
}
#else
typedef uint position_t;
typedef uint distance_t;
#define NO_SEED NO_DISTANCE
static inline distance_t distance_to(position_t seed, int x, int y, int width, int height, uint2 periods) {
  (void)periods;
  if (seed & EMPTY_BIT) return NO_SEED;
  const int along_x = shorter_way_x(packed_x(seed) - x, width);
  return distance_of_offset(along_x, shorter_way_y(packed_y(seed) - y, height));
}
#endif

// By how many pixels one distance is longer than another. The difference of two roots would lose its digits.
static inline float excess(distance_t distance, distance_t least) {
#ifdef VOROCL_EUCLIDEAN
  return (float)(distance - least) / (sqrt((float)distance) + sqrt((float)least));
#else
  return (float)(distance - least);
#endif
}

// Each work-item judges a chunk of pixels: how many are wrong, and how many of those have no seed; the sum and the
// greatest of the others' excess distances. Where labels are equal, nothing is looked up.
VECTOR_KERNEL void judge_labels(global const uint* restrict labels, global const uint* restrict exact,
                                global const position_t* restrict positions, uint count, uint2 periods, int width,
                                int height, uint chunk, global uint2* restrict wrong,
                                global float2* restrict excesses) {
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
      const distance_t distance = distance_to(positions[min(labels[i], count)], x, y, width, height, periods);
      const distance_t least = distance_to(positions[min(exact[i], count)], x, y, width, height, periods);
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
VECTOR_KERNEL void count_distant(global const uint* restrict a, global const uint* restrict b,
                                 global const position_t* restrict positions, uint count, uint2 periods, int width,
                                 int height, uint chunk, float tolerance, global uint* restrict differences) {
  const uint item = (uint)get_global_id(0), pixels = (uint)(width * height);
  if (item >= (pixels + chunk - 1) / chunk) return;
  const uint end = min((item + 1) * chunk, pixels);
  uint found = 0;
  for (uint i = item * chunk; i < end; ++i) {
    if (a[i] == b[i]) continue;
    const int x = (int)(i % (uint)width), y = (int)(i / (uint)width);
    const distance_t of_a = distance_to(positions[min(a[i], count)], x, y, width, height, periods);
    const distance_t of_b = distance_to(positions[min(b[i], count)], x, y, width, height, periods);
    if (of_a == of_b) continue;
    const distance_t longer = max(of_a, of_b);
    found += longer == NO_SEED || excess(longer, min(of_a, of_b)) > tolerance;
  }
  if (found > 0) atomic_add(differences, found);
}
