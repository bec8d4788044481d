// Labelling a patch where seeds are dense: the nearest seed of each row of pixels, found among the row's bits, and then
// the best of the rows.

#ifndef VOROCL_EXACT_GROUP_DENSE
#define VOROCL_EXACT_GROUP_DENSE

#include "exact/group/patch.cl"

// The rows of a patch and those up to REACH above and below it.
#define PATCH_ROWS (PATCH + 2 * REACH)

// A pixel's ROW KEY of a row: the distance to the row's nearest seed, and in the lowest bits the row, so that of rows
// at equal distances the upper one has the least key. A row without a seed near counts as one REACH + 1 away, which is
// too far for a label.
#define ROW_BITS 6
#define TOO_FAR (ALONG(REACH + 1) << ROW_BITS)
#if (1 << PATCH_BITS) + 2 * REACH > 1 << ROW_BITS
#error "A row does not fit in the bits of a row key"
#endif

// Pixels of an item, one below the other, that look at the same rows.
#define RUN 4
#if (((REACH + 1) * (REACH + 1)) << ROW_BITS) + (1 << ROW_BITS) > 0xffff
#error "The part of a row key along x does not fit in a ushort"
#endif

// The seeds of a row of the grid, a bit each, from the bin at the left of a patch to the one at its right.
static inline ulong mask_of_row(const SeedIndex* index, int bin_x, int y) {
  if (y < 0 || y >= index->height) return 0;
  global const uint* const row = index->bits + (y >> BIN_BITS) * index->columns * WORDS + y % BIN / ROWS_OF_WORD;
  ulong mask = 0;
#pragma unroll
  for (int i = 0; i < 4; ++i) {
    const int x = bin_x - 1 + i;
    if (x >= 0 && x < index->columns) mask |= (ulong)row_bits(row[x * WORDS], y) << i * BIN;
  }
  return mask;
}

// How far to the right of a pixel the nearest seed of its row is, of two the left one, which the tie rule says. REACH +
// 1 or more away stands for none.
static inline int offset_in_row(ulong mask, int column) {
  const uint window = (uint)(mask >> (column + BIN - REACH)), behind = window >> (REACH + 1);
  const int left = (int)clz(window & ALL_BITS) - (31 - REACH);
  const int right = (int)popcount((behind & -behind) - 1) + 1;
  return right < left ? right : -left;
}

static inline int greatest(int4 values) { return max(max(values.s0, values.s1), max(values.s2, values.s3)); }

// The least row keys of RUN pixels, the first one in `row`: goes up and down from them until no row farther away can
// have a nearer seed.
static inline int4 find_least_row_keys_below(local const ushort* along_x, int row, int column) {
  local const ushort* above = along_x + row * PATCH + column;
  local const ushort* below = above + (RUN - 1) * PATCH;
  int4 least = (int4)INT_MAX;
  int4 along_y = ALONG((int4)(0, 1, 2, 3)) << ROW_BITS;  // from the row above to the pixels
#pragma unroll
  for (int i = 0; i < RUN; ++i) {
    const int4 offset = (int4)(0, 1, 2, 3) - i;
    least = min(least, above[i * PATCH] + (ALONG(offset) << ROW_BITS));
  }
  for (int away = 1; away <= REACH && greatest(least) >= ALONG(away) << ROW_BITS; ++away) {
    above -= PATCH;
    below += PATCH;
    along_y = (int4)(along_y.s123, ALONG(away + RUN - 1) << ROW_BITS);
    least = min(least, min(*above + along_y, *below + along_y.s3210));
  }
  return least;
}

static inline bool is_dense(const SeedIndex* index, Box box) {
  uint seeds = 0;
#pragma unroll
  for (int i = 0; i < 4; ++i) {
    const int bin_x = box.left / BIN;
    seeds += count_seeds(index, bin_x - 1, bin_x + 2, box.top / BIN - 1 + i);
  }
  return seeds >= DENSE_AROUND;
}

// Labels dense patches, and says of each patch whether it is pending: not dense, or a pixel has no seed within reach.
kernel void label_dense_patches(SEED_INDEX_PARAMETERS, global uint* restrict labels, global uint* restrict pending,
                                global uint* restrict queue) {
  local ulong mask[PATCH_ROWS];
  local ushort along_x[PATCH_ROWS * PATCH];
  local uint missing;
  const SeedIndex index = SEED_INDEX_OF_PARAMETERS;
  const int item = (int)get_local_id(0), items = (int)get_local_size(0), patch = (int)get_group_id(0);
  const int column = item_column();
  const Box box = box_of_patch(patch, width, height);
  if (patch == 0 && item == 0) queue[0] = 0;
  if (!is_dense(&index, box)) {
    if (item == 0) pending[patch] = 1;
    return;
  }
  if (item == 0) missing = 0;
  for (int row = item; row < PATCH_ROWS; row += items) {
    mask[row] = mask_of_row(&index, box.left / BIN, box.top - REACH + row);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  for (int row = item_row(); row < PATCH_ROWS; row += item_rows()) {
    const int offset = offset_in_row(mask[row], column);
    along_x[row * PATCH + column] = (ushort)((ALONG(offset) << ROW_BITS) + row);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  for (int first = item_row() * RUN; first < PATCH; first += item_rows() * RUN) {
    int4 least = find_least_row_keys_below(along_x, REACH + first, column);
#pragma unroll
    for (int i = 0; i < RUN; ++i, least = least.s1230) {
      const int x = box.left + column, y = box.top + first + i;
      if (x <= box.right && y <= box.bottom) {
        if (least.s0 < TOO_FAR) {
          const int row = least.s0 & ((1 << ROW_BITS) - 1);
          labels[y * width + x] =
              id_of(&index, pack(x + offset_in_row(mask[row], column), box.top - REACH + row));
        } else {
          missing = 1;
        }
      }
    }
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (item == 0) pending[patch] = missing;
}

#endif
