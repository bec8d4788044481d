// The exact diagram. Most cells are labelled by the rows around them, or find their candidates among the seeds of the
// cells near them. For the others lists of candidates are made, which regions hand down to the tiles in them.

#include "exact/candidates.cl"
#include "exact/rows.cl"

// A work-item labels a pair of cells. By the number of seeds near a pair, in its two cells and the ten around them: one
// of less than SPARSE has candidates that are seldom near, one of less than MEDIUM is labelled as a whole. By the number
// near a cell, in it and the eight around it: one of DENSE or more is labelled by rows. Measured: the ways cost the same
// there.
#define SPARSE 5
#define MEDIUM 24
#define DENSE 56
// A region of more seeds gets no list: its tiles search for themselves.
#define MOST_OF_REGION 64
// What a list's count says if there are more candidates than it holds.
#define TOO_MANY 0xffffffffu

// Stores a run of labels, as far as it lies in the grid.
static inline void store_run(uint_run labels, global uint* image, int x, int y, int width) {
  if (x + VOROCL_WIDTH <= width) {
    STORE_WHOLE_RUN(labels, image + y * width + x);
    return;
  }
  uint label[VOROCL_WIDTH];
  STORE_RUN(labels, label);
  for (int lane = 0; x + lane < width; ++lane) image[y * width + x + lane] = label[lane];
}

static inline void fill_box(Box box, uint label, global uint* labels, int width) {
  const int whole = (box.right + 1 - box.left) / VOROCL_WIDTH * VOROCL_WIDTH, columns = box.right + 1 - box.left;
  for (int y = box.top; y <= box.bottom; ++y) {
    global uint* const row = labels + y * width + box.left;
    for (int x = 0; x < whole; x += VOROCL_WIDTH) STORE_WHOLE_RUN((uint_run)label, row + x);
    for (int x = whole; x < columns; ++x) row[x] = label;
  }
}

static inline void store_ids(uint_run seeds, const Listing* all, global uint* labels, int x, int y) {
  uint seed[VOROCL_WIDTH];
  STORE_RUN(seeds, seed);
  for (int lane = 0; lane < min(VOROCL_WIDTH, all->width - x); ++lane) {
    labels[y * all->width + x + lane] = id_of(all, seed[lane]);
  }
}

// Numbers the seeds of a padded list in the order of the tie rule.
static inline void rank_by_tie_rule(const uint* seeds, int count, uint* ranks) {
  for (int first = 0; first < count; first += VOROCL_WIDTH) {
    const uint_run run = LOAD_RUN(seeds + first);
    uint_run rank = (uint_run)0;
    for (int i = 0; i < count; ++i) rank += select((uint_run)0, (uint_run)1, seeds[i] < run);
    STORE_RUN(rank, ranks + first);
  }
}

// A BLOCK is so many rows of a cell, whole ones: what is written to memory comes in cache lines.
#define RUNS_OF_ROW (CELL / VOROCL_WIDTH)
#define BLOCK_ROWS (VOROCL_WIDTH >= 4 ? VOROCL_WIDTH / 2 : 1)
#define FOR_BLOCK                                                       \
  _Pragma("unroll") for (int row = 0; row < BLOCK_ROWS; ++row)          \
    _Pragma("unroll") for (int run = 0; run < RUNS_OF_ROW; ++run)

// Labels a box as wide as a cell by candidates and their ranks by the tie rule; `label_of` is in the order of the
// ranks. A candidate's KEY at a pixel says by how much farther it is than the base, and in its lowest bits its rank: the
// least key wins. As the base is the nearest seed to the centre and dominates no candidate, these differences fit in 22
// bits and a sign, however large the distances are. A key is the sum of a part for the pixel's column and one for its row.
#define MOST_KEYS 256
#define LABEL_BLOCK(look_up) FOR_BLOCK label[row][run] = look_up(label_of, AS_UINT_RUN(least[row][run]) & place);

