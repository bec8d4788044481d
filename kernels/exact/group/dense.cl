// Labelling a patch where seeds are dense: the nearest seed of each row of pixels, found among the row's bits, and then
// the best of the rows.

#ifndef VOROCL_EXACT_GROUP_DENSE
#define VOROCL_EXACT_GROUP_DENSE

#include "exact/group/patch.cl"

// The rows of a patch and those up to REACH above and below it.
#define PATCH_ROWS (PATCH + 2 * REACH)

// A pixel's ROW KEY of a row: the distance to the row's nearest seed, and in the lowest bits the row's number, so that
// of rows at equal distances the one with the least number has the least key. A row without a seed near counts as one
// REACH + 1 away, which is too far for a label.
#define ROW_BITS 6
#if (1 << PATCH_BITS) + 2 * REACH > 1 << ROW_BITS
#error "A row does not fit in the bits of a row key"
#endif

// Pixels of an item, one below the other, that look at the same rows.
#define RUN 4
#if (((REACH + 1) * (REACH + 1)) << ROW_BITS) + (1 << ROW_BITS) > 0xffff
#error "The part of a row key along x does not fit in a ushort"
#endif

// ROWS: the seeds of the rows of pixels in and around a patch, a bit each, from the bin at the left of the patch to the
// one at its right; and for each bin where its seeds of the row begin in the list of seeds, less the number of seeds in
// the row before them.
#define BINS_OF_ROW 4
typedef struct {
  ulong mask[PATCH_ROWS];
  uint start[PATCH_ROWS * BINS_OF_ROW];
} Rows;

// Where a period begins again among the rows and among their bits; 0 if it does not.
typedef struct {
  int row, bit;
} Border;

static inline Border border_around(const SeedIndex* index, Box patch) {
  const Border border = {
      PERIODIC_Y ? first_of_period(patch.top - REACH, PATCH_ROWS, index->y0, index->height, 0) : 0,
      PERIODIC_X ? first_of_period(patch.left - BIN, BINS_OF_ROW * BIN, index->x0, index->width, 0) : 0};
  return border;
}

// The rows are numbered in the order of the tie rule: from above to below, but those behind a border come first.
static inline int number_of_row(Border border, int row) {
  return row - border.row + (row < border.row ? PATCH_ROWS : 0);
}
static inline int row_of_number(Border border, int number) {
  const int row = number + border.row;
  return row - (row < PATCH_ROWS ? 0 : PATCH_ROWS);
}

static inline void read_row(local Rows* rows, int row, const SeedIndex* index, int first_bin, int y) {
  ulong mask = 0;
  if (y >= 0 && y < frame_height(index->height)) {
    const int of_rows = (y >> BIN_BITS) * index->columns * WORDS + y % BIN / ROWS_OF_WORD;
    const uint before = (1u << y % ROWS_OF_WORD * BIN) - 1;
#pragma unroll
    for (int i = 0; i < BINS_OF_ROW; ++i) {
      const int bin = first_bin + i;
      if (bin >= 0 && bin < index->columns) {
        const uint bits = index->bits[of_rows + bin * WORDS];
        rows->start[row * BINS_OF_ROW + i] =
            index->word_starts[of_rows + bin * WORDS] + popcount(bits & before) - (uint)popcount(mask);
        mask |= (ulong)row_bits(bits, y) << i * BIN;
      }
    }
  }
  rows->mask[row] = mask;
}

// The part of a row from REACH pixels left of a column to REACH + 1 right of it, and how far the nearest seeds on both
// sides are in it; REACH + 1 or more stands for none. The macros take numbers and vectors.
static inline ulong window_of_row(ulong mask, int column) { return mask >> (column + BIN - REACH); }
#define WAY_TO_LEFT(window) (clz((window) & ALL_BITS) - (31 - REACH))
#define BEHIND(window) ((window) >> (REACH + 1))
#define WAY_TO_RIGHT(window) (popcount((BEHIND(window) & -BEHIND(window)) - 1) + 1)

// The row keys' parts along x of a quad, four pixels of a row one beside the other.
#define QUADS_OF_ROW (PATCH / 4)
static inline ushort4 keys_along_x(local const Rows* rows, Border border, int row, int column) {
  const ulong first = window_of_row(rows->mask[row], column);
  const uint4 window = (uint4)((uint)first, (uint)(first >> 1), (uint)(first >> 2), (uint)(first >> 3));
  const int4 way = as_int4(min(WAY_TO_LEFT(window), WAY_TO_RIGHT(window)));
  return convert_ushort4((ALONG(way) << ROW_BITS) + number_of_row(border, row));
}

