// Labelling a patch that has any number of candidates: the pyramid is searched for them, and whenever a list is full
// the patch's pixels take the best of it.

#ifndef VOROCL_EXACT_GROUP_SEARCH
#define VOROCL_EXACT_GROUP_SEARCH

#include "exact/group/candidates.cl"

// What the search opens: a bin of some level, whose parts are FAN x FAN bins of the level below; a bin of level 0,
// whose parts are its rows; and a row, whose parts are its pixels. Each has PARTS parts, and as many items look at
// them. An entry holds the column of its bin, its level + 1 (0: a row), and its bin's row or the row of the grid.
#define PARTS (FAN * FAN)
#if FAN * FAN != 1 << BIN_BITS
#error "A bin has not as many rows, or a row not as many pixels, as a bin has parts"
#endif
#define LEVEL_SHIFT 12
#if LAST_COORDINATE >> BIN_BITS >= 1 << LEVEL_SHIFT
#error "The column of a bin does not fit in its bits"
#endif
#define NO_ENTRY 0xffffffffu
static inline uint entry_of(int x, int y, int level) { return pack(x, y) | (uint)(level + 1) << LEVEL_SHIFT; }
static inline int entry_x(uint entry) { return packed_x(entry) & ((1 << LEVEL_SHIFT) - 1); }
static inline int entry_level(uint entry) { return (packed_x(entry) >> LEVEL_SHIFT) - 1; }

// Rows, and the levels of the pyramid.
#define MOST_LEVELS (1 + 8)
#define SHORTEST_STACK (TOP_BINS + PARTS * MOST_LEVELS)
#if STACK < SHORTEST_STACK
#error "The stack may overflow"
#endif

// A list is full from MOST_GATHERED seeds on, and then there is one more from each item at most.
#define MOST_LISTED (MOST_GATHERED + MOST_ITEMS)
#if MOST_LISTED < 1 << 2 * BIN_BITS
#error "A list does not hold the seeds of a bin"
#endif
typedef struct {
  uint stack[STACK];
  uint stack_count;
  uint seeds[MOST_LISTED], kept[MOST_LISTED];
  uint count, kept_count;
} PatchSearch;

// How many entries are opened at once: of each level below so many parts less one stay on the stack, and one entry can
// always be opened.
static inline int entries_to_open(int stack_count, int items) {
  const int room = STACK - stack_count - (PARTS - 1) * MOST_LEVELS;
  return max(min(min(items / PARTS, stack_count), room / (PARTS - 1)), 1);
}

// A part of an entry: the pixels that it may have seeds in, the entry that stands for it, and its only seed, or EMPTY
// if it has more.
typedef struct {
  bool empty;
  Box box;
  uint entry, seed;
} Part;

static inline void part_of_bin(Part* part, const SeedIndex* index, global const uint* pyramid, int x, int y,
                               int level) {
  const bool inside = x < columns_of(index->width, level) && y < rows_of(index->height, level);
  const int bin = level_start(index->width, index->height, level) + y * columns_of(index->width, level) + x;
  const uint representative = inside ? pyramid[bin] : EMPTY;
  const bool only = (representative & MORE) == 0;
  const int bits = bin_bits(level);
  part->empty = representative == EMPTY;
  part->entry = entry_of(x, y, level);
  part->seed = only ? representative : EMPTY;
  part->box.left = only ? packed_x(representative) : x << bits;
  part->box.top = only ? packed_y(representative) : y << bits;
  part->box.right = only ? packed_x(representative) : ((x + 1) << bits) - 1;
  part->box.bottom = only ? packed_y(representative) : ((y + 1) << bits) - 1;
}

// The seeds of a row of pixels in a bin; none outside the frame.
static inline uint seeds_of_row(const SeedIndex* index, int bin_x, int y) {
  const bool inside = bin_x >= 0 && bin_x < index->columns && y >= 0 && y < frame_height(index->height);
  return inside ? row_bits(index->bits[((y >> BIN_BITS) * index->columns + bin_x) * WORDS + y % BIN / ROWS_OF_WORD], y)
                : 0;
}