static inline void label_by_keys(const uint* seeds, const uint* ranks, const uint* label_of, int count, uint base,
                                 Box box, global uint* labels, int width) {
  const int place_bits = 32 - (int)clz((uint)count - 1), tables = (count - 1) / VOROCL_WIDTH + 1;
  const uint_run place = (uint_run)((1u << place_bits) - 1);
  uint_run of_column[MOST_KEYS][RUNS_OF_ROW];
  uint of_row[MOST_KEYS * VOROCL_WIDTH];
#pragma unroll
  for (int run = 0; run < RUNS_OF_ROW; ++run) {
    const int_run x = box.left + run * VOROCL_WIDTH + AS_INT_RUN(LANES), offset_of_base = x - packed_x(base);
    const int_run along_base = ALONG(offset_of_base);
    for (int i = 0; i < count; ++i) {
      const int_run offset = x - packed_x(seeds[i]);
      of_column[i][run] = (AS_UINT_RUN(ALONG(offset) - along_base) << place_bits) + ranks[i];
    }
  }
  for (int top = box.top; top <= box.bottom; top += VOROCL_WIDTH) {
    const int_run y = top + AS_INT_RUN(LANES), offset_of_base = y - packed_y(base);
    const int_run along_base = ALONG(offset_of_base);
    for (int i = 0; i < count; ++i) {
      const int_run offset = y - packed_y(seeds[i]);
      STORE_RUN(AS_UINT_RUN(ALONG(offset) - along_base) << place_bits, of_row + i * VOROCL_WIDTH);
    }
    for (int first = 0; first < VOROCL_WIDTH; first += BLOCK_ROWS) {
      int_run least[BLOCK_ROWS][RUNS_OF_ROW];
      uint_run label[BLOCK_ROWS][RUNS_OF_ROW];
      FOR_BLOCK least[row][run] = (int_run)INT_MAX;
      for (int i = 0; i < count; ++i) {
        const uint* const of_rows = of_row + i * VOROCL_WIDTH + first;
        FOR_BLOCK least[row][run] = min(least[row][run], AS_INT_RUN(of_column[i][run] + of_rows[row]));
      }
      if (tables == 1) {
        LABEL_BLOCK(look_up_in_1)
      } else if (tables == 2) {
        LABEL_BLOCK(look_up_in_2)
      } else if (tables == 3) {
        LABEL_BLOCK(look_up_in_3)
      } else if (tables == 4) {
        LABEL_BLOCK(look_up_in_4)
      } else {
        uint at[VOROCL_WIDTH];
        for (int row = 0; row < BLOCK_ROWS; ++row) {
          for (int run = 0; run < RUNS_OF_ROW; ++run) {
            STORE_RUN(AS_UINT_RUN(least[row][run]) & place, at);
            for (int lane = 0; lane < VOROCL_WIDTH; ++lane) at[lane] = label_of[at[lane]];
            label[row][run] = LOAD_RUN(at);
          }
        }
      }
      if (box.left + CELL <= width && top + first + BLOCK_ROWS <= box.bottom + 1) {
        FOR_BLOCK STORE_WHOLE_RUN(label[row][run], labels + (top + first + row) * width + box.left + run * VOROCL_WIDTH);
      } else {
        for (int row = 0; row < min(BLOCK_ROWS, box.bottom + 1 - top - first); ++row) {
          for (int run = 0; run < RUNS_OF_ROW; ++run) {
            store_run(label[row][run], labels, box.left + run * VOROCL_WIDTH, top + first + row, width);
          }
        }
      }
    }
  }
}

// Labels a box by a padded list that holds its candidates.
static inline void label_by_list(const Listing* all, const Dominators* dominators, const uint* seeds, int count,
                                 Box box, global uint* labels) {
  uint ranks[MOST_KEYS + VOROCL_WIDTH], places[MOST_KEYS + VOROCL_WIDTH], label_of[MOST_KEYS + 4 * VOROCL_WIDTH];
  for (int i = 0; i < count; i += VOROCL_WIDTH) STORE_RUN(BIT_PLACE(LOAD_RUN(seeds + i), all->columns), places + i);
  rank_by_tie_rule(seeds, count, ranks);
  for (int i = 0; i < count; ++i) label_of[ranks[i]] = all->ids[listed(all->bits, all->word_starts, places[i])];
  if (count == 1) {
    fill_box(box, label_of[0], labels, all->width);
  } else {
    label_by_keys(seeds, ranks, label_of, count, dominators->seed[0], box, labels, all->width);
  }
}

