// Candidates: the seeds that can be the nearest one of some pixel of a box, searched from coarse cells to fine ones.
//
// DOMINANCE. Seed a dominates seed b in a box if a wins, by distance and tie rule, at the box's four corners; then it
// wins at every pixel of the box, and b is no candidate. For the Euclidean metric the difference of the two squared
// distances is affine in the pixel, for the Manhattan metric it is the sum of a monotone function of x and one of y:
// both are greatest at a corner. A cell is dominated if already its point nearest to each corner is.

#include "exact/cells.cl"

#define MOST_CELLS (FAN * FAN * MOST_PARENTS + TOP_CELLS)
// A cell's seeds are added to a list at once, and lists are read in whole runs.
#define LIST_ROOM (MOST_CANDIDATES + CELL * CELL + VOROCL_WIDTH)

DEFINE_DISTANCE_BETWEEN(distance_to_corners, uint4, short8, as_uint4, as_short8, convert_int4)

// Pixels, both ends included.
typedef struct {
  int left, top, right, bottom;
} Box;

static inline Box box_of(int x, int y, int columns, int rows, int width, int height) {
  const Box box = {x, y, min(x + columns, width) - 1, min(y + rows, height) - 1};
  return box;
}

// The seeds that dominate: the nearest one known to the centre, and to each of the four corners.
#define CORNERS 4
#define DOMINATORS (1 + CORNERS)
typedef struct {
  uint place[DOMINATORS];              // the centre and the corners, packed
  uint seed[DOMINATORS];               // packed
  uint distance[DOMINATORS][CORNERS];  // from each seed to each corner
} Dominators;

static inline void no_dominators(Dominators* dominators, Box box) {
  dominators->place[0] = pack((box.left + box.right) / 2, (box.top + box.bottom) / 2);
  dominators->place[1] = pack(box.left, box.top);
  dominators->place[2] = pack(box.right, box.top);
  dominators->place[3] = pack(box.left, box.bottom);
  dominators->place[4] = pack(box.right, box.bottom);
  for (int i = 0; i < DOMINATORS; ++i) dominators->seed[i] = EMPTY;
}

// Fills a list's last run with empty positions.
static inline void pad(uint* list, int count) { STORE_RUN((uint_run)EMPTY, list + count); }

// Whether a seed wins against another one, by distance and tie rule.
#define WINS(seed, distance, other_seed, other_distance) \
  (((distance) < (other_distance)) | (((distance) == (other_distance)) & ((seed) < (other_seed))))

// Takes the seed of a padded list that wins at a place, if it wins against the place's dominator.
static inline void improve_dominator(Dominators* dominators, int i, const uint* seeds, int count) {
  const uint_run place = dominators->place[i];
  uint_run nearest = dominators->seed[i];
  uint_run least = distance_to_label(nearest, place);
  for (int first = 0; first < count; first += VOROCL_WIDTH) {
    const uint_run seed = LOAD_RUN(seeds + first);
    const uint_run distance = distance_to_label(seed, place);
    nearest = select(nearest, seed, WINS(seed, distance, nearest, least));
    least = min(least, distance);
  }
  const uint least_of_all = lane_min(least);
  dominators->seed[i] = lane_min(select((uint_run)EMPTY, nearest, least == least_of_all));
  const uint4 corners = vload4(0, dominators->place + 1);
  vstore4(distance_to_corners((uint4)dominators->seed[i], corners), 0, dominators->distance[i]);
}

// Copies those entries of the run at `first` for which the condition holds behind the `kept` ones at the front of the
// list. Every entry is copied, and the next one over it unless it is kept: no branch depends on the condition.
static inline int keep_entries(uint* list, int first, int_run condition, int kept) {
  int keep[VOROCL_WIDTH];
  STORE_RUN(condition, keep);
#pragma unroll
  for (int lane = 0; lane < VOROCL_WIDTH; ++lane) {
    list[kept] = list[first + lane];
    kept += keep[lane] & 1;
  }
  return kept;
}

// By how much seeds at these distances from the corners are behind a dominator where they are least so: below 0 if
// they win at a corner. At an equal distance the dominator wins if it comes first.
static inline int_run least_lag(const Dominators* dominators, int i, uint_run seed, const uint_run* distance) {
  int_run lag = AS_INT_RUN(distance[0] - dominators->distance[i][0]);
#pragma unroll
  for (int corner = 1; corner < CORNERS; ++corner) {
    lag = min(lag, AS_INT_RUN(distance[corner] - dominators->distance[i][corner]));
  }
  return lag - AS_INT_RUN(select((uint_run)1, (uint_run)0, dominators->seed[i] < seed));
}

