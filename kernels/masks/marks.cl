// MARKS: a bit for each pixel that others look for, in words of 16 pixels of a row, the lowest bit at the left; and the
// number of marks of each row.

#ifndef VOROCL_MASKS_MARKS
#define VOROCL_MASKS_MARKS

#include "masks/lanes.cl"

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

// The marks of fewer pixels, as bits. `wanted`: see mark_pixels().
static inline uint marks_of_some(global const uchar* pixels, int bytes, bool has_sign, bool skips_nan, uint wanted,
                                 size_t at, int some) {
  uint word = 0;
  for (int i = 0; i < some; ++i) {
    const bool zero = is_zero(pixels, bytes, has_sign, skips_nan, at + (size_t)i);
    word |= (uint)(zero != (wanted != 0)) << i;
  }
  return word;
}

// Behind the counts of the rows stands that of all marks, and behind it how many marks come before each row. One
// work-group, whose items take a part of the rows each.
kernel void sum_counts(global uint* restrict counts, int rows) {
  local uint sums[MOST_SUMMING];  // of an item and of those before it
  const int item = (int)get_local_id(0), items = (int)get_local_size(0);
  const int first = (int)((long)item * rows / items), end = (int)((long)(item + 1) * rows / items);
  uint own = 0;
  for (int row = first; row < end; ++row) own += counts[row];
  uint sum = own;
  sums[item] = sum;
  barrier(CLK_LOCAL_MEM_FENCE);
  for (int step = 1; step < items; step *= 2) {
    if (item >= step) sum += sums[item - step];
    barrier(CLK_LOCAL_MEM_FENCE);
    sums[item] = sum;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  if (item == items - 1) counts[rows] = sum;
  uint before = sum - own;
  for (int row = first; row < end; ++row) {
    counts[rows + 1 + row] = before;
    before += counts[row];
  }
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

#define EMPTY_SEED 0x80000000u  // of a position: there is no seed

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

#endif