// Labels a cell of the rows' pair by the best of the rows' nearest seeds; false if there is a pixel that has none
// within reach.
static inline bool label_by_rows(NearestInRows* rows, int cell_y, global uint* labels) {
  const Listing* const all = rows->all;
  const int left = rows->cell_x * CELL, top = cell_y * CELL;
  const int count = min(CELL, all->height - top);
  ushort16 least[CELL];
  if (!find_least_row_keys(rows, top - rows->top, count, least)) return false;
  for (int y = 0; y < count; ++y) least[y] = (least[y] & (ushort)((1 << OFFSET_BITS) - 1)) * (ushort)CELL;
  // Gathered first and stored in runs then, the labels fit in a CPU's store buffer, and it need not wait for memory.
  uint label[CELL * CELL];
  for (int y = 0; y < count; ++y) {
    const ushort* const nearest = (const ushort*)(rows->nearest + (top - rows->top + y - REACH));
    const ushort* const row = (const ushort*)(least + y);
#pragma unroll
    for (int x = 0; x < CELL; ++x) label[y * CELL + x] = rows->ids[nearest[row[x] + x]];
  }
  for (int y = 0; y < count; ++y) {
    for (int x = 0; x < CELL; x += VOROCL_WIDTH) {
      store_run(LOAD_RUN(label + y * CELL + x), labels, left + x, top + y, all->width);
    }
  }
  return true;
}

// The seeds of a cell or a pair of cells and of the cells next to it and next but one, of which candidates are left in
// the end. Five cells, one beside the other, are added at once.
#define MOST_NEAR MOST_CANDIDATES
typedef struct {
  Box box;
  Dominators dominators;
  int count;
  uint seeds[MOST_NEAR + 5 * CELL * CELL + VOROCL_WIDTH];
} Near;

// Takes the seeds of so many cells, one above the other, and of those up to so many cells away; false if that makes
// too many.
static inline bool take_near(Near* near, const Listing* all, int x, int y, int cells, int away) {
  near->count = 0;
  for (int row = y - away; row < y + cells + away; ++row) {
    near->count = add_seeds(all, x - away, x + away, row, near->seeds, near->count);
    if (near->count <= MOST_NEAR) continue;
    pad(near->seeds, near->count);
    improve_dominator(&near->dominators, 0, near->seeds, near->count);
    near->count = drop_dominated(&near->dominators, near->seeds, near->count);
    if (near->count > MOST_NEAR) return false;
  }
  pad(near->seeds, near->count);
  return true;
}

// Labels so many cells, one above the other, if there are seeds near and all of their candidates are; else false.
static inline bool label_by_near(const Listing* all, int x, int y, int cells, global uint* labels) {
  Near near;
  near.box = box_of(x * CELL, y * CELL, CELL, cells * CELL, all->width, all->height);
  no_dominators(&near.dominators, near.box);
  if (!take_near(&near, all, x, y, cells, 1) || near.count == 0) return false;
  improve_dominator(&near.dominators, 0, near.seeds, near.count);
  int reach = 0;
  for (int corner = 0; corner < CORNERS; ++corner) reach = max(reach, (int)near.dominators.distance[0][corner]);
  if (reach > ALONG(2 * CELL)) return false;
  if (reach > ALONG(CELL) && !take_near(&near, all, x, y, cells, 2)) return false;
  near.count = drop_dominated(&near.dominators, near.seeds, near.count);
  if (near.count > MOST_KEYS) return false;
  label_by_list(all, &near.dominators, near.seeds, near.count, near.box, labels);
  return true;
}

static inline uint seeds_near(const Listing* all, int x, int y, int cells) {
  uint seeds = 0;
  for (int row = y - 1; row <= y + cells; ++row) seeds += count_seeds(all, x - 1, x + 1, row);
  return seeds;
}

static inline int pairs_down(const Listing* all) { return (all->rows - 1) / PAIR + 1; }

