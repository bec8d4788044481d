// Cells of pixels that weigh differently: their weights, first moments and energy. A weight is a whole number of 16
// bits, so that all sums are exact in 64: of 2^31 pixels, each at most 2^16 pixels from the window's first one.

#include "measures/seed_place.cl"

// Without 64-bit atomics, which OpenCL C 1.2 leaves to chance: a pair (low word, high word) and a carry.
static inline void add_long_to_pair(global uint* pair, ulong value) {
  const uint low = (uint)value;
  uint high = (uint)(value >> 32);
  if (low != 0 && atomic_add(pair, low) > 0xffffffffu - low) ++high;
  if (high != 0) atomic_add(pair + 1, high);
}

// The sums of a cell are its weight and the moments along all axes: the sum of weight times way, in pixels from the
// seed's own. What the block that holds the seed adds needs no atomics (see measures/home.cl): it goes to `at_home`.
// The rest goes to `elsewhere`, in pairs.
//
// The energy of a block is in units of weight times square pixels.
kernel void add_weights(global const uint* restrict labels, SEED_PARAMETERS, int4 bits,
                        global const ushort* restrict weights, global ulong* restrict at_home,
                        global uint* restrict elsewhere, global ulong* restrict energies) {
  const window_t window = window_of(size, lattice);
  block_t block;
  if (!take_block(size, bits, &block)) return;
  ulong energy_low = 0, energy_high = 0;  // of the low words of the squares, and of the high ones
  FOR_EACH_RUN(walk, y, z, block, labels, size) {
    global const ushort* const of_row = weights + (walk.row - labels);
    const uint label = run_label(&walk);
    if (label >= count || !is_there(seeds[label])) continue;
    const seed_t seed = seeds[label];
    const int home_x = seed_x(seed, size.x), home_y = seed_y(seed, size.y);
    const int dy = way_y(seed, y, window), dz = way_z(seed, z, window);
    const long across = (long)dy * dy * (SPACING_Y * SPACING_Y) + (long)dz * dz * (SPACING_Z * SPACING_Z);
    ulong weight = 0, moment_x = 0;
    for (int from = walk.from, to; from < walk.to; from = to) {
      const int way = way_x(seed, from, window);
      to = piece_end(from, walk.to, way, window.period_x);
      long dx = way, column = place_x(seed, way, size.x) - home_x;
      for (int x = from; x < to; ++x, ++column, dx += UNIT) {
        const ulong of_pixel = of_row[x], square = (ulong)(dx * dx * (SPACING_X * SPACING_X) + across);
        weight += of_pixel;
        moment_x += of_pixel * (ulong)column;
        energy_low += of_pixel * (square & 0xffffffffu);
        energy_high += of_pixel * (square >> 32);
      }
    }
    if (weight == 0) continue;
    const ulong moment_y = weight * (ulong)(long)(place_y(seed, dy, size.y) - home_y);
    const ulong moment_z = weight * (ulong)(long)(place_z(seed, dz) - seed_z(seed));
    if (block_of(home_x, home_y, seed_z(seed), size, bits) == block.index) {
      global ulong* const sums = at_home + 4 * (size_t)label;
      sums[0] += weight;
      sums[1] += moment_x;
      sums[2] += moment_y;
      if (DEPTH(size) > 1) sums[3] += moment_z;
    } else {
      global uint* const sums = elsewhere + 8 * (size_t)label;
      add_long_to_pair(sums, weight);
      add_long_to_pair(sums + 2, moment_x);
      add_long_to_pair(sums + 4, moment_y);
      if (DEPTH(size) > 1) add_long_to_pair(sums + 6, moment_z);
    }
  }
  energies[block.index] = (energy_high << (32 - 2 * UNIT_BITS)) + (energy_low >> (2 * UNIT_BITS));
}

// The sums of all blocks, of coordinates from the window's first pixel on.
kernel void join_weights(SEED_PARAMETERS, global const ulong* restrict at_home, global const uint2* restrict elsewhere,
                         global ulong* restrict weight, global long* restrict sum_x, global long* restrict sum_y,
                         global long* restrict sum_z) {
  (void)lattice;
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  global const ulong* const near = at_home + 4 * (size_t)id;
  global const uint2* const far = elsewhere + 4 * (size_t)id;
  const ulong all = near[0] + upsample(far[0].s1, far[0].s0);
  weight[id] = all;
  if (all == 0) return;
  sum_x[id] = (long)(near[1] + upsample(far[1].s1, far[1].s0) + all * (ulong)(long)seed_x(seeds[id], size.x));
  sum_y[id] = (long)(near[2] + upsample(far[2].s1, far[2].s0) + all * (ulong)(long)seed_y(seeds[id], size.y));
  sum_z[id] = (long)(near[3] + upsample(far[3].s1, far[3].s0) + all * (ulong)(long)seed_z(seeds[id]));
}
