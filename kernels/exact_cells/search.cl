// The sites that may cut a cell, from a tree of boxes. The host has put the sites in Morton's order; each eight are a
// leaf, and each eight boxes have one around them, up to one group of at most eight.
//
// A site cuts a cell only if it is nearer to one of the cell's vertices than the cell's own site is. This is asked of
// eight boxes, or eight sites, at once, in floats with a margin: what it lets through is decided in whole numbers.

#ifndef VOROCL_EXACT_CELLS_SEARCH
#define VOROCL_EXACT_CELLS_SEARCH

#include "exact_cells/polygon.cl"

#define FAN 8
#define FAN_BITS 3
#define MOST_LEVELS 10  // of boxes, for 2^30 sites
#define STACK (MOST_LEVELS * FAN)

typedef struct {
  global const int* sites;   // per leaf eight x and eight y
  global const int* boxes;   // per group eight left sides, eight right ones, eight lower and eight upper ones
  global const uint* levels; // by level: its first group. Those of level 1 are boxes around leaves.
  uint count;                // of sites
  int top;                   // the last level
} tree_t;

// A part of the tree that is still to be looked at, and its squared distance.
typedef struct {
  int level[STACK];
  uint index[STACK];
  float distance[STACK];
  int size;
} stack_t;

// The boxes or sites of a level.
static inline uint nodes_of(const tree_t* tree, int level) {
  return (tree->count + (1u << (FAN_BITS * level)) - 1) >> (FAN_BITS * level);
}

// Which of eight boxes may hold a site that cuts off a vertex. The boxes are seen from the cell's site.
static inline int8 may_cut(const polygon_t* polygon, float8 left, float8 right, float8 lower, float8 upper) {
  int8 hits = 0;
  for (int k = 0; k < polygon->used; ++k) {
    const float x = polygon->edges[k].rough_x, y = polygon->edges[k].rough_y;
    const float8 dx = max(max(left - x, x - right), 0.0f), dy = max(max(lower - y, y - upper), 0.0f);
    hits |= dx * dx + dy * dy < polygon->edges[k].reach;
  }
  return hits;
}

// Cuts the cell by the sites of a leaf, the nearest first. `from` is the cell's site as the image of the tree sees it.
static inline void cut_by_leaf(polygon_t* polygon, const tree_t* tree, uint leaf, int2 from) {
  const int8 x = vload8(2 * (size_t)leaf, tree->sites) - from.s0;
  const int8 y = vload8(2 * (size_t)leaf + 1, tree->sites) - from.s1;
  const float8 rough_x = convert_float8(x), rough_y = convert_float8(y);
  const int8 hits = may_cut(polygon, rough_x, rough_x, rough_y, rough_y);
  if (!any(hits)) return;
  int is_hit[FAN], a[FAN], b[FAN];
  float distances[FAN];
  vstore8(hits, 0, is_hit);
  vstore8(x, 0, a);
  vstore8(y, 0, b);
  vstore8(rough_x * rough_x + rough_y * rough_y, 0, distances);
  const uint first = leaf * FAN;
  const int count = (int)min(tree->count - first, (uint)FAN);
  int order[FAN], size = 0;
  for (int i = 0; i < count; ++i) {
    if (!is_hit[i] || (a[i] == 0 && b[i] == 0)) continue;
    int place = size++;
    for (; place > 0 && distances[order[place - 1]] > distances[i]; --place) order[place] = order[place - 1];
    order[place] = i;
  }
  for (int i = 0; i < size && polygon->first >= 0; ++i) {
    cut(polygon, a[order[i]], b[order[i]], first + (uint)order[i]);
  }
}

