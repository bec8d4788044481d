// The extent of each cell: its bounding box, where seed_place.cl says that its pixels lie, and the largest distance to
// the seed.

#include "measures/runs.cl"
#include "measures/seed_place.cl"

// Without 64-bit atomics a long distance is found in two passes: first the greatest upper word, then, of the distances
// that have it, the greatest lower one. A short distance has one word.
#ifdef VOROCL_FAR
#define UPPER_WORD(distance) ((int)((distance) >> 32))
#else
#define UPPER_WORD(distance) (distance)
#endif

// A box is left, top, right, bottom.
#define EMPTY_BOX ((int4)(INT_MAX, INT_MAX, INT_MIN, INT_MIN))

kernel void clear_shapes(uint count, global int4* restrict boxes, global int* restrict upper_words) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  boxes[id] = EMPTY_BOX;
  upper_words[id] = -1;
}

// Whether the next pixel along an axis is there, and as far from the seed as its place says. In a tilted grid that is
// not asked: no pixel decides for another one.
static inline bool goes_on_in(int at, int step, int size, int shown_whole, int way, int period) {
  return (shown_whole || (at + step >= 0 && at + step < size)) && goes_on(way, step, period);
}
static inline bool goes_on_x(int x, int step, int way, window_t window) {
  return !is_tilted(window) && goes_on_in(x, step, window.width, PERIODIC_X, way, window.period_x);
}
static inline bool goes_on_y(int y, int step, int way, window_t window) {
  return !is_tilted(window) && goes_on_in(y, step, window.height, PERIODIC_Y, way, window.period_y);
}

static inline bool in_one_of(global const uint* row, global const uint* above, global const uint* below, int x,
                             uint label) {
  return row[x] == label || above[x] == label || below[x] == label;
}

// What a row cannot decide is left to the others: a run adds to a side of its cell's box, or to the largest
// distance, only if the pixel next to its end in the row above or below, which would add more, is not in the cell.
// That leaves a few atomics of the many that the cells' borders would need.
kernel void add_shapes(global const uint* restrict labels, SEED_PARAMETERS, int wide, int high,
                       global int* restrict boxes, global int* restrict upper_words) {
  const window_t window = window_of(width, height, periods);
  block_t block;
  if (!take_block(width, height, wide, high, &block)) return;
  for (int y = block.top; y < block.bottom; ++y) {
    global const uint* const row = labels + y * width;
    walk_t walk = begin_walk(row, row, block.left, block.right);
    while (next_run(&walk)) {
      const uint label = run_label(&walk);
      if (label >= count) continue;
      const seed_t seed = seeds[label];
      global int* const box = boxes + 4 * (size_t)label;
      for (int from = walk.from, to; from < walk.to; from = to) {
        const piece_t piece = piece_from(seed, from, walk.to, y, window);
        const int along_x = piece.way.x, along_y = piece.way.y;
        const int row_at = PERIODIC_Y ? place_y(seed, along_y, height) : y;
        const bool above = goes_on_y(y, -1, along_y, window), below = goes_on_y(y, 1, along_y, window);
        global const uint* const row_above = labels + (above ? wrapped_y(y - 1, height) : y) * width;
        global const uint* const row_below = labels + (below ? wrapped_y(y + 1, height) : y) * width;
        to = piece.end;
        const int first = from, last = to - 1, along_x_last = along_x + (last - first) * UNIT;
        const int first_at = PERIODIC_X ? place_x(seed, along_x, width) : first;
        if (!(goes_on_x(first, -1, along_x, window) &&
              in_one_of(row, row_above, row_below, wrapped_x(first - 1, width), label))) {
          atomic_min(box, first_at);
        }
        if (!(goes_on_x(last, 1, along_x_last, window) &&
              in_one_of(row, row_above, row_below, wrapped_x(last + 1, width), label))) {
          atomic_max(box + 2, first_at + last - first);
        }
        if (!(above && row_above[first] == label)) atomic_min(box + 1, row_at);
        if (!(below && row_below[first] == label)) atomic_max(box + 3, row_at);

        const bool ends = along_y < 0 ? !above : !below;
        global const uint* const away = along_y < 0 ? row_above : row_below;
        if (ends || away[first] != label) {
          atomic_max(upper_words + label, UPPER_WORD(distance_of_ways(along_x, along_y)));
        }
        if (ends || away[last] != label) {
          atomic_max(upper_words + label, UPPER_WORD(distance_of_ways(along_x_last, along_y)));
        }
      }
    }
  }
}

// Seeds that are absent own nothing, whatever labels name them. (To ask before every addition would cost a tenth.)
kernel void clear_absent(global const seed_t* restrict seeds, uint count, global int4* restrict boxes,
                         global int* restrict upper_words) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || is_there(seeds[id])) return;
  boxes[id] = EMPTY_BOX;
  upper_words[id] = -1;
}

// The second pass over long distances.
kernel void add_lower_words(global const uint* restrict labels, SEED_PARAMETERS, int wide, int high,
                            global const int* restrict upper_words, global uint* restrict lower_words) {
  const window_t window = window_of(width, height, periods);
  block_t block;
  if (!take_block(width, height, wide, high, &block)) return;
  for (int y = block.top; y < block.bottom; ++y) {
    global const uint* const row = labels + y * width;
    walk_t walk = begin_walk(row, row, block.left, block.right);
    while (next_run(&walk)) {
      const uint label = run_label(&walk);
      if (label >= count || !is_there(seeds[label])) continue;
      for (int from = walk.from, to; from < walk.to; from = to) {
        const piece_t piece = piece_from(seeds[label], from, walk.to, y, window);
        to = piece.end;
        const LENGTH farthest = max(distance_of_ways(piece.way.x, piece.way.y),
                                    distance_of_ways(piece.way.x + (to - 1 - from) * UNIT, piece.way.y));
        if (UPPER_WORD(farthest) == upper_words[label]) atomic_max(lower_words + label, (uint)farthest);
      }
    }
  }
}
