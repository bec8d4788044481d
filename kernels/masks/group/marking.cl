// Marks are made of images: on GPUs a work-item takes a word.

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

#endif
