// The leaves around a leaf, with their boxes.

#if !defined(VOROCL_EXACT_CELLS_NEAR) && DIMENSIONS != 3  // which has volumes/near.cl
#define VOROCL_EXACT_CELLS_NEAR

#include "exact_cells/boxes.cl"

static inline void add_leaf(near_t* near, const tree_t* tree, uint leaf, int2 from) {
  const size_t group = tree->levels[1] + (leaf >> FAN_BITS);
  global const int* const at = tree->boxes + 4 * FAN * group + (leaf & (FAN - 1));
  const int k = near->count;
  near->left[k] = at[0] - from.x;
  near->right[k] = at[FAN] - from.x;
  near->lower[k] = at[2 * FAN] - from.y;
  near->upper[k] = at[3 * FAN] - from.y;
  near->lags[k] = tree->lags != 0 ? tree->box_lags[FAN * (size_t)tree->levels[1] + leaf] : 0;
}

// Finds the leaf's box. The list reaches as far as that is long.
static inline float find_extent(near_t* near, const tree_t* tree, uint leaf) {
  find_box(tree, leaf, near->base, &near->low, &near->high);
  const float2 size = near->high - near->low;
  return fmax(size.x, size.y);
}

// Cuts a cell by the sites of these leaves, the nearest leaf first.
static inline float cut_by_near(cell_t* cell, const tree_t* tree, const near_t* near, int2 at, uint site) {
  const int2 from = at - near->base;
  uint8 orders[MOST_NEAR / FAN];
  float end = end_of(cell);
  for (int first = 0; first < near->count; first += FAN) {
    const boxes_t boxes = {convert_float8(vload8(0, near->left + first) - from.x),
                           convert_float8(vload8(0, near->right + first) - from.x),
                           convert_float8(vload8(0, near->lower + first) - from.y),
                           convert_float8(vload8(0, near->upper + first) - from.y),
                           convert_float8(cell->lag - vload8(0, near->lags + first))};
    orders[first / FAN] = order_of_boxes(cell, boxes, first_of((uint)(near->count - first)), end, NEAREST);
  }
  while (true) {
    uint next = FAR;
    int first = 0;
    for (int k = 0; k < near->count; k += FAN) {
      const uint least = least_of(orders[k / FAN]);
      first = least < next ? k : first;
      next = min(next, least);
    }
    if (next >= as_uint(end)) return end;
    orders[first / FAN] = without(orders[first / FAN], next);
    const int k = first + (int)(next & (FAN - 1)), image = near->images[k];
    cut_by_leaf(cell, tree, near->leaves[k], at - shift_of(tree, image), site, image, &end, NEAREST);
  }
}

#endif
