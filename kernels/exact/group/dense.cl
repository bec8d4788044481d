// Labelling a patch where seeds are dense: the nearest seed of each row of pixels, found among the row's bits, and then
// the best of the rows.

#ifndef VOROCL_EXACT_GROUP_DENSE
#define VOROCL_EXACT_GROUP_DENSE

#include "exact/group/patch.cl"

// The rows of a patch and those up to REACH above and below it.
#define PATCH_ROWS (PATCH + 2 * REACH)

// ROWS: the seeds of the rows of pixels in and around a patch, a bit each, from the bin at the left of the patch to the
// one at its right, and the same bits in reverse; and for each bin where its seeds of the row begin in the list of
// seeds, less the number of seeds in the row before them.
#define BINS_OF_ROW 4
#define COLUMN_BITS 6  // of the number of a bit in its row
typedef struct {
  ulong mask[PATCH_ROWS], reversed[PATCH_ROWS];
  uint start[PATCH_ROWS * BINS_OF_ROW];
} Rows;
#if BINS_OF_ROW << BIN_BITS != 1 << COLUMN_BITS
#error "A row is not a ulong"
#endif

// A pixel's ROW KEY of a row: the distance to the row's nearest seed, the row's number, so that of rows at equal
// distances the one with the least number has the least key, and the number of the seed's bit. A row without a seed
// near has a key that is too great for a label.
#define NUMBER_BITS 6
#define KEY_BITS (NUMBER_BITS + COLUMN_BITS)  // below the distance
#if (1 << PATCH_BITS) + 2 * REACH > 1 << NUMBER_BITS
#error "A row does not fit in the bits of a row key"
#endif

// Pixels of an item, one below the other, that look at the same rows.
#define RUN 4

static inline ulong swapped(ulong bits, uint width, ulong lower) {
  return (bits >> width & lower) | (bits & lower) << width;
}
static inline ulong reversed_bits(ulong bits) {
  bits = swapped(bits, 1, 0x5555555555555555ul);
  bits = swapped(bits, 2, 0x3333333333333333ul);
  bits = swapped(bits, 4, 0x0f0f0f0f0f0f0f0ful);
  bits = swapped(bits, 8, 0x00ff00ff00ff00fful);
  bits = swapped(bits, 16, 0x0000ffff0000fffful);
  return rotate(bits, 32ul);
}

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
  return row - border.row + (PERIODIC_Y && row < border.row ? PATCH_ROWS : 0);
}

static inline void read_row(local Rows* rows, int number, const SeedIndex* index, int first_bin, int y) {
  ulong mask = 0;
  if (y >= 0 && y < frame_height(index->height)) {
    const int of_rows = (y >> BIN_BITS) * index->columns * WORDS + y % BIN / ROWS_OF_WORD;
    const uint before = (1u << y % ROWS_OF_WORD * BIN) - 1;
#pragma unroll
    for (int i = 0; i < BINS_OF_ROW; ++i) {
      const int bin = first_bin + i;
      if (bin >= 0 && bin < index->columns) {
        const uint bits = index->bits[of_rows + bin * WORDS];
        rows->start[number * BINS_OF_ROW + i] =
            index->word_starts[of_rows + bin * WORDS] + popcount(bits & before) - (uint)popcount(mask);
        mask |= (ulong)row_bits(bits, y) << i * BIN;
      }
    }
  }
  rows->mask[number] = mask;
  rows->reversed[number] = reversed_bits(mask);
}

// The row keys without the distance along y of a quad: four pixels of a row, one beside the other. What is to the left
// of a pixel, and what is to the right, are taken as words whose highest bit is the pixel's. Of two seeds as near the
// left one is the nearest, unless a border lies in between: so says the tie rule.
#define QUADS_OF_ROW (PATCH / 4)
#if REACH + 3 > 31 || BIN + PATCH + REACH > 1 << COLUMN_BITS
#error "A quad's seeds do not fit in their words"
#endif
static inline int4 keys_along_x(local const Rows* rows, Border border, int number, int column) {
  const int first = BIN + column, row_start = number << COLUMN_BITS;
  const uint4 left = (uint4)(uint)(rows->mask[number] << (60 - first) >> 32) << (uint4)(3, 2, 1, 0);
  const uint4 right = (uint4)(uint)(rows->reversed[number] << first >> 32) << (uint4)(0, 1, 2, 3);
  const int4 way = as_int4(clz(left | right)), pixel = row_start + first + (int4)(0, 1, 2, 3);
  const int4 at_left = pixel - way, at_right = pixel + way;
  int4 is_left = as_int4(left << as_uint4(way));  // below 0 if it is
  if (PERIODIC_X) {
    const int4 border_between = at_left < row_start + border.bit && row_start + border.bit <= at_right;
    is_left = select(is_left, ~as_int4(right << as_uint4(way)), border_between);
  }
  return (ALONG(way) << KEY_BITS) + select(at_right, at_left, is_left);
}