// Puts those boxes of a group on the stack that may hold sites which cut, the nearest on top. `own` is left out.
static inline void push_group(const polygon_t* polygon, const tree_t* tree, int level, uint group, uint own, int2 from,
                              stack_t* stack) {
  const size_t at = 4 * (size_t)(tree->levels[level] + group);
  const float8 left = convert_float8(vload8(at, tree->boxes) - from.s0),
               right = convert_float8(vload8(at + 1, tree->boxes) - from.s0),
               lower = convert_float8(vload8(at + 2, tree->boxes) - from.s1),
               upper = convert_float8(vload8(at + 3, tree->boxes) - from.s1);
  const float8 dx = max(max(left, -right), 0.0f), dy = max(max(lower, -upper), 0.0f);
  const float8 distance = dx * dx + dy * dy;
  if (!any(distance < 4 * polygon->reach)) return;
  const int8 hits = may_cut(polygon, left, right, lower, upper);
  if (!any(hits)) return;
  int is_hit[FAN];
  float distances[FAN];
  vstore8(hits, 0, is_hit);
  vstore8(distance, 0, distances);
  const uint first = group * FAN, count = min(nodes_of(tree, level) - first, (uint)FAN);
  const int bottom = stack->size;
  for (uint i = 0; i < count; ++i) {
    if (!is_hit[i] || first + i == own) continue;
    int place = stack->size++;
    for (; place > bottom && stack->distance[place - 1] < distances[i]; --place) {
      stack->level[place] = stack->level[place - 1];
      stack->index[place] = stack->index[place - 1];
      stack->distance[place] = stack->distance[place - 1];
    }
    stack->level[place] = level;
    stack->index[place] = first + i;
    stack->distance[place] = distances[i];
  }
}

static inline void empty_stack(polygon_t* polygon, const tree_t* tree, int2 from, stack_t* stack) {
  while (stack->size > 0 && polygon->first >= 0 && !polygon->is_full) {
    const int at = --stack->size, level = stack->level[at];
    if (stack->distance[at] >= 4 * polygon->reach) continue;
    if (level == 1) {
      cut_by_leaf(polygon, tree, stack->index[at], from);
    } else {
      push_group(polygon, tree, level - 1, stack->index[at], NO_CELL, from, stack);
    }
  }
}

// How far a coordinate is outside a stretch.
static inline float outside(long at, int from, int to) { return convert_float(max(max(from - at, at - to), 0L)); }

// Cuts a cell by the images of the sites in row j of the lattice. Along x no image can cut that is more than a period
// away: the one a period nearer is nearer to the whole cell.
static inline void cut_by_row(polygon_t* polygon, const tree_t* tree, int j, int2 at, int4 rectangle, int4 periods,
                              stack_t* stack) {
  const int y = (int)(at.s1 - (long)j * periods.s1);
  long x = at.s0;
  if (periods.s2 != 0) {
    const long shifted = (x - rectangle.s0 - (long)j * periods.s2) % periods.s0;
    x = rectangle.s0 + (shifted < 0 ? shifted + periods.s0 : shifted);
  }
  const int most_x = periods.s0 > 0;
  for (int i = -most_x; i <= most_x; ++i) {
    if (i == 0 && j == 0) continue;
    const int2 from = (int2)((int)(x - (long)i * periods.s0), y);
    push_group(polygon, tree, tree->top, 0, NO_CELL, from, stack);
    empty_stack(polygon, tree, from, stack);
  }
}

// Cuts a cell by all sites, and their images across the ends of periods: first by those that are next to its own in
// the tree. No row of images can cut that is more than a period away, but where the box is tilted.
static inline void cut_by_all(polygon_t* polygon, const tree_t* tree, uint site, int2 at, int4 rectangle,
                              int4 periods) {
  stack_t stack;
  stack.size = 0;
  cut_by_leaf(polygon, tree, site >> FAN_BITS, at);
  for (int level = 1; level <= tree->top; ++level) {
    const uint own = site >> (FAN_BITS * level);
    push_group(polygon, tree, level, own >> FAN_BITS, own, at, &stack);
    empty_stack(polygon, tree, at, &stack);
  }
  cut_by_row(polygon, tree, 0, at, rectangle, periods, &stack);
  if (periods.s1 == 0) return;
  const int most_rows = periods.s2 != 0 ? INT_MAX : 1;
  for (int side = -1; side <= 1; side += 2) {
    for (int j = 1; j <= most_rows; ++j) {
      const float away = outside(at.s1 - (long)(side * j) * periods.s1, rectangle.s1, rectangle.s3);
      if (away * away >= 4 * polygon->reach) break;
      cut_by_row(polygon, tree, side * j, at, rectangle, periods, &stack);
    }
  }
}

#endif
