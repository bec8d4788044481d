// The extent of each cell where seeds lie outside the grid: see shapes.cl. Boxes are of the pixels as they lie in the
// grid.

#include "core/plane.cl"
#include "measures/runs.cl"

// Without 64-bit atomics a long distance is found in two passes: first the greatest upper word, then, of the distances
// that have it, the greatest lower one. A short distance has one word.
#ifdef VOROCL_FAR
#define UPPER_WORD(distance) ((int)((distance) >> 32))
#else
#define UPPER_WORD(distance) (distance)
#endif

static inline LENGTH farthest_of_run(int2 seed, const walk_t* walk, int y, uint2 periods) {
  LENGTH farthest = 0;
  for (int x = walk->from; x < walk->to; ++x) farthest = max(farthest, plane_distance(seed, x, y, periods));
  return farthest;
}

kernel void add_plane_shapes(global const uint* restrict labels, global const int2* restrict seeds, uint count,
                             uint2 periods, int width, int height, int wide, int high, global int* restrict boxes,
                             global int* restrict upper_words) {
  block_t block;
  if (!take_block(width, height, wide, high, &block)) return;
  for (int y = block.top; y < block.bottom; ++y) {
    global const uint* const row = labels + y * width;
    walk_t walk = begin_walk(row, row, block.left, block.right);
    while (next_run(&walk)) {
      const uint label = run_label(&walk);
      if (label >= count || seeds[label].x == ABSENT) continue;
      global int* const box = boxes + 4 * (size_t)label;
      atomic_min(box, walk.from);
      atomic_min(box + 1, y);
      atomic_max(box + 2, walk.to - 1);
      atomic_max(box + 3, y);
      atomic_max(upper_words + label, UPPER_WORD(farthest_of_run(seeds[label], &walk, y, periods)));
    }
  }
}

kernel void add_lower_words(global const uint* restrict labels, global const int2* restrict seeds, uint count,
                            uint2 periods, int width, int height, int wide, int high,
                            global const int* restrict upper_words, global uint* restrict lower_words) {
  block_t block;
  if (!take_block(width, height, wide, high, &block)) return;
  for (int y = block.top; y < block.bottom; ++y) {
    global const uint* const row = labels + y * width;
    walk_t walk = begin_walk(row, row, block.left, block.right);
    while (next_run(&walk)) {
      const uint label = run_label(&walk);
      if (label >= count || seeds[label].x == ABSENT) continue;
      const LENGTH farthest = farthest_of_run(seeds[label], &walk, y, periods);
      if (UPPER_WORD(farthest) == upper_words[label]) atomic_max(lower_words + label, (uint)farthest);
    }
  }
}