// The id of a row's seed that is nearest to a pixel; of two the left one, unless a border lies in between: so says the
// tie rule.
static inline uint nearest_in_row(local const Rows* rows, Border border, int row, int column,
                                  const SeedIndex* index) {
  const ulong mask = rows->mask[row];
  const uint window = (uint)window_of_row(mask, column);
  const int left = (int)WAY_TO_LEFT(window), right = (int)WAY_TO_RIGHT(window);
  const int pixel = BIN + column;
  const bool right_first = pixel - left < border.bit && border.bit <= pixel + right;
  const uint bit = (uint)(pixel + (right < left + (right_first ? 1 : 0) ? right : -left));
  const uint before = (uint)popcount(mask & ((1ul << bit) - 1));
  return index->ids[rows->start[(uint)row * BINS_OF_ROW + bit / BIN] + before];
}

static inline int greatest(int4 values) { return max(max(values.s0, values.s1), max(values.s2, values.s3)); }

// The least row keys of RUN pixels, the first one in `row`: goes up and down from them, at most `reach` rows, until
// no row farther away can have a nearer seed.
static inline int4 find_least_row_keys_below(local const ushort* along_x, int row, int column, int reach) {
  local const ushort* above = along_x + row * PATCH + column;
  local const ushort* below = above + (RUN - 1) * PATCH;
  int4 along_y = ALONG((int4)(0, 1, 2, 3)) << ROW_BITS;  // from the row above to the pixels
  int4 least = *above + along_y;
#pragma unroll
  for (int i = 1; i < RUN; ++i) {
    const int4 offset = (int4)(0, 1, 2, 3) - i;
    least = min(least, above[i * PATCH] + (ALONG(offset) << ROW_BITS));
  }
  for (int away = 1; away <= reach && greatest(least) >= along_y.s1; ++away) {
    above -= PATCH;
    below += PATCH;
    along_y = (int4)(along_y.s123, ALONG(away + RUN - 1) << ROW_BITS);
    least = min(least, min(*above + along_y, *below + along_y.s3210));
  }
  return least;
}

// The seeds in the bins of a patch and in those at its left and right.
#define PIXELS_AROUND (2 * PATCH * PATCH)
static inline int count_seeds_around(const SeedIndex* index, Box patch) {
  const int bin_x = patch.left >> BIN_BITS, bin_y = patch.top >> BIN_BITS;
  return (int)(count_seeds(index, bin_x - 1, bin_x + 2, bin_y) + count_seeds(index, bin_x - 1, bin_x + 2, bin_y + 1));
}

// How many rows above and below are looked at first: twice the side of the square that a seed has on average. At
// random, one patch in 300 has a pixel whose seed is farther away.
static inline int first_reach(int seeds_around) {
  return min((int)(2 * sqrt((float)PIXELS_AROUND / (float)seeds_around)) + 1, REACH);
}

// Labels dense patches, and says of each patch whether it is pending: not dense, or a pixel has no seed within reach.
kernel void label_dense_patches(SEED_INDEX_PARAMETERS, global uint* restrict labels, global uint* restrict pending,
                                global uint* restrict queue) {
  local Rows rows;
  local ushort along_x[PATCH_ROWS * PATCH];
  local uint missing;
  const SeedIndex index = SEED_INDEX_OF_PARAMETERS;
  const int item = (int)get_local_id(0), items = (int)get_local_size(0), patch = (int)get_group_id(0);
  const int column = item_column();
  const Box box = box_of_patch(&index, patch);
  const Border border = border_around(&index, box);
  const int seeds_around = count_seeds_around(&index, box);
  if (patch == 0 && item == 0) queue[0] = 0;
  if (seeds_around < DENSE_AROUND) {
    if (item == 0) pending[patch] = 1;
    return;
  }
  for (int row = item; row < PATCH_ROWS; row += items) {
    read_row(&rows, row, &index, (box.left >> BIN_BITS) - 1, box.top - REACH + row);
  }
  int reach = first_reach(seeds_around);
  while (reach > 0) {
    if (item == 0) missing = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    const int quad = item & (QUADS_OF_ROW - 1);
    for (int row = REACH - reach + item / QUADS_OF_ROW; row < REACH + PATCH + reach; row += items / QUADS_OF_ROW) {
      vstore4(keys_along_x(&rows, border, row, 4 * quad), (size_t)(row * QUADS_OF_ROW + quad), along_x);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (int first = item_row() * RUN; first < PATCH; first += item_rows() * RUN) {
      int4 least = find_least_row_keys_below(along_x, REACH + first, column, reach);
      global uint* const label = label_in_patch(&index, labels, box, column, first);
      const int pixels = pixels_in_patch(box, column, first);
#pragma unroll
      for (int i = 0; i < RUN; ++i, least = least.s1230) {
        if (i < pixels) {
          if (least.s0 < ALONG(reach + 1) << ROW_BITS) {
            const int row = row_of_number(border, least.s0 & ((1 << ROW_BITS) - 1));
            label[i * width] = nearest_in_row(&rows, border, row, column, &index);
          } else {
            missing = 1;
          }
        }
      }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    reach = missing && reach < REACH ? REACH : 0;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  if (item == 0) pending[patch] = missing;
}

#endif
