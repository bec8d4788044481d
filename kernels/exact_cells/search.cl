// The sites that may cut a cell, from a tree of boxes. The host has put the sites in Hilbert's order; each
// eight are a leaf, and each eight boxes have one around them, up to one group of at most eight.
//
// A site cuts a cell only if it is nearer to one of the cell's vertices than the cell's own site is. This is
// asked of eight boxes, or eight sites, at once, in floats with a margin: what it lets through is decided in
// whole numbers. With weights a box counts as if all of its sites had the greatest one among them.

#ifndef VOROCL_EXACT_CELLS_SEARCH
#define VOROCL_EXACT_CELLS_SEARCH

#include "exact_cells/polygon.cl"

static inline int2 site_at(const tree_t* tree, uint site) {
  const size_t at = (size_t)(site >> FAN_BITS) * (2 * FAN) + (site & (FAN - 1));
  return (int2)(tree->sites[at], tree->sites[at + FAN]);
}

// Where a site is as seen from an image of all sites.
static inline int2 seen_from(const tree_t* tree, int2 at, int image) {
  return at - vload2((size_t)image, tree->shifts);
}

// The bisector of a site with this lag and another one that is so far away.
static inline line_t line_towards(const tree_t* tree, double lag, int2 way, uint cell, int image) {
  const long more = (long)lag_of(tree->lags, cell) - (long)lag;
  const line_t line = {square_of(way) + more, way.s0, way.s1, cell, image};
  return line;
}

// What a cell begins with: how far its lower, right, upper and left sides are.
static inline long4 first_sides(const tree_t* tree, long2 at) {
  const long x[2] = {FIRST_SIDES(tree, at, x)}, y[2] = {FIRST_SIDES(tree, at, y)};
  return (long4)(y[0], x[1], y[1], x[0]);
}

static inline line_t first_line(long4 sides, int k) {
  const long side = k == 0 ? sides.s0 : k == 1 ? sides.s1 : k == 2 ? sides.s2 : sides.s3;
  const int is_level = (k & 1) == 0, way = k == 0 || k == 3 ? -1 : 1;
  const line_t line = {way * side, is_level ? 0 : way, is_level ? way : 0, NO_CELL, k};
  return line;
}

static inline void begin_cell(cell_t* cell, const tree_t* tree, int2 at, uint site) {
  const long4 sides = first_sides(tree, convert_long2(at));
  const double4 ends = convert_double4(sides);
  cell->lag = lag_of(tree->lags, site);
  cell->is_full = false;
  end_edges(cell, 4);
  for (int k = 0; k < 4; ++k) set_line(cell, k, first_line(sides, k));
  const float4 reaches = {set_vertex(cell, 0, ends.s10), set_vertex(cell, 1, ends.s12),
                          set_vertex(cell, 2, ends.s32), set_vertex(cell, 3, ends.s30)};
  cell->reach = max(max(reaches.s0, reaches.s1), max(reaches.s2, reaches.s3));
}

// --- boxes and sites, eight at a time ---

// Behind which nothing can cut.
static inline uint end_of(const cell_t* cell) { return as_uint(4 * cell->reach); }

// The squared distances of bisectors with sites or boxes at these squared distances.
static inline float8 bisectors_of(const tree_t* tree, float8 distances, float8 leads) {
  return tree->lags != 0 ? bisectors_at(distances, leads) : distances;
}

// Cuts the cell by the sites of a leaf, the nearest first. `from` is the cell's site as the image of the tree
// sees it.
static inline void cut_by_leaf(cell_t* cell, const tree_t* tree, uint leaf, int2 from, int image) {
  const float8 x = convert_float8(vload8(2 * (size_t)leaf, tree->sites) - from.s0);
  const float8 y = convert_float8(vload8(2 * (size_t)leaf + 1, tree->sites) - from.s1);
  const float8 distances = x * x + y * y, leads = leads_of(tree->lags, leaf, cell->lag);
  const float8 more = with_margin(leads);
  int8 may_cut = 0;
  for (int k = 0; k < cell->size; ++k) {
    const float8 dx = x - cell->rough_x[k], dy = y - cell->rough_y[k];
    may_cut |= dx * dx + dy * dy < cell->reaches[k] + more;
  }
  const uint first = leaf * FAN;
  may_cut &= first_of(tree->count - first) & (distances > 0);
  uint8 order = order_of(bisectors_of(tree, distances, leads), may_cut);
  for (uint next = least_of(order); next < end_of(cell); next = least_of(order)) {
    const uint site = first + (next & (FAN - 1));
    order = without(order, next);
    cut(cell, line_towards(tree, cell->lag, site_at(tree, site) - from, site, image));
  }
}

