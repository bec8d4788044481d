// Seeds that lie outside the grid's pixels: positions in the plane, an int2 of pixels from the grid's corner, and
// distances to them. With the build option VOROCL_FAR some are so far away that distances take 64 bits.

#ifndef VOROCL_PLANE
#define VOROCL_PLANE

#include "core/position.cl"

// A seed that is absent.
#define ABSENT INT_MIN

// LENGTH holds offsets along an axis, distances, and differences of two distances. The host sees to it: no pixel is
// 2^31 pixels or more away from a seed along an axis, and without VOROCL_FAR not 2^15 or more.
#ifdef VOROCL_FAR
#define LENGTH long
#define MOST_LENGTH LONG_MAX
#else
#define LENGTH int
#define MOST_LENGTH INT_MAX
#endif

// The distance between a pixel and a seed, the shorter way round along axes that have a period (others have 0).
static inline LENGTH plane_distance(int2 seed, int x, int y, uint2 periods) {
  ulong along_x = abs_diff((long)seed.x, (long)x), along_y = abs_diff((long)seed.y, (long)y);
  if (periods.x > 0) {
    along_x %= periods.x;
    along_x = min(along_x, periods.x - along_x);
  }
  if (periods.y > 0) {
    along_y %= periods.y;
    along_y = min(along_y, periods.y - along_y);
  }
  const LENGTH dx = (LENGTH)along_x, dy = (LENGTH)along_y;
  return ALONG(dx) + ALONG(dy);
}

#endif
