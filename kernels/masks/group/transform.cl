// The mask engine in the group shape, for GPUs: of each pixel the nearest mark, by one pass along each axis.
// docs/masks.md says how and why. Squared distances are whole numbers of 32 bits, or of 64 where an image has longer
// ones (VOROCL_FAR).

#include "masks/group/lines.cl"
#include "masks/group/marking.cl"
#include "masks/targets.cl"

// Along x: the way to the nearest mark of each pixel's row. Neighbours look at the same words of 64 pixels.
kernel void nearest_columns(constant images_t* images, global const ulong* restrict marks,
                            global const uint* restrict counts, global short* restrict columns) {
  const images_t e = *images;
  const uint at = (uint)get_global_id(0);
  if (at >= pixels_of(&e)) return;
  const uint row = DIVIDE(at, e.factor_of_width, e.shift_of_width);
  const int x = (int)(at - row * (uint)e.width), period = e.period_x, words = SHORTS_OF_ROW(e.width) / 4, own = x / 64;
  global const ulong* const word = marks + row * (uint)words;
  const ulong of_pixel = word[own];  // It is loaded beside the count.
  if (counts[row] == 0) {
    columns[at] = NO_WAY;
    return;
  }
  const int none = 1 << 20;  // farther than any mark
  ulong before = of_pixel & (~0ul >> (63 - x % 64)), behind = of_pixel & (~0ul << x % 64);
  int i = own;
  while (before == 0 && i > 0) before = word[--i];
  int last = before == 0 ? -none : 64 * i + highest_of_word(before);
  i = own;
  while (behind == 0 && i < words - 1) behind = word[++i];
  int next = behind == 0 ? none : 64 * i + lowest_of_word(behind);
  if (period != 0 && before == 0) {
    for (i = words; before == 0;) before = word[--i];
    last = 64 * i + highest_of_word(before) - period;
  }
  if (period != 0 && behind == 0) {
    for (i = -1; behind == 0;) behind = word[++i];
    next = 64 * i + lowest_of_word(behind) + period;
  }
  const int column = nearer(x, last, next, period), way = column - x;
  columns[at] = (short)(period == 0 || abs(way) * 2 <= (uint)period ? way : way > 0 ? way - period : way + period);
}

// Along y: the way to the nearest mark, in a volume of each slice.
kernel void nearest_along_y(constant images_t* images, global const short* restrict columns,
                            global int* restrict between) {
  local band_t band;
  find_along_lines(images, false, columns, 0, between, 0, &band);
}

// Along z: how many slices away the nearest mark is.
kernel void nearest_along_z(constant images_t* images, global const int* restrict between,
                            global short* restrict slices) {
  local band_t band;
  find_along_lines(images, true, 0, between, 0, slices, &band);
}

static inline int at_end(int place, int way, int size) {
  const int end = place + way;
  return end < 0 ? end + size : end >= size ? end - size : end;
}

// Writes what is wanted of the nearest marks. Labels may be those of the marks before.
kernel void store_targets(constant images_t* images, global const int* between, global const short* slices,
                          global const ushort* marks, TARGET_PARAMETERS) {
  const images_t e = *images;
  const targets_t t = TARGETS_OF_PARAMETERS;
  const uint at = (uint)get_global_id(0);
  if (at >= pixels_of(&e)) return;
  const uint row = DIVIDE(at, e.factor_of_width, e.shift_of_width);
  const int z = (int)DIVIDE(row, e.factor_of_height, e.shift_of_height), y = (int)row - z * e.height;
  const int x = (int)(at - row * (uint)e.width);
  const int to_slice = e.depth > 1 ? slices[at] : 0, way_z = to_slice == NO_WAY ? 0 : to_slice;
  const int slice = at_end(z, way_z, e.depth), known = between[index_of_pixel(x, y, slice, &e)];
  const int way_x = (short)known, way_y = known >> 16;
  nearest_t n = {at, x, y, z, 1, at_end(x, way_x, e.width), at_end(y, way_y, e.height), slice, way_x == NO_WAY, 0};
  if (n.none) n.column = n.row = 0;
  n.square = squared(way_x, (squares)e.square_x) + squared(way_y, (squares)e.square_y) +
             squared(way_z, (squares)e.square_z);
  if (e.carried != CARRIES_LABELS) {
    n.none |= too_far(n.square, &e);
    store_nearest(&n, &e, &t);
  } else if (n.none || n.square != 0) {
    labels[at] = n.none ? NO_MARK : labels[index_of_pixel(n.column, n.row, slice, &e)];
  }
}
