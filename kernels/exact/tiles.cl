// Exact diagrams in the vector shape: a work-item labels a region or a tile, from one list if few places are there,
// else box by box. Lists are handed down: a box's list is what a greater box's list has for it. Where no list holds
// the places, they follow each other in parts.

#ifndef VOROCL_TILE_SIDES
#define VOROCL_TILE_SIDES

#include "exact/keys.cl"

#define FEW_PLACES 16   // of which more are dropped by those nearest to the corners, too
#define MOST_OF_BOX 48  // a box of 16 pixels with more is labelled in quarters
#define FEW_FOR_LIST 40  // a tile or region of fewer is labelled from one list
#if TILE_SIDE != 4 * 16
#error "A tile is not 4 x 4 boxes of 16 pixels a side"
#endif

// A square of pixels, and how far a place can be that wins there, in pixels along an axis.
typedef struct {
  int left, top, side;
  float reach;
} box_t;

static inline box_t box_of(int left, int top, int side) {
  const box_t box = {left, top, side, INFINITY};
  return box;
}

// A box in a box, by columns and rows of such boxes.
static inline box_t box_in(box_t outer, int side, int u, int v) {
  const box_t box = {outer.left + u * side, outer.top + v * side, side, outer.reach};
  return box;
}

static inline int2 centre_of(box_t box) { return (int2)(box.left + box.side / 2, box.top + box.side / 2) * ONE_PIXEL; }
static inline span_t columns_of(box_t box) { return span_of(box.left, box.left + box.side - 1); }
static inline span_t rows_of(box_t box) { return span_of(box.top, box.top + box.side - 1); }

// --- labels, which pixels outside the region do not get ---

static inline bool is_in_grid(const scene_t* scene, box_t box) {
  return box.left < scene->width && box.top < scene->height;
}

static inline bool is_in_region(const scene_t* scene, box_t box) {
  const int4 region = scene->region;
  return box.left >= region.s0 && box.top >= region.s1 && box.left + box.side - 1 <= region.s2 &&
         box.top + box.side - 1 <= region.s3;
}

typedef struct __attribute__((packed)) {
  uint8 labels;
} labels_t;

NOINLINE static void show_some(const scene_t* scene, int x, int y, uint8 labels) {
  const int4 region = scene->region;
  uint lane[8];
  store_uints(labels, lane);
  for (int i = 0; i < 8 && x + i < scene->width && y < scene->height; ++i) {
    const bool has_label = x + i >= region.s0 && x + i <= region.s2 && y >= region.s1 && y <= region.s3;
    scene->labels[(size_t)y * (size_t)scene->width + (size_t)(x + i)] = has_label ? lane[i] : NO_LABEL;
  }
}

// Shows the labels of eight pixels, in one piece if they are known to be in the region.
static inline void show_eight(const scene_t* scene, bool is_inside, int x, int y, uint8 labels) {
  if (is_inside) {
    ((global labels_t*)(scene->labels + (size_t)y * (size_t)scene->width + (size_t)x))->labels = labels;
  } else {
    show_some(scene, x, y, labels);
  }
}

// Shows the labels of a box, whose rows are `stride` values apart.
static inline void show(const scene_t* scene, box_t box, const uint* labels, int stride) {
  const bool is_inside = is_in_region(scene, box);
  for (int y = 0; y < box.side; ++y) {
    for (int x = 0; x < box.side; x += 8) {
      show_eight(scene, is_inside, box.left + x, box.top + y, vload8(0, labels + y * stride + x));
    }
  }
}

NOINLINE static void show_one(const scene_t* scene, box_t box, uint label) {
  const bool is_inside = is_in_region(scene, box);
  for (int y = 0; y < box.side; ++y) {
    for (int x = 0; x < box.side; x += 8) show_eight(scene, is_inside, box.left + x, box.top + y, (uint8)label);
  }
}

// --- boxes with more places than keys hold: pixels of a tile have the places that won so far, in 64 bits ---

// From a point of the grid to the nearest image of a place.
static inline int2 way_to(const scene_t* scene, int2 from, uint at) {
  const int2 way = scene->list[at] - from;
  return (int2)(shorter_way(way.x, scene->width * ONE_PIXEL, PERIODIC_X),
                shorter_way(way.y, scene->height * ONE_PIXEL, PERIODIC_Y));
}

