// Low resolution with reconstruction: a diagram of coarse pixels, brought up by halving the pixels.
//
// A coarse pixel of level l stands for 2^l x 2^l pixels of the grid. It keeps one of the seeds in it, and its distances
// are those of its middle pixel. Labels are the seeds' own positions at every level. `width` and `height` are those of
// the level, `full_width` and `full_height` the grid's.

#include "flooding/wave.cl"

// The middle pixels of a vector of coarse pixels, in the grid.
static inline uint_v middle_pixels(int x, int y, int level, int full_width, int full_height) {
  const uint to_middle = 1u << level >> 1;
  const uint across = (uint)(full_width - 1), down = (uint)(full_height - 1);
  return (min(((uint)y << level) + to_middle, down) << 16) +
         min((((uint)x + LANES) << (uint)level) + to_middle, (uint_v)across);
}

// Every second of the values that follow.
static inline uint_v every_second(global const uint* values) {
#if VOROCL_WIDTH == 1
  return *values;
#else
  uint_v result;
  result.lo = LOAD_VECTOR(values).even;
  result.hi = LOAD_VECTOR(values + VOROCL_WIDTH).even;
  return result;
#endif
}

// The seeds that the pixels of a level keep: of those that the four pixels of the finer level keep, `fine_width` x
// `fine_height` pixels, the best one for the middle pixel.
VECTOR_KERNEL void coarsen_seeds(global const uint* restrict seeds, int fine_width, int fine_height,
                                 global uint* restrict out, int width, int height, int level, int full_width,
                                 int full_height) {
  if (!has_vector(width, height)) return;
  const int x = vector_x(width), y = vector_y();
  const int_v has_right = AS_INT_V(2 * ((uint)x + LANES) + 1 < (uint_v)(uint)fine_width);
  global const uint* const top = seeds + VOROCL_GUARD + 2 * y * fine_width + 2 * x;
  global const uint* const bottom = 2 * y + 1 < fine_height ? top + fine_width : top;
  uint_v label[VOROCL_NEIGHBOURS];
#pragma unroll
  for (int i = 0; i < VOROCL_NEIGHBOURS; ++i) label[i] = (uint_v)EMPTY;
  label[0] = every_second(top);
  label[1] = has_right ? every_second(top + 1) : (uint_v)EMPTY;
  label[2] = every_second(bottom);
  label[3] = has_right ? every_second(bottom + 1) : (uint_v)EMPTY;
  store_labels(best_label(label, middle_pixels(x, y, level, full_width, full_height), periods(full_width, full_height)),
               out, x, y, width);
}

// The labels of a level from those of the coarser one. A label there stands for all seeds of its coarse pixel: the four
// pixels that it is halved into are asked for theirs. The pixel's own seed takes part too. Where seeds are there, every
// pixel of the coarser level has a label; else all pixels keep none.
VECTOR_KERNEL void refine(global const uint* restrict coarse, int coarse_width, global const uint* restrict seeds,
                          global uint* restrict out, int width, int height, int level, int full_width,
                          int full_height) {
  if (!has_vector(width, height)) return;
  const int x = vector_x(width), y = vector_y();
  const uint_v coarse_labels = LOAD_VECTOR(coarse + VOROCL_GUARD + y / 2 * coarse_width + x / 2);
  const uint_v above = permute(coarse_labels, ((uint)(x & 1) + LANES) / 2);
  const uint_v position = above & ~(uint_v)EMPTY;
  const uint one = lane_min(position), right = (uint)(width - 1), down = (uint)(height - 1);
  uint_v label[VOROCL_NEIGHBOURS];
#pragma unroll
  for (int i = 0; i < VOROCL_NEIGHBOURS; ++i) label[i] = LOAD_VECTOR(seeds + VOROCL_GUARD + y * width + x);
  if (ANY(position != one)) {
    const uint_v first_x = (position & 0xffffu) >> (uint)(level + 1) << 1u;
    const uint_v first_y = position >> (uint)(level + 17) << 1u;
    const uint_v row = first_y * (uint)width, next_row = min(first_y + 1, (uint_v)down) * (uint)width;
    const uint_v next_x = min(first_x + 1, (uint_v)right);
    label[0] = looked_up(seeds + VOROCL_GUARD, row + first_x);
    label[1] = looked_up(seeds + VOROCL_GUARD, row + next_x);
    label[2] = looked_up(seeds + VOROCL_GUARD, next_row + first_x);
    label[3] = looked_up(seeds + VOROCL_GUARD, next_row + next_x);
  } else {
    // Inside a cell all pixels ask the same four.
    const uint first_x = (one & 0xffffu) >> (level + 1) << 1, first_y = one >> (level + 17) << 1;
    const uint row = first_y * (uint)width, next_row = min(first_y + 1, down) * (uint)width;
    const uint next_x = min(first_x + 1, right);
    label[0] = seeds[VOROCL_GUARD + row + first_x];
    label[1] = seeds[VOROCL_GUARD + row + next_x];
    label[2] = seeds[VOROCL_GUARD + next_row + first_x];
    label[3] = seeds[VOROCL_GUARD + next_row + next_x];
  }
  store_labels(best_label(label, middle_pixels(x, y, level, full_width, full_height), periods(full_width, full_height)),
               out, x, y, width);
}

// A wave of a level.
VECTOR_KERNEL void level_wave(global const uint* restrict in, global uint* restrict out, int width, int height,
                              int step, int level, int full_width, int full_height) {
  if (!has_vector(width, height)) return;
  const int x = vector_x(width), y = vector_y();
  uint_v label[VOROCL_NEIGHBOURS];
  load_neighbours(label, in, x, y, width, height, step);
  store_labels(best_label(label, middle_pixels(x, y, level, full_width, full_height), periods(full_width, full_height)),
               out, x, y, width);
}