typedef struct {
  int8 left, right, lower, upper;
} boxes_t;

static inline boxes_t boxes_of_group(const tree_t* tree, int level, uint group) {
  const size_t at = 4 * (size_t)(tree->levels[level] + group);
  const boxes_t boxes = {vload8(at, tree->boxes), vload8(at + 1, tree->boxes), vload8(at + 2, tree->boxes),
                         vload8(at + 3, tree->boxes)};
  return boxes;
}

// Which of eight boxes, of those that count, may hold sites that cut.
static inline uint8 order_of_boxes(const cell_t* cell, const tree_t* tree, boxes_t boxes, float8 leads,
                                   int8 that_count, int2 from) {
  const float8 left = convert_float8(boxes.left - from.s0), right = convert_float8(boxes.right - from.s0),
               lower = convert_float8(boxes.lower - from.s1), upper = convert_float8(boxes.upper - from.s1);
  const float8 away_x = max(max(left, -right), 0.0f), away_y = max(max(lower, -upper), 0.0f);
  const float8 distances = bisectors_of(tree, away_x * away_x + away_y * away_y, leads), more = with_margin(leads);
  const int8 is_near = (distances < 4 * cell->reach) & that_count;
  if (bits_of_ints(is_near) == 0) return FAR;
  int8 may_cut = 0;
  for (int k = 0; k < cell->size; ++k) {
    const float x = cell->rough_x[k], y = cell->rough_y[k];
    const float8 dx = max(max(left - x, x - right), 0.0f), dy = max(max(lower - y, y - upper), 0.0f);
    may_cut |= dx * dx + dy * dy < cell->reaches[k] + more;
  }
  return order_of(distances, may_cut & is_near);
}

// The boxes of a group without `own`.
static inline uint8 order_of_group(const cell_t* cell, const tree_t* tree, int level, uint group, uint own,
                                   int2 from) {
  const int8 is_other = (int8)(0, 1, 2, 3, 4, 5, 6, 7) != (int)(own - group * FAN);
  const int8 that_count = are_there(tree->count, level, group) & is_other;
  const float8 leads = leads_of(tree->box_lags, tree->levels[level] + group, cell->lag);
  return order_of_boxes(cell, tree, boxes_of_group(tree, level, group), leads, that_count, from);
}

// Cuts a cell by the sites in a group's boxes, the nearest box first, but not by those in the box `own`.
static inline void cut_by_group(cell_t* cell, const tree_t* tree, int top, uint group, uint own, int2 from,
                                int image) {
  walk_t walk;
  begin_walk(&walk, top, group, order_of_group(cell, tree, top, group, own, from));
  while (goes_on(&walk, top, end_of(cell))) {
    if (walk.level == 1) {
      cut_by_leaf(cell, tree, walk.node, from, image);
    } else {
      enter(&walk, order_of_group(cell, tree, walk.level - 1, walk.node, FAR, from));
    }
  }
}

// --- what the cells of a leaf share ---

#define MOST_NEAR 24  // of uniform points there are some 15

// The leaves whose boxes are nearer to a leaf's own than that is long. Most of its cells need to look into no
// others.
typedef struct {
  int left[MOST_NEAR], right[MOST_NEAR], lower[MOST_NEAR], upper[MOST_NEAR];
  double lags[MOST_NEAR];
  uint leaves[MOST_NEAR];
  uint count;
  float distance;  // squared, within which there are no bisectors with others; 0 if there are too many leaves
} near_t;

