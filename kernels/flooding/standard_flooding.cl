// Standard flooding: waves of step 1 that report which was the last one to change a label.

#include "flooding/wave.cl"

VECTOR_KERNEL void reporting_wave(global const uint* restrict in, global uint* restrict out, int width, int height,
                                  int wave, global int* restrict last_change) {
  if (!has_vector(width, height)) return;
  const int x = vector_x(width), y = vector_y();
  const uint_v own = load_labels(in, x, y, width, height);
  const uint_v best = nearest_label(in, x, y, width, height, 1);
  store_labels(best, out, x, y, width);
  if (ANY(best != own)) atomic_max(last_change, wave);
}
