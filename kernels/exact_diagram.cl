// The exact diagram: lists candidates for large tiles, then labels the cells of each tile.

#include "exact_candidates.cl"
#include "exact_rows.cl"

// A tile is a cell of level 1. What its count says where it has more candidates than a list holds:
#define TILE (CELL * FAN)
#define TOO_MANY 0xffffffffu
// From so many seeds on a cell is labelled by rows: measured, the two ways cost the same there.
#ifndef DENSE
#define DENSE 8
#endif

inline bool is_dense(global const uint* bits, int cell) {
  uint seeds = 0;
  for (int word = 0; word < WORDS; ++word) seeds += popcount(bits[cell * WORDS + word]);
  return seeds >= DENSE;
}

inline bool all_dense(global const uint* bits, int tile_x, int tile_y, int columns, int rows) {
  for (int y = tile_y * FAN; y < min((tile_y + 1) * FAN, rows); ++y) {
    for (int x = tile_x * FAN; x < min((tile_x + 1) * FAN, columns); ++x) {
      if (!is_dense(bits, y * columns + x)) return false;
    }
  }
  return true;
}

kernel void list_candidates(global const uint* restrict pyramid, global const uint* restrict bits,
                            global uint* restrict lists, global uint* restrict counts, int width, int height,
                            int top_level) {
  const int tile = (int)get_global_id(0), tiles_across = cells_along(width, 1);
  if (tile >= tiles_across * cells_along(height, 1)) return;
  const int tile_x = tile % tiles_across, tile_y = tile / tiles_across;
  if (all_dense(bits, tile_x, tile_y, cells_along(width, 0), cells_along(height, 0))) return;
  Search search;
  begin_search(&search, box_of(tile_x * TILE, tile_y * TILE, TILE, width, height), pyramid, width, height, top_level);
  const bool all = find_candidates(&search, pyramid, bits, width, height);
  counts[tile] = all ? (uint)search.count : TOO_MANY;
  if (!all) return;
  global uint* const list = lists + (size_t)tile * MOST_CANDIDATES;
  for (int i = 0; i < search.count; ++i) list[i] = search.seeds[i];
}

// Stores a run of labels, as far as it lies in the grid.
inline void store_run(uint_run labels, global uint* image, int x, int y, int width, int height) {
  if (y >= height) return;
  if (x + VOROCL_WIDTH <= width) {
    STORE_RUN(labels, image + y * width + x);
    return;
  }
  uint label[VOROCL_WIDTH];
  STORE_RUN(labels, label);
  for (int lane = 0; x + lane < width; ++lane) image[y * width + x + lane] = label[lane];
}

inline void store_ids(uint_run seeds, global const uint* ids, global uint* labels, int x, int y, int width,
                      int height) {
  if (y >= height) return;
  const uint_run places = SEED_PLACE(seeds, cells_along(width, 0));
  if (x + VOROCL_WIDTH <= width) {
    store_looked_up(ids, places, labels, y * width + x);
    return;
  }
  uint place[VOROCL_WIDTH];
  STORE_RUN(places, place);
  for (int lane = 0; x + lane < width; ++lane) labels[y * width + x + lane] = ids[place[lane]];
}

inline void fill_box(Box box, uint label, global uint* labels, int width, int height) {
  for (int y = box.top; y <= box.bottom; ++y) {
    for (int x = box.left; x <= box.right; x += VOROCL_WIDTH) {
      store_run((uint_run)label, labels, x, y, width, height);
    }
  }
}

// Puts the list in the order of the tie rule, so that a seed wins only where it is nearer than those before it.
inline void sort_by_tie_rule(uint* seeds, int count, uint* sorted) {
  for (int first = 0; first < count; first += VOROCL_WIDTH) {
    const uint_run run = LOAD_RUN(seeds + first);
    uint_run rank = (uint_run)0;
    for (int i = 0; i < count; ++i) rank += select((uint_run)0, (uint_run)1, seeds[i] < run);
    uint to[VOROCL_WIDTH];
    STORE_RUN(rank, to);
    for (int lane = 0; lane < min(VOROCL_WIDTH, count - first); ++lane) sorted[to[lane]] = seeds[first + lane];
  }
}

// Rows whose distances and labels stay in registers together.
#define ROWS 8

inline void label_by_list(const uint* sorted, const uint* label_of, int count, Box box, global uint* labels,
                          int width, int height) {
  for (int x = box.left; x <= box.right; x += VOROCL_WIDTH) {
    const int_run pixel_x = x + AS_INT_RUN(LANES);
    for (int y = box.top; y <= box.bottom; y += ROWS) {
      int_run least[ROWS];
      uint_run label[ROWS];
#pragma unroll
      for (int row = 0; row < ROWS; ++row) {
        least[row] = (int_run)INT_MAX;
        label[row] = (uint_run)NO_LABEL;
      }
      for (int i = 0; i < count; ++i) {
        const int_run offset_x = pixel_x - packed_x(sorted[i]);
        const int_run along_x = ALONG(offset_x);
        const int offset_y = y - packed_y(sorted[i]);
#pragma unroll
        for (int row = 0; row < ROWS; ++row) {
          const int_run distance = along_x + ALONG(offset_y + row);
          label[row] = select(label[row], (uint_run)label_of[i], distance < least[row]);
          least[row] = min(least[row], distance);
        }
      }
#pragma unroll
      for (int row = 0; row < ROWS; ++row) store_run(label[row], labels, x, y + row, width, height);
    }
  }
}