// Whether a place wins against the one that won so far.
static inline bool wins(const scene_t* scene, int2 pixel, uint at, uint so_far) {
  if (at == so_far) return false;
  const ulong distance = length_of(way_to(scene, pixel, at)), least = length_of(way_to(scene, pixel, so_far));
  return distance < least || (distance == least && comes_first(scene, at, so_far));
}

// The part of a tile's pixels that a box has.
static inline uint* of_box(uint* of_tile, box_t box) {
  return of_tile + box.top % TILE_SIDE * TILE_SIDE + box.left % TILE_SIDE;
}

static inline void start_winners(box_t box, uint* of_tile) {
  uint* const so_far = of_box(of_tile, box);
  for (int y = 0; y < box.side; ++y) {
    for (int x = 0; x < box.side; x += 8) store_uints((uint8)NO_LABEL, so_far + y * TILE_SIDE + x);
  }
}

static inline void show_winners(const scene_t* scene, box_t box, uint* of_tile) {
  uint* const so_far = of_box(of_tile, box);
  for (int y = 0; y < box.side; ++y) {
    for (int x = 0; x < box.side; ++x) so_far[y * TILE_SIDE + x] = scene->ids[so_far[y * TILE_SIDE + x]];
  }
  show(scene, box, so_far, TILE_SIDE);
}

// Lets the places of a list stand against those that won so far in a box of 8 or 16 pixels a side, in parts that keys
// hold.
NOINLINE static void compare_in_parts(const scene_t* scene, const list_t* list, int count, box_t box, uint* of_tile) {
  uint* const so_far = of_box(of_tile, box);
  uint winners[16 * 16];
  for (int from = 0, some; from < count; from += some) {
    some = min(count - from, MOST_OF_KEYS);
    while (!find_by_keys(scene, list, from, some, box.side, INFINITY, PLACES, winners)) some /= 2;
    for (int y = 0; y < box.side; ++y) {
      for (int x = 0; x < box.side; ++x) {
        const int2 pixel = (int2)(box.left + x, box.top + y) * ONE_PIXEL + HALF_PIXEL;
        const uint winner = winners[y * box.side + x];
        uint* const best = so_far + y * TILE_SIDE + x;
        if (*best == NO_LABEL || wins(scene, pixel, winner, *best)) *best = winner;
      }
    }
  }
}

// --- lists handed down: what may win in a box is in the list of a greater one ---

// Copies to `list` what may win in a box, and returns how many. If the list is a part, the box has places that won so
// far, and that of a pixel in its middle drops places, too: `of_tile` is not null.
NOINLINE static int narrow(const scene_t* scene, const list_t* from, int count, box_t outer, box_t* box, list_t* list,
                         uint* of_tile) {
  const int2 way = centre_of(*box) - centre_of(outer);
  const int number = nearest_of(from, count, way);
  int2 nearest = (int2)(from->x[number], from->y[number]) - way;
  if (of_tile) {
    const uint so_far = of_box(of_tile, *box)[box->side / 2 * (TILE_SIDE + 1)];
    if (so_far != NO_LABEL) {
      const int2 place = way_to(scene, centre_of(*box), so_far);
      if (length_of(place) < length_of(nearest)) nearest = place;
    }
  }
  box->reach = fmin(box->reach, reach_over(nearest, box->side));
  count = drop_by(from, count, list, way, rival_at(nearest, box->side));
  return count > FEW_PLACES ? drop_by_corners(list, count, box->side) : count;
}

NOINLINE static bool label_by_keys(const scene_t* scene, const list_t* list, int count, box_t box) {
  if (count == 1) {
    show_one(scene, box, scene->ids[list->at[0]]);
    return true;
  }
  uint labels[16 * 16];
  if (!find_by_keys(scene, list, 0, count, box.side, box.reach, IDS, labels)) return false;
  show(scene, box, labels, box.side);
  return true;
}

NOINLINE static void label_8_by_list(const scene_t* scene, const list_t* list, int count, box_t box) {
  if (label_by_keys(scene, list, count, box)) return;
  uint of_tile[TILE_SIDE * TILE_SIDE];
  start_winners(box, of_tile);
  compare_in_parts(scene, list, count, box, of_tile);
  show_winners(scene, box, of_tile);
}

