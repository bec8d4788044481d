// Labelling a box by its candidates: at each pixel the candidate with the least key wins.
//
// A candidate's KEY at a pixel holds, above, by how much farther it is than the base, and, in the lowest bits, its rank
// by the tie rule. The base is the nearest seed to the box's centre. A key is the sum of a part for the pixel's column
// and one for its row.

#ifndef VOROCL_EXACT_KEYS
#define VOROCL_EXACT_KEYS

#include "exact/box.cl"
#include "exact/dominance.cl"

#define RANK_BITS 8
#define MOST_KEYS (1 << RANK_BITS)

// A difference of distances fits in so many bits and a sign, however large the distances are. At the centre the
// difference is not negative, as the base is the nearest seed; at one corner it is not positive, as the base
// dominates no candidate. So it is nowhere farther from 0 than it varies in the box, and along an axis it varies by
// at most 2 * LAST_COORDINATE per pixel (Euclidean) or 2 per pixel (Manhattan).
#define DIFFERENCE_BITS 22
#if 2 * LAST_COORDINATE * ((1 << BIN_BITS) - 1 + (PAIR << BIN_BITS) - 1) >= 1 << DIFFERENCE_BITS
#error "A difference of distances in a pair of bins does not fit in its bits"
#endif
#if 1 + DIFFERENCE_BITS + RANK_BITS > 32
#error "A key does not fit in an int"
#endif

// Numbers the seeds of a padded list in the order of the tie rule.
static inline void rank_by_tie_rule(const uint* seeds, int count, uint* ranks) {
  for (int first = 0; first < count; first += VOROCL_WIDTH) {
    const uint_v seed = LOAD_VECTOR(seeds + first);
    uint_v rank = (uint_v)0;
    for (int i = 0; i < count; ++i) rank += select((uint_v)0, (uint_v)1, COMES_FIRST(seeds[i], seed));
    STORE_VECTOR(rank, ranks + first);
  }
}

// A block is so many rows of a bin, whole ones: what is written to memory comes in cache lines. Its vectors are
// numbered row-major.
#define VECTORS_OF_ROW (BIN / VOROCL_WIDTH)
#define BLOCK_ROWS (VOROCL_WIDTH >= 4 ? VOROCL_WIDTH / 2 : 1)
#define BLOCK_VECTORS (BLOCK_ROWS * VECTORS_OF_ROW)

// The least keys in a block, given the keys' parts of each column and of the block's rows.
static inline void find_least_keys(const uint_v* of_column, const uint* of_rows, int count, int_v* least) {
#pragma unroll
  for (int i = 0; i < BLOCK_VECTORS; ++i) least[i] = (int_v)INT_MAX;
  for (int candidate = 0; candidate < count; ++candidate) {
    const uint_v* const of_columns = of_column + candidate * VECTORS_OF_ROW;
    const uint* const of_row = of_rows + candidate * VOROCL_WIDTH;
#pragma unroll
    for (int i = 0; i < BLOCK_VECTORS; ++i) {
      least[i] = min(least[i], AS_INT_V(of_columns[i % VECTORS_OF_ROW] + of_row[i / VECTORS_OF_ROW]));
    }
  }
}

// The labels of a block, looked up by the ranks in its keys. The table of labels fills so many vectors: up to four are
// permuted, which is done without memory. Each call has a constant for them.
__attribute__((always_inline)) static inline void look_up_labels(const uint* label_of, int vectors, uint_v rank_mask,
                                                                 const int_v* keys, uint_v* labels) {
#pragma unroll
  for (int i = 0; i < BLOCK_VECTORS; ++i) {
    const uint_v rank = AS_UINT_V(keys[i]) & rank_mask;
    if (vectors == 1) labels[i] = look_up_in_1(label_of, rank);
    if (vectors == 2) labels[i] = look_up_in_2(label_of, rank);
    if (vectors == 3) labels[i] = look_up_in_3(label_of, rank);
    if (vectors == 4) labels[i] = look_up_in_4(label_of, rank);
  }
}

static inline void look_up_labels_in_memory(const uint* label_of, uint_v rank_mask, const int_v* keys,
                                            uint_v* labels) {
  uint at[VOROCL_WIDTH];
  for (int i = 0; i < BLOCK_VECTORS; ++i) {
    STORE_VECTOR(AS_UINT_V(keys[i]) & rank_mask, at);
    for (int lane = 0; lane < VOROCL_WIDTH; ++lane) at[lane] = label_of[at[lane]];
    labels[i] = LOAD_VECTOR(at);
  }
}

