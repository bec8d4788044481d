// Boxes of pixels, and storing their labels.

#ifndef VOROCL_EXACT_BOX
#define VOROCL_EXACT_BOX

#include "exact/seed_index.cl"

// Both ends are included.
typedef struct {
  int left, top, right, bottom;
} Box;

// Pixels of the frame, as far as they are in the grid, in the coordinates of the index.
static inline Box box_of(const SeedIndex* index, int x, int y, int columns, int rows) {
  const int left = x + index->x0 - margin_x(index->width), top = y + index->y0 - margin_y(index->height);
  const Box box = {max(left, index->x0), max(top, index->y0), min(left + columns, index->x0 + index->width) - 1,
                   min(top + rows, index->y0 + index->height) - 1};
  return box;
}

// Where a pixel's label is.
static inline global uint* label_at(const SeedIndex* index, global uint* labels, int x, int y) {
  return labels + (y - index->y0) * index->width + x - index->x0;
}

// Stores labels, as far as their pixels lie in the grid.
static inline void store_in_row(const SeedIndex* index, uint_v labels, global uint* image, int x, int y) {
  global uint* const first = label_at(index, image, x, y);
  const int count = index->x0 + index->width - x;
  if (count >= VOROCL_WIDTH) {
    STORE_WHOLE_VECTOR(labels, first);
    return;
  }
  uint label[VOROCL_WIDTH];
  STORE_VECTOR(labels, label);
  for (int lane = 0; lane < count; ++lane) first[lane] = label[lane];
}

static inline void fill_box(const SeedIndex* index, Box box, uint label, global uint* labels) {
  const int whole = (box.right + 1 - box.left) / VOROCL_WIDTH * VOROCL_WIDTH, columns = box.right + 1 - box.left;
  const int width = index->width;
  global uint* row = label_at(index, labels, box.left, box.top);
  for (int y = box.top; y <= box.bottom; ++y, row += width) {
    for (int x = 0; x < whole; x += VOROCL_WIDTH) STORE_WHOLE_VECTOR((uint_v)label, row + x);
    for (int x = whole; x < columns; ++x) row[x] = label;
  }
}

#endif
