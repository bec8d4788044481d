// The extent of each cell: its bounding box, where seed_place.cl says that its pixels lie, and the largest distance to
// the seed.

#include "measures/home.cl"

// A box is left, top, right, bottom. While they are found the latter two are inverted, so that all four only fall.
static inline int4 inverted(int4 box) { return (int4)(box.s01, ~box.s23); }
#define NO_BOX ((int4)INT_MAX)

// The pixels at home have a box of their own and their largest distance. The others have another box and, because a
// distance may take 64 bits, which have no atomics, their farthest pixel, packed.
kernel void clear_shapes(SEED_PARAMETERS, int wide, int high, global ushort* restrict home, global int4* restrict boxes,
                         global LENGTH* restrict distances, global int4* restrict other_boxes,
                         global uint* restrict farthest) {
  (void)periods;
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  home[id] = home_of(seeds[id], width, height, wide, high);
  boxes[id] = other_boxes[id] = NO_BOX;
  distances[id] = -1;
  farthest[id] = EMPTY;
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

// Puts a pixel in the place of a cell's farthest one so far, if it is farther.
static inline void add_farthest(global uint* farthest, uint pixel, LENGTH distance, seed_t seed, window_t window) {
  for (uint known = EMPTY, found;; known = found) {
    found = atomic_cmpxchg(farthest, known, pixel);
    if (found == known || distance_to(seed, packed_x(found), packed_y(found), window) >= distance) return;
  }
}

// What a row cannot decide is left to the others: a run adds to a side of its cell's box, or to the largest
// distance, only if the pixel next to its end in the row above or below, which would add more, is not in the cell.
// That leaves a few atomics of the many that the cells' borders would need. At home a run adds all it has: to ask would
// take longer, for a CPU does not foresee the answers.
kernel void add_shapes(global const uint* restrict labels, SEED_PARAMETERS, int wide, int high,
                       global const ushort* restrict home, global int4* restrict boxes,
                       global LENGTH* restrict distances, global int* restrict other_boxes,
                       global uint* restrict farthest) {
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
      const bool at_home = home[label] == block.index;
      for (int from = walk.from, to; from < walk.to; from = to) {
        const piece_t piece = piece_from(seed, from, walk.to, y, window);
        to = piece.end;
        const int first = from, last = to - 1;
        const int along_x = piece.way.x, along_x_last = along_x + (last - first) * UNIT, along_y = piece.way.y;
        const int left = PERIODIC_X ? place_x(seed, along_x, width) : first, right = left + last - first;
        const int row_at = PERIODIC_Y ? place_y(seed, along_y, height) : y;
        const LENGTH distance = distance_of_ways(along_x, along_y), of_last = distance_of_ways(along_x_last, along_y);
        if (at_home) {
          boxes[label] = min(boxes[label], inverted((int4)(left, row_at, right, row_at)));
          distances[label] = max(distances[label], max(distance, of_last));
          continue;
        }
        const bool above = goes_on_y(y, -1, along_y, window), below = goes_on_y(y, 1, along_y, window);
        global const uint* const row_above = labels + (above ? wrapped_y(y - 1, height) : y) * width;
        global const uint* const row_below = labels + (below ? wrapped_y(y + 1, height) : y) * width;
        global int* const box = other_boxes + 4 * (size_t)label;
        if (!(goes_on_x(first, -1, along_x, window) &&
              in_one_of(row, row_above, row_below, wrapped_x(first - 1, width), label))) {
          atomic_min(box, left);
        }
        if (!(goes_on_x(last, 1, along_x_last, window) &&
              in_one_of(row, row_above, row_below, wrapped_x(last + 1, width), label))) {
          atomic_min(box + 2, ~right);
        }
        if (!(above && row_above[first] == label)) atomic_min(box + 1, row_at);
        if (!(below && row_below[first] == label)) atomic_min(box + 3, ~row_at);

        const bool ends = along_y < 0 ? !above : !below;
        global const uint* const away = along_y < 0 ? row_above : row_below;
        if (ends || away[first] != label) add_farthest(farthest + label, pack(first, y), distance, seed, window);
        if (ends || away[last] != label) add_farthest(farthest + label, pack(last, y), of_last, seed, window);
      }
    }
  }
}

// Joins what the pixels at home and the others have found. Seeds that are absent own nothing, whatever labels name
// them. (To ask before every addition would cost a tenth.)
kernel void join_shapes(SEED_PARAMETERS, global int4* restrict boxes, global LENGTH* restrict distances,
                        global const int4* restrict other_boxes, global const uint* restrict farthest) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  const seed_t seed = seeds[id];
  const bool is_shown = is_there(seed);
  boxes[id] = is_shown ? inverted(min(boxes[id], other_boxes[id])) : inverted(NO_BOX);
  const uint pixel = farthest[id];
  if (!is_shown) {
    distances[id] = -1;
  } else if (pixel != EMPTY) {
    const window_t window = window_of(width, height, periods);
    distances[id] = max(distances[id], distance_to(seed, packed_x(pixel), packed_y(pixel), window));
  }
}
