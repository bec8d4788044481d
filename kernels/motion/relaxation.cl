// Lloyd relaxation: the energy of a diagram, and the move of its seeds to their cells' centroids.

#include "measures/seed_place.cl"

// The energy of each block's pixels: their squared distances to their seeds, run by run. In square pixels, or in
// 1/ENERGY_UNITS of them, which is a square unit times a unit: more bits of a block's sum could be lost.
kernel void add_energy(global const uint* restrict labels, SEED_PARAMETERS, int4 bits,
                       global ulong* restrict energies) {
  const window_t window = window_of(size, periods);
  block_t block;
  if (!take_block(size, bits, &block)) return;
  ulong energy = 0, rest = 0;
  FOR_EACH_ROW(y, z, block) {
    global const uint* const row = row_of(labels, y, z, size);
    walk_t walk = begin_walk(row, row, block.left, block.right);
    while (next_run(&walk)) {
      const uint label = run_label(&walk);
      if (label >= count || !is_there(seeds[label])) continue;
      const long dy = way_y(seeds[label], y, window);
      for (int from = walk.from, to; from < walk.to; from = to) {
        const int way = way_x(seeds[label], from, window);
        to = piece_end(from, walk.to, way, window.period_x);
        const long n = to - from, x = way;
        const ulong squares = (ulong)(n * (x * x + dy * dy) + x * UNIT * n * (n - 1) +
                                      (long)UNIT * UNIT * ((n - 1) * n * (2 * n - 1) / 6));
        energy += squares >> UNIT_BITS;
        rest += squares & (UNIT - 1);
      }
    }
  }
  energies[block.index] = energy + (rest >> UNIT_BITS);
}

// The coordinate nearest to the mean; of two, the present one.
static inline int nearest_to_mean(long sum, long weight, int present) {
  const long quotient = sum / weight, low = quotient * weight > sum ? quotient - 1 : quotient;
  const long twice_the_rest = 2 * (sum - low * weight);
  if (twice_the_rest == weight) return present == (int)low + 1 ? present : (int)low;
  return twice_the_rest < weight ? (int)low : (int)low + 1;
}

// Moves a seed to the mean of what its cell's sums are of. Returns how far along an axis.
static inline uint move_to_mean(global uint* position, long weight, long sum_x, long sum_y, int width, int height) {
  const int x = packed_x(*position), y = packed_y(*position);
  const int new_x = nearest_to_mean(sum_x, weight, x), new_y = nearest_to_mean(sum_y, weight, y);
  *position = pack(wrapped_x(new_x, width), wrapped_y(new_y, height));
  return max(abs(new_x - x), abs(new_y - y));
}

// The seeds that moved, and the greatest displacement along an axis.
typedef struct {
  uint seeds, most;
} moves_t;

static inline void count_move(moves_t* moves, uint displacement) {
  moves->seeds += displacement > 0 ? 1u : 0u;
  moves->most = max(moves->most, displacement);
}

static inline void add_moves(const moves_t moves, global uint* moved_and_displacement) {
  if (moves.seeds == 0) return;
  atomic_add(moved_and_displacement, moves.seeds);
  atomic_max(moved_and_displacement + 1, moves.most);
}

// Each work-item moves a chunk of the seeds, so that few meet where moves are counted. A cell without pixels has no
// mean: its seed stays.
kernel void move_to_centroids(global uint* restrict positions, uint count, uint chunk, global const uint* restrict area,
                              global const long* restrict sum_x, global const long* restrict sum_y, int width,
                              int height, global uint* restrict moved_and_displacement) {
  const uint begin = (uint)get_global_id(0) * chunk;
  if (begin >= count) return;
  moves_t moves = {0, 0};
  for (uint id = begin; id < min(begin + chunk, count); ++id) {
    if (area[id] == 0) continue;
    count_move(&moves, move_to_mean(positions + id, area[id], sum_x[id], sum_y[id], width, height));
  }
  add_moves(moves, moved_and_displacement);
}

// The same of cells with weights (see density.cl).
kernel void move_to_weighted_centroids(global uint* restrict positions, uint count, uint chunk,
                                       global const ulong* restrict weight, global const long* restrict sum_x,
                                       global const long* restrict sum_y, int width, int height,
                                       global uint* restrict moved_and_displacement) {
  const uint begin = (uint)get_global_id(0) * chunk;
  if (begin >= count) return;
  moves_t moves = {0, 0};
  for (uint id = begin; id < min(begin + chunk, count); ++id) {
    if (weight[id] == 0) continue;
    count_move(&moves, move_to_mean(positions + id, (long)weight[id], sum_x[id], sum_y[id], width, height));
  }
  add_moves(moves, moved_and_displacement);
}
