// MARKS: a bit for each pixel that others look for, in words of 16 pixels of a row, the lowest bit at the left; and the
// number of marks of each row.

#ifndef VOROCL_MASKS_MARKS
#define VOROCL_MASKS_MARKS

#include "masks/rows.cl"

typedef struct __attribute__((packed)) {
  ulong v;
} any_ulong;

// Which of 8 bytes are zero, a bit each: a product gathers their bits.
#define LOWEST_BITS 0x0101010101010101ul
#define GATHERING 0x0102040810204080ul
static inline uint zero_bytes(ulong bytes) {
  bytes |= bytes >> 4;
  bytes |= bytes >> 2;
  bytes |= bytes >> 1;
  return (uint)((~bytes & LOWEST_BITS) * GATHERING >> 56);
}

// Which of 16 pixels of the sizes that an image may have are zero. `sign`: of numbers whose sign does not count; those
// that are greater than `most` without it, which no number is, count as zeros.
static inline uint zeros_of_bytes(global const uchar* pixels) {
  return zero_bytes(((global const any_ulong*)pixels)->v) | zero_bytes(((global const any_ulong*)(pixels + 8))->v) << 8;
}
static inline uint bits_of_lanes(char16 lanes) {
  const ulong2 both = as_ulong2(~lanes);
  return zero_bytes(both.x) | zero_bytes(both.y) << 8;
}
static inline uint zeros_of_shorts(global const ushort* pixels) {
  return bits_of_lanes(convert_char16(vload16(0, pixels) == (ushort16)0));
}
static inline uint zeros_of_ints(global const uint* pixels, uint sign, uint most) {
  return bits_of_lanes(convert_char16((vload16(0, pixels) & ~sign) - 1u >= (uint16)most));
}
static inline uint zeros_of_longs(global const ulong* pixels, ulong sign, ulong most) {
  return bits_of_lanes(convert_char16((vload16(0, pixels) & ~sign) - 1ul >= (ulong16)most));
}

// What has a sign is a float, or a double: greater than infinity is what is no number.
#define SIGN_OF_INTS(has_sign) ((has_sign) ? 0x80000000u : 0u)
#define MOST_OF_INTS(skips_nan) ((skips_nan) ? 0x7f800000u : 0xffffffffu)
#define SIGN_OF_LONGS(has_sign) ((has_sign) ? 0x8000000000000000ul : 0ul)
#define MOST_OF_LONGS(skips_nan) ((skips_nan) ? 0x7ff0000000000000ul : 0xfffffffffffffffful)

static inline bool is_zero(global const uchar* pixels, int bytes, bool has_sign, bool skips_nan, size_t at) {
  switch (bytes) {
    case 1: return pixels[at] == 0;
    case 2: return ((global const ushort*)pixels)[at] == 0;
    case 4: return (((global const uint*)pixels)[at] & ~SIGN_OF_INTS(has_sign)) - 1u >= MOST_OF_INTS(skips_nan);
    default: return (((global const ulong*)pixels)[at] & ~SIGN_OF_LONGS(has_sign)) - 1ul >= MOST_OF_LONGS(skips_nan);
  }
}

static inline uint zeros_of_word(global const uchar* pixels, int bytes, bool has_sign, bool skips_nan, size_t at) {
  switch (bytes) {
    case 1: return zeros_of_bytes(pixels + at);
    case 2: return zeros_of_shorts((global const ushort*)pixels + at);
    case 4: return zeros_of_ints((global const uint*)pixels + at, SIGN_OF_INTS(has_sign), MOST_OF_INTS(skips_nan));
    default: return zeros_of_longs((global const ulong*)pixels + at, SIGN_OF_LONGS(has_sign), MOST_OF_LONGS(skips_nan));
  }
}

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
      uint word = 0;
      for (int x = width / STRIP * STRIP; x < width; ++x) {
        const bool zero = is_zero(pixels, bytes, is_float, skips_nan, start + (size_t)x);
        word |= (uint)(zero != (wanted != 0)) << x % STRIP;
      }
      count += popcount(word);
      out[width / STRIP] = (ushort)word;
    }
    for (int i = STRIPS_OF(width); i < words; ++i) out[i] = 0;
    counts[row] = count;
  }
}

// Behind the counts of the rows stands that of all marks, and behind it how many marks come before each row.
kernel void sum_counts(global uint* restrict counts, int rows) {
  if (get_global_id(0) > 0) return;
  uint marks = 0;
  for (int row = 0; row < rows; ++row) {
    counts[rows + 1 + row] = marks;
    marks += counts[row];
  }
  counts[rows] = marks;
}

// THE RANK of a mark is its number in row-major order: `starts` says that of the first one of each 64 pixels of a row.
kernel void start_words(global const ulong* restrict marks, global const uint* restrict counts, int rows, int words,
                        global uint* restrict starts) {
  const int row = (int)get_global_id(0);
  if (row >= rows) return;
  const size_t first = (size_t)row * (size_t)words;
  uint start = counts[rows + 1 + row];
  for (int i = 0; i < words; ++i) {
    starts[first + (size_t)i] = start;
    start += (uint)popcount(marks[first + (size_t)i]);
  }
}

static inline uint rank_of(global const ulong* marks, global const uint* starts, uint word, uint bit) {
  return starts[word] + (uint)popcount(marks[word] & (((ulong)1 << bit) - 1));
}

// The positions of the marks, in the order of their ranks: x in the lowest bits, then y, then z; and one that is empty.
kernel void list_marks(global const ushort* restrict marks, global const uint* restrict counts, int rows, int words,
                       int height, int bits_x, int bits_y, uint empty, global uint* restrict positions) {
  const int row = (int)get_global_id(0);
  if (row > rows) return;
  if (row == rows) {
    positions[counts[rows]] = empty;
    return;
  }
  const size_t first = (size_t)row * (size_t)words;
  const uint start = (uint)(row / height) << (bits_x + bits_y) | (uint)(row % height) << bits_x;
  uint rank = counts[rows + 1 + row];
  for (int i = 0; i < words; ++i) {
    for (uint rest = marks[first + (size_t)i]; rest != 0; rest &= rest - 1) {
      positions[rank++] = start + (uint)(i * STRIP) + popcount((rest & -rest) - 1);
    }
  }
}

// SEEDS as marks: their pixels are marked, and `labels` has the id of the seed there, the lowest one of several. What
// other pixels of `labels` hold does not matter. Each work-item paints rows of its own, and looks at all seeds from the
// last one on: so the lowest id comes last.
#define EMPTY_SEED 0x80000000u
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
  if (!some_of(mine)) return;
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
  if (!some_of(mine)) return;
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
