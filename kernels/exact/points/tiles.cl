// Exact diagrams of points in the vector shape: a work-item labels a tile, from one list if few places are there, else
// box by box. Lists are handed down: a box's list is what a greater box's list has for it. Where no list holds the
// places, they follow each other in parts.

#ifndef VOROCL_POINTS_TILES
#define VOROCL_POINTS_TILES

#include "exact/points/keys.cl"

#define FEW_PLACES 8    // of which more are not dropped by corners
#define MOST_OF_BOX 48  // a box of 16 pixels with more is labelled in quarters
#define FEW_OF_TILE 24  // a tile of fewer is labelled from one list

// --- boxes with more places than keys hold: pixels have the places that won so far, in 64 bits ---

static inline int to_nearest_image(int way, int size, int periodic) {
  const int period = size * ONE_PIXEL;
  if (!periodic || abs(way) <= (uint)period / 2) return way;
  return way > 0 ? way - period : way + period;
}

// From a point of the grid to the nearest image of a place.
static inline int2 way_to(const scene_t* scene, int2 from, uint at) {
  const int2 way = scene->list[at] - from;
  return (int2)(to_nearest_image(way.x, scene->width, PERIODIC_X), to_nearest_image(way.y, scene->height, PERIODIC_Y));
}

// Whether a place wins against the one that won so far.
static inline bool wins(const scene_t* scene, int2 pixel, uint at, uint so_far) {
  if (at == so_far) return false;
  const ulong distance = length_of(way_to(scene, pixel, at)), least = length_of(way_to(scene, pixel, so_far));
  return distance < least || (distance == least && comes_first(scene, at, so_far));
}

// Lets the places of a list stand against those that won so far in a box of 8 or 16 pixels a side, in parts that keys
// hold.
NOINLINE static void label_in_parts(const scene_t* scene, const list_t* list, int count, int2 centre, int side,
                                    uint* so_far) {
  uint winners[16 * 16];
  for (int from = 0, some; from < count; from += some) {
    some = min(count - from, MOST_OF_KEYS);
    const bool is_first = so_far[0] == NO_LABEL;
    uint* const out = is_first ? so_far : winners;
    const int stride = is_first ? POINTS_TILE : side;
    while (!find_by_keys(scene, list, from, some, side, INFINITY, PLACES, out, stride)) some /= 2;
    if (is_first) continue;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const int2 pixel = centre + (int2)(x - side / 2, y - side / 2) * ONE_PIXEL + HALF_PIXEL;
        const uint winner = winners[y * side + x];
        if (wins(scene, pixel, winner, so_far[y * POINTS_TILE + x])) so_far[y * POINTS_TILE + x] = winner;
      }
    }
  }
}

static inline void label_all(int side, uint label, uint* labels) {
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; x += 8) vstore8((uint8)label, 0, labels + y * POINTS_TILE + x);
  }
}

static inline void show_ids(const scene_t* scene, int side, uint* labels) {
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) labels[y * POINTS_TILE + x] = scene->ids[labels[y * POINTS_TILE + x]];
  }
}

// --- lists handed down: what may win in a box is in the list of a greater one ---

// A box of pixels: where its labels are, and how far a place can be that wins, in pixels along an axis.
typedef struct {
  int2 centre;  // in units
  int side;
  uint* labels;
  float reach;
} box_t;

// A box in a box, by columns and rows of such boxes.
static inline box_t box_in(box_t outer, int side, int u, int v) {
  const int2 way = (int2)(u * side, v * side) + (side - outer.side) / 2;
  uint* const labels = outer.labels + v * side * POINTS_TILE + u * side;
  const box_t box = {outer.centre + way * ONE_PIXEL, side, labels, outer.reach};
  return box;
}

// Copies to `list` what may win in a box, and returns how many. If the list is a part, the box has places that won so
// far, and that of a pixel in its middle drops places, too.
static inline int narrow(const scene_t* scene, const list_t* from, int count, int2 centre, box_t* box, list_t* list,
                         bool is_part) {
  const int2 way = box->centre - centre;
  const int number = nearest_of(from, count, way);
  int2 nearest = (int2)(from->x[number], from->y[number]) - way;
  if (is_part) {
    const uint so_far = box->labels[box->side / 2 * (POINTS_TILE + 1)];
    if (so_far != NO_LABEL) {
      const int2 place = way_to(scene, box->centre, so_far);
      if (length_of(place) < length_of(nearest)) nearest = place;
    }
  }
  box->reach = fmin(box->reach, longest(reach_of(nearest, box->side)) + (float)box->side);
  count = drop_by(from, count, list, way, rival_at(nearest, box->side));
  return count > FEW_PLACES ? drop_by_corners(list, count, box->side) : count;
}

