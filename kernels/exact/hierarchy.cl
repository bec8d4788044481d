// The search for the candidates of a box, from the coarsest bins of the pyramid to fine ones. Dominated bins are
// dropped at each level; what is left at the end has its seeds collected.

#ifndef VOROCL_EXACT_HIERARCHY
#define VOROCL_EXACT_HIERARCHY

#include "exact/collect.cl"
#include "exact/dominance.cl"

// A bin of a search: its column and row in its level, packed, MORE, and where axes are periodic which image of the bin
// is meant along each: 0 is a period before the bin itself, 1 is the bin itself, 2 is a period behind it.
#define COLUMN_BITS 11
#define IMAGE_X_BIT COLUMN_BITS
#define IMAGE_Y_BIT (COLUMN_BITS + 2)
#define COLUMN_OF(bin) ((bin) & ((1u << COLUMN_BITS) - 1))
#define IMAGE_OF(bin) ((bin) & (0xfu << COLUMN_BITS))
#if LAST_COORDINATE >> BIN_BITS >= 1 << COLUMN_BITS || 1 << (COLUMN_BITS + 4) > MORE
#error "A bin's column and image leave no bit for MORE"
#endif

// How far an image of a bin is, in the coordinates of the index, from where the bin is in the frame.
#ifdef VOROCL_PERIODIC
#define MOST_IMAGES 9
#define PERIODS_X(bin) (((bin) >> IMAGE_X_BIT & 3u) - 1u)
#define PERIODS_Y(bin) (((bin) >> IMAGE_Y_BIT & 3u) - 1u)
#define SHIFT_X(index, bin) (PERIODS_X(bin) * (uint)(index)->width + (uint)((index)->x0 - margin_x((index)->width)))
#define SHIFT_Y(index, bin) (PERIODS_Y(bin) * (uint)(index)->height + (uint)((index)->y0 - margin_y((index)->height)))
#else
#define MOST_IMAGES 1
#define SHIFT_X(index, bin) ((void)(index), (void)(bin), 0u)
#define SHIFT_Y(index, bin) ((void)(index), (void)(bin), 0u)
#endif
#define MOST_BINS (FAN * FAN * MOST_PARENTS + TOP_BINS * MOST_IMAGES)

typedef struct {
  Box box;
  Dominators dominators;
  int level;                                       // of the bins
  int bin_count;                                   // bins that may hold candidates:
  uint bins[MOST_BINS + VOROCL_WIDTH];
  uint representatives[MOST_BINS + VOROCL_WIDTH];  // a seed of each
  int next_part;  // of the parts of level 0 of all bins, the first one not collected yet
  int count;      // candidates found and not yet taken: a full list, the seeds of one bin more, and padding
  uint seeds[MOST_CANDIDATES + BIN * BIN + VOROCL_WIDTH];
} BoxSearch;

// The part of the distance from a pixel to an interval of pixels that lies along one axis.
static inline int_v along_to_interval(int from, int_v first, int_v last) {
  return ALONG(max(max(first - from, from - last), (int_v)0));
}