// A box of 16 x 16 pixels with many places is labelled in quarters; their lists go to `parts`.
static inline void label_16_by_list(const scene_t* scene, const list_t* list, int count, box_t box, list_t* parts) {
  if (count <= MOST_OF_BOX && label_by_keys(scene, list, count, box)) return;
  for (int i = 0; i < 4; ++i) {
    box_t quarter = box_in(box, 8, i % 2, i / 2);
    if (!is_in_grid(scene, quarter)) continue;
    const int some = narrow(scene, list, count, box, &quarter, parts, 0);
    label_8_by_list(scene, parts, some, quarter);
  }
}

typedef struct {
  list_t a, b, c, d;
} lists_t;

// A tile, by a list that is none of c and d.
static inline void label_64_by_list(const scene_t* scene, const list_t* list, int count, box_t box, lists_t* lists) {
  if (count == 1) {
    show_one(scene, box, scene->ids[list->at[0]]);
    return;
  }
  for (int i = 0; i < 16; ++i) {
    box_t small = box_in(box, 16, i % 4, i / 4);
    if (!is_in_grid(scene, small)) continue;
    const int some = narrow(scene, list, count, box, &small, &lists->c, 0);
    label_16_by_list(scene, &lists->c, some, small, &lists->d);
  }
}

// Labels a box of which no list holds the places, part by part: `count` of them are in list b, and the walk goes on.
NOINLINE static void label_crowd(const scene_t* scene, walk_t* walk, uint2* range, box_t box, rival_t rival, int count,
                                 lists_t* lists) {
  const int side = min(box.side, 16), boxes = box.side / side;
  uint of_tile[TILE_SIDE * TILE_SIDE];
  start_winners(box, of_tile);
  for (; count > 0; count = gather(scene, walk, range, &lists->b, centre_of(box), rival)) {
    count = drop_by_corners(&lists->b, count, box.side);
    for (int i = 0; i < boxes * boxes; ++i) {
      box_t small = box_in(box, side, i % boxes, i / boxes);
      const int some = narrow(scene, &lists->b, count, box, &small, &lists->a, of_tile);
      compare_in_parts(scene, &lists->a, some, small, of_tile);
    }
  }
  show_winners(scene, box, of_tile);
}

// --- boxes, by the places around them ---

// Finds the place nearest to the centre of a box, or one that is nearly so, of the bins around it; false if there are
// none at all.
static inline bool find_near(const scene_t* scene, box_t box, span_t limits_x, span_t limits_y, list_t* list,
                             int2* place) {
  const int bits = scene->bins.bits;
  rival_t rival = no_rival();
  for (int rings = 0;; rings = 2 * rings + 1) {
    const span_t x = clamped(with_bins_around(columns_of(box), rings, bits), limits_x);
    const span_t y = clamped(with_bins_around(rows_of(box), rings, bits), limits_y);
    walk_t walk = walk_over(scene, x, y);
    uint2 range = (uint2)(0, 0);
    int count;
    do {
      count = gather(scene, &walk, &range, list, centre_of(box), rival);
      if (count == 0) break;
      const int number = nearest_of(list, count, (int2)(0, 0));
      const int2 found = (int2)(list->x[number], list->y[number]);
      if (rival.limit == INFINITY || length_of(found) < length_of(*place)) *place = found;
      rival = rival_at(*place, box.side);
    } while (is_full(count));
    if (rival.limit != INFINITY) return true;
    if (holds(x, limits_x) && holds(y, limits_y)) return false;
  }
}

// Whether a box has so few places in its bins that it is labelled from one list.
static inline bool has_few_places(const scene_t* scene, box_t box) {
  const bins_t* const bins = &scene->bins;
  const int first = column_of(bins, box.left), last = column_of(bins, box.left + box.side - 1);
  uint count = 0;
  for (int row = row_of(bins, box.top); row <= row_of(bins, box.top + box.side - 1) && count < FEW_FOR_LIST; ++row) {
    count += scene->starts[start_of(bins, last, row) + 1] - scene->starts[start_of(bins, first, row)];
  }
  return count < FEW_FOR_LIST;
}

