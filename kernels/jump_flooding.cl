// Jump flooding: the waves of a plan, with the stamping of seeds fused into the first and the ids into the last.

#include "wave.cl"

// The first wave, straight from the map of the pixels that hold a seed. Its candidates are the vector's own pixels
// moved by the neighbours' offsets: from the last to the first, in their order of distance, each that is there wins.
VECTOR_KERNEL void seed_wave(global const uchar* restrict seeded, global uint* restrict out, int width, int height,
                             int step) {
  if (!has_vector(width, height)) return;
  const int x = vector_x(width), y = vector_y();
  const uint_v pixel = vector_positions(x, y);
  uint_v best = (uint_v)EMPTY;
#pragma unroll
  for (int i = VOROCL_NEIGHBOURS - 1; i >= 0; --i) {
    const int from_x = x + neighbour_x[i] * step, from_y = y + neighbour_y[i] * step;
    if (from_y < 0 || from_y >= height || from_x <= -VOROCL_WIDTH || from_x >= width) continue;
    uint_v present = LOAD_BYTES(seeded + VOROCL_GUARD + from_y * width + from_x);
    if (from_x < 0 || from_x + VOROCL_WIDTH > width) present = inside_row(from_x, width, present, (uint_v)0);
    best = select(best, pixel + (uint)(neighbour_y[i] * step * 65536 + neighbour_x[i] * step), present != 0);
  }
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
