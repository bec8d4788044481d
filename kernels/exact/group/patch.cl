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

#endif
