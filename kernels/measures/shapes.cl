// The extent of each cell: its bounding box, where seed_place.cl says that its pixels lie, and the largest distance to
// the seed.

#include "measures/home.cl"

// While they are found, the last pixels of a box are inverted, so that all its numbers only fall: left, top, right,
// bottom; in a volume left, top, front, 0, right, bottom, back, 0.
#if VOROCL_DIMENSIONS == 3
typedef int8 box_t;
#define SIDES 8
#else
typedef int4 box_t;
#define SIDES 4
#endif
#define LAST_SIDES (SIDES / 2)

// Adds pixels of a row to a box that no other work-item uses; in halves, for the sake of a GPU's registers.
static inline void add_to_box(global box_t* box, int left, int right, int y, int z) {
#if VOROCL_DIMENSIONS == 3
  global int4* const sides = (global int4*)box;
  sides[0] = min(sides[0], (int4)(left, y, z, 0));
  sides[1] = min(sides[1], (int4)(~right, ~y, ~z, 0));
#else
  (void)z;
  *box = min(*box, (int4)(left, y, ~right, ~y));
#endif
}
#define NO_BOX ((box_t)INT_MAX)

// The pixels at home have a box of their own and their largest distance. The others have another box and, because a
// distance may take 64 bits, which have no atomics, their farthest pixel, packed; the distance between the centres of
// voxels takes 31, and is kept itself.
#define KEEPS_DISTANCES (VOROCL_DIMENSIONS == 3 && UNIT == 1)
kernel void clear_shapes(SEED_PARAMETERS, int4 bits, global ushort* restrict home, global box_t* restrict home_boxes,
                         global box_t* restrict other_boxes, global LENGTH* restrict distances,
                         global uint* restrict farthest) {
  (void)lattice;
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  home[id] = home_of(seeds[id], size, bits);
  home_boxes[id] = other_boxes[id] = NO_BOX;
  distances[id] = -1;
  farthest[id] = EMPTY;
}

// Whether the next pixel along an axis is there, and as far from the seed as its place says. In a tilted grid that is
// not asked: no pixel decides for another one.
static inline bool has_next(int at, int step, int size, int shown_whole, int way, int period) {
  return (shown_whole || (at + step >= 0 && at + step < size)) && goes_on(way, step, period);
}
static inline bool has_next_x(int x, int step, int way, window_t window) {
  return !is_tilted(window) && has_next(x, step, window.width, PERIODIC_X, way, window.period_x);
}
static inline bool has_next_y(int y, int step, int way, window_t window) {
  return !is_tilted(window) && has_next(y, step, window.height, PERIODIC_Y, way, window.period_y);
}
static inline bool has_next_z(int z, int step, int way, window_t window) {
  return window.depth > 1 && !is_tilted(window) && has_next(z, step, window.depth, PERIODIC_Z, way, window.period_z);
}

// Where a row and those above and below it begin among the labels. One that is not there, or where the way from the
// seed jumps, is the row itself.
typedef struct {
  uint row, above, below;
} rows_t;

static inline bool in_one_of(rows_t rows, global const uint* labels, uint x, uint label) {
  return labels[rows.row + x] == label || labels[rows.above + x] == label || labels[rows.below + x] == label;
}
static inline uint start_of_row(int y, int z, int4 size) {
  return ((uint)z * (uint)size.y + (uint)y) * (uint)size.x;
}

static inline LENGTH distance_of_farthest(uint found, seed_t seed, window_t window) {
#if KEEPS_DISTANCES
  (void)seed, (void)window;
  return (LENGTH)found;
#else
  return distance_to(seed, x_of(found), y_of(found), z_of(found), window);
#endif
}

// Puts a pixel in the place of a cell's farthest one so far, if it is farther.
static inline void add_farthest(global uint* farthest, uint pixel, LENGTH distance, seed_t seed, window_t window) {
  for (uint known = EMPTY, found;; known = found) {
    found = atomic_cmpxchg(farthest, known, pixel);
    if (found == known || distance_of_farthest(found, seed, window) >= distance) return;
  }
}

