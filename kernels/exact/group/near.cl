// Labelling a patch by the seeds of the bins around it: a seed near is found, then all seeds that it does not dominate.

#ifndef VOROCL_EXACT_GROUP_NEAR
#define VOROCL_EXACT_GROUP_NEAR

#include "exact/group/candidates.cl"

// As far as pixels at this distance can be apart along one axis.
static inline int most_along(uint distance) {
#ifdef VOROCL_EUCLIDEAN
  return (int)sqrt((float)distance) + 1;  // more than the error of the root
#else
  return (int)distance;
#endif
}

// Bins of a level, both ends included.
static inline Box bins_around(const SeedIndex* index, Box pixels, int reach, int level) {
  const int bits = bin_bits(level);
  const Box bins = {max((pixels.left - reach) >> bits, 0), max((pixels.top - reach) >> bits, 0),
                    min((pixels.right + reach) >> bits, columns_of(index->width, level) - 1),
                    min((pixels.bottom + reach) >> bits, rows_of(index->height, level) - 1)};
  return bins;
}

// A seed near the centre of a patch, or EMPTY if there is none at all: the nearest one of those that represent bins,
// from the top of the pyramid down, of a level those within the distance known.
typedef struct {
  uint least, seed;
  uint finer;  // the last level where a bin that was looked at has more seeds than its representative
} Descent;

static inline uint find_seed_near(local Descent* descent, const SeedIndex* index, global const uint* pyramid, int top,
                                  Box patch) {
  const int item = (int)get_local_id(0), items = (int)get_local_size(0);
  const uint centre = centre_of(patch);
  const Box pixel = box_of_pixel(centre);
  uint own_least = NO_DISTANCE, own_seed = EMPTY;
  if (item == 0) {
    descent->least = NO_DISTANCE;
    descent->seed = EMPTY;
    descent->finer = 0;
  }
  SYNC();
  Box bins = bins_around(index, pixel, LAST_COORDINATE, top);
  int level = top;
  while (level >= 0) {
    const int columns = bins.right - bins.left + 1, count = columns * (bins.bottom - bins.top + 1);
    const int across = columns_of(index->width, level);
    global const uint* const representatives =
        pyramid + level_start(index->width, index->height, level) + bins.top * across + bins.left;
    bool more = false;
    for (int i = item; i < count; i += items) {
      const uint representative = representatives[i / columns * across + i % columns];
      if (representative != EMPTY) {
        const uint seed = representative & ~MORE, distance = distance_to(centre, seed);
        own_seed = WINS(seed, distance, own_seed, own_least) ? seed : own_seed;
        own_least = min(own_least, distance);
        more |= (representative & MORE) != 0;
      }
    }
    if (own_seed != EMPTY) atomic_min(&descent->least, own_least);
    if (more) descent->finer = (uint)level;
    SYNC();
    if (descent->finer != (uint)level) {
      level = -1;
    } else {
      --level;
      bins = bins_around(index, pixel, most_along(descent->least), level);
      if ((bins.right - bins.left + 1) * (bins.bottom - bins.top + 1) > MOST_LOOKED_AT) level = -1;
    }
    SYNC();
  }
  if (own_seed != EMPTY && own_least == descent->least) atomic_min(&descent->seed, own_seed);
  SYNC();
  return descent->seed;
}

// Seeds of one row of bins are gathered by so many items at a time.
#define ITEMS_OF_ROW 8

static inline uint seeds_in(const SeedIndex* index, Box bins) {
  uint seeds = 0;
  for (int y = bins.top + (int)get_local_id(0); y <= bins.bottom; y += (int)get_local_size(0)) {
    seeds += count_seeds(index, bins.left, bins.right, y);
  }
  return seeds;
}

