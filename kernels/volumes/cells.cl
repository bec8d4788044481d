// Sums over the voxels of each cell of a volume: how many there are and their coordinates; and statistics of the first.

#include "measures/runs.cl"
#include "measures/sums.cl"
#include "volumes/blocks.cl"
#include "volumes/place.cl"

// HOME SUMS, see kernels/measures/home.cl: what the block that holds a cell's seed adds needs no atomics. Here they
// are a uint4: the voxels, and their columns, rows and slices counted from the block's corner.

static inline ushort home_of(uint seed, int4 size, int4 bits) {
  return seed & EMPTY ? 0 : (ushort)block_with(x_of(seed), y_of(seed), z_of(seed), size, bits);
}

kernel void clear_sums(global const uint* restrict positions, uint count, int4 size, int4 bits,
                       global uint* restrict area, global uint2* restrict sum_x, global uint2* restrict sum_y,
                       global uint2* restrict sum_z, global ushort* restrict home, global uint4* restrict home_sums) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  area[id] = 0;
  sum_x[id] = sum_y[id] = sum_z[id] = (uint2)0;
  home_sums[id] = (uint4)0;
  home[id] = home_of(positions[id], size, bits);
}

kernel void add_sums(global const uint* restrict labels, uint count, int4 size, int4 bits, global uint* restrict area,
                     global uint* restrict sum_x, global uint* restrict sum_y, global uint* restrict sum_z,
                     global const ushort* restrict home, global uint4* restrict home_sums) {
  cuboid_t block;
  if (!take_cuboid(size, bits, &block)) return;
  for (int z = block.first.z; z < block.end.z; ++z) {
    for (int y = block.first.y; y < block.end.y; ++y) {
      global const uint* const row = row_of(labels, y, z, size);
      walk_t walk = begin_walk(row, row, block.first.x, block.end.x);
      while (next_run(&walk)) {
        const uint label = run_label(&walk);
        if (label >= count) continue;
        const uint length = (uint)(walk.to - walk.from), steps = length * (length - 1) / 2;
        if (home[label] == block.index) {
          home_sums[label] += (uint4)(length, length * (uint)(walk.from - block.first.x) + steps,
                                      length * (uint)(y - block.first.y), length * (uint)(z - block.first.z));
        } else {
          atomic_add(area + label, length);
          add_to_pair(sum_x + 2 * label, length * (uint)walk.from + steps);
          add_to_pair(sum_y + 2 * label, length * (uint)y);
          add_to_pair(sum_z + 2 * label, length * (uint)z);
        }
      }
    }
  }
}

// A sum with what the home block added, whose corner is at `corner`.
static inline uint2 joined(uint2 sum, uint voxels, uint from_corner, int corner) {
  return as_uint2(upsample(sum.s1, sum.s0) + (ulong)voxels * (uint)corner + from_corner);
}

// Seeds that are absent own nothing, whatever labels name them.
kernel void join_sums(global const uint* restrict positions, uint count, int4 size, int4 bits,
                      global uint* restrict area, global uint2* restrict sum_x, global uint2* restrict sum_y,
                      global uint2* restrict sum_z, global const ushort* restrict home,
                      global const uint4* restrict home_sums) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  if (positions[id] & EMPTY) {
    area[id] = 0;
    sum_x[id] = sum_y[id] = sum_z[id] = (uint2)0;
    return;
  }
  const uint4 sums = home_sums[id];
  const int4 corner = first_of_block(home[id], size, bits);
  area[id] += sums.s0;
  sum_x[id] = joined(sum_x[id], sums.s0, sums.s1, corner.x);
  sum_y[id] = joined(sum_y[id], sums.s0, sums.s2, corner.y);
  sum_z[id] = joined(sum_z[id], sums.s0, sums.s3, corner.z);
}

// How many periods the voxels of a cell are away, in sum, from where they lie by the rule of place. For volumes with a
// periodic axis.
kernel void add_periods(global const uint* restrict labels, global const uint* restrict positions, uint count,
                        int4 size, int4 bits, global int* restrict periods_x, global int* restrict periods_y,
                        global int* restrict periods_z) {
  cuboid_t block;
  if (!take_cuboid(size, bits, &block)) return;
  for (int z = block.first.z; z < block.end.z; ++z) {
    for (int y = block.first.y; y < block.end.y; ++y) {
      global const uint* const row = row_of(labels, y, z, size);
      walk_t walk = begin_walk(row, row, block.first.x, block.end.x);
      while (next_run(&walk)) {
        const uint label = run_label(&walk);
        if (label >= count) continue;
        const uint seed = positions[label];
        const int length = walk.to - walk.from;
        const int x = PERIODIC_X ? periods_away(walk.from, walk.to, x_of(seed), size.x) : 0;
        const int of_row_y = PERIODIC_Y ? periods_away(y, y + 1, y_of(seed), size.y) : 0;
        const int of_row_z = PERIODIC_Z ? periods_away(z, z + 1, z_of(seed), size.z) : 0;
        if (x != 0) atomic_add(periods_x + label, x);
        if (of_row_y != 0) atomic_add(periods_y + label, of_row_y * length);
        if (of_row_z != 0) atomic_add(periods_z + label, of_row_z * length);
      }
    }
  }
}

// Moves the sums there.
kernel void unwrap_sums(uint count, int4 size, global const int* restrict periods_x,
                        global const int* restrict periods_y, global const int* restrict periods_z,
                        global const uint* restrict area, global long* restrict sum_x, global long* restrict sum_y,
                        global long* restrict sum_z) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || area[id] == 0) return;
  sum_x[id] += (long)periods_x[id] * size.x;
  sum_y[id] += (long)periods_y[id] * size.y;
  sum_z[id] += (long)periods_z[id] * size.z;
}

// The voxels alone, in the same way.
kernel void clear_areas(global const uint* restrict positions, uint count, int4 size, int4 bits,
                        global uint* restrict area, global ushort* restrict home, global uint* restrict home_area) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  area[id] = 0;
  home_area[id] = 0;
  home[id] = home_of(positions[id], size, bits);
}

kernel void add_areas(global const uint* restrict labels, uint count, int4 size, int4 bits, global uint* restrict area,
                      global const ushort* restrict home, global uint* restrict home_area) {
  cuboid_t block;
  if (!take_cuboid(size, bits, &block)) return;
  for (int z = block.first.z; z < block.end.z; ++z) {
    for (int y = block.first.y; y < block.end.y; ++y) {
      global const uint* const row = row_of(labels, y, z, size);
      walk_t walk = begin_walk(row, row, block.first.x, block.end.x);
      while (next_run(&walk)) {
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
  }
}

kernel void join_areas(global const uint* restrict positions, uint count, global uint* restrict area,
                       global const uint* restrict home_area) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  area[id] = positions[id] & EMPTY ? 0 : area[id] + home_area[id];
}

// Statistics of all cells, as kernels/measures/cells.cl has them. All seeds that are there lie in the volume.
kernel void sum_areas(global const uint* restrict positions, uint count, global const uint* restrict area,
                      uint cells_per_item, uint items, global ulong4* restrict partial) {
  const uint item = (uint)get_global_id(0);
  if (item >= items) return;
  const uint end = min((item + 1) * cells_per_item, count);
  ulong4 sums = (ulong4)0;
  for (uint id = item * cells_per_item; id < end; ++id) {
    const ulong voxels = area[id];
    sums += (ulong4)(!(positions[id] & EMPTY), voxels != 0, voxels, voxels * voxels);
  }
  partial[item] = sums;
}