// Labels a pair of cells, and says by a bit each which of them it could.
#define BOTH 3
static inline uint label_pair(const Listing* all, int x, int y, global uint* labels) {
  const uint seeds = seeds_near(all, x, y, PAIR);
  if (seeds < SPARSE) return 0;
  if (seeds < MEDIUM) return label_by_near(all, x, y, PAIR, labels) ? BOTH : 0;
  NearestInRows rows;
  begin_rows(&rows, all, x, y);
  uint labelled = BOTH;
  for (int i = 0; i < min(PAIR, all->rows - y); ++i) {
    if (seeds_near(all, x, y + i, 1) >= DENSE && label_by_rows(&rows, y + i, labels)) continue;
    if (!label_by_near(all, x, y + i, 1, labels)) labelled ^= 1u << i;
  }
  return labelled;
}

RUN_KERNEL void label_near(global const uint* restrict bits, global const uint* restrict starts,
                           global const uint* restrict word_starts, global const uint* restrict list,
                           global const uint* restrict ids, int width, int height, global uint* restrict labels,
                           global uint* restrict labelled) {
  const Listing all = listing(bits, starts, word_starts, list, ids, width, height);
  const int pair = (int)get_global_id(0);
  if (pair >= all.columns * pairs_down(&all)) return;
  labelled[pair] = label_pair(&all, pair % all.columns, pair / all.columns * PAIR, labels);
}

// Whether all pairs of a cell of some level are labelled.
static inline bool all_labelled(const Listing* all, global const uint* labelled, int level, int x, int y) {
  const int size = 1 << FAN_BITS * level;
  for (int part_y = y * size; part_y < min((y + 1) * size, all->rows); part_y += PAIR) {
    for (int part_x = x * size; part_x < min((x + 1) * size, all->columns); ++part_x) {
      if (labelled[part_y / PAIR * all->columns + part_x] != BOTH) return false;
    }
  }
  return true;
}

// The number of a tile or region among them, the tiles first.
static inline int list_number(const Listing* all, int level, int x, int y) {
  return level_start(all->width, all->height, level) - level_start(all->width, all->height, TILE) +
         y * cells_along(all->width, level) + x;
}

static inline uint seeds_in_cell(const Listing* all, int level, int x, int y) {
  const int size = 1 << FAN_BITS * level;
  uint seeds = 0;
  for (int part_y = y * size; part_y < (y + 1) * size; ++part_y) {
    seeds += count_seeds(all, x * size, (x + 1) * size - 1, part_y);
  }
  return seeds;
}

// Takes those of a list that can be candidates of a box, and pads them.
static inline int take_candidates(global const uint* list, int count, Box box, Dominators* dominators, uint* seeds) {
  for (int i = 0; i < count; i += VOROCL_WIDTH) STORE_RUN(LOAD_RUN(list + i), seeds + i);
  pad(seeds, count);
  no_dominators(dominators, box);
  improve_dominator(dominators, 0, seeds, count);
  return drop_dominated(dominators, seeds, count);
}

// Lists the candidates of a tile or region that has cells to be labelled yet. A tile of one is labelled at once: it has
// no crowded cell, whose rim would be more.
RUN_KERNEL void list_candidates(global const uint* restrict bits, global const uint* restrict starts,
                                global const uint* restrict word_starts, global const uint* restrict list,
                                global const uint* restrict ids, int width, int height, int level,
                                global const uint* restrict labelled, global const uint* restrict pyramid, int top_level,
                                global uint* lists, global uint* counts, global uint* restrict labels) {
  const Listing all = listing(bits, starts, word_starts, list, ids, width, height);
  const int across = cells_along(width, level), cell = (int)get_global_id(0);
  if (cell >= across * cells_along(height, level)) return;
  const int x = cell % across, y = cell / across, number = list_number(&all, level, x, y);
  if (all_labelled(&all, labelled, level, x, y)) return;
  const int size = 1 << cell_bits(level);
  const Box box = box_of(x * size, y * size, size, size, width, height);
  if (level == REGION && seeds_in_cell(&all, level, x, y) > MOST_OF_REGION) {
    counts[number] = TOO_MANY;
    return;
  }
  const int region = list_number(&all, REGION, x / FAN, y / FAN);  // of a tile
  Search search;
  if (level == TILE && counts[region] != TOO_MANY) {
    search.count = take_candidates(lists + (size_t)region * MOST_CANDIDATES, (int)counts[region], box,
                                   &search.dominators, search.seeds);
  } else {
    begin_search(&search, box, &all, pyramid, top_level);
    if (!find_candidates(&search, &all)) {
      counts[number] = TOO_MANY;
      return;
    }
  }
  counts[number] = (uint)search.count;
  if (level == TILE && search.count <= 1) {
    fill_box(box, search.count == 0 ? NO_LABEL : id_of(&all, search.seeds[0]), labels, width);
    counts[number] = 0;
    return;
  }
  global uint* const candidates = lists + (size_t)number * MOST_CANDIDATES;
  for (int i = 0; i < search.count; ++i) candidates[i] = search.seeds[i];
}