static inline void label_8_by_list(const scene_t* scene, const list_t* list, int count, box_t box) {
  if (find_by_keys(scene, list, 0, count, 8, box.reach, IDS, box.labels, POINTS_TILE)) return;
  label_all(8, NO_LABEL, box.labels);
  label_in_parts(scene, list, count, box.centre, 8, box.labels);
  show_ids(scene, 8, box.labels);
}

NOINLINE static void label_quarters(const scene_t* scene, const list_t* from, int count, box_t box, list_t* list) {
  for (int i = 0; i < 4; ++i) {
    box_t quarter = box_in(box, 8, i % 2, i / 2);
    const int some = narrow(scene, from, count, box.centre, &quarter, list, false);
    label_8_by_list(scene, list, some, quarter);
  }
}

// A box of 16 x 16 pixels with many places is labelled in quarters; their lists go to `list`.
static inline void label_16_by_list(const scene_t* scene, const list_t* from, int count, box_t box, list_t* list) {
  if (count <= MOST_OF_BOX && find_by_keys(scene, from, 0, count, 16, box.reach, IDS, box.labels, POINTS_TILE)) return;
  label_quarters(scene, from, count, box, list);
}
typedef struct {
  list_t a, b, c;
} lists_t;

static inline bool is_shown(const scene_t* scene, int x, int y) { return x < scene->width && y < scene->height; }

// Labels a box of which no list holds the places, part by part: `count` of them are in list b, and the walk goes on.
NOINLINE static void label_crowd(const scene_t* scene, walk_t* walk, uint2* range, box_t box, rival_t rival, int count,
                                 lists_t* lists) {
  const int side = min(box.side, 16), boxes = box.side / side;
  label_all(box.side, NO_LABEL, box.labels);
  for (; count > 0; count = gather_part(scene, walk, range, &lists->b, box.centre, rival)) {
    count = drop_by_corners(&lists->b, count, box.side);
    for (int i = 0; i < boxes * boxes; ++i) {
      box_t small = box_in(box, side, i % boxes, i / boxes);
      const int some = narrow(scene, &lists->b, count, box.centre, &small, &lists->a, true);
      label_in_parts(scene, &lists->a, some, small.centre, side, small.labels);
    }
  }
  show_ids(scene, box.side, box.labels);
}

// Labels a box of 64, 16 or 8 pixels a side by the places around it; false if one of 16 has a crowd.
static inline __attribute__((always_inline)) bool label_box(const scene_t* scene, int left, int top, int side,
                                                            lists_t* lists, uint* labels) {
  const span_t own_x = span_of(left, left + side - 1), own_y = span_of(top, top + side - 1);
  const span_t limits_x = limits_of(own_x, scene->width, PERIODIC_X);
  const span_t limits_y = limits_of(own_y, scene->height, PERIODIC_Y);
  const int2 centre = (int2)(left + side / 2, top + side / 2) * ONE_PIXEL;
  const int bits = scene->bins.bits;
  int rings = 1, count;
  int2 nearest;
  reach_t reach;
  span_t x = clamped(with_bins_around(own_x, rings, bits), limits_x);
  span_t y = clamped(with_bins_around(own_y, rings, bits), limits_y);
  while (true) {
    count = gather(scene, &lists->a, x, y, centre, &nearest);
    if (count == 0) {
      if (holds(x, limits_x) && holds(y, limits_y)) {
        label_all(side, NO_LABEL, labels);
        return true;
      }
      rings *= 2;
      x = clamped(with_bins_around(own_x, rings, bits), limits_x);
      y = clamped(with_bins_around(own_y, rings, bits), limits_y);
      continue;
    }
    reach = reach_of(nearest, side);
    const span_t needed_x = clamped(span_of_reach(own_x, reach.west, reach.east), limits_x);
    const span_t needed_y = clamped(span_of_reach(own_y, reach.north, reach.south), limits_y);
    if (holds(x, needed_x) && holds(y, needed_y)) break;
    x = joined(x, needed_x);
    y = joined(y, needed_y);
  }
  const box_t box = {centre, side, labels, longest(reach) + (float)side};
  const rival_t rival = rival_at(nearest, side);
  if (count <= MOST_IN_LIST) {
    count = drop_by(&lists->a, count, &lists->b, (int2)(0, 0), rival);
  } else if (side == 16) {
    return false;
  } else {
    walk_t walk = walk_over(scene, x, y);
    uint2 range = (uint2)(0, 0);
    count = gather_part(scene, &walk, &range, &lists->b, centre, rival);
    if (count > MOST_IN_LIST - 8) {
      label_crowd(scene, &walk, &range, box, rival, count, lists);
      return true;
    }
  }
  if (count > FEW_PLACES) count = drop_by_corners(&lists->b, count, side);
  if (side == 8) label_8_by_list(scene, &lists->b, count, box);
  if (side == 16) label_16_by_list(scene, &lists->b, count, box, &lists->a);
  for (int i = 0; side == 64 && i < 16; ++i) {
    box_t small = box_in(box, 16, i % 4, i / 4);
    if (!is_shown(scene, left + i % 4 * 16, top + i / 4 * 16)) continue;
    const int some = narrow(scene, &lists->b, count, centre, &small, &lists->a, false);
    label_16_by_list(scene, &lists->a, some, small, &lists->c);
  }
  return true;
}

