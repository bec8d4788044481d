// Images that follow from the labels: distances to the seeds, borders of the cells.

#include "core/position.cl"

#if VOROCL_WIDTH == 1
typedef float float_v;
#define TO_BYTES convert_uchar
#else
typedef JOIN(float, VOROCL_WIDTH) float_v;
#define TO_BYTES JOIN(convert_uchar, VOROCL_WIDTH)
#endif

// Each pixel's distance to its label's seed.
static inline uint_v find_distances(global const uint* labels, global const uint* positions, uint count, int x, int y,
                                    int width, int height) {
  const uint_v position = look_up_positions(labels + y * width + x, positions, count);
  const uint_v distance = distance_in_grid(position, vector_positions(x, y), periods(width, height));
  return select(distance, (uint_v)NO_DISTANCE, (position & EMPTY_BIT) != 0);
}

VECTOR_KERNEL void integer_distances(global const uint* restrict labels, global const uint* restrict positions,
                                     uint count, global uint* restrict out, int width, int height) {
  if (!has_vector(width, height)) return;
  const int x = vector_x(width), y = vector_y();
  STORE_VECTOR(find_distances(labels, positions, count, x, y, width, height), out + y * width + x);
}

VECTOR_KERNEL void float_distances(global const uint* restrict labels, global const uint* restrict positions,
                                   uint count, global float* restrict out, int width, int height) {
  if (!has_vector(width, height)) return;
  const int x = vector_x(width), y = vector_y();
  const uint_v distance = find_distances(labels, positions, count, x, y, width, height);
#ifdef VOROCL_EUCLIDEAN
  const float_v in_pixels = sqrt(CONVERT_FLOAT_V(distance));
#else
  const float_v in_pixels = CONVERT_FLOAT_V(distance);
#endif
  STORE_VECTOR(select(in_pixels, (float_v)INFINITY, distance == NO_DISTANCE), out + y * width + x);
}

// Whether a pixel has another label than the pixel at (x, y), less than a period outside the grid.
static inline bool differs(uint own, global const uint* labels, int x, int y, int width, int height) {
  x = wrapped_x(x, width);
  y = wrapped_y(y, height);
  return x >= 0 && x < width && y >= 0 && y < height && labels[y * width + x] != own;
}

// Whether a pixel has another label than one of its four neighbours.
static inline bool is_border(global const uint* labels, int x, int y, int width, int height) {
  const uint own = labels[y * width + x];
  return differs(own, labels, x - 1, y, width, height) || differs(own, labels, x + 1, y, width, height) ||
         differs(own, labels, x, y - 1, width, height) || differs(own, labels, x, y + 1, width, height);
}

VECTOR_KERNEL void mark_borders(global const uint* restrict labels, global uchar* restrict mask, int width,
                                int height) {
  if (!has_vector(width, height)) return;
  const int x = vector_x(width), y = vector_y();
  global const uint* const pixels = labels + y * width + x;
  if (x > 0 && x + VOROCL_WIDTH < width && y > 0 && y + 1 < height) {
    const uint_v own = LOAD_VECTOR(pixels);
    const uint_v differs = select((uint_v)0, (uint_v)1,
                                  own != LOAD_VECTOR(pixels - 1) || own != LOAD_VECTOR(pixels + 1) ||
                                  own != LOAD_VECTOR(pixels - width) || own != LOAD_VECTOR(pixels + width));
    STORE_VECTOR(TO_BYTES(differs), mask + y * width + x);
  } else {
    for (int i = 0; i < VOROCL_WIDTH; ++i) mask[y * width + x + i] = (uchar)is_border(labels, x + i, y, width, height);
  }
}
