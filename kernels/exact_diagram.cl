// The exact diagram. Most cells find their candidates among the seeds of the cells near them. For the others lists of
// candidates are made, one for each large tile that has such cells.

#include "exact_candidates.cl"
#include "exact_rows.cl"

// A tile is a cell of level 1. What its count says where it has more candidates than a list holds:
#define TILE (CELL * FAN)
#define TOO_MANY 0xffffffffu
// By the number of seeds in a cell and those next to it: from so many on it is labelled by rows, and with less than so
// many its candidates are seldom near. Measured: the ways cost the same there.
#define DENSE 48
#define SPARSE 4

// Stores a run of labels, as far as it lies in the grid.
inline void store_run(uint_run labels, global uint* image, int x, int y, int width) {
  if (x + VOROCL_WIDTH <= width) {
    STORE_WHOLE_RUN(labels, image + y * width + x);
    return;
  }
  uint label[VOROCL_WIDTH];
  STORE_RUN(labels, label);
  for (int lane = 0; x + lane < width; ++lane) image[y * width + x + lane] = label[lane];
}

inline void fill_box(Box box, uint label, global uint* labels, int width) {
  for (int x = box.left; x <= box.right; x += VOROCL_WIDTH) {
    for (int y = box.top; y <= box.bottom; ++y) store_run((uint_run)label, labels, x, y, width);
  }
}

inline void store_ids(uint_run seeds, const Listing* all, global uint* labels, int x, int y) {
  uint seed[VOROCL_WIDTH];
  STORE_RUN(seeds, seed);
  for (int lane = 0; lane < min(VOROCL_WIDTH, all->width - x); ++lane) {
    labels[y * all->width + x + lane] = id_of(all, seed[lane]);
  }
}

// Puts the list in the order of the tie rule.
inline void sort_by_tie_rule(const uint* seeds, int count, uint* sorted) {
  for (int first = 0; first < count; first += VOROCL_WIDTH) {
    const uint_run run = LOAD_RUN(seeds + first);
    uint_run rank = (uint_run)0;
    for (int i = 0; i < count; ++i) rank += select((uint_run)0, (uint_run)1, seeds[i] < run);
    uint to[VOROCL_WIDTH];
    STORE_RUN(rank, to);
    for (int lane = 0; lane < min(VOROCL_WIDTH, count - first); ++lane) sorted[to[lane]] = seeds[first + lane];
  }
}

// Rows whose least keys stay in registers together.
#define ROWS 8

// Labels a box by candidates in the order of the tie rule. A candidate's KEY at a pixel says by how much farther it is
// than the base, a seed that dominates none of them, and in its lowest bits which one it is: the least key wins. As no
// candidate is dominated, these differences fit in 22 bits, however large the distances are. A key is the sum of a
// part for the pixel's column and one for its row.
#define MOST_KEYS 256
#define LABEL_ROWS(look_up)                                                               \
  _Pragma("unroll") for (int row = 0; row < ROWS; ++row) {                                \
    label[row] = look_up(label_of, AS_UINT_RUN(least[row]) & place);                      \
  }

inline void label_by_keys(const uint* sorted, const uint* label_of, int count, uint base, Box box,
                          global uint* labels, int width) {
  const int place_bits = 32 - (int)clz((uint)count - 1);
  const uint_run place = (uint_run)((1u << place_bits) - 1);
  uint of_row[MOST_KEYS * CELL];
  uint_run of_column[MOST_KEYS];
  for (int first = 0; first < CELL; first += VOROCL_WIDTH) {
    const int_run y = box.top + first + AS_INT_RUN(LANES), offset_of_base = y - packed_y(base);
    const int_run along_base = ALONG(offset_of_base);
    for (int i = 0; i < count; ++i) {
      const int_run offset = y - packed_y(sorted[i]);
      STORE_RUN(AS_UINT_RUN(ALONG(offset) - along_base) << place_bits, of_row + i * CELL + first);
    }
  }
  for (int x = box.left; x <= box.right; x += VOROCL_WIDTH) {
    const int_run pixel_x = x + AS_INT_RUN(LANES), offset_of_base = pixel_x - packed_x(base);
    const int_run along_base = ALONG(offset_of_base);
    for (int i = 0; i < count; ++i) {
      const int_run offset = pixel_x - packed_x(sorted[i]);
      of_column[i] = (AS_UINT_RUN(ALONG(offset) - along_base) << place_bits) + (uint)i;
    }
    for (int y = box.top; y <= box.bottom; y += ROWS) {
      int_run least[ROWS];
      uint_run label[ROWS];
#pragma unroll
      for (int row = 0; row < ROWS; ++row) least[row] = (int_run)INT_MAX;
      for (int i = 0; i < count; ++i) {
        const uint* const of_rows = of_row + i * CELL + (y - box.top);
        const uint_run column = of_column[i];
#pragma unroll
        for (int row = 0; row < ROWS; ++row) least[row] = min(least[row], AS_INT_RUN(column + of_rows[row]));
      }
      const int tables = (count - 1) / VOROCL_WIDTH + 1;
      if (tables == 1) {
        LABEL_ROWS(look_up_in_1)
      } else if (tables == 2) {
        LABEL_ROWS(look_up_in_2)
      } else if (tables == 3) {
        LABEL_ROWS(look_up_in_3)
      } else if (tables == 4) {
        LABEL_ROWS(look_up_in_4)
      } else {
        uint at[VOROCL_WIDTH];
        for (int row = 0; row < ROWS; ++row) {
          STORE_RUN(AS_UINT_RUN(least[row]) & place, at);
          for (int lane = 0; lane < VOROCL_WIDTH; ++lane) at[lane] = label_of[at[lane]];
          label[row] = LOAD_RUN(at);
        }
      }
#pragma unroll
      for (int row = 0; row < ROWS; ++row) {
        if (y + row <= box.bottom) store_run(label[row], labels, x, y + row, width);
      }
    }
  }
}

