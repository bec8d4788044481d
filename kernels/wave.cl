// One wave of flooding: every pixel takes the best of its own label and its neighbours' at a step.
//
// A wave gathers: it reads one image of packed positions and writes another, so its result does not depend on the
// order in which work-items run (the paper's Algorithm 1 scatters, so its work-items race). Rong & Tan 2006.

#include "position.cl"

// Of the values of a vector that starts at x, those whose pixel is in the row; `outside` in the other lanes.
static inline uint_v inside_row(int x, int width, uint_v values, uint_v outside) {
  return select(outside, values, (uint)x + LANES < (uint_v)(uint)width);
}

// The labels of a vector that starts at (x, y); pixels outside the grid are empty. All tests but the last one are
// the same for the whole vector.
static inline uint_v load_labels(global const uint* image, int x, int y, int width, int height) {
  if (y < 0 || y >= height || x <= -VOROCL_WIDTH || x >= width) return EMPTY;
  uint_v labels = LOAD_VECTOR(image + VOROCL_GUARD + y * width + x);
  if (x < 0 || x + VOROCL_WIDTH > width) return inside_row(x, width, labels, (uint_v)EMPTY);
  return labels;
}

static inline void store_labels(uint_v labels, global uint* image, int x, int y, int width) {
  STORE_VECTOR(labels, image + VOROCL_GUARD + y * width + x);
}

// A pixel and its neighbours, nearest first and within each distance in row-major order. The build option
// VOROCL_NEIGHBOURS says how many take part: 5 for a von Neumann wave, 9 for a Moore wave, the pixel itself counted.
constant int neighbour_x[9] = {0, 0, -1, 1, 0, -1, 1, -1, 1};
constant int neighbour_y[9] = {0, -1, 0, 0, 1, -1, -1, 1, 1};

// The labels of the vector at (x, y) after a wave. First the least distance of all candidates, then the first position
// among those that have it: that keeps the tie rule at one masked minimum per candidate.
static inline uint_v nearest_label(global const uint* image, int x, int y, int width, int height, int step) {
  uint_v label[VOROCL_NEIGHBOURS], distance[VOROCL_NEIGHBOURS];
  if (x >= step && x + VOROCL_WIDTH + step <= width && y >= step && y + step < height) {
    // All neighbours are inside the grid: without the tests a wave of a small step takes an eighth less time.
    global const uint* const own = image + VOROCL_GUARD + y * width + x;
#pragma unroll
    for (int i = 0; i < VOROCL_NEIGHBOURS; ++i) {
      label[i] = LOAD_VECTOR(own + (neighbour_y[i] * width + neighbour_x[i]) * step);
    }
  } else {
#pragma unroll
    for (int i = 0; i < VOROCL_NEIGHBOURS; ++i) {
      label[i] = load_labels(image, x + neighbour_x[i] * step, y + neighbour_y[i] * step, width, height);
    }
  }
  const uint_v pixel = vector_positions(x, y);
  uint_v least = (uint_v)0xffffffffu;
#pragma unroll
  for (int i = 0; i < VOROCL_NEIGHBOURS; ++i) {
    distance[i] = distance_to_label(label[i], pixel);
    least = min(least, distance[i]);
  }
  uint_v best = (uint_v)0xffffffffu;
#pragma unroll
  for (int i = 0; i < VOROCL_NEIGHBOURS; ++i) best = first_of_nearest(best, label[i], distance[i], least);
  return best;
}