NOINLINE static void label_64(const scene_t* scene, int left, int top, lists_t* lists, uint* labels) {
  label_box(scene, left, top, 64, lists, labels);
}
NOINLINE static void label_8(const scene_t* scene, int left, int top, lists_t* lists, uint* labels) {
  label_box(scene, left, top, 8, lists, labels);
}
NOINLINE static void label_16(const scene_t* scene, int left, int top, lists_t* lists, uint* labels) {
  if (label_box(scene, left, top, 16, lists, labels)) return;
  for (int i = 0; i < 4; ++i) {
    const int x = i % 2 * 8, y = i / 2 * 8;
    label_8(scene, left + x, top + y, lists, labels + y * POINTS_TILE + x);
  }
}

// The places in the bins of a tile.
static inline uint places_of_tile(const scene_t* scene, int left, int top) {
  const bins_t* const bins = &scene->bins;
  const int first = column_of(bins, left), last = column_of(bins, left + POINTS_TILE - 1);
  uint count = 0;
  for (int row = row_of(bins, top); row <= row_of(bins, top + POINTS_TILE - 1); ++row) {
    count += scene->starts[start_of(bins, last, row) + 1] - scene->starts[start_of(bins, first, row)];
  }
  return count;
}

static inline void label_tile(const scene_t* scene, int left, int top, uint* labels) {
  lists_t lists;
  if (places_of_tile(scene, left, top) < FEW_OF_TILE) {
    label_64(scene, left, top, &lists, labels);
    return;
  }
  for (int i = 0; i < 16; ++i) {
    const int x = i % 4 * 16, y = i / 4 * 16;
    if (is_shown(scene, left + x, top + y)) label_16(scene, left + x, top + y, &lists, labels + y * POINTS_TILE + x);
  }
}

// Labels all tiles. Pixels outside the region (left, top, right, bottom, both ends included) get no label.
kernel void label_tiles(global const uint* restrict starts, global const int2* restrict list,
                        global const uint* restrict ids, global const int2* restrict seeds, int has_images, int bits,
                        int width, int height, int4 region, global uint* restrict out) {
  const int across = ((width - 1) >> POINTS_TILE_BITS) + 1, item = (int)get_global_id(0);
  const int left = item % across * POINTS_TILE, top = item / across * POINTS_TILE;
  if (top >= height) return;
  uint labels[POINTS_TILE * POINTS_TILE];
  const scene_t scene = {bins_of(bits, width, height), width, height, starts, list, ids, has_images ? seeds : 0};
  label_tile(&scene, left, top, labels);
  const int end = min(POINTS_TILE, width - left), bottom = min(POINTS_TILE, height - top);
  const bool is_inside = left >= region.s0 && top >= region.s1 && left + end - 1 <= region.s2 &&
                         top + bottom - 1 <= region.s3;
  for (int y = 0; y < bottom; ++y) {
    global uint* const row = out + (size_t)(top + y) * (size_t)width + (size_t)left;
    if (is_inside && end == POINTS_TILE) {
      for (int x = 0; x < POINTS_TILE; x += 8) vstore8(vload8(0, labels + y * POINTS_TILE + x), 0, row + x);
      continue;
    }
    for (int x = 0; x < end; ++x) {
      const bool has_label = left + x >= region.s0 && left + x <= region.s2 && top + y >= region.s1 &&
                             top + y <= region.s3;
      row[x] = has_label ? labels[y * POINTS_TILE + x] : NO_LABEL;
    }
  }
}

#endif
