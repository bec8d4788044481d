// Marks are made of images and of seeds: on GPUs a work-item takes a word or a seed.

#ifndef VOROCL_MASKS_GROUP_MARKING
#define VOROCL_MASKS_GROUP_MARKING

#include "masks/marks.cl"

static inline int lowest_of_word(ulong word) { return (int)popcount((word & -word) - 1); }
static inline int highest_of_word(ulong word) { return 63 - (int)clz(word); }

// As mark_pixels(), a word of 16 pixels for each work-item. Counts are 0 at first.
kernel void mark_words(global const uchar* restrict pixels, int bytes, int has_sign, uint wanted, int width, int rows,
                       global ushort* restrict marks, global uint* restrict counts) {
  const uint words = (uint)SHORTS_OF_ROW(width), item = (uint)get_global_id(0), row = item / words;
  if (row >= (uint)rows) return;
  const int x = (int)(item % words) * STRIP, some = clamp(width - x, 0, STRIP);
  const bool is_float = has_sign != 0, skips_nan = is_float && wanted != 0;
  const size_t at = (size_t)row * (size_t)width + (size_t)x;
  const uint word = some == STRIP ? (zeros_of_word(pixels, bytes, is_float, skips_nan, at) ^ wanted) & 0xffff
                                  : marks_of_some(pixels, bytes, is_float, skips_nan, wanted, at, some);
  marks[item] = (ushort)word;
  if (word != 0) atomic_add(counts + row, popcount(word));
}

// As paint_seeds(), a seed for each work-item. Marks and counts are 0 at first, and labels of pixels with seeds are
// greater than any id. Of a row it counts the words of 32 pixels that have seeds: then it is asked whether there are
// any, and atomic operations at one place wait for each other.
kernel void paint_pixels(global const uint* restrict positions, uint count, int width, int height, int bits_x,
                         int bits_y, global uint* marks, global uint* counts, global uint* labels) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  const uint position = positions[id];
  if (position >= EMPTY_SEED) return;
  const uint x = position & ((1u << bits_x) - 1), y = position >> bits_x & ((1u << bits_y) - 1);
  const uint z = bits_x + bits_y < 32 ? position >> (bits_x + bits_y) : 0;
  const uint row = z * (uint)height + y, bit = 1u << x % 32;
  atomic_min(labels + ((size_t)row * (size_t)width + x), id);
  if (atomic_or(marks + ((size_t)row * (SHORTS_OF_ROW((size_t)width) / 2) + x / 32), bit) == 0)
    atomic_inc(counts + row);
}

#endif