// As above for any number of candidates, list after list in any order.
inline void label_by_search(Search* search, global const uint* pyramid, global const uint* bits,
                            global const uint* ids, global uint* labels, int width, int height) {
  const Box box = search->box;
  uint_run least[CELL * CELL / VOROCL_WIDTH], nearest[CELL * CELL / VOROCL_WIDTH];
  for (int i = 0; i < CELL * CELL / VOROCL_WIDTH; ++i) least[i] = nearest[i] = (uint_run)0xffffffffu;
  bool all = false;
  while (!all) {
    all = find_candidates(search, pyramid, bits, width, height);
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
  }
  int i = 0;
  for (int y = box.top; y <= box.bottom; ++y) {
    for (int x = box.left; x <= box.right; x += VOROCL_WIDTH, ++i) {
      store_ids(nearest[i], ids, labels, x, y, width, height);
    }
  }
}

// Labels a cell by the best of the rows' nearest seeds. Of rows at equal distances the upper one wins.
inline void label_by_rows(global const uint* bits, global const uint* ids, Box box, global uint* labels, int width,
                          int height) {
  for (int x = box.left; x <= box.right; x += VOROCL_WIDTH) {
    NearestInRows rows;
    begin_rows(&rows, bits, x, box.top, width, height);
    for (int y = box.top; y <= box.bottom; ++y) {
      const int middle = y - box.top + REACH;
      find_rows(&rows, middle, middle);
      int_run least = rows.along_x[middle];
      uint_run nearest = rows.seed[middle];
      // Two offsets at a time, because asking all lanes whether they are done costs as much as an offset.
      for (int offset = 1; offset <= REACH && lane_bits(least >= ALONG(offset)) != 0; offset += 2) {
        find_rows(&rows, middle - offset - 1, middle + offset + 1);
#pragma unroll
        for (int i = 0; i < 2; ++i) {
          const int above = middle - offset - i, below = middle + offset + i;
          const int_run to_above = rows.along_x[above] + ALONG(offset + i);
          nearest = select(nearest, rows.seed[above], to_above <= least);
          least = min(least, to_above);
          const int_run to_below = rows.along_x[below] + ALONG(offset + i);
          nearest = select(nearest, rows.seed[below], to_below < least);
          least = min(least, to_below);
        }
      }
      store_ids(nearest, ids, labels, x, y, width, height);
    }
  }
}

inline void label_by_tile(global const uint* list, int count, global const uint* ids, Box box, global uint* labels,
                          int width, int height) {
  uint seeds[MOST_CANDIDATES + VOROCL_WIDTH], sorted[MOST_CANDIDATES], label_of[MOST_CANDIDATES];
  for (int i = 0; i < count; ++i) seeds[i] = list[i];
  pad(seeds, count);
  if (count > 1) {
    Dominators dominators;
    no_dominators(&dominators, box);
    count = drop_dominated(&dominators, seeds, count);
  }
  sort_by_tie_rule(seeds, count, sorted);
  for (int i = 0; i < count; ++i) label_of[i] = ids[SEED_PLACE(sorted[i], cells_along(width, 0))];
  if (count == 1) {
    fill_box(box, label_of[0], labels, width, height);
  } else {
    label_by_list(sorted, label_of, count, box, labels, width, height);
  }
}

kernel void label_cells(global const uint* restrict pyramid, global const uint* restrict bits,
                        global const uint* restrict lists, global const uint* restrict counts,
                        global const uint* restrict ids, global uint* restrict labels, int width, int height,
                        int top_level) {
  const int cell = (int)get_global_id(0), columns = cells_along(width, 0);
  if (cell >= columns * cells_along(height, 0)) return;
  const int x = cell % columns, y = cell / columns;
  const Box box = box_of(x * CELL, y * CELL, CELL, width, height);
  if (is_dense(bits, cell)) {
    label_by_rows(bits, ids, box, labels, width, height);
    return;
  }
  const int tile = y / FAN * cells_along(width, 1) + x / FAN;
  if (counts[tile] != TOO_MANY) {
    label_by_tile(lists + (size_t)tile * MOST_CANDIDATES, (int)counts[tile], ids, box, labels, width, height);
    return;
  }
  Search search;
  begin_search(&search, box, pyramid, width, height, top_level);
  label_by_search(&search, pyramid, bits, ids, labels, width, height);
}
