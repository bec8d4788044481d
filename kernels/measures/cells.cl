// Sums over the pixels of each cell: area and coordinates, which give the centroid.

#include "measures/runs.cl"

// 64-bit sums without 64-bit atomics, which OpenCL C 1.2 leaves to chance: a pair (low word, high word) and a carry.
static inline void add_to_pair(global uint* pair, uint value) {
  if (atomic_add(pair, value) > 0xffffffffu - value) atomic_inc(pair + 1);
}

// Home sums: the block that holds a cell's seed, its home, holds most of its pixels. What those add to the cell needs
// no atomics, for no other work-item adds to the same place. Blocks are so small that three sums fit in 64 bits
// (src/measures/measurement.cpp asserts it): the pixels, and their columns and rows counted from the block's corner.
// They and the homes are kept small and apart from the rest, because with many cells the time goes into waiting for
// memory: of the home's index 16 bits are kept. With small blocks on a large grid they may belong to another block;
// then that one is the cell's home: the sums stay right, but fewer atomics are saved.
#define HOME_X_SHIFT 16
#define HOME_Y_SHIFT 40
#define HOME_AREA(sums) ((uint)(sums) & 0xffffu)
#define HOME_X(sums) ((uint)((sums) >> HOME_X_SHIFT) & 0xffffffu)
#define HOME_Y(sums) ((uint)((sums) >> HOME_Y_SHIFT))

kernel void clear_sums(global const uint* restrict positions, uint count, int width, int wide, int high,
                       global uint* restrict area, global uint2* restrict sum_x, global uint2* restrict sum_y,
                       global ushort* restrict home, global ulong* restrict home_sums) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  area[id] = 0;
  sum_x[id] = (uint2)(0, 0);
  sum_y[id] = (uint2)(0, 0);
  home_sums[id] = 0;
  home[id] = (ushort)block_of(packed_x(positions[id]), packed_y(positions[id]), width, wide, high);
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

// How many periods the pixels of a cell are away, in sum, from where they lie the shorter way round from its seed. For
// grids with a periodic axis.
kernel void add_periods(global const uint* restrict labels, global const uint* restrict positions, uint count,
                        int width, int height, int wide, int high, global int* restrict periods_x,
                        global int* restrict periods_y) {
  block_t block;
  if (!take_block(width, height, wide, high, &block)) return;
  for (int y = block.top; y < block.bottom; ++y) {
    global const uint* const row = labels + y * width;
    walk_t walk = begin_walk(row, row, block.left, block.right);
    while (next_run(&walk)) {
      const uint label = run_label(&walk);
      if (label >= count) continue;
      const int seed_x = packed_x(positions[label]), inside_y = y - packed_y(positions[label]);
      int sum_x = 0;
      for (int from = walk.from, to; from < walk.to; from = to) {
        to = piece_end(from, walk.to, seed_x, width);
        sum_x += (shorter_way_x(from - seed_x, width) - (from - seed_x)) / width * (to - from);
      }
      const int sum_y = (shorter_way_y(inside_y, height) - inside_y) / height * (walk.to - walk.from);
      if (sum_x != 0) atomic_add(periods_x + label, sum_x);
      if (sum_y != 0) atomic_add(periods_y + label, sum_y);
    }
  }
}

// Moves the sums there.
kernel void unwrap_sums(uint count, int width, int height, global const int* restrict periods_x,
                        global const int* restrict periods_y, global long* restrict sum_x,
                        global long* restrict sum_y) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  sum_x[id] += (long)periods_x[id] * width;
  sum_y[id] += (long)periods_y[id] * height;
}

// Adds the home sums to the others, and turns the pairs into 64-bit numbers.
kernel void join_sums(uint count, int width, int wide, int high, global uint* restrict area,
                      global uint2* restrict sum_x, global uint2* restrict sum_y, global const ushort* restrict home,
                      global const ulong* restrict home_sums) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  const ulong sums = home_sums[id];
  const uint pixels = HOME_AREA(sums);
  const uint across = blocks_across(width, wide);
  const uint left = home[id] % across << wide, top = home[id] / across << high;
  area[id] += pixels;
  sum_x[id] = as_uint2(upsample(sum_x[id].s1, sum_x[id].s0) + (ulong)pixels * left + HOME_X(sums));
  sum_y[id] = as_uint2(upsample(sum_y[id].s1, sum_y[id].s0) + (ulong)pixels * top + HOME_Y(sums));
}
