// Patches: squares of pixels that a work-group labels together.

#ifndef VOROCL_EXACT_GROUP_PATCH
#define VOROCL_EXACT_GROUP_PATCH

#include "exact/group/seed_index.cl"

#define PATCH (1 << PATCH_BITS)

// Pixels of the frame. Both ends are included.
typedef struct {
  int left, top, right, bottom;
} Box;

// Where a pixel's label is.
static inline global uint* label_at(const SeedIndex* index, global uint* labels, int x, int y) {
  return labels + (y - index->y0) * index->width + x - index->x0;
}

static inline int patches_along(int pixels) { return ((pixels - 1) >> PATCH_BITS) + 1; }

static inline Box box_of_patch(const SeedIndex* index, int patch) {
  const int across = patches_along(index->width);
  const int left = index->x0 + patch % across * PATCH, top = index->y0 + patch / across * PATCH;
  const Box box = {left, top, min(left + PATCH, index->x0 + index->width) - 1,
                   min(top + PATCH, index->y0 + index->height) - 1};
  return box;
}

// The group's items are rows of a patch, one below the other: this item's column and the first of its rows.
static inline int item_column(void) { return (int)get_local_id(0) & (PATCH - 1); }
static inline int item_row(void) { return (int)get_local_id(0) >> PATCH_BITS; }
static inline int item_rows(void) { return (int)get_local_size(0) >> PATCH_BITS; }

// The pixels of a column of a patch, from a row downwards: the first one's label, and how many there are in the grid.
static inline global uint* label_in_patch(const SeedIndex* index, global uint* labels, Box patch, int column,
                                          int row) {
  return label_at(index, labels, patch.left + column, patch.top + row);
}
static inline int pixels_in_patch(Box patch, int column, int row) {
  return patch.left + column <= patch.right ? patch.bottom + 1 - patch.top - row : 0;
}

// Gives a patch one label.
static inline void fill_patch(const SeedIndex* index, Box patch, uint value, global uint* labels) {
  const int column = item_column(), row = item_row(), step = item_rows();
  const int pixels = pixels_in_patch(patch, column, row);
  global uint* label = label_in_patch(index, labels, patch, column, row);
  for (int i = 0; i < pixels; i += step, label += step * index->width) *label = value;
}

#endif
