// Sums over the pixels of each cell: area and coordinates, which give the centroid; and statistics of the areas.

#include "measures/home.cl"
#include "measures/sums.cl"

// What the pixels at home add. Blocks are so small that three sums fit in 64 bits (src/measures/measurement.cpp asserts
// it): the pixels, and their columns and rows counted from the block's corner.
#define HOME_X_SHIFT 16
#define HOME_Y_SHIFT 40
#define HOME_AREA(sums) ((uint)(sums) & 0xffffu)
#define HOME_X(sums) ((uint)((sums) >> HOME_X_SHIFT) & 0xffffffu)
#define HOME_Y(sums) ((uint)((sums) >> HOME_Y_SHIFT))

kernel void clear_sums(global const seed_t* restrict seeds, uint count, int width, int height, int wide, int high,
                       global uint* restrict area, global uint2* restrict sum_x, global uint2* restrict sum_y,
                       global ushort* restrict home, global ulong* restrict home_sums) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  area[id] = 0;
  sum_x[id] = (uint2)(0, 0);
  sum_y[id] = (uint2)(0, 0);
  home_sums[id] = 0;
  home[id] = home_of(seeds[id], width, height, wide, high);
}

kernel void add_sums(global const uint* restrict labels, uint count, int width, int height, int wide, int high,
                     global uint* restrict area, global uint* restrict sum_x, global uint* restrict sum_y,
                     global const ushort* restrict home, global ulong* restrict home_sums) {
  block_t block;
  if (!take_block(width, height, wide, high, &block)) return;
  for (int y = block.top; y < block.bottom; ++y) {
    global const uint* const row = labels + y * width;
    const ulong of_row = (ulong)1 | (ulong)(uint)(y - block.top) << HOME_Y_SHIFT;
    walk_t walk = begin_walk(row, row, block.left, block.right);
    while (next_run(&walk)) {
      const uint label = run_label(&walk);
      if (label >= count) continue;
      const uint length = (uint)(walk.to - walk.from);
      const uint steps = length * (length - 1) / 2;
      if (home[label] == block.index) {
        const ulong first_pixel = of_row + ((ulong)(uint)(walk.from - block.left) << HOME_X_SHIFT);
        home_sums[label] += first_pixel * length + ((ulong)steps << HOME_X_SHIFT);
      } else {
        atomic_add(area + label, length);
        add_to_pair(sum_x + 2 * label, length * (uint)walk.from + steps);
        add_to_pair(sum_y + 2 * label, length * (uint)y);
      }
    }
  }
}

// The areas alone, in the same way: those of the pixels at home apart, and then all.
kernel void clear_areas(global const seed_t* restrict seeds, uint count, int width, int height, int wide, int high,
                        global uint* restrict area, global ushort* restrict home, global ushort* restrict home_area) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  area[id] = 0;
  home_area[id] = 0;
  home[id] = home_of(seeds[id], width, height, wide, high);
}

kernel void add_areas(global const uint* restrict labels, uint count, int width, int height, int wide, int high,
                      global uint* restrict area, global const ushort* restrict home,
                      global ushort* restrict home_area) {
  block_t block;
  if (!take_block(width, height, wide, high, &block)) return;
  for (int y = block.top; y < block.bottom; ++y) {
    global const uint* const row = labels + y * width;
    walk_t walk = begin_walk(row, row, block.left, block.right);
    while (next_run(&walk)) {
      const uint label = run_label(&walk);
      if (label >= count) continue;
      const uint length = (uint)(walk.to - walk.from);
      if (home[label] == block.index) {
        home_area[label] += (ushort)length;
      } else {
        atomic_add(area + label, length);
      }
    }
  }
}

kernel void join_areas(global const seed_t* restrict seeds, uint count, global uint* restrict area,
                       global const ushort* restrict home_area) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  area[id] = is_there(seeds[id]) ? area[id] + home_area[id] : 0;
}

// Whether a coordinate is less than half a period away from a seed, where none of the ways round is shorter.
static inline bool is_near(int at, int seed, int period) { return 2 * abs(at - seed) < (uint)period; }

// How many periods a pixel of a tilted grid is away from where it lies by the rule of place.
static inline int2 periods_away(seed_t seed, int2 way, int x, int y, window_t window) {
  const long along_y = (long)seed_y(seed, window.height) * UNIT - centre_behind_y(seed) + way.y - (long)y * UNIT;
  const long rows = along_y / ((long)window.period_y * UNIT);
  const long along_x = (long)seed_x(seed, window.width) * UNIT - centre_behind_x(seed) + way.x - (long)x * UNIT;
  return (int2)((int)((along_x - rows * window.shift) / ((long)window.period_x * UNIT)), (int)rows);
}

