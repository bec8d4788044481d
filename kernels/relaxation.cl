// Lloyd relaxation: the energy of a diagram, and the move of its seeds to their cells' centroids.

#include "runs.cl"

// The energy of each block's pixels: their squared distances to their seeds, run by run.
kernel void add_energy(global const uint* restrict labels, global const uint* restrict positions, uint count, int width,
                       int height, int wide, int high, global ulong* restrict energies) {
  block_t block;
  if (!take_block(width, height, wide, high, &block)) return;
  ulong energy = 0;
  for (int y = block.top; y < block.bottom; ++y) {
    global const uint* const row = labels + y * width;
    walk_t walk = begin_walk(row, row, block.left, block.right);
    while (next_run(&walk)) {
      const uint label = run_label(&walk);
      if (label >= count) continue;
      const long n = walk.to - walk.from;
      const long x = walk.from - packed_x(positions[label]), dy = y - packed_y(positions[label]);
      energy += (ulong)(n * (x * x + dy * dy) + x * n * (n - 1) + (n - 1) * n * (2 * n - 1) / 6);
    }
  }
  energies[block.index] = energy;
}

// The coordinate nearest to the mean; of two, the present one.
static inline int nearest_to_mean(ulong sum, uint area, int present) {
  const int low = (int)(sum / area);
  const ulong twice_the_rest = 2 * (sum % area);
  if (twice_the_rest == area) return present == low + 1 ? present : low;
  return twice_the_rest < area ? low : low + 1;
}

// Counts the seeds that moved, and finds the greatest displacement along an axis; each work-item for a chunk of the seeds,
// so that few meet there.
kernel void move_to_centroids(global uint* restrict positions, uint count, uint chunk, global const uint* restrict area,
                              global const ulong* restrict sum_x, global const ulong* restrict sum_y,
                              global uint* restrict moved_and_displacement) {
  const uint begin = (uint)get_global_id(0) * chunk;
  if (begin >= count) return;
  const uint end = min(begin + chunk, count);
  uint moved = 0, max_displacement = 0;
  for (uint id = begin; id < end; ++id) {
    if (area[id] == 0) continue;
    const int x = packed_x(positions[id]), y = packed_y(positions[id]);
    const int new_x = nearest_to_mean(sum_x[id], area[id], x), new_y = nearest_to_mean(sum_y[id], area[id], y);
    const uint displacement = max(abs(new_x - x), abs(new_y - y));
    moved += displacement > 0 ? 1u : 0u;
    max_displacement = max(max_displacement, displacement);
    positions[id] = pack(new_x, new_y);
  }
  if (moved == 0) return;
  atomic_add(moved_and_displacement, moved);
  atomic_max(moved_and_displacement + 1, max_displacement);
}
