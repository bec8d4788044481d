// The search for the candidates of a box, from the coarsest bins of the pyramid to fine ones. Dominated bins are
// dropped at each level; what is left at the end has its seeds collected.

#ifndef VOROCL_EXACT_HIERARCHY
#define VOROCL_EXACT_HIERARCHY

#include "exact/collect.cl"
#include "exact/dominance.cl"

#define MOST_BINS (FAN * FAN * MOST_PARENTS + TOP_BINS)
#if LAST_COORDINATE >> BIN_BITS >= MORE
#error "A bin's column leaves no bit for MORE"
#endif

typedef struct {
  Box box;
  Dominators dominators;
  int level;                                       // of the bins
  int bin_count;                                   // bins that may hold candidates:
  uint bins[MOST_BINS + VOROCL_WIDTH];             // their column and row in their level, packed, and MORE
  uint representatives[MOST_BINS + VOROCL_WIDTH];  // a seed of each
  int next_part;  // of the parts of level 0 of all bins, the first one not collected yet
  int count;      // candidates found and not yet taken: a full list, the seeds of one bin more, and padding
  uint seeds[MOST_CANDIDATES + BIN * BIN + VOROCL_WIDTH];
} Search;

// The part of the distance from a pixel to an interval of pixels that lies along one axis.
static inline int_v along_to_interval(int from, int_v first, int_v last) {
  return ALONG(max(max(first - from, from - last), (int_v)0));
}

// Drops the bins that are dominated by one of the dominators from `begin` to `end`. A bin's first pixel stands for its
// seeds in the tie rule, for none of them comes before it.
static inline void drop_dominated_bins(Search* search, int begin, int end) {
  const Box box = search->box;
  const int size = 1 << bin_bits(search->level);
  int kept = 0;
  for (int first = 0; first < search->bin_count; first += VOROCL_WIDTH) {
    const uint_v bin = LOAD_VECTOR(search->bins + first);
    const int_v left = AS_INT_V(bin & (MORE - 1)) * size, top = AS_INT_V(bin >> 16) * size;
    const int_v to_left = along_to_interval(box.left, left, left + size - 1);
    const int_v to_right = along_to_interval(box.right, left, left + size - 1);
    const int_v to_top = along_to_interval(box.top, top, top + size - 1);
    const int_v to_bottom = along_to_interval(box.bottom, top, top + size - 1);
    const uint_v distance[CORNERS] = {AS_UINT_V(to_left + to_top), AS_UINT_V(to_right + to_top),
                                      AS_UINT_V(to_left + to_bottom), AS_UINT_V(to_right + to_bottom)};
    int_v lag = (int_v)INT_MIN;
    const uint_v first_pixel = AS_UINT_V(top) << 16 | AS_UINT_V(left);
    for (int i = begin; i < end; ++i) lag = max(lag, least_lag(&search->dominators, i, first_pixel, distance));
    lag = select(lag, (int_v)0, AS_INT_V(LOAD_VECTOR(search->representatives + first)) < 0);  // empty
    keep_entries(search->bins, first, lag < 0, kept);
    kept = keep_entries(search->representatives, first, lag < 0, kept);
  }
  search->bin_count = kept;
  pad(search->representatives, kept);
}

// Adds the bins of a square of the search's level that are not empty.
static inline void add_bins(Search* search, const SeedIndex* index, global const uint* pyramid, int x, int y,
                            int size) {
  const int columns = bins_along(index->width, search->level), rows = bins_along(index->height, search->level);
  global const uint* const level = pyramid + level_start(index->width, index->height, search->level);
  for (int bin_y = y; bin_y < min(y + size, rows); ++bin_y) {
    for (int bin_x = x; bin_x < min(x + size, columns); ++bin_x) {
      const uint representative = level[bin_y * columns + bin_x];
      search->bins[search->bin_count] = pack(bin_x, bin_y) | (representative & MORE);
      search->representatives[search->bin_count] = representative & ~MORE;
      search->bin_count += representative != EMPTY;
    }
  }
}

// Takes the seeds that are their bins' only ones as candidates, as long as there is room, so that these bins need not
// be refined.
static inline void take_only_seeds(Search* search) {
  int kept = 0;
  for (int i = 0; i < search->bin_count; ++i) {
    if (search->bins[i] & MORE || search->count >= MOST_CANDIDATES) {
      search->bins[kept++] = search->bins[i] & ~MORE;
    } else {
      search->seeds[search->count++] = search->representatives[i];
    }
  }
  search->bin_count = kept;
}

// Finds the bins that may hold candidates of the box, as fine as they can be listed, and candidates on the way.
static inline void begin_search(Search* search, Box box, const SeedIndex* index, global const uint* pyramid,
                                int top_level) {
  uint parents[MOST_PARENTS];
  search->box = box;
  search->level = top_level;
  search->bin_count = 0;
  search->count = 0;
  search->next_part = 0;
  no_dominators(&search->dominators, box);
  add_bins(search, index, pyramid, 0, 0, TOP_BINS);
  while (true) {
    pad(search->representatives, search->bin_count);
    improve_dominator(&search->dominators, 0, search->representatives, search->bin_count);
    drop_dominated_bins(search, 0, 1);
    for (int i = 1; i < DOMINATORS; ++i) {
      improve_dominator(&search->dominators, i, search->representatives, search->bin_count);
    }
    drop_dominated_bins(search, 1, DOMINATORS);
    take_only_seeds(search);
    if (search->level == 0 || search->bin_count > MOST_PARENTS) return;
    const int parent_count = search->bin_count;
    for (int i = 0; i < parent_count; ++i) parents[i] = search->bins[i];
    search->bin_count = 0;
    --search->level;
    for (int i = 0; i < parent_count; ++i) {
      add_bins(search, index, pyramid, packed_x(parents[i]) * FAN, packed_y(parents[i]) * FAN, FAN);
    }
  }
}

// Collects candidates behind those that the search has already; false if there are more of them than fit, so that the
// caller takes these and comes again.
static inline bool find_candidates(Search* search, const SeedIndex* index) {
  const int side_bits = FAN_BITS * search->level, side = 1 << side_bits;  // parts of a bin along an axis
  const int parts = search->bin_count << 2 * side_bits;
  while (search->next_part < parts) {
    const int part = search->next_part++;
    const uint bin = search->bins[part >> 2 * side_bits];
    const int x = packed_x(bin) * side + (part & (side - 1));
    const int y = packed_y(bin) * side + (part >> side_bits & (side - 1));
    search->count = add_seeds(index, x, x, y, search->seeds, search->count);
    if (search->count <= MOST_CANDIDATES) continue;
    pad(search->seeds, search->count);
    improve_dominator(&search->dominators, 0, search->seeds, search->count);
    search->count = drop_dominated(&search->dominators, search->seeds, search->count);
    if (search->count > MOST_CANDIDATES / 2) return false;
  }
  pad(search->seeds, search->count);
  improve_dominator(&search->dominators, 0, search->seeds, search->count);
  search->count = drop_dominated(&search->dominators, search->seeds, search->count);
  return true;
}

#endif
