// Sums over the pixels of each cell: area and coordinates, which give the centroid; and statistics of the areas.

#include "measures/home.cl"
#include "measures/sums.cl"

// What the pixels at home add: how many they are, and their columns, rows and slices counted from the block's corner.
// The blocks of planes are so small that three sums fit in 64 bits (src/measures/measurement.cpp asserts it).
#if VOROCL_DIMENSIONS == 3
typedef uint4 home_sums_t;
static inline home_sums_t sums_of_run(uint length, uint x, uint y, uint z) {
  return (uint4)(length, length * x + length * (length - 1) / 2, length * y, length * z);
}
static inline uint4 unpacked(home_sums_t sums) { return sums; }
#else
typedef ulong home_sums_t;
static inline home_sums_t sums_of_run(uint length, uint x, uint y, uint z) {
  (void)z;
  return ((ulong)1 | (ulong)x << 16 | (ulong)y << 40) * length + ((ulong)(length * (length - 1) / 2) << 16);
}
static inline uint4 unpacked(home_sums_t sums) {
  return (uint4)((uint)sums & 0xffffu, (uint)(sums >> 16) & 0xffffffu, (uint)(sums >> 40), 0);
}
#endif

kernel void clear_sums(global const seed_t* restrict seeds, uint count, int4 size, int4 bits,
                       global uint* restrict area, global uint2* restrict sum_x, global uint2* restrict sum_y,
                       global uint2* restrict sum_z, global ushort* restrict home,
                       global home_sums_t* restrict home_sums) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  area[id] = 0;
  sum_x[id] = sum_y[id] = sum_z[id] = (uint2)0;
  home_sums[id] = (home_sums_t)0;
  home[id] = home_of(seeds[id], size, bits);
}

kernel void add_sums(global const uint* restrict labels, uint count, int4 size, int4 bits, global uint* restrict area,
                     global uint* restrict sum_x, global uint* restrict sum_y, global uint* restrict sum_z,
                     global const ushort* restrict home, global home_sums_t* restrict home_sums) {
  block_t block;
  if (!take_block(size, bits, &block)) return;
  FOR_EACH_RUN(walk, y, z, block, labels, size) {
    const uint label = run_label(&walk);
    if (label >= count) continue;
    const uint length = (uint)(walk.to - walk.from);
    if (home[label] == block.index) {
      home_sums[label] += sums_of_run(length, (uint)(walk.from - block.left), (uint)(y - block.top),
                                      (uint)(z - block.front));
    } else {
      atomic_add(area + label, length);
      add_to_pair(sum_x + 2 * label, length * (uint)walk.from + length * (length - 1) / 2);
      add_to_pair(sum_y + 2 * label, length * (uint)y);
      if (DEPTH(size) > 1) add_to_pair(sum_z + 2 * label, length * (uint)z);
    }
  }
}

// A sum, which was a pair, with what the home block added, whose corner is at `corner`.
static inline uint2 joined(uint2 sum, uint pixels, uint from_corner, int corner) {
  return as_uint2(upsample(sum.s1, sum.s0) + (ulong)pixels * (uint)corner + from_corner);
}

// Adds the home sums to the others. Seeds that are absent own nothing, whatever labels name them.
kernel void join_sums(global const seed_t* restrict seeds, uint count, int4 size, int4 bits,
                      global uint* restrict area, global uint2* restrict sum_x, global uint2* restrict sum_y,
                      global uint2* restrict sum_z, global const ushort* restrict home,
                      global const home_sums_t* restrict home_sums) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  if (!is_there(seeds[id])) {
    area[id] = 0;
    sum_x[id] = sum_y[id] = sum_z[id] = (uint2)0;
    return;
  }
  const uint4 sums = unpacked(home_sums[id]);
  const int4 corner = first_of_block(home[id], size, bits);
  area[id] += sums.s0;
  sum_x[id] = joined(sum_x[id], sums.s0, sums.s1, corner.x);
  sum_y[id] = joined(sum_y[id], sums.s0, sums.s2, corner.y);
  if (DEPTH(size) > 1) sum_z[id] = joined(sum_z[id], sums.s0, sums.s3, corner.z);
}

