// Which sites a cell is cut by: those of the leaves, and of images of them, around its own, which the cells of a leaf
// share if they are not too many; then, if it reaches farther, those of the whole tree of boxes. The host has put the
// sites in Hilbert's order (src/exact_cells/sites.hpp); each eight are a leaf, and each eight boxes have one around
// them, up to one group of at most eight.

#ifndef VOROCL_EXACT_CELLS_SEARCH
#define VOROCL_EXACT_CELLS_SEARCH

#include "exact_cells/near.cl"

// Which boxes of a group are as near as is listed. The others are not.
static inline uint8 boxes_near(near_t* near, const tree_t* tree, int level, uint group, place_t from) {
  const boxes_t boxes = boxes_of_group(tree, level, group, from, near->lag);
  const float8 distances = distances_of(boxes, near->low, near->high);
  const int8 there = are_there(tree->count, level, group), is_near = distances <= near->distance * near->distance;
  if (tree->lags != 0) {
    const float8 others = select((float8)INFINITY, bisectors_at(distances, boxes.leads), there & ~is_near);
    near->least = fmin(near->least, least_of_floats(others));
  }
  return order_of(0, there & is_near);
}

// False if there are too many.
static inline bool list_near(near_t* near, const tree_t* tree, float distance) {
  near->count = 0;
  near->distance = distance;
  near->least = INFINITY;
  for (int image = 0; image < tree->images; ++image) {
    const place_t from = near->base - shift_of(tree, image);
    walk_t walk;
    begin_walk(&walk, tree->top, 0, boxes_near(near, tree, tree->top, 0, from));
    while (goes_on(&walk, tree->top, FAR)) {
      if (walk.level > 1) {
        enter(&walk, boxes_near(near, tree, walk.level - 1, walk.node, from));
      } else if (near->count < MOST_NEAR) {
        near->leaves[near->count] = walk.node;
        near->images[near->count] = (ushort)image;
        add_leaf(near, tree, walk.node, from);
        ++near->count;
      } else {
        return false;
      }
    }
  }
  return true;
}

// Tries ever shorter distances. Without a list where even the shortest is too long.
static inline void list_nearest(near_t* near, const tree_t* tree, float distance, int most_tries, float shorter) {
  for (int tries = 0; tries < most_tries; ++tries, distance *= shorter) {
    if (list_near(near, tree, distance)) return;
  }
  near->count = 0;
  near->distance = near->least = 0;
}

// Around a leaf, for all of its sites. Floats are right to 10^-7 of its length: the shortest distance is a fifth of it.
static inline void find_near(near_t* near, const tree_t* tree, uint leaf) {
  near->base = site_at(tree, leaf * FAN);
  near->lag = most_lag(tree->lags, leaf, tree->count);
  list_nearest(near, tree, find_extent(near, tree, leaf), 6, 0.75f);
  near->is_shared = near->count > 0;
}

// Around one of its sites, where there are too many around the leaf: it may be long, and most of it empty. All is as
// seen from the site, for distances may be tiny beside the leaf.
static inline void find_near_site(near_t* near, const tree_t* tree, uint site) {
  near->base = site_at(tree, site);
  near->lag = lag_of(tree->lags, site);
  const float extent = find_extent(near, tree, site >> FAN_BITS);
  near->low = near->high = 0;
  list_nearest(near, tree, extent / 2, 16, 0.5f);
}

// --- farther away ---

static inline bool is_listed(const near_t* near, uint leaf, int image) {
  for (int k = 0; k < near->count; ++k) {
    if (near->leaves[k] == leaf && near->images[k] == image) return true;
  }
  return false;
}

// Cuts a cell by all sites that are not in the list. In planes the deepest cuts come first, and the walk begins anew
// behind each leaf that cuts, until one does not. Beside a curve of many sites a cell is long and thin: each of the
// nearest sites would cut a little off its far end. (A cell without a list is still the whole rectangle, and
// would be cut by thousands of sites far away before those around it.)
static inline void cut_by_tree(cell_t* cell, const tree_t* tree, const near_t* near, place_t at, uint site, float end) {
  const first_t first = DIMENSIONS == 2 && near->count > 0 ? DEEPEST : NEAREST;
  for (int image = 0; image < tree->images; ++image) {
    const place_t from = at - shift_of(tree, image);
    bool again = first == DEEPEST;
    walk_t walk;
    begin_walk(&walk, tree->top, 0, order_of_group(cell, tree, tree->top, 0, from, end, first));
    while (goes_on(&walk, tree->top, end_of_order(end, first))) {
      if (walk.level > 1) {
        enter(&walk, order_of_group(cell, tree, walk.level - 1, walk.node, from, end, first));
      } else if (!is_listed(near, walk.node, image)) {
        again &= cut_by_leaf(cell, tree, walk.node, from, site, image, &end, first);
        if (again) begin_walk(&walk, tree->top, 0, order_of_group(cell, tree, tree->top, 0, from, end, first));
      }
    }
  }
}

static inline void cut_by_all(cell_t* cell, const tree_t* tree, near_t* near, uint site) {
  if (!near->is_shared) find_near_site(near, tree, site);
  const place_t at = site_at(tree, site);
  begin_cell(cell, tree, at, site);
  const float end = near->count > 0 ? cut_by_near(cell, tree, near, at, site) : end_of(cell);
  const float covered = covered_by(near, at);
  if (end >= (tree->lags != 0 ? near->least : covered * covered)) cut_by_tree(cell, tree, near, at, site, end);
}

#endif
