// One wave of flooding: every pixel takes the best of its own label and its neighbours' at a step.
//
// A wave gathers: it reads one image of packed positions and writes another, so its result does not depend on the
// order in which work-items run (the paper's Algorithm 1 scatters, so its work-items race). Rong & Tan 2006.

#include "core/position.cl"

// Of the values of a vector that starts at x, those whose pixel is in the row; `outside` in the other lanes.
static inline uint_v inside_row(int x, int width, uint_v values, uint_v outside) {
  return select(outside, values, (uint)x + LANES < (uint_v)(uint)width);
}

// The values of an image in the vector that starts at (x, y), less than a period outside the grid. A periodic axis goes
// on there with the pixels of its other end; else pixels outside have the value `none`. All tests but the last one are
// the same for the whole vector.
#define DEFINE_LOAD(name, type, load, none)                                                            \
  static inline uint_v name(global const type* image, int x, int y, int width, int height) {           \
    x = wrapped_x(x, width);                                                                           \
    y = wrapped_y(y, height);                                                                          \
    if (!PERIODIC_Y && (y < 0 || y >= height)) return none;                                            \
    if (!PERIODIC_X && (x <= -VOROCL_WIDTH || x >= width)) return none;                                \
    global const type* const row = image + VOROCL_GUARD + y * width;                                   \
    const uint_v values = load(row + x);                                                               \
    if ((PERIODIC_X || x >= 0) && x + VOROCL_WIDTH <= width) return values;                            \
    return inside_row(x, width, values, PERIODIC_X ? load(row + x - width) : (uint_v)none);            \
  }
DEFINE_LOAD(load_labels, uint, LOAD_VECTOR, EMPTY)
DEFINE_LOAD(load_marks, uchar, LOAD_BYTES, 0)

static inline void store_labels(uint_v labels, global uint* image, int x, int y, int width) {
  STORE_VECTOR(labels, image + VOROCL_GUARD + y * width + x);
}

// A pixel and its neighbours, nearest first and within each distance in row-major order. The build option
// VOROCL_NEIGHBOURS says how many take part: 5 for a von Neumann wave, 9 for a Moore wave, the pixel itself counted.
constant int neighbour_x[9] = {0, 0, -1, 1, 0, -1, 1, -1, 1};
constant int neighbour_y[9] = {0, -1, 0, 0, 1, -1, -1, 1, 1};

// A wave's step along an axis. Along a periodic one it may be longer than the period.
static inline int step_along(int step, int size, int periodic) { return periodic && step >= size ? step % size : step; }

// For each pixel of a vector the best label of VOROCL_NEIGHBOURS. First the least distance of all, then the first
// position among those that have it: that keeps the tie rule at one masked minimum per candidate.
static inline uint_v best_label(const uint_v* label, uint_v pixel, uint period) {
  uint_v distance[VOROCL_NEIGHBOURS];
  uint_v least = (uint_v)0xffffffffu;
#pragma unroll
  for (int i = 0; i < VOROCL_NEIGHBOURS; ++i) {
    distance[i] = distance_to_label_in_grid(label[i], pixel, period);
    least = min(least, distance[i]);
  }
  uint_v best = (uint_v)0xffffffffu;
#pragma unroll
  for (int i = 0; i < VOROCL_NEIGHBOURS; ++i) best = first_of_nearest(best, label[i], distance[i], least);
  return best;
}

// The labels that the vector at (x, y) may take in a wave: its own and its neighbours'.
static inline void load_neighbours(uint_v* label, global const uint* image, int x, int y, int width, int height,
                                   int step) {
  const int step_x = step_along(step, width, PERIODIC_X), step_y = step_along(step, height, PERIODIC_Y);
  if (x >= step_x && x + VOROCL_WIDTH + step_x <= width && y >= step_y && y + step_y < height) {
    // All neighbours are inside the grid: without the tests a wave of a small step takes an eighth less time.
    global const uint* const own = image + VOROCL_GUARD + y * width + x;
#pragma unroll
    for (int i = 0; i < VOROCL_NEIGHBOURS; ++i) {
      label[i] = LOAD_VECTOR(own + neighbour_y[i] * step_y * width + neighbour_x[i] * step_x);
    }
  } else {
#pragma unroll
    for (int i = 0; i < VOROCL_NEIGHBOURS; ++i) {
      label[i] = load_labels(image, x + neighbour_x[i] * step_x, y + neighbour_y[i] * step_y, width, height);
    }
  }
}

// The labels of the vector at (x, y) after a wave.
static inline uint_v nearest_label(global const uint* image, int x, int y, int width, int height, int step) {
  uint_v label[VOROCL_NEIGHBOURS];
  load_neighbours(label, image, x, y, width, height, step);
  return best_label(label, vector_positions(x, y), periods(width, height));
}
