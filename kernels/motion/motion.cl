// Random motion: each seed steps by (dx, dy), each uniform in -most ... most, and stays inside the grid.

#include "core/philox.cl"
#include "core/position.cl"

// Where a coordinate ends up on an axis of `size` pixels. Reflected, the axis and its mirror image repeat for ever.
static inline int bounded(int at, int size, int periodic) {
  const int period = periodic ? size : 2 * size;
  int folded = at % period;
  if (folded < 0) folded += period;
  return folded < size ? folded : period - 1 - folded;
}

kernel void random_step(global uint* restrict positions, uint count, int width, int height, int most,
                        int periodic_x, int periodic_y, uint frame, uint2 key) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || positions[id] & EMPTY_BIT) return;
  const uint4 bits = philox((uint4)(id, frame, 0, PHILOX_MOTION), key);
  const uint choices = 2 * (uint)most + 1;
  const int x = packed_x(positions[id]) + (int)uniform_below(bits.s0, choices) - most;
  const int y = packed_y(positions[id]) + (int)uniform_below(bits.s1, choices) - most;
  positions[id] = pack(bounded(x, width, periodic_x), bounded(y, height, periodic_y));
}