// Labels a box by a padded list that holds its candidates.
inline void label_by_list(const Listing* all, const Dominators* dominators, const uint* seeds, int count, Box box,
                          global uint* labels) {
  uint sorted[MOST_KEYS], label_of[MOST_KEYS + 4 * VOROCL_WIDTH];
  sort_by_tie_rule(seeds, count, sorted);
  for (int i = 0; i < count; ++i) label_of[i] = id_of(all, sorted[i]);
  if (count == 1) {
    fill_box(box, label_of[0], labels, all->width);
  } else {
    label_by_keys(sorted, label_of, count, dominators->seed[0], box, labels, all->width);
  }
}

// Labels a cell by the best of the rows' nearest seeds; false if there is a pixel that has none within reach.
inline bool label_by_rows(const Listing* all, int cell_x, int cell_y, global uint* labels) {
  NearestInRows rows;
  rows.all = all;
  rows.cell_x = cell_x;
  rows.top = cell_y * CELL;
  ushort16 least[CELL];
  const int columns = min(CELL, all->width - cell_x * CELL), count = min(CELL, all->height - rows.top);
  if (!find_least_row_keys(&rows, count, least)) return false;
  for (int y = 0; y < count; ++y) {
    const uint* const nearest = rows.label + y * CELL;
    least[y] = (least[y] & (ushort)((1 << OFFSET_BITS) - 1)) * (ushort)CELL;
    const ushort* const at = (const ushort*)(least + y);
    global uint* const out = labels + (rows.top + y) * all->width + cell_x * CELL;
    if (columns == CELL) {
#pragma unroll
      for (int x = 0; x < CELL; ++x) out[x] = nearest[at[x] + x];
    } else {
      for (int x = 0; x < columns; ++x) out[x] = nearest[at[x] + x];
    }
  }
  return true;
}

// A cell's candidates and those of the cells next to it and next but one.
#define MOST_NEAR MOST_CANDIDATES
typedef struct {
  Box box;
  Dominators dominators;
  int count;
  uint seeds[MOST_NEAR + 5 * CELL * CELL + VOROCL_WIDTH];
} Near;

// Takes the seeds of a cell and of those up to so many cells away; false if that makes too many.
inline bool take_near(Near* near, const Listing* all, int x, int y, int away) {
  near->count = 0;
  for (int row = -away; row <= away; ++row) {
    near->count = add_seeds(all, x - away, x + away, y + row, near->seeds, near->count);
    if (near->count <= MOST_NEAR) continue;
    pad(near->seeds, near->count);
    improve_dominator(&near->dominators, 0, near->seeds, near->count);
    near->count = drop_dominated(&near->dominators, near->seeds, near->count);
    if (near->count > MOST_NEAR) return false;
  }
  pad(near->seeds, near->count);
  return true;
}

// Lists the candidates of a cell that has seeds near, if all of them are near; else false.
inline bool find_near(Near* near, const Listing* all, int x, int y) {
  near->box = box_of(x * CELL, y * CELL, CELL, all->width, all->height);
  no_dominators(&near->dominators, near->box);
  if (!take_near(near, all, x, y, 1)) return false;
  improve_dominator(&near->dominators, 0, near->seeds, near->count);
  int reach = 0;
  for (int corner = 0; corner < CORNERS; ++corner) reach = max(reach, (int)near->dominators.distance[0][corner]);
  if (reach > ALONG(2 * CELL)) return false;
  if (reach > ALONG(CELL) && !take_near(near, all, x, y, 2)) return false;
  near->count = drop_dominated(&near->dominators, near->seeds, near->count);
  return near->count <= MOST_KEYS;
}

