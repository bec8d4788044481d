// The inner loops of the paper's Algorithm 1 as they are printed: each pixel writes its label into the neighbours
// whose own is farther, in the image that all pixels read. Work-items race for a pixel, and read what others have
// written in the same wave or not: so the result depends on their order, and differs from run to run. Part of the
// evaluation; the library's waves gather instead.

#define EMPTY_BIT 0x80000000u

// The neighbours in the order of the paper's Table I; every other one is a von Neumann neighbour.
constant int neighbour_x[8] = {1, 1, 0, -1, -1, -1, 0, 1};
constant int neighbour_y[8] = {0, 1, 1, 1, 0, -1, -1, -1};

// The squared distance of a pixel to the seed of a label; a label that names no seed is farthest.
static inline uint distance_to(global const uint* positions, uint count, uint label, int x, int y) {
  const uint position = positions[min(label, count)];
  if (position & EMPTY_BIT) return 0xffffffffu;
  const int dx = (int)(position & 0xffffu) - x, dy = (int)(position >> 16) - y;
  return (uint)(dx * dx + dy * dy);
}

// One wave: for each neighbour q of p, "if d(s_p, q) < d(s_q, q): VD[q] = s_p". Every `stride`th neighbour takes
// part: 1 for Moore, 2 for von Neumann.
kernel void scatter_in_place(global volatile uint* labels, global const uint* restrict positions, uint count, int width,
                             int height, int step, int stride) {
  const int x = (int)get_global_id(0), y = (int)get_global_id(1);
  if (x >= width || y >= height) return;
  for (int i = 0; i < 8; i += stride) {
    const int to_x = x + neighbour_x[i] * step, to_y = y + neighbour_y[i] * step;
    if (to_x < 0 || to_x >= width || to_y < 0 || to_y >= height) continue;
    global volatile uint* const to = labels + to_y * width + to_x;
    const uint own = labels[y * width + x];
    if (distance_to(positions, count, own, to_x, to_y) < distance_to(positions, count, *to, to_x, to_y)) *to = own;
  }
}

// What Algorithm 1 leaves out: each seed's own pixel gets its label. Of the seeds on one pixel any may stay.
kernel void stamp_labels(global volatile uint* labels, global const uint* restrict positions, uint count, int width) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || positions[id] & EMPTY_BIT) return;
  labels[(positions[id] >> 16) * (uint)width + (positions[id] & 0xffffu)] = id;
}