// Drops the bins that are dominated by one of the dominators from `begin` to `end`. A bin's first pixel stands for its
// seeds in the tie rule, for none of them comes before it.
static inline void drop_dominated_bins(BoxSearch* search, const SeedIndex* index, int begin, int end) {
  const Box box = search->box;
  const int size = 1 << bin_bits(search->level);
  int kept = 0;
  for (int first = 0; first < search->bin_count; first += VOROCL_WIDTH) {
    const uint_v bin = LOAD_VECTOR(search->bins + first);
    const int_v left = AS_INT_V(COLUMN_OF(bin) * (uint)size + SHIFT_X(index, bin));
    const int_v top = AS_INT_V((bin >> 16) * (uint)size + SHIFT_Y(index, bin));
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

// Whether pixels from box_first to box_last may be nearest to some from `first` to `last` the way that does not go
// round the grid: that is half a period at most.
static inline bool within_half_a_period(int first, int last, int box_first, int box_last, int period) {
  return 2 * max(first - box_last, box_first - last) <= period;
}

// A coordinate that a position cannot hold is brought to another image of its seed. That is a seed too, and the one
// that was meant is too far away to matter.
static inline int held_by_position(int at, int period) {
  return at < 0 ? at + period : at > LAST_COORDINATE ? at - period : at;
}

// The image of a seed of the frame that an image of its bin has.
static inline uint image_of_seed(const SeedIndex* index, uint seed, uint bin) {
#ifdef VOROCL_PERIODIC
  int x = packed_x(seed) + (int)SHIFT_X(index, bin), y = packed_y(seed) + (int)SHIFT_Y(index, bin);
  if (PERIODIC_X) x = held_by_position(x, index->width);
  if (PERIODIC_Y) y = held_by_position(y, index->height);
  return pack(x, y);
#else
  (void)index, (void)bin;
  return seed;
#endif
}

// The bins of a level, along an axis, whose images may matter to a box: they have pixels of the grid, and none is
// farther than half a period. The image is `shift` pixels away from where the frame has the bins.
typedef struct {
  int first, last;
} Bins;
static inline Bins bins_that_matter(int box_first, int box_last, int shift, int size, int margin, int periodic,
                                    int bits) {
  const int reach = periodic ? size / 2 : LAST_COORDINATE;
  const Bins bins = {max(box_first - reach - shift, margin) >> bits,
                     min(box_last + reach - shift, margin + size - 1) >> bits};
  return bins;
}

// Adds those bins of a square of the search's level, of one image, that are not empty and may matter.
static inline void add_bins(BoxSearch* search, const SeedIndex* index, global const uint* pyramid, uint image, int x,
                            int y, int size) {
  const Box box = search->box;
  const int bits = bin_bits(search->level), columns = columns_of(index->width, search->level);
  const int width = index->width, height = index->height;
  const Bins across = bins_that_matter(box.left, box.right, (int)SHIFT_X(index, image), width, margin_x(width),
                                       PERIODIC_X, bits);
  const Bins down = bins_that_matter(box.top, box.bottom, (int)SHIFT_Y(index, image), height, margin_y(height),
                                     PERIODIC_Y, bits);
  global const uint* const level = pyramid + level_start(index->width, index->height, search->level);
  for (int bin_y = max(y, down.first); bin_y <= min(y + size - 1, down.last); ++bin_y) {
    for (int bin_x = max(x, across.first); bin_x <= min(x + size - 1, across.last); ++bin_x) {
      const uint representative = level[bin_y * columns + bin_x];
      const uint bin = pack(bin_x, bin_y) | image | (representative & MORE);
      search->bins[search->bin_count] = bin;
      search->representatives[search->bin_count] = image_of_seed(index, representative & ~MORE, bin);
      search->bin_count += representative != EMPTY;
    }
  }
}

// Adds all bins of the search's level, with all their images.
static inline void add_all_bins(BoxSearch* search, const SeedIndex* index, global const uint* pyramid) {
#ifdef VOROCL_PERIODIC
  for (uint image_y = PERIODIC_Y ? 0 : 1; image_y <= (PERIODIC_Y ? 2 : 1); ++image_y) {
    for (uint image_x = PERIODIC_X ? 0 : 1; image_x <= (PERIODIC_X ? 2 : 1); ++image_x) {
      add_bins(search, index, pyramid, image_x << IMAGE_X_BIT | image_y << IMAGE_Y_BIT, 0, 0, TOP_BINS);
    }
  }
#else
  add_bins(search, index, pyramid, 0u, 0, 0, TOP_BINS);
#endif
}

// Takes the seeds that are their bins' only ones as candidates, as long as there is room, so that these bins need not
// be refined.
static inline void take_only_seeds(BoxSearch* search) {
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
static inline void begin_search(BoxSearch* search, Box box, const SeedIndex* index, global const uint* pyramid,
                                int top_level) {
  uint parents[MOST_PARENTS];
  search->box = box;
  search->level = top_level;
  search->bin_count = 0;
  search->count = 0;
  search->next_part = 0;
  no_dominators(&search->dominators, box);
  add_all_bins(search, index, pyramid);
  while (true) {
    pad(search->representatives, search->bin_count);
    improve_dominator(&search->dominators, 0, search->representatives, search->bin_count);
    drop_dominated_bins(search, index, 0, 1);
    for (int i = 1; i < DOMINATORS; ++i) {
      improve_dominator(&search->dominators, i, search->representatives, search->bin_count);
    }
    drop_dominated_bins(search, index, 1, DOMINATORS);
    take_only_seeds(search);
    if (search->level == 0 || search->bin_count > MOST_PARENTS) return;
    const int parent_count = search->bin_count;
    for (int i = 0; i < parent_count; ++i) parents[i] = search->bins[i];
    search->bin_count = 0;
    --search->level;
    for (int i = 0; i < parent_count; ++i) {
      const int x = (int)COLUMN_OF(parents[i]), y = packed_y(parents[i]);
      add_bins(search, index, pyramid, IMAGE_OF(parents[i]), x * FAN, y * FAN, FAN);
    }
  }
}

// Adds the seeds of an image of a bin of level 0 that can be candidates.
static inline void collect_bin(BoxSearch* search, const SeedIndex* index, int x, int y, uint image) {
  const int first = search->count;
  search->count = add_seeds(index, x, x, y, search->seeds, search->count);
#ifdef VOROCL_PERIODIC
  // Only seeds of the grid whose image may matter here.
  const Box box = search->box;
  int kept = first;
  for (int i = first; i < search->count; ++i) {
    const int grid_x = packed_x(search->seeds[i]) - margin_x(index->width);
    const int grid_y = packed_y(search->seeds[i]) - margin_y(index->height);
    const int at_x = packed_x(search->seeds[i]) + (int)SHIFT_X(index, image);
    const int at_y = packed_y(search->seeds[i]) + (int)SHIFT_Y(index, image);
    const bool in_grid = grid_x >= 0 && grid_x < index->width && grid_y >= 0 && grid_y < index->height;
    const bool near_x = !PERIODIC_X || within_half_a_period(at_x, at_x, box.left, box.right, index->width);
    const bool near_y = !PERIODIC_Y || within_half_a_period(at_y, at_y, box.top, box.bottom, index->height);
    search->seeds[kept] = pack(at_x, at_y);
    kept += in_grid && near_x && near_y;
  }
  search->count = kept;
#else
  (void)first, (void)image;
#endif
}

// Collects candidates behind those that the search has already; false if there are more of them than fit, so that the
// caller takes these and comes again.
static inline bool find_candidates(BoxSearch* search, const SeedIndex* index) {
  const int side_bits = FAN_BITS * search->level, side = 1 << side_bits;  // parts of a bin along an axis
  const int parts = search->bin_count << 2 * side_bits;
  while (search->next_part < parts) {
    const int part = search->next_part++;
    const uint bin = search->bins[part >> 2 * side_bits];
    const int x = (int)COLUMN_OF(bin) * side + (part & (side - 1));
    const int y = packed_y(bin) * side + (part >> side_bits & (side - 1));
    collect_bin(search, index, x, y, IMAGE_OF(bin));
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
