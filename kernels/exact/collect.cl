// Collecting the seeds of bins that can be candidates elsewhere.

#ifndef VOROCL_EXACT_COLLECT
#define VOROCL_EXACT_COLLECT

#include "exact/seed_index.cl"

// The seeds of a row of the frame in one bin; outside the frame every pixel counts as a seed.
static inline uint seeds_in_row(const SeedIndex* index, int bin_x, int y) {
  if (bin_x < 0 || bin_x >= index->columns || y < 0 || y >= frame_height(index->height)) return ALL_BITS;
  return row_bits(index->bits[((y >> BIN_BITS) * index->columns + bin_x) * WORDS + y % BIN / ROWS_OF_WORD], y);
}

// Adds the rim of a bin: its seeds but those whose four neighbours are seeds, which win at no pixel but their own.
static inline int add_rim(const SeedIndex* index, int bin_x, int bin_y, uint* seeds, int count) {
  const int top = bin_y * BIN;
  uint above = seeds_in_row(index, bin_x, top - 1), own = seeds_in_row(index, bin_x, top);
  for (int y = top; y < min(top + BIN, frame_height(index->height)); ++y) {
    const uint below = seeds_in_row(index, bin_x, y + 1);
    const uint left = own << 1 | seeds_in_row(index, bin_x - 1, y) >> (BIN - 1);
    const uint right = own >> 1 | seeds_in_row(index, bin_x + 1, y) << (BIN - 1);
    for (uint rim = own & ~(above & below & left & right); rim != 0; rim &= rim - 1) {
      seeds[count++] = pack(bin_x * BIN + (int)lowest_bit(rim), y);
    }
    above = own;
    own = below;
  }
  return count;
}

// Copies a part of the list of all seeds, and may write a vector behind it.
static inline int copy_seeds(const SeedIndex* index, uint begin, uint end, uint* seeds, int count) {
  for (uint i = begin; i < end; i += VOROCL_WIDTH) {
    STORE_VECTOR(LOAD_VECTOR(index->list + i), seeds + count + (int)(i - begin));
  }
  return count + (int)(end - begin);
}

// Adds those seeds of the bins from (first_x, y) to (last_x, y), as far as they are in the frame, that can be
// candidates elsewhere: of a crowded bin only the rim. The pixels of its seeds are labelled by label_crowd().
static inline int add_seeds(const SeedIndex* index, int first_x, int last_x, int y, uint* seeds, int count) {
  first_x = max(first_x, 0);
  last_x = min(last_x, index->columns - 1);
  if (y < 0 || y >= index->rows || first_x > last_x) return count;
  global const uint* const starts = index->starts + start_of(0, y, index->columns);
  if (starts[last_x + 1] - starts[first_x] < CROWDED) {
    return copy_seeds(index, starts[first_x], starts[last_x + 1], seeds, count);
  }
  for (int x = first_x; x <= last_x; ++x) {
    count = starts[x + 1] - starts[x] < CROWDED ? copy_seeds(index, starts[x], starts[x + 1], seeds, count)
                                                : add_rim(index, x, y, seeds, count);
  }
  return count;
}

#endif