// Stores the labels of a block whose first row is `y`, as far as they lie in the box.
static inline void store_block(const SeedIndex* index, const uint_v* label, Box box, int y, global uint* labels) {
  const int width = index->width;
  if (box.left + BIN <= index->x0 + width && y + BLOCK_ROWS <= box.bottom + 1) {
    global uint* const first = label_at(index, labels, box.left, y);
#pragma unroll
    for (int i = 0; i < BLOCK_VECTORS; ++i) {
      STORE_WHOLE_VECTOR(label[i], first + i / VECTORS_OF_ROW * width + i % VECTORS_OF_ROW * VOROCL_WIDTH);
    }
  } else {
    for (int i = 0; i < min(BLOCK_ROWS, box.bottom + 1 - y) * VECTORS_OF_ROW; ++i) {
      store_in_row(index, label[i], labels, box.left + i % VECTORS_OF_ROW * VOROCL_WIDTH, y + i / VECTORS_OF_ROW);
    }
  }
}

// Labels a box as wide as a bin by candidates and their ranks; `label_of` is in the order of the ranks.
static inline void label_by_keys(const SeedIndex* index, const uint* seeds, const uint* ranks, const uint* label_of,
                                 int count, uint base, Box box, global uint* labels) {
  const int rank_bits = 32 - (int)clz((uint)count - 1), tables = (count - 1) / VOROCL_WIDTH + 1;
  const uint_v rank_mask = (uint_v)((1u << rank_bits) - 1);
  uint_v of_column[MOST_KEYS * VECTORS_OF_ROW];
  uint of_row[MOST_KEYS * VOROCL_WIDTH];
#pragma unroll
  for (int i = 0; i < VECTORS_OF_ROW; ++i) {
    const int_v x = box.left + i * VOROCL_WIDTH + AS_INT_V(LANES), offset_of_base = x - packed_x(base);
    const int_v along_base = ALONG(offset_of_base);
    for (int candidate = 0; candidate < count; ++candidate) {
      const int_v offset = x - packed_x(seeds[candidate]);
      of_column[candidate * VECTORS_OF_ROW + i] =
          (AS_UINT_V(ALONG(offset) - along_base) << rank_bits) + ranks[candidate];
    }
  }
  for (int top = box.top; top <= box.bottom; top += VOROCL_WIDTH) {
    const int_v y = top + AS_INT_V(LANES), offset_of_base = y - packed_y(base);
    const int_v along_base = ALONG(offset_of_base);
    for (int candidate = 0; candidate < count; ++candidate) {
      const int_v offset = y - packed_y(seeds[candidate]);
      STORE_VECTOR(AS_UINT_V(ALONG(offset) - along_base) << rank_bits, of_row + candidate * VOROCL_WIDTH);
    }
    for (int first = 0; first < VOROCL_WIDTH; first += BLOCK_ROWS) {
      int_v least[BLOCK_VECTORS];
      uint_v label[BLOCK_VECTORS];
      find_least_keys(of_column, of_row + first, count, least);
      if (tables == 1) {
        look_up_labels(label_of, 1, rank_mask, least, label);
      } else if (tables == 2) {
        look_up_labels(label_of, 2, rank_mask, least, label);
      } else if (tables == 3) {
        look_up_labels(label_of, 3, rank_mask, least, label);
      } else if (tables == 4) {
        look_up_labels(label_of, 4, rank_mask, least, label);
      } else {
        look_up_labels_in_memory(label_of, rank_mask, least, label);
      }
      store_block(index, label, box, top + first, labels);
    }
  }
}

// Labels a box by a padded list that holds its candidates. The dominators' first seed is the nearest one to its centre.
// (Inlined by PoCL into label_far it takes half as long again.)
__attribute__((noinline)) static void label_by_list(const SeedIndex* index, const Dominators* dominators,
                                                    const uint* seeds, int count, Box box, global uint* labels) {
  uint own[MOST_KEYS + VOROCL_WIDTH], bits[MOST_KEYS + VOROCL_WIDTH];
  uint ranks[MOST_KEYS + VOROCL_WIDTH], label_of[MOST_KEYS + 4 * VOROCL_WIDTH];
  for (int i = 0; i < count; i += VOROCL_WIDTH) {
    const uint_v seed = seed_of_image(index, LOAD_VECTOR(seeds + i));
    STORE_VECTOR(seed, own + i);
    STORE_VECTOR(BIT_INDEX(seed, index->columns), bits + i);
  }
  rank_by_tie_rule(own, count, ranks);
  for (int i = 0; i < count; ++i) label_of[ranks[i]] = index->ids[list_index(index->bits, index->word_starts, bits[i])];
  if (count == 1) {
    fill_box(index, box, label_of[0], labels);
  } else {
    label_by_keys(index, seeds, ranks, label_of, count, dominators->seed[0], box, labels);
  }
}

#endif
