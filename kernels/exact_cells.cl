// What the exact engine knows about where seeds are: a grid of cells with one bit a pixel, and above it a pyramid that
// names one seed of each cell, or none. Neither depends on the order in which work-items run.

#ifndef VOROCL_EXACT_CELLS
#define VOROCL_EXACT_CELLS

#include "position.cl"

#if VOROCL_WIDTH == 1
#define AS_INT_RUN as_int
#define AS_UINT_RUN as_uint
#define CONVERT_FLOAT_RUN convert_float
#else
#define AS_INT_RUN JOIN(as_int, VOROCL_WIDTH)
#define AS_UINT_RUN JOIN(as_uint, VOROCL_WIDTH)
#define CONVERT_FLOAT_RUN JOIN(convert_float, VOROCL_WIDTH)
#endif

// The lanes in which a condition holds, a bit each. (any() becomes a branch for each lane under PoCL.)
inline uint join_lanes_1(uint lanes) { return lanes; }
inline uint join_lanes_2(uint2 lanes) { return join_lanes_1(lanes.lo | lanes.hi); }
inline uint join_lanes_4(uint4 lanes) { return join_lanes_2(lanes.lo | lanes.hi); }
inline uint join_lanes_8(uint8 lanes) { return join_lanes_4(lanes.lo | lanes.hi); }
inline uint join_lanes_16(uint16 lanes) { return join_lanes_8(lanes.lo | lanes.hi); }
inline uint lane_bits(int_run condition) {
  return JOIN(join_lanes_, VOROCL_WIDTH)(select((uint_run)0, (uint_run)1 << LANES, condition));
}

// The sides of a cell of level 0 in pixels, and of a cell in cells of the level below it, as powers of two.
#define CELL_BITS 4
#define FAN_BITS 2
#define CELL (1 << CELL_BITS)
#define FAN (1 << FAN_BITS)

inline int cell_bits(int level) { return CELL_BITS + FAN_BITS * level; }
inline int cells_along(int pixels, int level) { return ((pixels - 1) >> cell_bits(level)) + 1; }

// Where a level begins in the pyramid, which holds its levels row-major, the finest one first.
inline int level_start(int width, int height, int level) {
  int start = 0;
  for (int i = 0; i < level; ++i) start += cells_along(width, i) * cells_along(height, i);
  return start;
}

// The place of a seed's pixel where the pixels of a cell stand together, row-major, one cell after the other. Ids are
// kept so, because the rows of a cell in a row-major image are too far apart for a CPU's nearest cache.
#define SEED_PLACE(seed, columns)                                                                                \
  (((((seed) >> (16 + CELL_BITS)) * (uint)(columns) + (((seed) & 0xffffu) >> CELL_BITS)) << 2 * CELL_BITS) + \
   (((seed) >> 16 & (CELL - 1)) << CELL_BITS) + ((seed) & (CELL - 1)))

// The seeds in a row of a cell, a bit each, the lowest bit at the left.
#define WORDS (CELL * CELL / 32)
#define ROWS_OF_WORD (32 / CELL)
inline uint row_bits(global const uint* bits, int cell, int row) {
  return bits[cell * WORDS + row / 2] >> (row & 1) * 16 & 0xffffu;
}
inline uint lowest_bit(uint bits) { return 31u - clz(bits & -bits); }
// The pixel of a word's bit, as an offset from the word's first pixel.
inline uint pixel_of_bit(uint bit) { return pack((int)(bit % CELL), (int)(bit / CELL)); }

// The highest bit of each lane, none of which is 0, from a float's exponent: PoCL takes clz() of vectors lane by lane.
// Without the bit below the highest one, rounding cannot reach the next power of two.
inline int_run highest_bits(uint_run bits) {
  return AS_INT_RUN(AS_UINT_RUN(CONVERT_FLOAT_RUN(bits & ~(bits >> 1))) >> 23) - 127;
}

// The length of an offset along one axis, as it enters the distance.
#ifdef VOROCL_EUCLIDEAN
#define ALONG(offset) ((offset) * (offset))
#else
#define ALONG(offset) max(offset, -(offset))
#endif

// Puts the seeds in their cells. The first one to reach its pixel leaves its id there, the others queue up ...
kernel void put_seeds(global const uint* restrict positions, uint count, global uint* restrict ids,
                      global uint* restrict bits, global uint* restrict late, global uint* restrict late_count,
                      int width) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || positions[id] & EMPTY_BIT) return;
  const uint place = SEED_PLACE(positions[id], cells_along(width, 0)), bit = 1u << place % 32;
  if (atomic_or(bits + place / 32, bit) & bit) {
    late[atomic_inc(late_count)] = id;
  } else {
    ids[place] = id;
  }
}

// ... and then the lowest id stays. So the image of ids need never be cleared.
kernel void keep_lowest_ids(global const uint* restrict positions, global const uint* restrict late,
                            global const uint* restrict late_count, global uint* restrict ids, int width) {
  const uint i = (uint)get_global_id(0);
  if (i >= *late_count) return;
  atomic_min(ids + SEED_PLACE(positions[late[i]], cells_along(width, 0)), late[i]);
}

// Level 0 of the pyramid: the first seed of each cell.
kernel void name_seeds(global const uint* restrict bits, global uint* restrict pyramid, int width, int height) {
  const int cell = (int)get_global_id(0), columns = cells_along(width, 0);
  if (cell >= columns * cells_along(height, 0)) return;
  const uint first_pixel = pack(cell % columns * CELL, cell / columns * CELL);
  uint named = EMPTY;
  for (int word = WORDS - 1; word >= 0; --word) {
    const uint seeds = bits[cell * WORDS + word];
    const uint first_seed = first_pixel + pack(0, word * ROWS_OF_WORD) + pixel_of_bit(lowest_bit(seeds));
    named = seeds == 0 ? named : first_seed;
  }
  pyramid[cell] = named;
}

// A level above 0: the first of the seeds that a cell's FAN x FAN parts name.
kernel void name_seeds_above(global uint* pyramid, int width, int height, int level) {
  const int cell = (int)get_global_id(0), columns = cells_along(width, level);
  if (cell >= columns * cells_along(height, level)) return;
  const int x = cell % columns, y = cell / columns, start = level_start(width, height, level);
  const int parts_across = cells_along(width, level - 1), parts_down = cells_along(height, level - 1);
  const int below = level_start(width, height, level - 1);
  uint named = EMPTY;
  for (int part_y = y * FAN; part_y < min((y + 1) * FAN, parts_down); ++part_y) {
    for (int part_x = x * FAN; part_x < min((x + 1) * FAN, parts_across); ++part_x) {
      named = min(named, pyramid[below + part_y * parts_across + part_x]);
    }
  }
  pyramid[start + cell] = named;
}

#endif
