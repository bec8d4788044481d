// The last tiers: for the pairs of bins that near.cl left, regions search the hierarchy for their candidates and hand
// them down to the tiles in them. Where lists overflow, each bin searches for itself.

#include "exact/hierarchy.cl"
#include "exact/near.cl"

// What a list's count says if there are more candidates than it holds.
#define TOO_MANY 0xffffffffu

// Along a periodic axis the image of a seed that is nearest to a region may be half a period away from it, outside the
// frame. So a region has coordinates of its own there, with its centre in the middle of those that a position holds.
#define MIDDLE ((LAST_COORDINATE + 1) / 2)
static inline void centre_on_region(SeedIndex* index, int region_x, int region_y) {
  const int size = 1 << bin_bits(REGION);
  if (PERIODIC_X) index->x0 = margin_x(index->width) + MIDDLE - (region_x * size + size / 2);
  if (PERIODIC_Y) index->y0 = margin_y(index->height) + MIDDLE - (region_y * size + size / 2);
}

static inline uint id_of_image(const SeedIndex* index, uint image) {
  uint seed[VOROCL_WIDTH];
  STORE_VECTOR(seed_of_image(index, (uint_v)image), seed);
  return id_of(index, seed[0]);
}

// Whether all pairs of a bin of some level are labelled.
static inline bool all_labelled(const SeedIndex* index, global const uint* labelled, int level, int x, int y) {
  const int size = 1 << FAN_BITS * level;
  for (int part_y = y * size; part_y < min((y + 1) * size, index->rows); part_y += PAIR) {
    for (int part_x = x * size; part_x < min((x + 1) * size, index->columns); ++part_x) {
      if (labelled[part_y / PAIR * index->columns + part_x] != BOTH) return false;
    }
  }
  return true;
}

// The number of a tile or region among them, the tiles first.
static inline int list_number(const SeedIndex* index, int level, int x, int y) {
  return level_start(index->width, index->height, level) - level_start(index->width, index->height, TILE) +
         y * columns_of(index->width, level) + x;
}

static inline uint seeds_in_bin(const SeedIndex* index, int level, int x, int y) {
  const int size = 1 << FAN_BITS * level;
  uint seeds = 0;
  for (int part_y = y * size; part_y < (y + 1) * size; ++part_y) {
    seeds += count_seeds(index, x * size, (x + 1) * size - 1, part_y);
  }
  return seeds;
}

// Takes those of a list that can be candidates of a box, and pads them.
static inline int take_candidates(global const uint* list, int count, Box box, Dominators* dominators, uint* seeds) {
  for (int i = 0; i < count; i += VOROCL_WIDTH) STORE_VECTOR(LOAD_VECTOR(list + i), seeds + i);
  pad(seeds, count);
  no_dominators(dominators, box);
  improve_dominator(dominators, 0, seeds, count);
  return drop_dominated(dominators, seeds, count);
}

// Lists the candidates of a tile or region that has bins to be labelled yet. A tile of one candidate is labelled at
// once, all of it: it has no crowded bin, for the rim of that would be more candidates.
VECTOR_KERNEL void list_candidates(SEED_INDEX_PARAMETERS, int level, global const uint* restrict labelled,
                                   global const uint* restrict pyramid, int top_level, global uint* lists,
                                   global uint* counts, global uint* restrict labels) {
  const int across = columns_of(width, level), bin = (int)get_global_id(0);
  if (bin >= across * rows_of(height, level)) return;
  const int x = bin % across, y = bin / across, in_region = FAN_BITS * (REGION - level);
  SeedIndex index = SEED_INDEX_OF_PARAMETERS;
  centre_on_region(&index, x >> in_region, y >> in_region);
  const int number = list_number(&index, level, x, y);
  if (all_labelled(&index, labelled, level, x, y)) return;
  const int size = 1 << bin_bits(level);
  const Box box = box_of(&index, x * size, y * size, size, size);
  if (level == REGION && seeds_in_bin(&index, level, x, y) > MOST_OF_REGION) {
    counts[number] = TOO_MANY;
    return;
  }
  const int region = list_number(&index, REGION, x / FAN, y / FAN);  // of a tile
  BoxSearch search;
  if (level == TILE && counts[region] != TOO_MANY) {
    search.count = take_candidates(lists + (size_t)region * MOST_CANDIDATES, (int)counts[region], box,
                                   &search.dominators, search.seeds);
  } else {
    begin_search(&search, box, &index, pyramid, top_level);
    if (!find_candidates(&search, &index)) {
      counts[number] = TOO_MANY;
      return;
    }
  }
  counts[number] = (uint)search.count;
  if (level == TILE && search.count <= 1) {
    fill_box(&index, box, search.count == 0 ? NO_LABEL : id_of_image(&index, search.seeds[0]), labels);
    counts[number] = 0;
    return;
  }
  global uint* const candidates = lists + (size_t)number * MOST_CANDIDATES;
  for (int i = 0; i < search.count; ++i) candidates[i] = search.seeds[i];
}