// Labels a box of 256, 64, 16 or 8 pixels a side by the places around it; false if one of 256 or 16 has a crowd.
NOINLINE static bool label_box(const scene_t* scene, box_t box, lists_t* lists) {
  const span_t limits_x = limits_of(columns_of(box), scene->width, PERIODIC_X);
  const span_t limits_y = limits_of(rows_of(box), scene->height, PERIODIC_Y);
  int2 nearest;
  if (!find_near(scene, box, limits_x, limits_y, &lists->a, &nearest)) {
    show_one(scene, box, NO_LABEL);
    return true;
  }
  const reach_t reach = reach_of(nearest, box.side);
  box.reach = reach_over(nearest, box.side);
  const rival_t rival = rival_at(nearest, box.side);
  walk_t walk = walk_over(scene, clamped(span_of_reach(columns_of(box), reach.west, reach.east), limits_x),
                          clamped(span_of_reach(rows_of(box), reach.north, reach.south), limits_y));
  uint2 range = (uint2)(0, 0);
  int count = gather(scene, &walk, &range, &lists->b, centre_of(box), rival);
  if (is_full(count)) {
    if (box.side == 16 || box.side == REGION_SIDE) return false;
    label_crowd(scene, &walk, &range, box, rival, count, lists);
    return true;
  }
  if (count > FEW_PLACES) count = drop_by_corners(&lists->b, count, box.side);
  if (count == 1) {
    show_one(scene, box, scene->ids[lists->b.at[0]]);
  } else if (box.side == 8) {
    label_8_by_list(scene, &lists->b, count, box);
  } else if (box.side == 16) {
    label_16_by_list(scene, &lists->b, count, box, &lists->a);
  } else if (box.side == TILE_SIDE) {
    label_64_by_list(scene, &lists->b, count, box, lists);
  } else {
    for (int i = 0; i < TILES_OF_REGION * TILES_OF_REGION; ++i) {
      box_t tile = box_in(box, TILE_SIDE, i % TILES_OF_REGION, i / TILES_OF_REGION);
      if (!is_in_grid(scene, tile)) continue;
      const int some = narrow(scene, &lists->b, count, box, &tile, &lists->a, 0);
      label_64_by_list(scene, &lists->a, some, tile, lists);
    }
  }
  return true;
}

static inline void label_tile(const scene_t* scene, box_t tile, lists_t* lists) {
  if (has_few_places(scene, tile) && label_box(scene, tile, lists)) return;
  for (int i = 0; i < 16; ++i) {
    const box_t box = box_in(tile, 16, i % 4, i / 4);
    if (!is_in_grid(scene, box) || label_box(scene, box, lists)) continue;
    for (int k = 0; k < 4; ++k) {
      const box_t quarter = box_in(box, 8, k % 2, k / 2);
      if (is_in_grid(scene, quarter)) label_box(scene, quarter, lists);
    }
  }
}

// A region is labelled as a whole if it has few places and no pixel outside the grid.
static inline box_t region_of(int x, int y) {
  return box_of(x / REGION_SIDE * REGION_SIDE, y / REGION_SIDE * REGION_SIDE, REGION_SIDE);
}
static inline bool is_labelled_as_whole(const scene_t* scene, box_t region) {
  return region.left + REGION_SIDE <= scene->width && region.top + REGION_SIDE <= scene->height &&
         has_few_places(scene, region);
}

// Labels the regions of few places, or the tiles of all others: squares of so many tiles a side. (One kernel, launched
// twice, as a driver compiles all that it calls for each kernel.)
kernel void label_tiles(global const uint* restrict starts, global const int2* restrict list,
                        global const uint* restrict ids, global const int2* restrict order, int has_images, int bits,
                        int width, int height, int4 region, global uint* restrict labels, int tiles) {
  const int side = tiles * TILE_SIDE, across = (width - 1) / side + 1, item = (int)get_global_id(0);
  const box_t square = box_of(item % across * side, item / across * side, side);
  const scene_t scene = {bins_of(bits, width, height), width, height, starts, list, ids, has_images ? order : 0,
                         labels, region};
  const bool is_region = tiles == TILES_OF_REGION;
  if (square.top >= height || is_labelled_as_whole(&scene, region_of(square.left, square.top)) != is_region) return;
  lists_t lists;
  if (is_region && label_box(&scene, square, &lists)) return;
  for (int i = 0; i < tiles * tiles; ++i) {
    label_tile(&scene, box_in(square, TILE_SIDE, i % tiles, i / tiles), &lists);
  }
}

#endif