// The areas alone, in the same way: those of the pixels at home apart, and then all.
kernel void clear_areas(global const seed_t* restrict seeds, uint count, int4 size, int4 bits,
                        global uint* restrict area, global ushort* restrict home, global uint* restrict home_area) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  area[id] = 0;
  home_area[id] = 0;
  home[id] = home_of(seeds[id], size, bits);
}

kernel void add_areas(global const uint* restrict labels, uint count, int4 size, int4 bits, global uint* restrict area,
                      global const ushort* restrict home, global uint* restrict home_area) {
  block_t block;
  if (!take_block(size, bits, &block)) return;
  FOR_EACH_RUN(walk, y, z, block, labels, size) {
    const uint label = run_label(&walk);
    if (label >= count) continue;
    const uint length = (uint)(walk.to - walk.from);
    if (home[label] == block.index) {
      home_area[label] += length;
    } else {
      atomic_add(area + label, length);
    }
  }
}

kernel void join_areas(global const seed_t* restrict seeds, uint count, global uint* restrict area,
                       global const uint* restrict home_area) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  area[id] = is_there(seeds[id]) ? area[id] + home_area[id] : 0;
}

// How many periods a pixel of a tilted grid is away from where it lies by the rule of place.
static inline int whole_periods(long way, int period) { return period == 0 ? 0 : (int)(way / ((long)period * UNIT)); }
static inline int3 periods_of_way(seed_t seed, way_t way, int x, int y, int z, window_t window) {
  const long along_z = (long)seed_z(seed) * UNIT - centre_behind_z(seed) + way.z - (long)z * UNIT;
  const int slices = whole_periods(along_z, window.period_z);
  const long along_y = (long)seed_y(seed, window.height) * UNIT - centre_behind_y(seed) + way.y - (long)y * UNIT;
  const int rows = whole_periods(along_y - (long)slices * TILT_YZ(&window), window.period_y);
  const long along_x = (long)seed_x(seed, window.width) * UNIT - centre_behind_x(seed) + way.x - (long)x * UNIT;
  const long tilts = (long)slices * TILT_XZ(&window) + (long)rows * TILT_XY(&window);
  return (int3)(whole_periods(along_x - tilts, window.period_x), rows, slices);
}

// How many periods the pixels [from, to) along an axis are away, in sum, from where they lie by the rule of place,
// given the pixel of the seed and how far behind the seed its centre is. A period of pixels lies around the seed, from
// that one on which is less than half a period before it.
static inline int periods_away(int from, int to, int seed, int centre_behind, int period) {
  const long before = ((long)period * UNIT - 1) / 2 + centre_behind;
  const int first = seed - (int)(before >> UNIT_BITS), end = first + period;
  return max(min(to, first) - from, 0) - max(to - max(from, end), 0);
}

// How many periods the pixels of a cell are away, in sum, from where they lie by the rule of place: three numbers per
// cell, for x, y and z. For windows that show a whole period.
kernel void add_periods(global const uint* restrict labels, SEED_PARAMETERS, int4 bits, global int* restrict away) {
  const window_t window = window_of(size, lattice);
  block_t block;
  if (!take_block(size, bits, &block)) return;
  FOR_EACH_RUN(walk, y, z, block, labels, size) {
    const uint label = run_label(&walk);
    if (label >= count) continue;
    const seed_t seed = seeds[label];
    global int* const of_cell = away + 3 * (size_t)label;
    if (is_tilted(window)) {
      for (int from = walk.from, to; from < walk.to; from = to) {
        const piece_t piece = piece_from(seed, from, walk.to, y, z, window);
        to = piece.end;
        const int3 of_piece = periods_of_way(seed, piece.way, from, y, z, window) * (to - from);
        if (of_piece.x != 0) atomic_add(of_cell, of_piece.x);
        if (of_piece.y != 0) atomic_add(of_cell + 1, of_piece.y);
        if (of_piece.z != 0) atomic_add(of_cell + 2, of_piece.z);
      }
      continue;
    }
    const int at_x = seed_x(seed, size.x), at_y = seed_y(seed, size.y), length = walk.to - walk.from;
    const int x = PERIODIC_X ? periods_away(walk.from, walk.to, at_x, centre_behind_x(seed), size.x) : 0;
    const int of_row_y = PERIODIC_Y ? periods_away(y, y + 1, at_y, centre_behind_y(seed), size.y) : 0;
    const int of_row_z = PERIODIC_Z ? periods_away(z, z + 1, seed_z(seed), centre_behind_z(seed), DEPTH(size)) : 0;
    if (x != 0) atomic_add(of_cell, x);
    if (of_row_y != 0) atomic_add(of_cell + 1, of_row_y * length);
    if (of_row_z != 0) atomic_add(of_cell + 2, of_row_z * length);
  }
}