// The id of the seed of a row key.
static inline uint id_of_key(local const Rows* rows, int key, const SeedIndex* index) {
  const uint place = (uint)key & ((1 << KEY_BITS) - 1), bit = place & ((1 << COLUMN_BITS) - 1);
  const uint before = (uint)popcount(rows->mask[place >> COLUMN_BITS] & ((1ul << bit) - 1));
  return index->ids[rows->start[place >> BIN_BITS] + before];
}

static inline int greatest(int4 values) { return max(max(values.s0, values.s1), max(values.s2, values.s3)); }

// The least row keys of RUN pixels, the first one in `row`: goes up and down from them, at most `reach` rows, until
// no row farther away can have a nearer seed.
static inline int4 find_least_row_keys_below(local const int* along_x, int row, int column, int reach) {
  local const int* above = along_x + row * PATCH + column;
  local const int* below = above + (RUN - 1) * PATCH;
  int4 along_y = ALONG((int4)(0, 1, 2, 3)) << KEY_BITS;  // from the row above to the pixels
  int4 least = *above + along_y;
#pragma unroll
  for (int i = 1; i < RUN; ++i) {
    const int4 offset = (int4)(0, 1, 2, 3) - i;
    least = min(least, above[i * PATCH] + (ALONG(offset) << KEY_BITS));
  }
  for (int away = 1; away <= reach && greatest(least) >= along_y.s1; ++away) {
    above -= PATCH;
    below += PATCH;
    along_y = (int4)(along_y.s123, ALONG(away + RUN - 1) << KEY_BITS);
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

// How many rows above and below are looked at first: those at less than so many sides of the square that a seed has on
// average. A ball of this radius has the area of 12.5 squares in both metrics. At random, one patch in 300 has a pixel
// whose seed is farther away.
#ifdef VOROCL_EUCLIDEAN
#define SIDES_LOOKED_AT 2.0f
#else
#define SIDES_LOOKED_AT 2.5f
#endif
static inline int first_reach(int seeds_around) {
  return min((int)ceil(SIDES_LOOKED_AT * sqrt((float)PIXELS_AROUND / (float)seeds_around)) - 1, REACH);
}

// Labels dense patches, and says of each patch whether it is pending: not dense, or a pixel has no seed within reach.
kernel void label_dense_patches(SEED_INDEX_PARAMETERS, global uint* restrict labels, global uint* restrict pending,
                                global uint* restrict queue) {
  local Rows rows;
  local int along_x[PATCH_ROWS * PATCH];
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
    read_row(&rows, number_of_row(border, row), &index, (box.left >> BIN_BITS) - 1, box.top - REACH + row);
  }
  int reach = first_reach(seeds_around);
  while (reach > 0) {
    if (item == 0) missing = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    const int quad = item & (QUADS_OF_ROW - 1);
    for (int row = REACH - reach + item / QUADS_OF_ROW; row < REACH + PATCH + reach; row += items / QUADS_OF_ROW) {
      vstore4(keys_along_x(&rows, border, number_of_row(border, row), 4 * quad),
              (size_t)(row * QUADS_OF_ROW + quad), along_x);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (int first = item_row() * RUN; first < PATCH; first += item_rows() * RUN) {
      int4 least = find_least_row_keys_below(along_x, REACH + first, column, reach);
      global uint* const label = label_in_patch(&index, labels, box, column, first);
      const int pixels = pixels_in_patch(box, column, first);
#pragma unroll
      for (int i = 0; i < RUN; ++i, least = least.s1230) {
        if (i < pixels) {
          if (least.s0 < ALONG(reach + 1) << KEY_BITS) {
            label[i * width] = id_of_key(&rows, least.s0, &index);
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