// Labels a box by its tile's candidates, if only so many of them are left that this can be done.
static inline bool label_by_tile(const Listing* all, global const uint* candidates, int count, Box box,
                                 global uint* labels) {
  uint seeds[MOST_CANDIDATES + VOROCL_WIDTH];
  Dominators dominators;
  count = take_candidates(candidates, count, box, &dominators, seeds);
  if (count > MOST_KEYS) return false;
  label_by_list(all, &dominators, seeds, count, box, labels);
  return true;
}

// Labels a cell of its box by any number of candidates, list after list in any order.
static inline void label_by_search(Search* search, const Listing* all, global uint* labels) {
  const Box box = search->box;
  uint_run least[CELL * CELL / VOROCL_WIDTH], nearest[CELL * CELL / VOROCL_WIDTH];
  for (int i = 0; i < CELL * CELL / VOROCL_WIDTH; ++i) least[i] = nearest[i] = (uint_run)0xffffffffu;
  bool complete = false;
  while (!complete) {
    complete = find_candidates(search, all);
    int i = 0;
    for (int y = box.top; y <= box.bottom; ++y) {
      for (int x = box.left; x <= box.right; x += VOROCL_WIDTH, ++i) {
        const uint_run pixel = run_positions(x, y);
        for (int c = 0; c < search->count; ++c) {
          const uint_run seed = search->seeds[c];
          const uint_run distance = distance_between(seed, pixel);
          nearest[i] = select(nearest[i], seed, WINS(seed, distance, nearest[i], least[i]));
          least[i] = min(least[i], distance);
        }
      }
    }
    search->count = 0;
  }
  int i = 0;
  for (int y = box.top; y <= box.bottom; ++y) {
    for (int x = box.left; x <= box.right; x += VOROCL_WIDTH, ++i) store_ids(nearest[i], all, labels, x, y);
  }
}

RUN_KERNEL void label_far(global const uint* restrict bits, global const uint* restrict starts,
                          global const uint* restrict word_starts, global const uint* restrict list,
                          global const uint* restrict ids, int width, int height, global const uint* restrict labelled,
                          global const uint* restrict pyramid, int top_level, global const uint* restrict lists,
                          global const uint* restrict counts, global uint* restrict labels) {
  const Listing all = listing(bits, starts, word_starts, list, ids, width, height);
  const int pair = (int)get_global_id(0);
  if (pair >= all.columns * pairs_down(&all) || labelled[pair] == BOTH) return;
  const int x = pair % all.columns, y = pair / all.columns * PAIR;
  const int tile = list_number(&all, TILE, x / FAN, y / FAN);
  if (counts[tile] == 0) return;
  const int first = y + (labelled[pair] == 1), end = min(labelled[pair] == 2 ? y + 1 : y + PAIR, all.rows);
  const Box box = box_of(x * CELL, first * CELL, CELL, (end - first) * CELL, width, height);
  if (counts[tile] != TOO_MANY &&
      label_by_tile(&all, lists + (size_t)tile * MOST_CANDIDATES, (int)counts[tile], box, labels)) {
    return;
  }
  for (int cell_y = first; cell_y < end; ++cell_y) {
    Search search;
    begin_search(&search, box_of(x * CELL, cell_y * CELL, CELL, CELL, width, height), &all, pyramid, top_level);
    label_by_search(&search, &all, labels);
  }
}
