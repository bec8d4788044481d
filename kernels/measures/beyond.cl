// Labels of pixels beyond the ends of periodic axes. In a tilted grid what follows the last row, or the last slice, is
// shifted by whole pixels: of two pixels of the row beside it that share an edge with a pixel the one that has more of
// it counts.

#ifndef VOROCL_BEYOND
#define VOROCL_BEYOND

#include "measures/runs.cl"

// The place of a pixel in an image of labels, less than a period outside the grid; -1 if there is none. `shifts`: along
// x, one period of y further; along x and y, one period of z further.
static inline long index_of_image(int x, int y, int z, int4 size, int4 shifts) {
  const int image_z = !PERIODIC_Z ? 0 : z < 0 ? -1 : z >= DEPTH(size);
  x -= image_z * shifts.y, y -= image_z * shifts.z, z -= image_z * DEPTH(size);
  const int image_y = !PERIODIC_Y ? 0 : y < 0 ? -1 : y >= size.y;
  x -= image_y * shifts.x, y -= image_y * size.y;
  if (PERIODIC_X) x = (x % size.x + size.x) % size.x;
  const bool inside = x >= 0 && x < size.x && y >= 0 && y < size.y && z >= 0 && z < DEPTH(size);
  return inside ? ((long)z * size.y + y) * size.x + x : -1;
}

// The rows that follow the last one of each slice along a periodic y, and then those of the slice that follows the last
// one along a periodic z. Along an axis that is not periodic nothing follows, and nothing is written.
kernel void copy_rows_behind(global const uint* restrict labels, int4 size, int4 shifts, uint pixels,
                             global uint* restrict behind) {
  const uint item = (uint)get_global_id(0);
  if (item >= pixels) return;
  const int x = (int)(item % (uint)size.x), row = (int)(item / (uint)size.x), depth = DEPTH(size);
  const long at = row < depth ? index_of_image(x, size.y, row, size, shifts)
                              : index_of_image(x, row - depth, depth, size, shifts);
  if (at >= 0) behind[item] = labels[at];
}

#endif
