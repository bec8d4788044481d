// Distances to the seeds of the labels where seeds lie outside the grid: see fields.cl.

#include "core/plane.cl"

// A pixel's distance to its label's seed; MOST_LENGTH without one.
static inline LENGTH distance_to_seed(global const uint* labels, global const int2* seeds, uint count, uint2 periods,
                                      int x, int y, int width) {
  const int2 seed = seeds[min(labels[y * width + x], count)];
  return seed.x == ABSENT ? MOST_LENGTH : plane_distance(seed, x, y, periods);
}

// Notes where a distance is too long for 31 bits.
VECTOR_KERNEL void integer_plane_distances(global const uint* restrict labels, global const int2* restrict seeds,
                                           uint count, uint2 periods, global uint* restrict out, int width,
                                           int height, global uint* restrict too_long) {
  if (!has_vector(width, height)) return;
  const int first = vector_x(width), y = vector_y();
  for (int x = first; x < first + VOROCL_WIDTH; ++x) {
    const LENGTH distance = distance_to_seed(labels, seeds, count, periods, x, y, width);
    out[y * width + x] = distance < (LENGTH)NO_DISTANCE ? (uint)distance : NO_DISTANCE;
    if (distance >= (LENGTH)NO_DISTANCE && distance != MOST_LENGTH) atomic_or(too_long, 1u);
  }
}

VECTOR_KERNEL void float_plane_distances(global const uint* restrict labels, global const int2* restrict seeds,
                                         uint count, uint2 periods, global float* restrict out, int width,
                                         int height) {
  if (!has_vector(width, height)) return;
  const int first = vector_x(width), y = vector_y();
  for (int x = first; x < first + VOROCL_WIDTH; ++x) {
    const LENGTH distance = distance_to_seed(labels, seeds, count, periods, x, y, width);
#ifdef VOROCL_EUCLIDEAN
    const float in_pixels = sqrt((float)distance);
#else
    const float in_pixels = (float)distance;
#endif
    out[y * width + x] = distance == MOST_LENGTH ? INFINITY : in_pixels;
  }
}
