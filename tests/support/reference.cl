// The exact diagram in plain words: every pixel against every seed. The engines of the library are judged by it.

#include "core/position.cl"

// One work-item per pixel. A seed that is not there has an empty position. Of the seeds on one pixel, which have equal
// distances and positions, the first in the list stays: it has the lowest id.
kernel void label_by_all_seeds(global const uint* restrict positions, uint count, global uint* restrict labels,
                               int width, int height) {
  const int pixel = (int)get_global_id(0);
  if (pixel >= width * height) return;
  const int x = pixel % width, y = pixel / width;
  uint label = NO_LABEL, nearest = EMPTY, least = NO_DISTANCE;
  for (uint id = 0; id < count; ++id) {
    const uint seed = positions[id];
    if (seed & EMPTY_BIT) continue;
    const int along_x = shorter_way_x(x_of(seed) - x, width), along_y = shorter_way_y(y_of(seed) - y, height);
    const uint distance = distance_of_offset(along_x, along_y);
    if (WINS(seed, distance, nearest, least)) {
      label = id;
      nearest = seed;
      least = distance;
    }
  }
  labels[pixel] = label;
}
