// Standard flooding: waves of step 1 that report which was the last one to change a label.

#include "wave.cl"

RUN_KERNEL void reporting_wave(global const uint* restrict in, global uint* restrict out, int width, int height,
                               int wave, global int* restrict last_change) {
  if (!has_run(width, height)) return;
  const int x = run_x(width), y = run_y();
  const uint_run own = load_labels(in, x, y, width, height);
  const uint_run best = nearest_label(in, x, y, width, height, 1);
  store_labels(best, out, x, y, width);
  if (ANY(best != own)) atomic_max(last_change, wave);
}
