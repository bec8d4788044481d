// The first tier: pairs of bins that have seeds near are labelled by candidates from the bins around them. What that
// cannot do is left to far.cl.

#ifndef VOROCL_EXACT_NEAR
#define VOROCL_EXACT_NEAR

#include "exact/collect.cl"
#include "exact/keys.cl"

// The seeds of a bin or a pair of bins and of the bins up to MOST_AWAY away. In the end the candidates are left.
// The bins of a row, one beside the other, are added at once.
#define MOST_NEAR MOST_CANDIDATES
typedef struct {
  Box box;
  Dominators dominators;
  int count;
  uint seeds[MOST_NEAR + (2 * MOST_AWAY + 1) * BIN * BIN + VOROCL_WIDTH];
} Near;

// Takes the seeds of so many bins, one above the other, and of those up to so many bins away; false if that makes too
// many.
static inline bool take_near(Near* near, const SeedIndex* index, int x, int y, int bins, int away) {
  near->count = 0;
  for (int row = y - away; row < y + bins + away; ++row) {
    near->count = add_seeds(index, x - away, x + away, row, near->seeds, near->count);
    if (near->count <= MOST_NEAR) continue;
    pad(near->seeds, near->count);
    improve_dominator(&near->dominators, 0, near->seeds, near->count);
    near->count = drop_dominated(&near->dominators, near->seeds, near->count);
    if (near->count > MOST_NEAR) return false;
  }
  pad(near->seeds, near->count);
  return true;
}

// Labels rows of so many bins, one above the other, if there are seeds near and all of their candidates are; else
// false. No pixel of the box is farther from the seed nearest to its centre than the farthest corner is, so every
// candidate is no farther from some pixel.
static bool label_by_near(const SeedIndex* index, int x, int y, int bins, int first, int rows, global uint* labels) {
  Near near;
  near.box = box_of(index, x * BIN, y * BIN + first, BIN, rows);
  if (near.box.top > near.box.bottom) return true;
  no_dominators(&near.dominators, near.box);
  if (!take_near(&near, index, x, y, bins, 1) || near.count == 0) return false;
  improve_dominator(&near.dominators, 0, near.seeds, near.count);
  int farthest = 0;
  for (int corner = 0; corner < CORNERS; ++corner) farthest = max(farthest, (int)near.dominators.distance[0][corner]);
  if (farthest > ALONG(MOST_AWAY * BIN)) return false;
  if (farthest > ALONG(BIN) && !take_near(&near, index, x, y, bins, MOST_AWAY)) return false;
  near.count = drop_dominated(&near.dominators, near.seeds, near.count);
  if (near.count > MOST_KEYS) return false;
  label_by_list(index, &near.dominators, near.seeds, near.count, near.box, labels);
  return true;
}

// Labels the pixels of seeds in crowded bins, of so many bins one above the other: see add_seeds().
static inline void label_crowd(const SeedIndex* index, int x, int y, int bins, global uint* labels) {
  const int x0 = x * BIN - margin_x(index->width);
  for (int bin_y = y; bin_y < min(y + bins, index->rows); ++bin_y) {
    if (count_seeds(index, x, x, bin_y) < CROWDED) continue;
    for (int row = bin_y * BIN; row < bin_y * BIN + BIN; ++row) {
      const int y0 = row - margin_y(index->height);
      if (y0 < 0 || y0 >= index->height) continue;
      for (uint rest = seeds_in_row(index, x, row); rest != 0; rest &= rest - 1) {
        const int column = (int)lowest_bit(rest);
        if (x0 + column < 0 || x0 + column >= index->width) continue;
        labels[y0 * index->width + x0 + column] = id_of(index, pack(x * BIN + column, row));
      }
    }
  }
}

// Whether all pixels of a bin are seeds.
static inline bool is_full(const SeedIndex* index, int x, int y) {
  const int columns = min(BIN, frame_width(index->width) - x * BIN);
  return (int)count_seeds(index, x, x, y) == columns * min(BIN, frame_height(index->height) - y * BIN);
}

// Labels a bin, or each half of one that has too many candidates.
static inline bool label_bin(const SeedIndex* index, int x, int y, global uint* labels) {
  return label_by_near(index, x, y, 1, 0, BIN, labels) || (label_by_near(index, x, y, 1, 0, BIN / 2, labels) &&
                                                           label_by_near(index, x, y, 1, BIN / 2, BIN / 2, labels));
}

static inline uint seeds_near(const SeedIndex* index, int x, int y, int bins) {
  uint seeds = 0;
  for (int row = y - 1; row <= y + bins; ++row) seeds += count_seeds(index, x - 1, x + 1, row);
  return seeds;
}

static inline int pairs_down(const SeedIndex* index) { return (index->rows - 1) / PAIR + 1; }

// Labels a pair of bins, and says by a bit each which of them it could: the upper bin's is UPPER, the lower bin's
// LOWER.
#define UPPER 1
#define LOWER 2
#define BOTH (UPPER | LOWER)
#if PAIR != 2
#error "UPPER and LOWER are not the bits of a pair"
#endif
static inline uint label_pair(const SeedIndex* index, int x, int y, global uint* labels) {
  const Box box = box_of(index, x * BIN, y * BIN, BIN, PAIR * BIN);
  if (box.left > box.right || box.top > box.bottom) return BOTH;  // in the margin
  const uint seeds = seeds_near(index, x, y, PAIR);
  if (seeds < SPARSE) return 0;
  if (seeds < MEDIUM) return label_by_near(index, x, y, PAIR, 0, PAIR * BIN, labels) ? BOTH : 0;
  uint labelled = BOTH;
  for (int i = 0; i < min(PAIR, rows_of_grid(index) - y); ++i) {
    if (!is_full(index, x, y + i) && !label_bin(index, x, y + i, labels)) labelled ^= 1u << i;
  }
  label_crowd(index, x, y, PAIR, labels);
  return labelled;
}

VECTOR_KERNEL void label_near(SEED_INDEX_PARAMETERS, global uint* restrict labels, global uint* restrict labelled) {
  const SeedIndex index = SEED_INDEX_OF_PARAMETERS;
  const int pair = (int)get_global_id(0);
  if (pair >= index.columns * pairs_down(&index)) return;
  labelled[pair] = label_pair(&index, pair % index.columns, pair / index.columns * PAIR, labels);
}

#endif
