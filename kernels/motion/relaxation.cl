// Lloyd relaxation: the energy of a diagram, and the move of its seeds to their cells' centroids.

#include "measures/seed_place.cl"

// The energy of each block's pixels: their squared distances to their seeds, run by run. In square pixels, or in
// 1/UNIT of them, which is a square unit times a unit: more bits of a block's sum could be lost.
kernel void add_energy(global const uint* restrict labels, SEED_PARAMETERS, int4 bits,
                       global ulong* restrict energies) {
  const window_t window = window_of(size, lattice);
  block_t block;
  if (!take_block(size, bits, &block)) return;
  ulong energy = 0, rest = 0;
  FOR_EACH_RUN(walk, y, z, block, labels, size) {
    const uint label = run_label(&walk);
    if (label >= count || !is_there(seeds[label])) continue;
    const long dy = SPACING_Y * way_y(seeds[label], y, window), dz = SPACING_Z * way_z(seeds[label], z, window);
    for (int from = walk.from, to; from < walk.to; from = to) {
      const int way = way_x(seeds[label], from, window);
      to = piece_end(from, walk.to, way, window.period_x);
      const long n = to - from, x = way;
      const long along_x = n * x * x + x * UNIT * n * (n - 1) + (long)UNIT * UNIT * ((n - 1) * n * (2 * n - 1) / 6);
      const ulong squares = (ulong)(n * (dy * dy + dz * dz) + SPACING_X * SPACING_X * along_x);
      energy += squares >> UNIT_BITS;
      rest += squares & (UNIT - 1);
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
static inline uint move_to_mean(global uint* position, long weight, long sum_x, long sum_y, long sum_z, int4 size) {
  const int3 from = (int3)(x_of(*position), y_of(*position), z_of(*position));
  const int3 to = (int3)(nearest_to_mean(sum_x, weight, from.x), nearest_to_mean(sum_y, weight, from.y),
                         nearest_to_mean(sum_z, weight, from.z));
  const int3 inside = (int3)(wrapped(to.x, size.x, PERIODIC_X), wrapped(to.y, size.y, PERIODIC_Y),
                             wrapped(to.z, size.z, PERIODIC_Z));
  *position = packed(inside);
  return max(max(abs(to.x - from.x), abs(to.y - from.y)), abs(to.z - from.z));
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
#define DEFINE_MOVE(name, weight_t)                                                                                 \
  kernel void name(global uint* restrict positions, uint count, uint chunk, global const weight_t* restrict weight, \
                   global const long* restrict sum_x, global const long* restrict sum_y,                            \
                   global const long* restrict sum_z, int4 size, global uint* restrict moved_and_displacement) {    \
    const uint begin = (uint)get_global_id(0) * chunk;                                                              \
    if (begin >= count) return;                                                                                     \
    moves_t moves = {0, 0};                                                                                         \
    for (uint id = begin; id < min(begin + chunk, count); ++id) {                                                   \
      if (weight[id] == 0) continue;                                                                                \
      count_move(&moves, move_to_mean(positions + id, (long)weight[id], sum_x[id], sum_y[id], sum_z[id], size));    \
    }                                                                                                               \
    add_moves(moves, moved_and_displacement);                                                                       \
  }

DEFINE_MOVE(move_to_centroids, uint)
DEFINE_MOVE(move_to_weighted_centroids, ulong)  // of cells with weights (see density.cl)