kernel void label_near(global const uint* restrict bits, global const uint* restrict starts,
                       global const uint* restrict word_starts, global const uint* restrict list,
                       global const uint* restrict ids, int width, int height, global uint* restrict labels,
                       global uint* restrict labelled) {
  const Listing all = listing(bits, starts, word_starts, list, ids, width, height);
  const int cell = (int)get_global_id(0);
  if (cell >= all.columns * all.rows) return;
  const int x = cell % all.columns, y = cell / all.columns;
  uint seeds = 0;
  for (int row = -1; row <= 1; ++row) seeds += count_seeds(&all, x - 1, x + 1, y + row);
  labelled[cell] = 1;
  if (seeds >= DENSE && label_by_rows(&all, x, y, labels)) return;
  Near near;
  if (seeds >= SPARSE && find_near(&near, &all, x, y)) {
    label_by_list(&all, &near.dominators, near.seeds, near.count, near.box, labels);
  } else {
    labelled[cell] = 0;
  }
}

inline bool all_labelled(const Listing* all, global const uint* labelled, int tile_x, int tile_y) {
  for (int y = tile_y * FAN; y < min((tile_y + 1) * FAN, all->rows); ++y) {
    for (int x = tile_x * FAN; x < min((tile_x + 1) * FAN, all->columns); ++x) {
      if (!labelled[y * all->columns + x]) return false;
    }
  }
  return true;
}

kernel void list_candidates(global const uint* restrict bits, global const uint* restrict starts,
                            global const uint* restrict word_starts, global const uint* restrict list,
                            global const uint* restrict ids, int width, int height,
                            global const uint* restrict labelled, global const uint* restrict pyramid, int top_level,
                            global uint* restrict lists, global uint* restrict counts) {
  const Listing all = listing(bits, starts, word_starts, list, ids, width, height);
  const int tile = (int)get_global_id(0), tiles_across = cells_along(width, 1);
  if (tile >= tiles_across * cells_along(height, 1)) return;
  const int tile_x = tile % tiles_across, tile_y = tile / tiles_across;
  if (all_labelled(&all, labelled, tile_x, tile_y)) return;
  Search search;
  begin_search(&search, box_of(tile_x * TILE, tile_y * TILE, TILE, width, height), &all, pyramid, top_level);
  const bool complete = find_candidates(&search, &all);
  counts[tile] = complete ? (uint)search.count : TOO_MANY;
  if (!complete) return;
  global uint* const candidates = lists + (size_t)tile * MOST_CANDIDATES;
  for (int i = 0; i < search.count; ++i) candidates[i] = search.seeds[i];
}

// Labels a cell by its tile's candidates, if only so many of them are left that this can be done.
inline bool label_by_tile(const Listing* all, global const uint* candidates, int count, Box box,
                          global uint* labels) {
  if (count <= 1) {
    fill_box(box, count == 0 ? NO_LABEL : id_of(all, candidates[0]), labels, all->width);
    return true;
  }
  uint seeds[MOST_CANDIDATES + VOROCL_WIDTH];
  for (int i = 0; i < count; ++i) seeds[i] = candidates[i];
  pad(seeds, count);
  Dominators dominators;
  no_dominators(&dominators, box);
  improve_dominator(&dominators, 0, seeds, count);
  count = drop_dominated(&dominators, seeds, count);
  if (count > MOST_KEYS) return false;
  label_by_list(all, &dominators, seeds, count, box, labels);
  return true;
}

// Labels a cell by any number of candidates, list after list in any order.
inline void label_by_search(Search* search, const Listing* all, global uint* labels) {
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

kernel void label_far(global const uint* restrict bits, global const uint* restrict starts,
                      global const uint* restrict word_starts, global const uint* restrict list,
                      global const uint* restrict ids, int width, int height, global const uint* restrict labelled,
                      global const uint* restrict pyramid, int top_level, global const uint* restrict lists,
                      global const uint* restrict counts, global uint* restrict labels) {
  const Listing all = listing(bits, starts, word_starts, list, ids, width, height);
  const int cell = (int)get_global_id(0);
  if (cell >= all.columns * all.rows || labelled[cell]) return;
  const int x = cell % all.columns, y = cell / all.columns;
  const Box box = box_of(x * CELL, y * CELL, CELL, width, height);
  const int tile = y / FAN * cells_along(width, 1) + x / FAN;
  if (counts[tile] != TOO_MANY &&
      label_by_tile(&all, lists + (size_t)tile * MOST_CANDIDATES, (int)counts[tile], box, labels)) {
    return;
  }
  Search search;
  begin_search(&search, box, &all, pyramid, top_level);
  label_by_search(&search, &all, labels);
}