// Which boxes of a group are within a squared distance of a box, of which the left, right, lower and upper sides are
// given. `least` is that of bisectors of the others with sites of this lag.
static inline uint8 boxes_within(const tree_t* tree, int level, uint group, int4 box, float distance, double lag,
                               float* least) {
  const boxes_t boxes = boxes_of_group(tree, level, group);
  const float8 away_x = max(convert_float8(max(boxes.left - box.s1, box.s0 - boxes.right)), 0.0f);
  const float8 away_y = max(convert_float8(max(boxes.lower - box.s3, box.s2 - boxes.upper)), 0.0f);
  const float8 distances = away_x * away_x + away_y * away_y;
  const int8 there = are_there(tree->count, level, group), within = (distances < distance) & there;
  if (tree->lags != 0) {
    const float8 leads = leads_of(tree->box_lags, tree->levels[level] + group, lag);
    const float8 others = select((float8)INFINITY, bisectors_at(distances, leads), there & ~within);
    *least = fmin(*least, least_of_floats(others));
  }
  return order_of(0, within);
}

static inline int4 box_of_leaf(const tree_t* tree, uint leaf) {
  const size_t at = 4 * FAN * (size_t)(tree->levels[1] + (leaf >> FAN_BITS)) + (leaf & (FAN - 1));
  return (int4)(tree->boxes[at], tree->boxes[at + FAN], tree->boxes[at + 2 * FAN], tree->boxes[at + 3 * FAN]);
}

static inline void find_near(near_t* near, const tree_t* tree, uint own) {
  const int4 box = box_of_leaf(tree, own);
  const float length = convert_float(max(box.s1 - box.s0, box.s3 - box.s2)), distance = length * length;
  const double lag = most_lag(tree->lags, own, tree->count);
  near->count = 0;
  near->distance = distance;
  walk_t walk;
  begin_walk(&walk, tree->top, 0, boxes_within(tree, tree->top, 0, box, distance, lag, &near->distance));
  while (goes_on(&walk, tree->top, FAR)) {
    if (walk.level > 1) {
      enter(&walk, boxes_within(tree, walk.level - 1, walk.node, box, distance, lag, &near->distance));
      continue;
    }
    if (walk.node == own) continue;
    const uint k = near->count++;
    if (k == MOST_NEAR) {
      near->count = MOST_NEAR;
      near->distance = 0;
      return;
    }
    const int4 found = box_of_leaf(tree, walk.node);
    near->left[k] = found.s0;
    near->right[k] = found.s1;
    near->lower[k] = found.s2;
    near->upper[k] = found.s3;
    near->lags[k] = tree->lags != 0 ? tree->box_lags[(size_t)tree->levels[1] * FAN + walk.node] : 0;
    near->leaves[k] = walk.node;
  }
}

// Cuts a cell by the sites of these leaves, the nearest leaf first.
static inline void cut_by_near(cell_t* cell, const tree_t* tree, const near_t* near, int2 at) {
  uint8 orders[MOST_NEAR / FAN];
  for (uint first = 0; first < near->count; first += FAN) {
    const boxes_t boxes = {vload8(0, near->left + first), vload8(0, near->right + first),
                           vload8(0, near->lower + first), vload8(0, near->upper + first)};
    const float8 leads = convert_float8(cell->lag - vload8(0, near->lags + first));
    orders[first / FAN] = order_of_boxes(cell, tree, boxes, leads, first_of(near->count - first), at);
  }
  while (true) {
    uint next = FAR, first = 0;
    for (uint k = 0; k < near->count; k += FAN) {
      const uint least = least_of(orders[k / FAN]);
      first = least < next ? k : first;
      next = min(next, least);
    }
    if (next >= end_of(cell)) return;
    orders[first / FAN] = without(orders[first / FAN], next);
    cut_by_leaf(cell, tree, near->leaves[first + (next & (FAN - 1))], at, 0);
  }
}

// Cuts a cell by all sites, and their images across the ends of periods: first by those of its own leaf and
// of the leaves near it, then, if it reaches farther, by those that are next to its own in the tree.
static inline void cut_by_all(cell_t* cell, const tree_t* tree, const near_t* near, uint site, int2 at) {
  cut_by_leaf(cell, tree, site >> FAN_BITS, at, 0);
  cut_by_near(cell, tree, near, at);
  for (int level = 1; level <= tree->top && 4 * cell->reach > near->distance; ++level) {
    const uint own = site >> (FAN_BITS * level);
    cut_by_group(cell, tree, level, own >> FAN_BITS, own, at, 0);
  }
  for (int image = 1; image < tree->images; ++image)
    cut_by_group(cell, tree, tree->top, 0, FAR, seen_from(tree, at, image), image);
}

#endif