// The same without seeds that another one hides from a patch beside them: it is between them and all of the patch along
// one axis, where they are alike along the other one, and so it is nearer everywhere. Of the row the seed next to the
// patch hides all others, and where seeds are dense those in front hide whole bins. Of a column the seeds in a few rows
// are looked at.
#define HIDING_ROWS 4
static inline uint open_seeds_of_row(const SeedIndex* index, Box patch, int bin_x, int y) {
  const int left = bin_x * BIN, right = left + BIN - 1;
  uint seeds = seeds_of_row(index, bin_x, y);
  if (right < patch.left && seeds != 0) {
    const uint hiding = right + BIN < patch.left ? ALL_BITS : 1;
    seeds = seeds_of_row(index, bin_x + 1, y) & hiding ? 0 : 1u << (31 - clz(seeds));
  }
  if (left > patch.right && seeds != 0) {
    const uint hiding = left - BIN > patch.right ? ALL_BITS : 1u << (BIN - 1);
    seeds = seeds_of_row(index, bin_x - 1, y) & hiding ? 0 : seeds & -seeds;
  }
  for (int below = y + 1; below <= min(y + HIDING_ROWS, patch.top); ++below) {
    seeds &= ~seeds_of_row(index, bin_x, below);
  }
  for (int above = y - 1; above >= max(y - HIDING_ROWS, patch.bottom); --above) {
    seeds &= ~seeds_of_row(index, bin_x, above);
  }
  return seeds;
}

// Of a row: all of it, or one pixel.
static inline void part_of_row(Part* part, const SeedIndex* index, Box patch, int bin_x, int y, int first, int last) {
  const uint seeds = open_seeds_of_row(index, patch, bin_x, y);
  part->empty = (seeds >> first & ALL_BITS >> (BIN - 1 - last + first)) == 0;
  part->entry = entry_of(bin_x, y, -1);
  part->seed = first == last ? pack(bin_x * BIN + first, y) : EMPTY;
  part->box.left = bin_x * BIN + first;
  part->box.right = bin_x * BIN + last;
  part->box.top = part->box.bottom = y;
}

static inline void part_of(Part* part, const SeedIndex* index, global const uint* pyramid, Box patch, uint entry,
                           int number) {
  const int level = entry_level(entry), x = entry_x(entry), y = packed_y(entry);
  if (level > 0) {
    part_of_bin(part, index, pyramid, x * FAN + number % FAN, y * FAN + number / FAN, level - 1);
  } else {
    part_of_row(part, index, patch, x, level == 0 ? y * BIN + number : y, level == 0 ? 0 : number,
                level == 0 ? BIN - 1 : number);
  }
}

// Puts a part of an entry on the stack, or takes its only seed, unless it is empty or dominated.
static inline void take_part(local PatchSearch* search, local const PatchDominators* dominators, Box patch,
                             const Part* part) {
  if (!part->empty && !is_dominated(dominators, DOMINATORS, patch, part->box)) {
    if (part->seed == EMPTY) {
      search->stack[atomic_inc(&search->stack_count)] = part->entry;
    } else {
      search->seeds[atomic_inc(&search->count)] = part->seed;
    }
  }
}

// Takes entries off the stack and opens them. Begins and ends with what the whole group knows.
static inline void open_entries(local PatchSearch* search, local const PatchDominators* dominators,
                                const SeedIndex* index, global const uint* pyramid, Box patch) {
  const int item = (int)get_local_id(0), slot = item / PARTS, stack_count = (int)search->stack_count;
  const int open = entries_to_open(stack_count, (int)get_local_size(0));
  const uint entry = slot < open ? search->stack[stack_count - 1 - slot] : NO_ENTRY;
  SYNC();
  if (item == 0) search->stack_count = (uint)(stack_count - open);
  SYNC();
  if (entry != NO_ENTRY) {
    Part part;
    part_of(&part, index, pyramid, patch, entry, item % PARTS);
    take_part(search, dominators, patch, &part);
  }
  SYNC();
}

