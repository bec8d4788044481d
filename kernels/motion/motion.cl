// Random motion: each seed steps by (dx, dy), each uniform in -most ... most, and stays inside the grid.

#include "core/philox.cl"
#include "core/position.cl"

// Where a coordinate ends up on an axis of `size` pixels. Reflected, the axis and its mirror image repeat for ever.
static inline int bounded_lane(int at, int size, int periodic) {
  const int period = periodic ? size : 2 * size;
  int folded = at % period;
  if (folded < 0) folded += period;
  return folded < size ? folded : period - 1 - folded;
}

static inline int_v bounded(int_v at, int size, int periodic) {
  if (!ANY((at < 0) | (at >= size))) return at;
  int lane[VOROCL_WIDTH];
  STORE_VECTOR(at, lane);
  for (int i = 0; i < VOROCL_WIDTH; ++i) lane[i] = bounded_lane(lane[i], size, periodic);
  return LOAD_VECTOR(lane);
}

// Each work-item moves a vector of seeds.
VECTOR_KERNEL void random_step(global uint* restrict positions, uint count, int width, int height, int most,
                               int periodic_x, int periodic_y, uint frame, uint2 key) {
  const uint first = (uint)get_global_id(0) * VOROCL_WIDTH;
  if (first >= count) return;
  const uint_v position = load_some(positions + first, count - first);
  const uint choices = 2 * (uint)most + 1;
  uint_v dx, dy;
  philox(first + LANES, frame, PHILOX_MOTION, key, &dx, &dy);
  dx = uniform_below(dx, choices) - (uint)most;
  dy = uniform_below(dy, choices) - (uint)most;
  const int_v x = bounded(AS_INT_V((position & 0xffffu) + dx), width, periodic_x);
  const int_v y = bounded(AS_INT_V((position >> 16) + dy), height, periodic_y);
  const uint_v moved = AS_UINT_V(y) << 16 | AS_UINT_V(x);
  store_some(select(moved, position, position & EMPTY_BIT), positions + first, count - first);
}
