// Marks are made of images and of seeds: on CPUs work-items take rows of their own.

#ifndef VOROCL_MASKS_MARKING
#define VOROCL_MASKS_MARKING

#include "masks/marks.cl"
#include "masks/rows.cl"

// Marks the pixels that are zero, or those that are neither zero nor NaN (`wanted` is 0xffff then), of an image whose
// pixels have so many bytes. Work-items share the rows.
kernel void mark_pixels(global const uchar* restrict pixels, int bytes, int has_sign, uint wanted, int width, int rows,
                        global ushort* restrict marks, global uint* restrict counts) {
  const int parts = (int)get_global_size(0), id = (int)get_global_id(0), words = SHORTS_OF_ROW(width);
  const int first = (int)((long)id * rows / parts), end = (int)((long)(id + 1) * rows / parts);
  const bool is_float = has_sign != 0, skips_nan = is_float && wanted != 0;
  for (int row = first; row < end; ++row) {
    const size_t start = (size_t)row * (size_t)width;
    global ushort* const out = marks + (size_t)row * (size_t)words;
    uint count = 0;
    for (int i = 0; i < width / STRIP; ++i) {
      const uint zeros = zeros_of_word(pixels, bytes, is_float, skips_nan, start + (size_t)i * STRIP);
      const uint word = (zeros ^ wanted) & 0xffff;
      count += popcount(word);
      out[i] = (ushort)word;
    }
    if (width % STRIP != 0) {
      const int some = width % STRIP;
      const uint word =
          marks_of_some(pixels, bytes, is_float, skips_nan, wanted, start + (size_t)(width - some), some);
      count += popcount(word);
      out[width / STRIP] = (ushort)word;
    }
    for (int i = STRIPS_OF(width); i < words; ++i) out[i] = 0;
    counts[row] = count;
  }
}

// SEEDS as marks: their pixels are marked, and `labels` has the id of the seed there, the lowest one of several. What
// other pixels of `labels` hold does not matter. Each work-item paints rows of its own, and looks at all seeds from the
// last one on: so the lowest id comes last.
#define SEEDS_AHEAD 64  // whose pixels are loaded before they are painted
typedef struct {
  uint first, rows;  // of a work-item
  uint width, height, words;
  uint bits_x, bits_y;
  global ushort* marks;
  global uint *counts, *labels;
} painter_t;

// Rows and columns of seeds, and whether they are the work-item's.
INLINE int16 find_seeds(const painter_t* p, uint16 position, uint16* row, uint16* x) {
  const uint shift_z = min(p->bits_x + p->bits_y, 31u), mask_z = shift_z < 31 ? ~0u : 0u;
  const uint16 y = position >> p->bits_x & ((1u << p->bits_y) - 1);
  *x = position & ((1u << p->bits_x) - 1);
  *row = (position >> shift_z & mask_z) * p->height + y;
  return (*row - p->first < (uint16)p->rows) & ~(as_int16(position) >> 31);
}

INLINE void prefetch_seeds(const painter_t* p, uint16 position) {
  uint16 row, x;
  const int16 mine = find_seeds(p, position, &row, &x);
  if (!SOME(mine)) return;
  uint pixel[STRIP];
  vstore16(select((uint16)(p->first * p->width), row * p->width + x, mine), 0, pixel);
#pragma unroll
  for (int i = 0; i < STRIP; ++i) PREFETCH(p->labels + pixel[i]);
}

// Without a branch, which random seeds would take one way as often as the other: those of other rows are painted where
// they do no harm.
INLINE void paint(const painter_t* p, uint16 position, uint id) {
  uint16 row, x;
  const int16 mine = find_seeds(p, position, &row, &x);
  if (!SOME(mine)) return;
  uint pixel[STRIP], word[STRIP], bit[STRIP];
  int is_mine[STRIP];
  vstore16(row * p->width + x, 0, pixel);
  vstore16(select((uint16)(p->first * p->words), row * p->words + x / STRIP, mine), 0, word);
  vstore16(as_uint16(mine) & ((uint16)1u << (x & (STRIP - 1))), 0, bit);
  vstore16(mine, 0, is_mine);
#pragma unroll
  for (int i = STRIP - 1; i >= 0; --i) {
    global uint* const label = is_mine[i] ? p->labels + pixel[i] : p->counts + p->first;
    *label = id + (uint)i;
    p->marks[word[i]] |= (ushort)bit[i];
  }
}

ITEM_KERNEL void paint_seeds(global const uint* restrict positions, uint count, int width, int height, int rows,
                             int bits_x, int bits_y, global ushort* marks, global uint* counts, global uint* labels) {
  const long parts = (long)get_global_size(0), id = (long)get_global_id(0);
  const uint words = (uint)SHORTS_OF_ROW(width);
  const uint first = (uint)(id * rows / parts), end = (uint)((id + 1) * rows / parts);
  const painter_t p = {first,        end - first,  (uint)width, (uint)height, words,
                       (uint)bits_x, (uint)bits_y, marks,       counts,       labels};
  for (size_t i = (size_t)first * words; i < (size_t)end * words; ++i) marks[i] = 0;
  const uint whole = count / STRIP * STRIP;
  if (whole < count) {
    uint rest[STRIP];
    for (uint i = 0; i < STRIP; ++i) rest[i] = whole + i < count ? positions[whole + i] : EMPTY_SEED;
    paint(&p, vload16(0, rest), whole);
  }
  for (uint i = whole; i > 0; i -= STRIP) {
    if (i > SEEDS_AHEAD) prefetch_seeds(&p, vload16(0, positions + i - STRIP - SEEDS_AHEAD));
    paint(&p, vload16(0, positions + i - STRIP), i - STRIP);
  }
  for (uint row = first; row < end; ++row) {
    uint marks_of_row = 0;
    for (uint i = 0; i < words; ++i) marks_of_row += popcount((uint)marks[(size_t)row * words + i]);
    counts[row] = marks_of_row;
  }
}

#endif
