// Which sites a cell of a volume is cut by: those of the leaves around its own, in the order of their
// distances, then, if it reaches farther, those of the whole tree (see lanes.cl and
// src/exact_cells/sites.hpp).

#ifndef VOROCL_EXACT_CELLS_VOLUME_SEARCH
#define VOROCL_EXACT_CELLS_VOLUME_SEARCH

#include "exact_cells/volumes/polyhedron.cl"

static inline double3 site_at(const tree_t* tree, uint site) {
  global const double* const at = tree->sites + (size_t)(site >> FAN_BITS) * (3 * FAN) + (site & (FAN - 1));
  return (double3)(at[0], at[FAN], at[2 * FAN]);
}

// How far away an image of all sites is.
static inline double3 shift_of(const tree_t* tree, int image) { return vload3((size_t)image, tree->shifts); }

static inline void begin_cell(cell_t* cell, const tree_t* tree, double3 at, uint site) {
  const double sides[6] = {FIRST_SIDES(tree, at, x), FIRST_SIDES(tree, at, y), FIRST_SIDES(tree, at, z)};
  begin_box(cell, tree->lags, site, sides);
}

// --- boxes and sites, eight at a time ---

typedef struct {
  float8 x0, x1, y0, y1, z0, z1;  // as seen from a place
  float8 leads;                   // over a lag
} boxes_t;

static inline boxes_t boxes_of_group(const tree_t* tree, int level, uint group, double3 from, double lag) {
  const size_t at = 6 * (size_t)(tree->levels[level] + group);
  const boxes_t boxes = {
      convert_float8(vload8(at, tree->boxes) - from.x),          convert_float8(vload8(at + 1, tree->boxes) - from.x),
      convert_float8(vload8(at + 2, tree->boxes) - from.y),      convert_float8(vload8(at + 3, tree->boxes) - from.y),
      convert_float8(vload8(at + 4, tree->boxes) - from.z),      convert_float8(vload8(at + 5, tree->boxes) - from.z),
      leads_of(tree->box_lags, tree->levels[level] + group, lag)};
  return boxes;
}

// The squared distances of boxes from another one.
static inline float8 distances_of(boxes_t boxes, float3 low, float3 high) {
  const float8 x = fmax(fmax(boxes.x0 - high.x, low.x - boxes.x1), 0.0f);
  const float8 y = fmax(fmax(boxes.y0 - high.y, low.y - boxes.y1), 0.0f);
  const float8 z = fmax(fmax(boxes.z0 - high.z, low.z - boxes.z1), 0.0f);
  return x * x + y * y + z * z;
}

// Which of eight boxes, as seen from the site, may hold sites that cut, the nearest first.
static inline uint8 order_of_boxes(const cell_t* cell, boxes_t boxes, float end) {
  const float8 away = distances_of(boxes, (float3)(0), (float3)(0)), more = with_margin(boxes.leads);
  const float8 distances = cell->lags != 0 ? bisectors_at(away, boxes.leads) : away;
  const int8 is_near = distances < end;
  if (bits_of_ints(is_near) == 0) return FAR;
  int8 may_cut = 0;
  for (int k = 0; k < cell->top; ++k) {
    const float3 v = 0.5f * convert_float3((double3)(cell->x[k], cell->y[k], cell->z[k]));
    may_cut |= distances_of(boxes, v, v) <= (v.x * v.x + v.y * v.y + v.z * v.z) * 1.00001f + more;
  }
  return order_of(distances, may_cut & is_near);
}

static inline uint8 order_of_group(const cell_t* cell, const tree_t* tree, int level, uint group, double3 from,
                                   float end) {
  return order_of_boxes(cell, boxes_of_group(tree, level, group, from, cell->lag), end);
}

// --- what the cells of a leaf share ---

#define MOST_NEAR 112  // of uniform points there are some 76
#define SPACINGS 2.5f  // how far they reach
#define BUCKETS 64     // of distances

// The leaves, and images of them, within a distance of a leaf's box, and their sites, as seen from the leaf's
// first one.
typedef struct {
  float x[MOST_NEAR * FAN], y[MOST_NEAR * FAN], z[MOST_NEAR * FAN];
  double exact_x[MOST_NEAR * FAN], exact_y[MOST_NEAR * FAN], exact_z[MOST_NEAR * FAN];
  uint leaves[MOST_NEAR];
  ushort images[MOST_NEAR];
  double3 base;      // the leaf's first site
  float3 low, high;  // its box
  double lag;        // the greatest of the leaf's sites
  int count;         // of leaves
  float distance;    // 0: there are too many
  float least;       // of the squared distances of bisectors with sites that are not listed
} __attribute__((aligned(64))) near_t;

