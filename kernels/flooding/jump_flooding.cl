// Jump flooding: the waves of a plan, with the stamping of seeds fused into the first and the ids into the last.

#include "flooding/wave.cl"

// The first wave, straight from the map of the pixels that hold a seed. Its candidates are the vector's own pixels
// moved by the neighbours' offsets.
VECTOR_KERNEL void seed_wave(global const uchar* restrict seeded, global uint* restrict out, int width, int height,
                             int step) {
  if (!has_vector(width, height)) return;
  const int x = vector_x(width), y = vector_y();
  const uint_v pixel = vector_positions(x, y);
#ifdef VOROCL_PERIODIC
  const int step_x = step_along(step, width, PERIODIC_X), step_y = step_along(step, height, PERIODIC_Y);
  uint_v label[VOROCL_NEIGHBOURS];
#pragma unroll
  for (int i = 0; i < VOROCL_NEIGHBOURS; ++i) {
    const int from_x = x + neighbour_x[i] * step_x, from_y = y + neighbour_y[i] * step_y;
    const uint_v present = load_marks(seeded, from_x, from_y, width, height);
    const uint_v position = positions_in_grid(from_x, from_y, width, height);
    label[i] = select((uint_v)EMPTY, position, present != 0);
  }
  const uint_v best = best_label(label, pixel, periods(width, height));
#else
  // The neighbours are in the order of their distance: from the last to the first, each that is there wins.
  uint_v best = (uint_v)EMPTY;
#pragma unroll
  for (int i = VOROCL_NEIGHBOURS - 1; i >= 0; --i) {
    const int offset_x = neighbour_x[i] * step, offset_y = neighbour_y[i] * step;
    const uint_v present = load_marks(seeded, x + offset_x, y + offset_y, width, height);
    best = select(best, pixel + (uint)(offset_y * 65536 + offset_x), present != 0);
  }
#endif
  store_labels(best, out, x, y, width);
}

VECTOR_KERNEL void wave(global const uint* restrict in, global uint* restrict out, int width, int height, int step) {
  if (!has_vector(width, height)) return;
  const int x = vector_x(width), y = vector_y();
  store_labels(nearest_label(in, x, y, width, height, step), out, x, y, width);
}

// The last wave writes ids, which it looks up in the ids at the seeds' pixels (see seeds.cl).
VECTOR_KERNEL void last_wave(global const uint* restrict in, global const uint* restrict ids,
                             global uint* restrict labels, int width, int height, int step) {
  if (!has_vector(width, height)) return;
  const int x = vector_x(width), y = vector_y();
  const uint_v best = nearest_label(in, x, y, width, height, step);
  const uint_v at = select(FIRST_ID + pixel_index(best, width), (uint_v)0, (best & EMPTY_BIT) != 0);
  store_looked_up(ids, at, labels, y * width + x);
}