// How many periods the pixels of a cell are away, in sum, from where they lie by the rule of place. For windows that
// show a whole period.
kernel void add_periods(global const uint* restrict labels, SEED_PARAMETERS, int wide, int high,
                        global int* restrict periods_x, global int* restrict periods_y) {
  const window_t window = window_of(width, height, periods);
  block_t block;
  if (!take_block(width, height, wide, high, &block)) return;
  for (int y = block.top; y < block.bottom; ++y) {
    global const uint* const row = labels + y * width;
    walk_t walk = begin_walk(row, row, block.left, block.right);
    while (next_run(&walk)) {
      const uint label = run_label(&walk);
      if (label >= count) continue;
      const seed_t seed = seeds[label];
      if (is_tilted(window)) {
        for (int from = walk.from, to; from < walk.to; from = to) {
          const piece_t piece = piece_from(seed, from, walk.to, y, window);
          to = piece.end;
          const int2 away = periods_away(seed, piece.way, from, y, window) * (to - from);
          if (away.x != 0) atomic_add(periods_x + label, away.x);
          if (away.y != 0) atomic_add(periods_y + label, away.y);
        }
        continue;
      }
      // Nearly all pixels are near.
      const int x = seed_x(seed, width);
      if (PERIODIC_X && !(is_near(walk.from, x, width) && is_near(walk.to - 1, x, width))) {
        int sum = 0;
        for (int from = walk.from, to; from < walk.to; from = to) {
          const int way = way_x(seed, from, window);
          to = piece_end(from, walk.to, way, window.period_x);
          sum += (place_x(seed, way, width) - from) / width * (to - from);
        }
        if (sum != 0) atomic_add(periods_x + label, sum);
      }
      if (PERIODIC_Y && !is_near(y, seed_y(seed, height), height)) {
        const int away = (place_y(seed, way_y(seed, y, window), height) - y) / height;
        if (away != 0) atomic_add(periods_y + label, away * (walk.to - walk.from));
      }
    }
  }
}

// Moves the sums there. What the tilt adds is rounded to whole pixels.
kernel void unwrap_sums(uint count, int4 periods, int width, int height, global const int* restrict periods_x,
                        global const int* restrict periods_y, global const uint* restrict area,
                        global long* restrict sum_x, global long* restrict sum_y) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || area[id] == 0) return;
  const window_t window = window_of(width, height, periods);
  sum_x[id] += (long)periods_x[id] * width + (((long)periods_y[id] * window.shift + UNIT / 2) >> UNIT_BITS);
  sum_y[id] += (long)periods_y[id] * height;
}

// Adds the home sums to the others, and turns the pairs into 64-bit numbers. Seeds that are absent own nothing,
// whatever labels name them.
kernel void join_sums(global const seed_t* restrict seeds, uint count, int width, int wide, int high,
                      global uint* restrict area, global uint2* restrict sum_x, global uint2* restrict sum_y,
                      global const ushort* restrict home, global const ulong* restrict home_sums) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  if (!is_there(seeds[id])) {
    area[id] = 0;
    sum_x[id] = sum_y[id] = (uint2)0;
    return;
  }
  const ulong sums = home_sums[id];
  const uint pixels = HOME_AREA(sums);
  const uint across = blocks_across(width, wide);
  const uint left = home[id] % across << wide, top = home[id] / across << high;
  area[id] += pixels;
  sum_x[id] = as_uint2(upsample(sum_x[id].s1, sum_x[id].s0) + (ulong)pixels * left + HOME_X(sums));
  sum_y[id] = as_uint2(upsample(sum_y[id].s1, sum_y[id].s0) + (ulong)pixels * top + HOME_Y(sums));
}

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
  const int unit = x * UNIT - centre_behind_x(seed) + CENTRE + row * window.shift;
  int at = unit >> UNIT_BITS;
  if (row != 0 && width <= window.period_x) {
    if (at < 0) at += window.period_x;
    if (at >= window.period_x) at -= window.period_x;
  }
  return is_shown(at, width, window.period_x) && y + row * window.period_y >= 0 && y + row * window.period_y < height;
}

// Statistics of all cells, as partial sums over parts of their list: how many there are (of seeds outside the window
// those that own pixels), how many of them have pixels, the areas, and their squares.
kernel void sum_areas(SEED_PARAMETERS, global const uint* restrict area, uint cells_per_item, uint items,
                      global ulong4* restrict partial) {
  const window_t window = window_of(width, height, periods);
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
