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
// last one on: so the lowest id comes last. Of many work-items each has few seeds, and gathers them first.
#define SEEDS_AHEAD 32  // whose pixels are loaded before they are painted
#define SEEDS_AT_ONCE (16 * SEEDS_AHEAD)
#define FEW_PAINTERS 4
typedef struct {
  uint first, low, own;  // a work-item's first row; its positions: from `low` on, so many
  uint width, height, words, bits_x, bits_y;
  global ushort* marks;
  global uint *counts, *labels;
} painter_t;
typedef struct {
  uint position[SEEDS_AT_ONCE + 2 * STRIP], id[SEEDS_AT_ONCE + 2 * STRIP];
  int held, loaded, painted;  // so many
} gathered_t;

// Positions come in the order of rows.
static inline uint position_of_row(uint row, uint height, uint bits_x, uint bits_y) {
  return (row / height << bits_y | row % height) << bits_x;
}
INLINE int16 are_own(uint16 position, const painter_t* p) { return position - p->low < (uint16)p->own; }
INLINE uint16 columns_of_seeds(uint16 position, const painter_t* p) { return position & ((1u << p->bits_x) - 1); }
INLINE uint16 rows_of_seeds(uint16 position, const painter_t* p) {
  const uint shift_z = min(p->bits_x + p->bits_y, 31u), mask_z = shift_z < 31 ? ~0u : 0u;
  return (position >> shift_z & mask_z) * p->height + (position >> p->bits_x & ((1u << p->bits_y) - 1));
}

INLINE void load_seeds(uint16 position, const painter_t* p) {
  const int16 own = are_own(position, p);
  if (!SOME(own)) return;
  const uint16 at = rows_of_seeds(position, p) * p->width + columns_of_seeds(position, p);
  uint pixel[STRIP];
  vstore16(select((uint16)(p->first * p->width), at, own), 0, pixel);
#pragma unroll
  for (int i = 0; i < STRIP; ++i) PREFETCH(p->labels + pixel[i]);
}

// Without a branch, which random seeds would take one way as often as the other: those of other rows are painted where
// they do no harm.
INLINE void paint(uint16 position, uint16 ids, const painter_t* p) {
  const uint16 row = rows_of_seeds(position, p), x = columns_of_seeds(position, p);
  const int16 own = are_own(position, p);
  uint id[STRIP], pixel[STRIP], word[STRIP], bit[STRIP];
  int is_own[STRIP];
  vstore16(ids, 0, id);
  vstore16(row * p->width + x, 0, pixel);
  vstore16(select((uint16)(p->first * p->words), row * p->words + x / STRIP, own), 0, word);
  vstore16(as_uint16(own) & ((uint16)1u << (x & (STRIP - 1))), 0, bit);
  vstore16(own, 0, is_own);
#pragma unroll
  for (int i = 0; i < STRIP; ++i) {
    global uint* const label = is_own[i] ? p->labels + pixel[i] : p->counts + p->first;
    *label = id[i];
    p->marks[word[i]] |= (ushort)bit[i];
  }
}

INLINE void gather_seeds(uint16 positions, uint16 ids, gathered_t* g, const painter_t* p) {
  uint position[STRIP], id[STRIP];
  int is_own[STRIP], held = g->held;
  vstore16(positions, 0, position);
  vstore16(ids, 0, id);
  vstore16(are_own(positions, p), 0, is_own);
#pragma unroll
  for (int i = 0; i < STRIP; ++i) {
    g->position[held] = position[i];
    g->id[held] = id[i];
    held -= is_own[i];
  }
  g->held = held;
}

static inline void paint_rest(gathered_t* g, const painter_t* p) {
  for (int i = g->held; i % STRIP != 0; ++i) g->position[i] = EMPTY_SEED;
  for (; g->painted < g->held; g->painted += STRIP)
    paint(vload16(0, g->position + g->painted), vload16(0, g->id + g->painted), p);
  g->held = g->loaded = g->painted = 0;
}

// Paints some of them, and loads others that come after them.
INLINE void paint_gathered(gathered_t* g, const painter_t* p) {
  if (g->held - g->loaded >= STRIP) {
    load_seeds(vload16(0, g->position + g->loaded), p);
    g->loaded += STRIP;
    if (g->loaded <= SEEDS_AHEAD) return;
    paint(vload16(0, g->position + g->painted), vload16(0, g->id + g->painted), p);
    g->painted += STRIP;
  }
  if (g->held < SEEDS_AT_ONCE) return;
  const int moved = g->painted;
  for (int i = 0; i + moved < g->held; i += STRIP) {
    vstore16(vload16(0, g->position + moved + i), 0, g->position + i);
    vstore16(vload16(0, g->id + moved + i), 0, g->id + i);
  }
  g->held -= moved, g->loaded -= moved, g->painted = 0;
}

ITEM_KERNEL void paint_seeds(global const uint* restrict positions, uint count, int width, int height, int rows,
                             int bits_x, int bits_y, global ushort* marks, global uint* counts, global uint* labels) {
  const long parts = (long)get_global_size(0), item = (long)get_global_id(0);
  const uint words = (uint)SHORTS_OF_ROW(width);
  const uint first = (uint)(item * rows / parts), end = (uint)((item + 1) * rows / parts);
  const uint low = position_of_row(first, (uint)height, (uint)bits_x, (uint)bits_y);
  const uint last = position_of_row(end - 1, (uint)height, (uint)bits_x, (uint)bits_y);
  const painter_t p = {first, low, last - low + (1u << bits_x), (uint)width, (uint)height, words, (uint)bits_x,
                       (uint)bits_y, marks, counts, labels};
  for (size_t i = (size_t)first * words; i < (size_t)end * words; ++i) marks[i] = 0;
  gathered_t g;
  g.held = g.loaded = g.painted = 0;
  uint left = count;
  for (; left % STRIP != 0; ++g.held) {
    --left;
    g.position[g.held] = positions[left];
    g.id[g.held] = left;
  }
  paint_rest(&g, &p);
  const uint ahead = (uint)parts * SEEDS_AHEAD;
  while (left > 0) {
    left -= STRIP;
    const uint16 position = vload16(0, positions + left).sfedcba9876543210;
    const uint16 ids = left + (STRIP - 1) - as_uint16(LANE);
    const bool are_few = parts <= FEW_PAINTERS;
    if (are_few && left >= ahead) load_seeds(vload16(0, positions + left - ahead), &p);
    if (!SOME(are_own(position, &p))) continue;
    if (are_few) {
      paint(position, ids, &p);
    } else {
      gather_seeds(position, ids, &g, &p);
      paint_gathered(&g, &p);
    }
  }
  paint_rest(&g, &p);
  for (uint row = first; row < end; ++row) {
    uint marks_of_row = 0;
    for (uint i = 0; i < words; ++i) marks_of_row += popcount((uint)marks[(size_t)row * words + i]);
    counts[row] = marks_of_row;
  }
}

#endif