// What a row cannot decide is left to the others: a run adds to a side of its cell's box, or to the largest
// distance, only if the pixel next to its end in the rows beside it, which would add more, is not in the cell.
// That leaves a few atomics of the many that the cells' borders would need. In volumes a run always adds its distance:
// one atomic does it, and a GPU has no registers left for more questions. At home a run adds all it has: to ask would
// take longer, for a CPU does not foresee the answers.
kernel void add_shapes(global const uint* restrict labels, SEED_PARAMETERS, int4 bits,
                       global const ushort* restrict home, global box_t* restrict home_boxes,
                       global int* restrict other_boxes, global LENGTH* restrict distances,
                       global uint* restrict farthest) {
  const window_t window = window_of(size, lattice);
  block_t block;
  if (!take_block(size, bits, &block)) return;
  FOR_EACH_ROW(y, z, block) {
    rows_t rows;
    rows.row = start_of_row(y, z, size);
    walk_t walk = begin_walk(labels + rows.row, block);
    while (next_run(&walk)) {
      const uint label = run_label(&walk);
      if (label >= count) continue;
      const seed_t seed = seeds[label];
      const bool at_home = home[label] == block.index;
      for (int from = walk.from, to; from < walk.to; from = to) {
        const piece_t piece = piece_from(seed, from, walk.to, y, z, window);
        to = piece.end;
        const int first = from, last = to - 1;
        const way_t way = piece.way, way_of_last = way + (way_t)((last - first) * UNIT, 0, 0, 0);
        const int left = PERIODIC_X ? place_x(seed, way.x, size.x) : first, right = left + last - first;
        const int row_at = PERIODIC_Y ? place_y(seed, way.y, size.y) : y;
        const int slice_at = PERIODIC_Z ? place_z(seed, way.z) : z;
        const LENGTH distance = length_of(way), of_last = length_of(way_of_last);
        if (at_home) {
          add_to_box(home_boxes + label, left, right, row_at, slice_at);
          distances[label] = max(distances[label], max(distance, of_last));
          continue;
        }
        const bool above = has_next_y(y, -1, way.y, window), below = has_next_y(y, 1, way.y, window);
        rows.above = start_of_row(above ? wrapped(y - 1, size.y, PERIODIC_Y) : y, z, size);
        rows.below = start_of_row(below ? wrapped(y + 1, size.y, PERIODIC_Y) : y, z, size);
        global int* const box = other_boxes + SIDES * (size_t)label;
        if (!(has_next_x(first, -1, way.x, window) &&
              in_one_of(rows, labels, (uint)wrapped(first - 1, size.x, PERIODIC_X), label))) {
          atomic_min(box, left);
        }
        if (!(has_next_x(last, 1, way_of_last.x, window) &&
              in_one_of(rows, labels, (uint)wrapped(last + 1, size.x, PERIODIC_X), label))) {
          atomic_min(box + LAST_SIDES, ~right);
        }
        if (!(above && labels[rows.above + (uint)first] == label)) atomic_min(box + 1, row_at);
        if (!(below && labels[rows.below + (uint)first] == label)) atomic_min(box + LAST_SIDES + 1, ~row_at);
#if VOROCL_DIMENSIONS == 3
        const uint front = start_of_row(y, wrapped(z - 1, size.z, PERIODIC_Z), size);
        if (!(has_next_z(z, -1, way.z, window) && labels[front + (uint)first] == label)) atomic_min(box + 2, slice_at);
        const uint back = start_of_row(y, wrapped(z + 1, size.z, PERIODIC_Z), size);
        if (!(has_next_z(z, 1, way.z, window) && labels[back + (uint)first] == label)) {
          atomic_min(box + LAST_SIDES + 2, ~slice_at);
        }
#if KEEPS_DISTANCES
        atomic_max((global int*)(farthest + label), max(distance, of_last));
#else
        const int end = of_last > distance ? last : first;
        add_farthest(farthest + label, packed((int3)(end, y, z)), max(distance, of_last), seed, window);
#endif
#else
        const bool ends_y = way.y < 0 ? !above : !below;
        const uint away_y = way.y < 0 ? rows.above : rows.below;
        if (ends_y || labels[away_y + (uint)first] != label) {
          add_farthest(farthest + label, pack(first, y), distance, seed, window);
        }
        if (ends_y || labels[away_y + (uint)last] != label) {
          add_farthest(farthest + label, pack(last, y), of_last, seed, window);
        }
#endif
      }
    }
  }
}

// Joins what the pixels at home and the others have found: a box is left, top, front, right, bottom, back. Seeds that
// are absent own nothing, whatever labels name them. (To ask before every addition would cost a tenth.)
kernel void join_shapes(SEED_PARAMETERS, global const box_t* restrict home_boxes,
                        global const box_t* restrict other_boxes, global LENGTH* restrict distances,
                        global const uint* restrict farthest, global int* restrict boxes) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  const seed_t seed = seeds[id];
  const bool is_shown = is_there(seed);
  const box_t box = is_shown ? min(home_boxes[id], other_boxes[id]) : NO_BOX;
#if VOROCL_DIMENSIONS == 3
  const int3 first = box.s012, last = ~box.s456;
#else
  const bool empty = box.s0 == INT_MAX;
  const int3 first = (int3)(box.s01, empty ? INT_MAX : 0), last = (int3)(~box.s23, empty ? INT_MIN : 0);
#endif
  vstore3(first, 2 * (size_t)id, boxes);
  vstore3(last, 2 * (size_t)id + 1, boxes);
  const uint found = farthest[id];
  if (!is_shown) {
    distances[id] = -1;
  } else if (found != EMPTY) {
    const window_t window = window_of(size, lattice);
    distances[id] = max(distances[id], distance_of_farthest(found, seed, window));
  }
}
