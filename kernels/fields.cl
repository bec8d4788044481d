// Images that follow from the labels: distances to the seeds, borders of the cells.

#include "position.cl"

#if VOROCL_WIDTH == 1
typedef float float_run;
#define TO_FLOATS convert_float
#define TO_BYTES convert_uchar
#else
typedef JOIN(float, VOROCL_WIDTH) float_run;
#define TO_FLOATS JOIN(convert_float, VOROCL_WIDTH)
#define TO_BYTES JOIN(convert_uchar, VOROCL_WIDTH)
#endif

// Each pixel's distance to its label's seed.
static inline uint_run find_distances(global const uint* labels, global const uint* positions, uint count, int x, int y,
                                      int width) {
  uint lane[VOROCL_WIDTH];
  STORE_RUN(min(LOAD_RUN(labels + y * width + x), (uint_run)count), lane);
  for (int i = 0; i < VOROCL_WIDTH; ++i) lane[i] = positions[lane[i]];
  const uint_run position = LOAD_RUN(lane);
  return select(distance_between(position, run_positions(x, y)), (uint_run)NO_DISTANCE, (position & EMPTY_BIT) != 0);
}

RUN_KERNEL void integer_distances(global const uint* restrict labels, global const uint* restrict positions, uint count,
                                  global uint* restrict out, int width, int height) {
  if (!has_run(width, height)) return;
  const int x = run_x(width), y = run_y();
  STORE_RUN(find_distances(labels, positions, count, x, y, width), out + y * width + x);
}

RUN_KERNEL void float_distances(global const uint* restrict labels, global const uint* restrict positions, uint count,
                                global float* restrict out, int width, int height) {
  if (!has_run(width, height)) return;
  const int x = run_x(width), y = run_y();
  const uint_run distance = find_distances(labels, positions, count, x, y, width);
#ifdef VOROCL_EUCLIDEAN
  const float_run in_pixels = sqrt(TO_FLOATS(distance));
#else
  const float_run in_pixels = TO_FLOATS(distance);
#endif
  STORE_RUN(select(in_pixels, (float_run)INFINITY, distance == NO_DISTANCE), out + y * width + x);
}

// Whether a pixel has another label than one of its four neighbours.
static inline uint is_border(global const uint* labels, int x, int y, int width, int height) {
  global const uint* const own = labels + y * width + x;
  return (uint)((x > 0 && own[-1] != *own) || (x + 1 < width && own[1] != *own) ||
                (y > 0 && own[-width] != *own) || (y + 1 < height && own[width] != *own));
}

RUN_KERNEL void mark_borders(global const uint* restrict labels, global uchar* restrict mask, int width, int height) {
  if (!has_run(width, height)) return;
  const int x = run_x(width), y = run_y();
  global const uint* const run = labels + y * width + x;
  if (x > 0 && x + VOROCL_WIDTH < width && y > 0 && y + 1 < height) {
    const uint_run own = LOAD_RUN(run);
    const uint_run differs = select((uint_run)0, (uint_run)1,
                                    own != LOAD_RUN(run - 1) || own != LOAD_RUN(run + 1) ||
                                    own != LOAD_RUN(run - width) || own != LOAD_RUN(run + width));
    STORE_RUN(TO_BYTES(differs), mask + y * width + x);
  } else {
    for (int i = 0; i < VOROCL_WIDTH; ++i) mask[y * width + x + i] = (uchar)is_border(labels, x + i, y, width, height);
  }
}