// Moves the sums there. What tilts add is rounded to whole pixels.
kernel void unwrap_sums(uint count, int8 lattice, int4 size, global const int* restrict away,
                        global const uint* restrict area, global long* restrict sum_x, global long* restrict sum_y,
                        global long* restrict sum_z) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || area[id] == 0) return;
  const window_t window = window_of(size, lattice);
  const int3 of_cell = vload3(id, away);
  const long tilt_x = (long)of_cell.y * TILT_XY(&window) + (long)of_cell.z * TILT_XZ(&window);
  const long tilt_y = (long)of_cell.z * TILT_YZ(&window);
  sum_x[id] += (long)of_cell.x * size.x + ((tilt_x + UNIT / 2) >> UNIT_BITS);
  sum_y[id] += (long)of_cell.y * size.y + ((tilt_y + UNIT / 2) >> UNIT_BITS);
  sum_z[id] += (long)of_cell.z * DEPTH(size);
}

#ifdef VOROCL_FAR
// Whether a coordinate is one of the window's, or has an image there: the positions of an axis that has a period lie
// in one period, which may begin outside a window that is no longer.
static inline bool is_shown(int at, int size, int period) {
  if (at < 0 && size <= period) at += period;
  return at >= 0 && at < size;
}

// Whether a seed, or an image of it, lies in the window.
static inline bool is_seed_shown(seed_t seed, window_t window) {
  const int width = window.width, height = window.height;
  if (!is_tilted(window)) {
    return is_shown(seed_x(seed, width), width, window.period_x) &&
           is_shown(seed_y(seed, height), height, window.period_y);
  }
  // Less than a period away from the pixels of a window which is no longer than a period, there is one image.
  const int x = seed_x(seed, width), y = seed_y(seed, height);
  const int row = height > window.period_y ? 0 : y < 0 ? 1 : y >= height ? -1 : 0;
  const int unit = x * UNIT - centre_behind_x(seed) + CENTRE + row * TILT_XY(&window);
  int at = unit >> UNIT_BITS;
  if (row != 0 && width <= window.period_x) {
    if (at < 0) at += window.period_x;
    if (at >= window.period_x) at -= window.period_x;
  }
  return is_shown(at, width, window.period_x) && y + row * window.period_y >= 0 && y + row * window.period_y < height;
}

#else
static inline bool is_seed_shown(seed_t seed, window_t window) {
  (void)seed, (void)window;
  return true;
}
#endif

// Statistics of all cells, as partial sums over parts of their list: how many there are (of seeds outside the window
// those that own pixels), how many of them have pixels, the areas, and their squares.
kernel void sum_areas(SEED_PARAMETERS, global const uint* restrict area, uint cells_per_item, uint items,
                      global ulong4* restrict partial) {
  const window_t window = window_of(size, lattice);
  const uint item = (uint)get_global_id(0);
  if (item >= items) return;
  const uint end = min((item + 1) * cells_per_item, count);
  ulong4 sums = (ulong4)0;
  for (uint id = item * cells_per_item; id < end; ++id) {
    const seed_t seed = seeds[id];
    const ulong pixels = area[id];
    const bool shown = is_there(seed) && is_seed_shown(seed, window);
    sums += (ulong4)(shown || pixels != 0, pixels != 0, pixels, pixels * pixels);
  }
  partial[item] = sums;
}