// Gives the patch's pixels the best seeds of the list, unless they have better ones. What they have is in `labels`, as
// positions. An item has the same pixels each time, but not those that others fill and name: hence SYNC_LABELS().
#define SYNC_LABELS() barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE)
static inline void take_best(local const uint* seeds, int seed_count, local Ranked* ranked, const SeedIndex* index,
                             uint base, Box patch, global uint* labels) {
  const int column = item_column(), x = patch.left + column;
  for (int begin = 0; begin < seed_count; begin += MOST_RANKED) {
    const int count = min(seed_count - begin, MOST_RANKED);
    rank_candidates(ranked, index, patch, base, seeds + begin, count);
    const uint mask = (1u << bits_of_rank(count)) - 1;
    for (int row = item_row() * FEW_PIXELS; row < PATCH; row += item_rows() * FEW_PIXELS) {
      int4 least = find_few_least_keys_below(ranked, count, column, row);
      global uint* const labels_below = label_in_patch(index, labels, patch, column, row);
      const int pixels = pixels_in_patch(patch, column, row);
#pragma unroll
      for (int k = 0; k < FEW_PIXELS; ++k, least = least.s1230) {
        if (k < pixels) {
          global uint* const label = labels_below + k * index->width;
          const int y = patch.top + row + k;
          const uint seed = ranked->value[(uint)least.s0 & mask], other = *label;
          const uint distance = distance_of_offset(packed_x(seed) - x, packed_y(seed) - y);
          const uint other_distance = distance_of_offset(packed_x(other) - x, packed_y(other) - y);
          if (distance < other_distance ||
              (distance == other_distance &&
               COMES_FIRST(seed_of_one_image(index, seed), seed_of_one_image(index, other)))) {
            *label = seed;
          }
        }
      }
    }
    SYNC();
  }
}

// Begins with the best seeds of a bin: where seeds are dense, one alone leaves too much in question.
static inline void begin_with_bin_of(local PatchSearch* search, local PatchDominators* dominators,
                                     const SeedIndex* index, Box patch, uint seed) {
  begin_dominators(dominators, patch, seed);
  const int bin = start_of(packed_x(seed) >> BIN_BITS, packed_y(seed) >> BIN_BITS, index->columns);
  const int start = (int)index->starts[bin], count = (int)index->starts[bin + 1] - start;
  for (int i = (int)get_local_id(0); i < count; i += (int)get_local_size(0)) search->seeds[i] = index->list[start + i];
  SYNC();
  improve_dominators(dominators, search->seeds, count);
}

// Labels a patch of the queue, given a seed near it.
static inline void search_patch(local PatchSearch* search, local PatchDominators* dominators, local Ranked* ranked,
                                const SeedIndex* index, global const uint* pyramid, int top_level, Box patch, uint near,
                                global uint* labels) {
  const int item = (int)get_local_id(0), column = item_column();
  begin_with_bin_of(search, dominators, index, patch, near);
  fill_patch(index, patch, near, labels);
  SYNC_LABELS();

  // The top of the pyramid is put on the stack as a whole.
  if (item == 0) search->stack_count = search->count = 0;
  SYNC();
  const int top_across = columns_of(index->width, top_level);
  const int top_bins = top_across * rows_of(index->height, top_level);
  for (int bin = (int)get_local_id(0); bin < top_bins; bin += (int)get_local_size(0)) {
    search->stack[atomic_inc(&search->stack_count)] = entry_of(bin % top_across, bin / top_across, top_level);
  }
  SYNC();
  while (search->stack_count > 0) {
    open_entries(search, dominators, index, pyramid, patch);
    const int left = (int)search->stack_count, count = (int)search->count;
    SYNC();
    if (left == 0 || count > MOST_GATHERED) {
      improve_dominators(dominators, search->seeds, count);
      if (item == 0) search->count = search->kept_count = 0;
      SYNC();
      keep_candidates(search->kept, &search->kept_count, MOST_LISTED, dominators, patch, search->seeds, count);
      take_best(search->kept, (int)search->kept_count, ranked, index, dominators->seed[0], patch, labels);
    }
    SYNC();
  }
  SYNC_LABELS();
  for (int row = item_row(); row < PATCH; row += item_rows()) {
    global uint* const label = label_in_patch(index, labels, patch, column, row);
    if (pixels_in_patch(patch, column, row) > 0) *label = id_of(index, *label);
  }
}

// Labels the patches of the queue: how many, and each with a seed near it. They are shared out among the work-groups.
kernel void search_patches(SEED_INDEX_PARAMETERS, global const uint* restrict pyramid, int top_level,
                           global const uint* restrict queue, global uint* labels) {
  local PatchSearch search;
  local PatchDominators dominators;
  local Ranked ranked;
  if (get_group_id(0) >= queue[0]) return;
  const SeedIndex index = SEED_INDEX_OF_PARAMETERS;
  const uint end = 1 + 2 * queue[0];
  for (uint at = 1 + 2 * (uint)get_group_id(0); at < end; at += 2 * (uint)get_num_groups(0)) {
    const Box patch = box_of_patch(&index, (int)queue[at]);
    search_patch(&search, &dominators, &ranked, &index, pyramid, top_level, patch, queue[at + 1], labels);
    SYNC();
  }
}

#endif
