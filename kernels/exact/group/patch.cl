// Patches: squares of pixels that a work-group labels together.

#ifndef VOROCL_EXACT_GROUP_PATCH
#define VOROCL_EXACT_GROUP_PATCH

#include "exact/box.cl"
#include "exact/group/sizes.cl"

#define PATCH (1 << PATCH_BITS)

static inline int patches_along(int pixels) { return ((pixels - 1) >> PATCH_BITS) + 1; }

static inline Box box_of_patch(int patch, int width, int height) {
  const int across = patches_along(width), left = patch % across * PATCH, top = patch / across * PATCH;
  const Box box = {left, top, min(left + PATCH, width) - 1, min(top + PATCH, height) - 1};
  return box;
}

// The group's items are rows of a patch, one below the other: this item's column and the first of its rows.
static inline int item_column(void) { return (int)get_local_id(0) & (PATCH - 1); }
static inline int item_row(void) { return (int)get_local_id(0) >> PATCH_BITS; }
static inline int item_rows(void) { return (int)get_local_size(0) >> PATCH_BITS; }

// The pixels of a column of a patch, from a row downwards: the first one's label, and how many there are in the grid.
static inline global uint* label_in_patch(global uint* labels, Box patch, int column, int row, int width) {
  return labels + (patch.top + row) * width + patch.left + column;
}
static inline int pixels_in_patch(Box patch, int column, int row) {
  return patch.left + column <= patch.right ? patch.bottom + 1 - patch.top - row : 0;
}

// Gives a patch one label.
static inline void fill_patch(Box patch, uint value, int width, global uint* labels) {
  const int column = item_column(), row = item_row(), step = item_rows();
  const int pixels = pixels_in_patch(patch, column, row);
  global uint* label = label_in_patch(labels, patch, column, row, width);
  for (int i = 0; i < pixels; i += step, label += step * width) *label = value;
}

#endif
