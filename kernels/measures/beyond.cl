// The labels of what follows the last rows and the last slice in a tilted grid.

#include "measures/runs.cl"

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
