// What the exact engine knows about where seeds are: a grid of cells with one bit a pixel, a list of the seeds cell by
// cell, and a pyramid of cells that names one seed of each, or none.

#ifndef VOROCL_EXACT_CELLS
#define VOROCL_EXACT_CELLS

#include "exact/sizes.cl"
#include "position.cl"

#if VOROCL_WIDTH == 1
#define AS_INT_RUN as_int
#define AS_UINT_RUN as_uint
#else
#define AS_INT_RUN JOIN(as_int, VOROCL_WIDTH)
#define AS_UINT_RUN JOIN(as_uint, VOROCL_WIDTH)
#endif

#define CELL (1 << CELL_BITS)
#define FAN (1 << FAN_BITS)

static inline int cell_bits(int level) { return CELL_BITS + FAN_BITS * level; }
static inline int cells_along(int pixels, int level) { return ((pixels - 1) >> cell_bits(level)) + 1; }

// Where a level begins in the pyramid, which holds its levels row-major, the finest one first.
static inline int level_start(int width, int height, int level) {
  int start = 0;
  for (int i = 0; i < level; ++i) start += cells_along(width, i) * cells_along(height, i);
  return start;
}

// The place of a pixel's bit: the bits of a cell stand together, row-major, one cell after the other.
#define BIT_PLACE(pixel, columns)                                                                       \
  (((((pixel) >> (16 + CELL_BITS)) * (uint)(columns) + (((pixel) & 0xffffu) >> CELL_BITS)) << 2 * CELL_BITS) + \
   (((pixel) >> 16 & (CELL - 1)) << CELL_BITS) + ((pixel) & (CELL - 1)))

// THE LIST OF SEEDS. The seeds of each cell stand in it together, row-major, without those that share a pixel; the
// cells of a row of cells follow each other. `starts` says where a cell's seeds begin, `word_starts` where those of
// each word of its bits do, so that a seed's place in the list follows from its position: a bit vector with rank.
static inline uint listed(global const uint* bits, global const uint* word_starts, uint place) {
  const uint word = place / 32;
  return word_starts[word] + popcount(bits[word] & ((1u << place % 32) - 1));
}

// A row of cells has one start more than cells: where its last cell ends.
static inline int start_of(int cell_x, int cell_y, int columns) { return cell_y * (columns + 1) + cell_x; }

// All of it, once it is made.
typedef struct {
  int width, height, columns, rows;  // of the grid in pixels, and in cells of level 0
  global const uint *bits, *starts, *word_starts;
  global const uint *list, *ids;  // the seeds' positions and ids
} Listing;

static inline Listing listing(global const uint* bits, global const uint* starts, global const uint* word_starts,
                              global const uint* list, global const uint* ids, int width, int height) {
  const Listing all = {width, height, cells_along(width, 0), cells_along(height, 0), bits, starts, word_starts,
                       list, ids};
  return all;
}

static inline uint id_of(const Listing* all, uint seed) {
  return all->ids[listed(all->bits, all->word_starts, BIT_PLACE(seed, all->columns))];
}

// The seeds of the cells from (first_x, y) to (last_x, y), as far as these are in the grid.
static inline uint count_seeds(const Listing* all, int first_x, int last_x, int y) {
  if (y < 0 || y >= all->rows) return 0;
  const int end = start_of(min(last_x + 1, all->columns), y, all->columns);
  return all->starts[end] - all->starts[start_of(max(first_x, 0), y, all->columns)];
}

#define WORDS (CELL * CELL / 32)
#define ROWS_OF_WORD (32 / CELL)
// The seeds in a row of a cell, given the word that holds it: a bit each, the lowest bit at the left.
#define ALL_BITS ((1u << CELL) - 1)
static inline uint row_bits(uint word, int y) { return word >> y % ROWS_OF_WORD * CELL & ALL_BITS; }
static inline uint lowest_bit(uint bits) { return 31u - clz(bits & -bits); }
// The pixel of a word's bit, as an offset from the word's first pixel.
static inline uint pixel_of_bit(uint bit) { return pack((int)(bit % CELL), (int)(bit / CELL)); }

// The length of an offset along one axis, as it enters the distance.
#ifdef VOROCL_EUCLIDEAN
#define ALONG(offset) ((offset) * (offset))
#else
#define ALONG(offset) max(offset, -(offset))
#endif

// Sets the seeds' bits, and notes their places. A seed that comes late to its pixel gets NO_PLACE and queues up.
#define NO_PLACE 0xffffffffu
kernel void set_bits(global const uint* restrict positions, uint count, global uint* restrict bits,
                     global uint* restrict places, global uint* restrict late, global uint* restrict late_count,
                     int width) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  places[id] = NO_PLACE;
  if (positions[id] & EMPTY_BIT) return;
  const uint place = BIT_PLACE(positions[id], cells_along(width, 0)), bit = 1u << place % 32;
  if (atomic_or(bits + place / 32, bit) & bit) {
    late[atomic_inc(late_count)] = id;
  } else {
    places[id] = place;
  }
}