// Drops the seeds of a padded list that are dominated by one of the dominators from `begin` to `end`.
static inline int drop_dominated_seeds(const Dominators* dominators, int begin, int end, uint* seeds, int count) {
  int kept = 0;
  for (int first = 0; first < count; first += VOROCL_WIDTH) {
    const uint_run seed = LOAD_RUN(seeds + first);
    uint_run distance[CORNERS];
#pragma unroll
    for (int corner = 0; corner < CORNERS; ++corner) {
      distance[corner] = distance_to_label(seed, (uint_run)dominators->place[1 + corner]);
    }
    int_run lag = (int_run)INT_MIN;
    for (int i = begin; i < end; ++i) lag = max(lag, least_lag(dominators, i, seed, distance));
    lag = select(lag, (int_run)0, AS_INT_RUN(seed) < 0);  // empty
    kept = keep_entries(seeds, first, lag < 0, kept);
  }
  pad(seeds, kept);
  return kept;
}

// Drops what is dominated from a padded list whose winner at the centre is known. That one dominates most of the list,
// so the winners at the corners are found among what is left: what is nearest to a corner is dominated by none. A few
// are let be: trying them at the pixels costs less.
#define FEW 8
static inline int drop_dominated(Dominators* dominators, uint* seeds, int count) {
  count = drop_dominated_seeds(dominators, 0, 1, seeds, count);
  if (count <= FEW) return count;
  for (int i = 1; i < DOMINATORS; ++i) improve_dominator(dominators, i, seeds, count);
  return drop_dominated_seeds(dominators, 1, DOMINATORS, seeds, count);
}

// The seeds of a row of the grid in one cell; outside the grid everything counts as a seed.
static inline uint seeds_in_row(const Listing* all, int cell_x, int y) {
  if (cell_x < 0 || cell_x >= all->columns || y < 0 || y >= all->height) return ALL_BITS;
  return row_bits(all->bits[((y >> CELL_BITS) * all->columns + cell_x) * WORDS + y % CELL / ROWS_OF_WORD], y);
}

// Adds the seeds of a cell but those whose four neighbours are seeds: these win at no pixel but their own.
static inline int add_rim(const Listing* all, int cell_x, int cell_y, uint* seeds, int count) {
  const int top = cell_y * CELL;
  uint above = seeds_in_row(all, cell_x, top - 1), own = seeds_in_row(all, cell_x, top);
  for (int y = top; y < min(top + CELL, all->height); ++y) {
    const uint below = seeds_in_row(all, cell_x, y + 1);
    const uint left = own << 1 | seeds_in_row(all, cell_x - 1, y) >> (CELL - 1);
    const uint right = own >> 1 | seeds_in_row(all, cell_x + 1, y) << (CELL - 1);
    for (uint rim = own & ~(above & below & left & right); rim != 0; rim &= rim - 1) {
      seeds[count++] = pack(cell_x * CELL + (int)lowest_bit(rim), y);
    }
    above = own;
    own = below;
  }
  return count;
}

// Copies a part of the list, and may write a run behind it.
static inline int copy_seeds(const Listing* all, uint begin, uint end, uint* seeds, int count) {
  for (uint i = begin; i < end; i += VOROCL_WIDTH) {
    STORE_RUN(LOAD_RUN(all->list + i), seeds + count + (int)(i - begin));
  }
  return count + (int)(end - begin);
}

// Adds those seeds of the cells from (first_x, y) to (last_x, y), as far as they are in the grid, that can be candidates
// for other cells: of a crowded cell only the rim. A crowded cell itself is always labelled by rows, without candidates:
// of its CELL * CELL pixels at most 120 are farther than REACH from one of them (a corner, Manhattan), so one of more
// seeds than that is in reach of each pixel.
#define CROWDED 160  // with a margin
static inline int add_seeds(const Listing* all, int first_x, int last_x, int y, uint* seeds, int count) {
  first_x = max(first_x, 0);
  last_x = min(last_x, all->columns - 1);
  if (y < 0 || y >= all->rows || first_x > last_x) return count;
  global const uint* const starts = all->starts + start_of(0, y, all->columns);
  if (starts[last_x + 1] - starts[first_x] < CROWDED) {
    return copy_seeds(all, starts[first_x], starts[last_x + 1], seeds, count);
  }
  for (int x = first_x; x <= last_x; ++x) {
    count = starts[x + 1] - starts[x] < CROWDED ? copy_seeds(all, starts[x], starts[x + 1], seeds, count)
                                                : add_rim(all, x, y, seeds, count);
  }
  return count;
}

// The part of the distance from a pixel to an interval of pixels that lies along one axis.
#define TO_INTERVAL(from, first, last) ALONG(max(max((first) - (from), (from) - (last)), (int_run)0))

// The search for the candidates of one box.
typedef struct {
  Box box;
  Dominators dominators;
  int level;                             // of the cells
  int cell_count;                        // cells that may hold candidates:
  uint cells[MOST_CELLS + VOROCL_WIDTH]; // their column and row in their level, packed, and MORE
  uint named[MOST_CELLS + VOROCL_WIDTH]; // a seed of each
  int next_part;                         // of the parts of level 0 of all cells, the first one not looked at yet
  int count;                             // candidates found and not yet taken:
  uint seeds[LIST_ROOM];
} Search;