static inline void add_leaf(near_t* near, const tree_t* tree, uint leaf, int image, double3 from) {
  const int k = near->count++;
  const size_t at = 3 * (size_t)leaf;
  const double8 x = vload8(at, tree->sites) - from.x, y = vload8(at + 1, tree->sites) - from.y,
                z = vload8(at + 2, tree->sites) - from.z;
  near->leaves[k] = leaf;
  near->images[k] = (ushort)image;
  vstore8(x, (size_t)k, near->exact_x);
  vstore8(y, (size_t)k, near->exact_y);
  vstore8(z, (size_t)k, near->exact_z);
  vstore8(convert_float8(x), (size_t)k, near->x);
  vstore8(convert_float8(y), (size_t)k, near->y);
  vstore8(convert_float8(z), (size_t)k, near->z);
}

// Which boxes of a group are as near as is listed. The others are not.
static inline uint8 boxes_near(near_t* near, const tree_t* tree, int level, uint group, double3 from) {
  const boxes_t boxes = boxes_of_group(tree, level, group, from, near->lag);
  const float8 distances = distances_of(boxes, near->low, near->high);
  const int8 is_near = distances <= near->distance * near->distance;
  if (tree->lags != 0) {
    const float8 others = select(bisectors_at(distances, boxes.leads), (float8)INFINITY, is_near);
    near->least = fmin(near->least, least_of_floats(others));
  }
  return order_of(0, is_near);
}

// False if there are too many.
static inline bool list_near(near_t* near, const tree_t* tree, float distance) {
  near->count = 0;
  near->distance = distance;
  near->least = INFINITY;
  for (int image = 0; image < tree->images; ++image) {
    const double3 from = near->base - shift_of(tree, image);
    walk_t walk;
    begin_walk(&walk, tree->top, 0, boxes_near(near, tree, tree->top, 0, from));
    while (goes_on(&walk, tree->top, FAR)) {
      if (walk.level > 1) {
        enter(&walk, boxes_near(near, tree, walk.level - 1, walk.node, from));
      } else if (near->count < MOST_NEAR) {
        add_leaf(near, tree, walk.node, image, from);
      } else {
        return false;
      }
    }
  }
  return true;
}

static inline void find_near(near_t* near, const tree_t* tree, uint leaf) {
  near->base = site_at(tree, leaf * FAN);
  near->lag = most_lag(tree->lags, leaf, tree->count);
  const uint first = leaf & ~(uint)(FAN - 1);
  float3 low = INFINITY, high = -INFINITY;  // of the 64 sites around: they say how dense sites are here
  const uint leaves = min((tree->count + FAN - 1) / FAN - first, (uint)FAN);
  global const double* const boxes = tree->boxes + 6 * FAN * (size_t)(tree->levels[1] + (leaf >> FAN_BITS));
  for (uint k = 0; k < leaves; ++k) {
    const float3 of_low = convert_float3((double3)(boxes[k], boxes[k + 2 * FAN], boxes[k + 4 * FAN]) - near->base);
    const float3 of_high =
        convert_float3((double3)(boxes[k + FAN], boxes[k + 3 * FAN], boxes[k + 5 * FAN]) - near->base);
    if (first + k == leaf) near->low = of_low;
    if (first + k == leaf) near->high = of_high;
    low = fmin(low, of_low);
    high = fmax(high, of_high);
  }
  const float3 extent = high - low, size = near->high - near->low;
  const float spacing = cbrt(extent.x) * cbrt(extent.y) * cbrt(extent.z) / cbrt(convert_float(leaves * FAN));
  float distance = SPACINGS * fmax(spacing, 0.15f * (size.x + size.y + size.z));
  for (int tries = 0; tries < 6; ++tries, distance *= 0.75f) {
    if (list_near(near, tree, distance)) return;
  }
  near->count = 0;
  near->distance = near->least = 0;
}

// Cuts a cell by one of the sites of the list.
static inline bool cut_by_listed(cell_t* cell, const near_t* near, int k, double3 from, uint site) {
  const uint other = near->leaves[k >> FAN_BITS] * FAN + (uint)(k & (FAN - 1));
  const int image = near->images[k >> FAN_BITS];
  if (other == site && image == 0) return false;
  return cut(cell, (double3)(near->exact_x[k], near->exact_y[k], near->exact_z[k]) - from, other, image);
}

// The squared distances of the bisectors with eight sites of the list, from site k on.
static inline float8 bisectors_of_listed(const cell_t* cell, const near_t* near, int k, float3 from) {
  const float8 x = vload8(0, near->x + k) - from.x, y = vload8(0, near->y + k) - from.y,
               z = vload8(0, near->z + k) - from.z;
  const float8 distances = x * x + y * y + z * z;
  if (cell->lags == 0) return distances;
  return bisectors_at(distances, leads_of(cell->lags, near->leaves[k >> FAN_BITS], cell->lag));
}