// Says of a named seed, in a bit that no position has, that it is not the only one of its cell.
#define MORE 0x8000u

// Level 0 of the pyramid: the first seed of each cell. And how many seeds the cell has.
kernel void name_seeds(global const uint* restrict bits, global uint* restrict pyramid, global uint* restrict starts,
                       int width, int height) {
  const int cell = (int)get_global_id(0), columns = cells_along(width, 0);
  if (cell >= columns * cells_along(height, 0)) return;
  const int x = cell % columns, y = cell / columns;
  uint named = EMPTY, count = 0, any = 0;
  for (int word = 0; word < WORDS; ++word) any |= bits[cell * WORDS + word];
  if (any != 0) {
    for (int word = WORDS - 1; word >= 0; --word) {
      const uint seeds = bits[cell * WORDS + word];
      const uint first_pixel = pack(x * CELL, y * CELL + word * ROWS_OF_WORD);
      named = seeds == 0 ? named : first_pixel + pixel_of_bit(lowest_bit(seeds));
      count += popcount(seeds);
    }
    named |= count > 1 ? MORE : 0;
  }
  pyramid[cell] = named;
  starts[start_of(x, y, columns)] = count;
}

// A level above 0: one of the seeds that a cell's FAN x FAN parts name.
kernel void name_seeds_above(global uint* pyramid, int width, int height, int level) {
  const int cell = (int)get_global_id(0), columns = cells_along(width, level);
  if (cell >= columns * cells_along(height, level)) return;
  const int x = cell % columns, y = cell / columns, start = level_start(width, height, level);
  const int parts_across = cells_along(width, level - 1), parts_down = cells_along(height, level - 1);
  const int below = level_start(width, height, level - 1);
  uint named = EMPTY, more = 0;
  for (int part_y = y * FAN; part_y < min((y + 1) * FAN, parts_down); ++part_y) {
    for (int part_x = x * FAN; part_x < min((x + 1) * FAN, parts_across); ++part_x) {
      const uint of_part = pyramid[below + part_y * parts_across + part_x];
      more |= named != EMPTY && of_part != EMPTY ? MORE : 0;
      named = min(named, of_part);
    }
  }
  pyramid[start + cell] = named | more;
}

// Gives each row of cells its part of the list, in the order in which the rows come, and each cell its start.
kernel void share_out_list(global uint* restrict starts, global uint* restrict end, int width, int height) {
  const int y = (int)get_global_id(0), columns = cells_along(width, 0);
  if (y >= cells_along(height, 0)) return;
  global uint* const row = starts + start_of(0, y, columns);
  uint seeds = 0;
  for (int x = 0; x < columns; ++x) seeds += row[x];
  uint start = atomic_add(end, seeds);
  for (int x = 0; x < columns; ++x) {
    const uint count = row[x];
    row[x] = start;
    start += count;
  }
  row[columns] = start;
}

// Says where the seeds of each word of a cell begin in the list.
kernel void start_words(global const uint* restrict bits, global const uint* restrict starts,
                        global uint* restrict word_starts, int width, int height) {
  const int cell = (int)get_global_id(0), columns = cells_along(width, 0);
  if (cell >= columns * cells_along(height, 0)) return;
  const int start = start_of(cell % columns, cell / columns, columns);
  uint at = starts[start];
  if (at == starts[start + 1]) return;
  for (int word = 0; word < WORDS; ++word) {
    word_starts[cell * WORDS + word] = at;
    at += popcount(bits[cell * WORDS + word]);
  }
}

// Lists the seeds and their ids, of those on one pixel the first one that came ...
kernel void list_seeds(global const uint* restrict positions, global const uint* restrict places, uint count,
                       global const uint* restrict bits, global const uint* restrict word_starts,
                       global uint* restrict list, global uint* restrict ids) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || places[id] == NO_PLACE) return;
  const uint at = listed(bits, word_starts, places[id]);
  list[at] = positions[id];
  ids[at] = id;
}

// ... and then the lowest one stays.
kernel void keep_lowest_ids(global const uint* restrict positions, global const uint* restrict late,
                            global const uint* restrict late_count, global const uint* restrict bits,
                            global const uint* restrict word_starts, global uint* restrict ids, int width) {
  for (uint i = (uint)get_global_id(0); i < *late_count; i += (uint)get_global_size(0)) {
    atomic_min(ids + listed(bits, word_starts, BIT_PLACE(positions[late[i]], cells_along(width, 0))), late[i]);
  }
}

#endif