// Gathers the seeds of some bins that the first dominator does not drop; counts more than there is room for.
static inline void gather(local uint* seeds, local uint* count, const SeedIndex* index,
                          local const PatchDominators* dominators, Box patch, Box bins) {
  const int item = (int)get_local_id(0), items = (int)get_local_size(0);
  for (int y = bins.top + item / ITEMS_OF_ROW; y <= bins.bottom; y += items / ITEMS_OF_ROW) {
    const uint end = index->starts[start_of(bins.right + 1, y, index->columns)];
    for (uint i = index->starts[start_of(bins.left, y, index->columns)] + (uint)(item % ITEMS_OF_ROW); i < end;
         i += ITEMS_OF_ROW) {
      const uint seed = index->list[i];
      if (!is_dominated(dominators, 1, patch, box_of_pixel(seed))) {
        const uint at = atomic_inc(count);
        if (at < MOST_GATHERED) seeds[at] = seed;
      }
    }
  }
  SYNC();
}

// Labels the patches that are pending, or queues them for the search: how many, and each with the seed near it.
kernel void label_patches(SEED_INDEX_PARAMETERS, global const uint* restrict pyramid, int top_level,
                          global const uint* restrict pending, global uint* restrict labels,
                          global uint* restrict queue) {
  local PatchDominators dominators;
  local Ranked ranked;
  local uint gathered[MOST_GATHERED], candidates[MOST_RANKED];
  local Descent descent;
  local uint scanned[1], gathered_count[1], candidate_count[1];
  const int item = (int)get_local_id(0), items = (int)get_local_size(0), patch = (int)get_group_id(0);
  if (!pending[patch]) return;
  const SeedIndex index = SEED_INDEX_OF_PARAMETERS;
  const Box box = box_of_patch(&index, patch);
  if (item == 0) *scanned = *gathered_count = *candidate_count = 0;
  const uint near = find_seed_near(&descent, &index, pyramid, top_level, box);
  begin_dominators(&dominators, box, near);

  // No pixel's nearest seed is farther than this one is from the farthest corner.
  const uint farthest = max(max(dominators.distance[0][0], dominators.distance[0][1]),
                            max(dominators.distance[0][2], dominators.distance[0][3]));
  Box bins = bins_around(&index, box, most_along(farthest), 0);
  const uint own = seeds_in(&index, bins);
  if (own != 0) atomic_add(scanned, own);
  SYNC();
  if (*scanned > MOST_SCANNED) bins.bottom = -1;  // gathers nothing
  gather(gathered, gathered_count, &index, &dominators, box, bins);

  if (near == EMPTY || *gathered_count == 1) {
    fill_patch(&index, box, near == EMPTY ? NO_LABEL : id_of(&index, near), labels);
  } else {
    // From here on lists that are too long count as empty.
    const int seeds = *gathered_count <= MOST_GATHERED ? (int)*gathered_count : 0;
    improve_dominators(&dominators, gathered, seeds);
    keep_candidates(candidates, candidate_count, MOST_RANKED, &dominators, box, gathered, seeds);
    const int count = *candidate_count <= MOST_RANKED ? (int)*candidate_count : 0;
    rank_candidates(&ranked, &index, box, dominators.seed[0], candidates, count);
    for (int i = item; i < count; i += items) ranked.value[i] = id_of(&index, ranked.value[i]);
    SYNC();
    const uint mask = (1u << bits_of_rank(count)) - 1;
    const int column = item_column();
    for (int row = item_row() * PIXELS; row < PATCH && count > 0; row += item_rows() * PIXELS) {
      int8 least = find_least_keys_below(&ranked, count, column, row);
      global uint* const label = label_in_patch(&index, labels, box, column, row);
      const int pixels = pixels_in_patch(box, column, row);
#pragma unroll
      for (int k = 0; k < PIXELS; ++k, least = least.s12345670) {
        if (k < pixels) label[k * width] = ranked.value[(uint)least.s0 & mask];
      }
    }
    if (item == 0 && count == 0) {
      const uint at = atomic_inc(queue);
      queue[1 + 2 * at] = (uint)patch;
      queue[2 + 2 * at] = near;
    }
  }
}

#endif
