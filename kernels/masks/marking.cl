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
// last one on: so the lowest id comes last. Its own are gathered first, for where there are many items they are few.
#define SEEDS_AHEAD 64  // whose pixels are loaded before they are painted
#define SEEDS_AT_ONCE (8 * SEEDS_AHEAD)
typedef struct {
  uint width, height, words, bits_x, bits_y;
  global ushort* marks;
  global uint* labels;
  // The seeds that are gathered: `held` in all, of which so many are loaded and so many painted.
  uint position[SEEDS_AT_ONCE + 2 * STRIP], id[SEEDS_AT_ONCE + 2 * STRIP];
  int held, loaded, painted;
} painter_t;

INLINE uint position_of_row(uint row, const painter_t* p) {
  return (row / p->height << p->bits_y | row % p->height) << p->bits_x;
}
INLINE uint16 columns_of_seeds(uint16 position, const painter_t* p) { return position & ((1u << p->bits_x) - 1); }
INLINE uint16 rows_of_seeds(uint16 position, const painter_t* p) {
  const uint shift_z = min(p->bits_x + p->bits_y, 31u), mask_z = shift_z < 31 ? ~0u : 0u;
  return (position >> shift_z & mask_z) * p->height + (position >> p->bits_x & ((1u << p->bits_y) - 1));
}

// Gathers seeds, the last one first. Without a branch, which random seeds would take one way as often as the other.
INLINE void gather_seeds(uint16 positions, int16 are_own, uint id, painter_t* p) {
  uint position[STRIP];
  int is_own[STRIP], held = p->held;
  vstore16(positions, 0, position);
  vstore16(are_own, 0, is_own);
#pragma unroll
  for (int i = STRIP - 1; i >= 0; --i) {
    p->position[held] = position[i];
    p->id[held] = id + (uint)i;
    held -= is_own[i];
  }
  p->held = held;
}

INLINE void load_strip(painter_t* p) {
  const uint16 position = vload16(0, p->position + p->loaded);
  uint pixel[STRIP];
  vstore16(rows_of_seeds(position, p) * p->width + columns_of_seeds(position, p), 0, pixel);
#pragma unroll
  for (int i = 0; i < STRIP; ++i) PREFETCH(p->labels + pixel[i]);
  p->loaded += STRIP;
}

INLINE void paint_strip(painter_t* p) {
  const uint16 position = vload16(0, p->position + p->painted);
  const uint16 row = rows_of_seeds(position, p), x = columns_of_seeds(position, p);
  uint pixel[STRIP], word[STRIP], bit[STRIP];
  vstore16(row * p->width + x, 0, pixel);
  vstore16(row * p->words + x / STRIP, 0, word);
  vstore16((uint16)1u << (x & (STRIP - 1)), 0, bit);
#pragma unroll
  for (int i = 0; i < STRIP; ++i) {
    p->labels[pixel[i]] = p->id[p->painted + i];
    p->marks[word[i]] |= (ushort)bit[i];
  }
  p->painted += STRIP;
}

ITEM_KERNEL void paint_seeds(global const uint* restrict positions, uint count, int width, int height, int rows,
                             int bits_x, int bits_y, global ushort* marks, global uint* counts, global uint* labels) {
  const long parts = (long)get_global_size(0), item = (long)get_global_id(0);
  const uint words = (uint)SHORTS_OF_ROW(width);
  const uint first = (uint)(item * rows / parts), end = (uint)((item + 1) * rows / parts);
  for (size_t i = (size_t)first * words; i < (size_t)end * words; ++i) marks[i] = 0;
  painter_t p;
  p.width = (uint)width, p.height = (uint)height, p.words = words, p.bits_x = (uint)bits_x, p.bits_y = (uint)bits_y;
  p.marks = marks, p.labels = labels;
  p.held = p.loaded = p.painted = 0;
  // Positions come in the order of rows.
  const uint low = position_of_row(first, &p), own = position_of_row(end - 1, &p) - low + (1u << bits_x);
  uint left = count;
  for (; left % STRIP != 0; --left) {
    p.position[p.held] = positions[left - 1];
    p.id[p.held] = left - 1;
    p.held += positions[left - 1] - low < own;
  }
  while (left > 0) {
    left -= STRIP;
    const uint16 position = vload16(0, positions + left);
    const int16 are_own = position - low < (uint16)own;
    if (!SOME(are_own)) continue;
    gather_seeds(position, are_own, left, &p);
    if (p.held - p.loaded >= STRIP) {
      load_strip(&p);
      if (p.loaded > SEEDS_AHEAD) paint_strip(&p);
    }
    if (p.held < SEEDS_AT_ONCE) continue;
    const int moved = p.painted;
    for (int i = 0; i + moved < p.held; i += STRIP) {
      vstore16(vload16(0, p.position + moved + i), 0, p.position + i);
      vstore16(vload16(0, p.id + moved + i), 0, p.id + i);
    }
    p.held -= moved, p.loaded -= moved, p.painted = 0;
  }
  // The last one is painted again where a strip has room.
  for (int i = p.held; i % STRIP != 0; ++i) {
    p.position[i] = p.position[p.held - 1];
    p.id[i] = p.id[p.held - 1];
  }
  while (p.painted < p.held) paint_strip(&p);
  for (uint row = first; row < end; ++row) {
    uint marks_of_row = 0;
    for (uint i = 0; i < words; ++i) marks_of_row += popcount((uint)marks[(size_t)row * words + i]);
    counts[row] = marks_of_row;
  }
}

#endif