// Cuts a cell by the sites of the list: by those nearer than is covered about in the order of their
// distances, then, if it reaches farther, by the others. Returns behind which squared distance nothing can
// cut.
static inline float cut_by_near(cell_t* cell, const near_t* near, double3 at, uint site, float covered) {
  const double3 exact_from = at - near->base;
  const float3 from = convert_float3(exact_from);
  const float scale = BUCKETS / (covered * covered);
  int buckets[MOST_NEAR * FAN];  // the last one, BUCKETS, has what is not covered
  ushort list[MOST_NEAR * FAN], order[MOST_NEAR * FAN], ends[BUCKETS];
  for (int b = 0; b < BUCKETS; ++b) ends[b] = 0;
  const int sites = near->count * FAN;
  for (int k = 0; k < sites; k += 8) {
    const float8 d = bisectors_of_listed(cell, near, k, from) * scale;
    vstore8(convert_int8(fmin(d, (float8)(BUCKETS))), 0, buckets + k);
  }
  int found = 0;
  for (int k = 0; k < sites; ++k) {
    list[found] = (ushort)k;
    found += buckets[k] < BUCKETS;
  }
  for (int i = 0; i < found; ++i) ++ends[buckets[list[i]]];
  ushort sum = 0;
  for (int b = 0; b < BUCKETS; ++b) {
    const ushort many = ends[b];
    ends[b] = sum;
    sum = (ushort)(sum + many);
  }
  for (int i = 0; i < found; ++i) order[ends[buckets[list[i]]]++] = list[i];
  float end = INFINITY;
  for (int i = 0, since = 0; i < found && convert_float(buckets[order[i]]) <= end * scale; ++i) {
    since += cut_by_listed(cell, near, order[i], exact_from, site);
    if (since < 3 && (i & 15) != 15) continue;
    end = end_of(cell);
    since = 0;
  }
  end = end_of(cell);
  if (end < covered * covered) return end;
  for (int k = 0; k < sites; k += 8) {
    const int8 may_cut = (bisectors_of_listed(cell, near, k, from) < end) & (vload8(0, buckets + k) == BUCKETS);
    for (int left = bits_of_ints(may_cut); left != 0; left &= left - 1) {
      if (cut_by_listed(cell, near, k + lowest_bit(left), exact_from, site)) end = end_of(cell);
    }
  }
  return end;
}

// --- farther away ---

static inline bool is_listed(const near_t* near, uint leaf, int image) {
  for (int k = 0; k < near->count; ++k) {
    if (near->leaves[k] == leaf && near->images[k] == image) return true;
  }
  return false;
}

// Cuts a cell by the sites of a leaf, the nearest first.
static inline float cut_by_leaf(cell_t* cell, const tree_t* tree, uint leaf, double3 from, uint site, int image,
                                float end) {
  const size_t at = 3 * (size_t)leaf;
  const float8 x = convert_float8(vload8(at, tree->sites) - from.x),
               y = convert_float8(vload8(at + 1, tree->sites) - from.y),
               z = convert_float8(vload8(at + 2, tree->sites) - from.z);
  const boxes_t points = {x, x, y, y, z, z, leads_of(tree->lags, leaf, cell->lag)};
  uint8 order = order_of_boxes(cell, points, end);
  for (uint next = least_of(order); next < as_uint(end); next = least_of(order)) {
    order = without(order, next);
    const uint other = leaf * FAN + (next & (FAN - 1));
    if (other >= tree->count || (other == site && image == 0)) continue;
    if (cut(cell, site_at(tree, other) - from, other, image)) end = end_of(cell);
  }
  return end;
}

// Cuts a cell by all sites that are not in the list, the nearest box first.
static inline void cut_by_tree(cell_t* cell, const tree_t* tree, const near_t* near, double3 at, uint site, float end) {
  for (int image = 0; image < tree->images; ++image) {
    const double3 from = at - shift_of(tree, image);
    walk_t walk;
    begin_walk(&walk, tree->top, 0, order_of_group(cell, tree, tree->top, 0, from, end));
    while (goes_on(&walk, tree->top, as_uint(end))) {
      if (walk.level > 1) {
        enter(&walk, order_of_group(cell, tree, walk.level - 1, walk.node, from, end));
      } else if (!is_listed(near, walk.node, image)) {
        end = cut_by_leaf(cell, tree, walk.node, from, site, image, end);
      }
    }
  }
}

static inline void cut_by_all(cell_t* cell, const tree_t* tree, const near_t* near, uint site) {
  const double3 at = site_at(tree, site);
  begin_cell(cell, tree, at, site);
  const float3 from = convert_float3(at - near->base);
  const float3 inside = fmin(from - near->low, near->high - from);  // how deep in the leaf's box
  const float covered = 0.9999f * (near->distance + fmax(fmin(fmin(inside.x, inside.y), inside.z), 0.0f));
  const float end = near->count > 0 ? cut_by_near(cell, near, at, site, covered) : end_of(cell);
  if (end >= (tree->lags != 0 ? near->least : covered * covered)) cut_by_tree(cell, tree, near, at, site, end);
}

#endif
