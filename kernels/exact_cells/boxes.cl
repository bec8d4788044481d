// Sites, and boxes of the tree, eight at a time, and what the cells of a leaf share.
//
// A site cuts a cell only if it is nearer to one of the cell's vertices than the cell's own site is. This is asked of
// eight boxes, or eight sites, at once, in floats with a margin: what it lets through is decided in whole numbers. With
// weights a box counts as if all of its sites had the greatest one among them.

#ifndef VOROCL_EXACT_CELLS_BOXES
#define VOROCL_EXACT_CELLS_BOXES

#include "exact_cells/polygon.cl"

static inline place_t site_at(const tree_t* tree, uint site) {
  global const NUMBER* const at = tree->sites + (size_t)(site >> FAN_BITS) * (DIMENSIONS * FAN) + (site & (FAN - 1));
  return place_from(at, FAN);
}

// How far away an image of all sites is.
static inline place_t shift_of(const tree_t* tree, int image) {
  return place_from(tree->shifts + (size_t)image * DIMENSIONS, 1);
}

// --- boxes and sites, eight at a time ---

typedef struct {
  float8 x0, x1, y0, y1;  // as seen from a place
#if DIMENSIONS == 3
  float8 z0, z1;
#endif
  float8 leads;  // over a lag
} boxes_t;

// So many numbers for each axis lie behind each other, eight of each: the lower ends, and the upper ones last.
static inline boxes_t boxes_from(global const NUMBER* numbers, size_t group, size_t of_axis, place_t from,
                                 float8 leads) {
  const size_t first = group * DIMENSIONS * of_axis, last = first + of_axis - 1;
  boxes_t boxes;
  boxes.x0 = convert_float8(vload8(first, numbers) - from.x);
  boxes.x1 = convert_float8(vload8(last, numbers) - from.x);
  boxes.y0 = convert_float8(vload8(first + of_axis, numbers) - from.y);
  boxes.y1 = convert_float8(vload8(last + of_axis, numbers) - from.y);
#if DIMENSIONS == 3
  boxes.z0 = convert_float8(vload8(first + 2 * of_axis, numbers) - from.z);
  boxes.z1 = convert_float8(vload8(last + 2 * of_axis, numbers) - from.z);
#endif
  boxes.leads = leads;
  return boxes;
}

static inline boxes_t boxes_of_group(const tree_t* tree, int level, uint group, place_t from, double lag) {
  const size_t at = tree->levels[level] + group;
  return boxes_from(tree->boxes, at, 2, from, leads_of(tree->box_lags, at, lag));
}

// The squared distances of boxes from another one.
static inline float8 distances_of(boxes_t boxes, rough_t low, rough_t high) {
  const float8 x = fmax(fmax(boxes.x0 - high.x, low.x - boxes.x1), 0.0f);
  const float8 y = fmax(fmax(boxes.y0 - high.y, low.y - boxes.y1), 0.0f);
#if DIMENSIONS == 3
  const float8 z = fmax(fmax(boxes.z0 - high.z, low.z - boxes.z1), 0.0f);
  return x * x + y * y + z * z;
#else
  return x * x + y * y;
#endif
}

// Which boxes or sites come first: those that are nearest to the cell's site, up to the `end` behind which none cuts;
// or those that may cut deepest, which are far nearer to a vertex of the cell than its site is.
typedef enum { NEAREST, DEEPEST } first_t;

// Which of eight boxes, of those that count, may hold sites that cut, in order.
static inline uint8 order_of_boxes(const cell_t* cell, boxes_t boxes, int8 that_count, float end, first_t first) {
  const float8 away = distances_of(boxes, (rough_t)(0), (rough_t)(0)), more = with_margin(boxes.leads);
  const float8 distances = cell->lags != 0 ? bisectors_at(away, boxes.leads) : away;
  const int8 is_near = (distances < end) & that_count;
  if (bits_of_ints(is_near) == 0) return FAR;
  int8 may_cut = 0;
  float8 ratios = INFINITY;
  for (int k = 0; k < vertices_of(cell); ++k) {
    float reach;
    const rough_t v = vertex_of(cell, k, &reach);
    const float8 from_vertex = distances_of(boxes, v, v);
    may_cut |= from_vertex <= reach + more;
    if (first == DEEPEST) ratios = fmin(ratios, (from_vertex - more) / reach);
  }
  return order_of(first == DEEPEST ? fmax(ratios, 0.0f) : distances, may_cut & is_near);
}

static inline uint8 order_of_group(const cell_t* cell, const tree_t* tree, int level, uint group, place_t from,
                                   float end, first_t first) {
  return order_of_boxes(cell, boxes_of_group(tree, level, group, from, cell->lag), are_there(tree->count, level, group),
                        end, first);
}

// Where such an order ends.
static inline uint end_of_order(float end, first_t first) { return first == DEEPEST ? FAR : as_uint(end); }

// Cuts a cell by the sites of a leaf, in that order. `from` is the cell's site as the image sees it. Returns whether
// anything has been cut off.
static inline bool cut_by_leaf(cell_t* cell, const tree_t* tree, uint leaf, place_t from, uint site, int image,
                               float* end, first_t first) {
  bool is_cut = false;
  const boxes_t points = boxes_from(tree->sites, leaf, 1, from, leads_of(tree->lags, leaf, cell->lag));
  uint8 order = order_of_boxes(cell, points, first_of(tree->count - leaf * FAN), *end, first);
  for (uint next = least_of(order); next < end_of_order(*end, first); next = least_of(order)) {
    order = without(order, next);
    const uint other = leaf * FAN + (next & (FAN - 1));
    if (other == site && image == 0) continue;
    if (!cut(cell, site_at(tree, other) - from, other, image)) continue;
    *end = end_of(cell);
    is_cut = true;
  }
  return is_cut;
}

// --- what the cells of a leaf share ---

// The leaves, and images of them, within a distance of a leaf's box, or of one of its sites.
typedef struct {
  NEAR_LISTS
  uint leaves[MOST_NEAR];
  ushort images[MOST_NEAR];
  place_t base;       // the leaf's first site, or the one
  rough_t low, high;  // the leaf's box, as seen from there, or the site's place
  double lag;         // the greatest of the leaf's sites, or that of the one
  int count;          // of leaves
  float distance;     // 0: there are too many
  bool is_shared;     // by all of the leaf's sites
  float least;        // of the squared distances of bisectors with sites that are not listed
} __attribute__((aligned(64))) near_t;

// How far all sites around one of the leaf's sites are listed: it may lie deep in the leaf's box. 0 where none are.
static inline float covered_by(const near_t* near, place_t at) {
  if (near->count == 0) return 0;
  const rough_t from = rough_of(at - near->base), inside = fmin(from - near->low, near->high - from);
#if DIMENSIONS == 3
  const float deep = fmin(fmin(inside.x, inside.y), inside.z);
#else
  const float deep = fmin(inside.x, inside.y);
#endif
  return 0.9999f * (near->distance + fmax(deep, 0.0f));
}

// The box of a leaf, as seen from a place.
static inline void find_box(const tree_t* tree, uint leaf, place_t from, rough_t* low, rough_t* high) {
  const size_t group = tree->levels[1] + (leaf >> FAN_BITS);
  global const NUMBER* const at = tree->boxes + 2 * DIMENSIONS * FAN * group + (leaf & (FAN - 1));
  *low = rough_of(place_from(at, 2 * FAN) - from);
  *high = rough_of(place_from(at + FAN, 2 * FAN) - from);
}

#endif