// Labels a box by its tile's candidates, if only so many of them are left that this can be done.
static inline bool label_by_tile(const SeedIndex* index, global const uint* candidates, int count, Box box,
                                 global uint* labels) {
  uint seeds[MOST_CANDIDATES + VOROCL_WIDTH];
  Dominators dominators;
  count = take_candidates(candidates, count, box, &dominators, seeds);
  if (count > MOST_KEYS) return false;
  label_by_list(index, &dominators, seeds, count, box, labels);
  return true;
}

// Stores the ids of seeds at their positions in the frame.
static inline void store_ids(uint_v seeds, const SeedIndex* index, global uint* labels, int x, int y) {
  uint seed[VOROCL_WIDTH];
  STORE_VECTOR(seeds, seed);
  const int count = min(VOROCL_WIDTH, index->x0 + index->width - x);
  for (int lane = 0; lane < count; ++lane) label_at(index, labels, x, y)[lane] = id_of(index, seed[lane]);
}

// Labels the bin that is a search's box by any number of candidates, list after list in any order.
static inline void label_by_search(BoxSearch* search, const SeedIndex* index, global uint* labels) {
  const Box box = search->box;
  uint_v least[BIN * BIN / VOROCL_WIDTH], nearest[BIN * BIN / VOROCL_WIDTH];
  for (int i = 0; i < BIN * BIN / VOROCL_WIDTH; ++i) least[i] = nearest[i] = (uint_v)0xffffffffu;
  bool complete = false;
  while (!complete) {
    complete = find_candidates(search, index);
    int i = 0;
    for (int y = box.top; y <= box.bottom; ++y) {
      for (int x = box.left; x <= box.right; x += VOROCL_WIDTH, ++i) {
        const uint_v pixel = vector_positions(x, y);
        for (int c = 0; c < search->count; ++c) {
          const uint_v distance = distance_between((uint_v)search->seeds[c], pixel);
          const uint_v seed = seed_of_image(index, (uint_v)search->seeds[c]);
          nearest[i] = select(nearest[i], seed, WINS(seed, distance, nearest[i], least[i]));
          least[i] = min(least[i], distance);
        }
      }
    }
    search->count = 0;
  }
  int i = 0;
  for (int y = box.top; y <= box.bottom; ++y) {
    for (int x = box.left; x <= box.right; x += VOROCL_WIDTH, ++i) store_ids(nearest[i], index, labels, x, y);
  }
}

// Labels what is left of a pair: both bins or one.
VECTOR_KERNEL void label_far(SEED_INDEX_PARAMETERS, global const uint* restrict labelled,
                             global const uint* restrict pyramid, int top_level, global const uint* restrict lists,
                             global const uint* restrict counts, global uint* restrict labels) {
  SeedIndex index = SEED_INDEX_OF_PARAMETERS;
  const int pair = (int)get_global_id(0);
  if (pair >= index.columns * pairs_down(&index) || labelled[pair] == BOTH) return;
  const int x = pair % index.columns, y = pair / index.columns * PAIR;
  const int in_region = FAN_BITS * REGION;
  centre_on_region(&index, x >> in_region, y >> in_region);
  const int tile = list_number(&index, TILE, x / FAN, y / FAN);
  if (counts[tile] == 0) return;  // list_candidates labelled it
  const int first = y + (labelled[pair] == UPPER);
  const int end = min(labelled[pair] == LOWER ? y + 1 : y + PAIR, rows_of_grid(&index));
  const Box box = box_of(&index, x * BIN, first * BIN, BIN, (end - first) * BIN);
  if (counts[tile] != TOO_MANY &&
      label_by_tile(&index, lists + (size_t)tile * MOST_CANDIDATES, (int)counts[tile], box, labels)) {
    label_crowd(&index, x, first, end - first, labels);
    return;
  }
  for (int bin_y = first; bin_y < end; ++bin_y) {
    BoxSearch search;
    begin_search(&search, box_of(&index, x * BIN, bin_y * BIN, BIN, BIN), &index, pyramid, top_level);
    label_by_search(&search, &index, labels);
  }
  label_crowd(&index, x, first, end - first, labels);
}