// Drops the cells that are dominated by one of the dominators from `begin` to `end`. No seed of a cell comes before the
// cell's first pixel.
static inline void drop_dominated_cells(Search* search, int begin, int end) {
  const Box box = search->box;
  const int size = 1 << cell_bits(search->level);
  int kept = 0;
  for (int first = 0; first < search->cell_count; first += VOROCL_WIDTH) {
    const uint_run cell = LOAD_RUN(search->cells + first);
    const int_run left = AS_INT_RUN(cell & 0x7fffu) * size, top = AS_INT_RUN(cell >> 16) * size;
    const int_run to_left = TO_INTERVAL(box.left, left, left + size - 1);
    const int_run to_right = TO_INTERVAL(box.right, left, left + size - 1);
    const int_run to_top = TO_INTERVAL(box.top, top, top + size - 1);
    const int_run to_bottom = TO_INTERVAL(box.bottom, top, top + size - 1);
    const uint_run distance[CORNERS] = {AS_UINT_RUN(to_left + to_top), AS_UINT_RUN(to_right + to_top),
                                        AS_UINT_RUN(to_left + to_bottom), AS_UINT_RUN(to_right + to_bottom)};
    int_run lag = (int_run)INT_MIN;
    const uint_run first_pixel = AS_UINT_RUN(top) << 16 | AS_UINT_RUN(left);
    for (int i = begin; i < end; ++i) lag = max(lag, least_lag(&search->dominators, i, first_pixel, distance));
    lag = select(lag, (int_run)0, AS_INT_RUN(LOAD_RUN(search->named + first)) < 0);  // empty
    keep_entries(search->cells, first, lag < 0, kept);
    kept = keep_entries(search->named, first, lag < 0, kept);
  }
  search->cell_count = kept;
  pad(search->named, kept);
}

// Adds the cells of a rectangle of the search's level that are not empty.
static inline void add_cells(Search* search, const Listing* all, global const uint* pyramid, int x, int y, int size) {
  const int columns = cells_along(all->width, search->level), rows = cells_along(all->height, search->level);
  global const uint* const level = pyramid + level_start(all->width, all->height, search->level);
  for (int cell_y = y; cell_y < min(y + size, rows); ++cell_y) {
    for (int cell_x = x; cell_x < min(x + size, columns); ++cell_x) {
      const uint named = level[cell_y * columns + cell_x];
      search->cells[search->cell_count] = pack(cell_x, cell_y) | (named & MORE);
      search->named[search->cell_count] = named & ~MORE;
      search->cell_count += named != EMPTY;
    }
  }
}

// Takes the seeds that are their cells' only ones as candidates, as long as there is room, so that these cells need not
// be refined.
static inline void take_only_seeds(Search* search) {
  int kept = 0;
  for (int i = 0; i < search->cell_count; ++i) {
    if (search->cells[i] & MORE || search->count >= MOST_CANDIDATES) {
      search->cells[kept++] = search->cells[i] & ~MORE;
    } else {
      search->seeds[search->count++] = search->named[i];
    }
  }
  search->cell_count = kept;
}

// Finds the cells that may hold candidates of the box, as fine as they can be listed, and candidates on the way.
static inline void begin_search(Search* search, Box box, const Listing* all, global const uint* pyramid,
                                int top_level) {
  uint parents[MOST_PARENTS];
  search->box = box;
  search->level = top_level;
  search->cell_count = 0;
  search->count = 0;
  search->next_part = 0;
  no_dominators(&search->dominators, box);
  add_cells(search, all, pyramid, 0, 0, TOP_CELLS);
  while (true) {
    pad(search->named, search->cell_count);
    improve_dominator(&search->dominators, 0, search->named, search->cell_count);
    drop_dominated_cells(search, 0, 1);
    for (int i = 1; i < DOMINATORS; ++i) {
      improve_dominator(&search->dominators, i, search->named, search->cell_count);
    }
    drop_dominated_cells(search, 1, DOMINATORS);
    take_only_seeds(search);
    if (search->level == 0 || search->cell_count > MOST_PARENTS) return;
    const int parent_count = search->cell_count;
    for (int i = 0; i < parent_count; ++i) parents[i] = search->cells[i];
    search->cell_count = 0;
    --search->level;
    for (int i = 0; i < parent_count; ++i) {
      add_cells(search, all, pyramid, packed_x(parents[i]) * FAN, packed_y(parents[i]) * FAN, FAN);
    }
  }
}

// Lists candidates behind those that the search has already; false if there are more of them than fit, so that the
// caller takes these and comes again.
static inline bool find_candidates(Search* search, const Listing* all) {
  const int side_bits = FAN_BITS * search->level, side = 1 << side_bits;  // parts of a cell along an axis
  const int parts = search->cell_count << 2 * side_bits;
  while (search->next_part < parts) {
    const int part = search->next_part++;
    const uint cell = search->cells[part >> 2 * side_bits];
    const int x = packed_x(cell) * side + (part & (side - 1));
    const int y = packed_y(cell) * side + (part >> side_bits & (side - 1));
    search->count = add_seeds(all, x, x, y, search->seeds, search->count);
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
