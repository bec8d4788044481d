// Boxes of pixels, and storing their labels.

#ifndef VOROCL_EXACT_BOX
#define VOROCL_EXACT_BOX

#include "exact/seed_index.cl"

// Both ends are included.
typedef struct {
  int left, top, right, bottom;
} Box;

static inline Box box_of(int x, int y, int columns, int rows, int width, int height) {
  const Box box = {x, y, min(x + columns, width) - 1, min(y + rows, height) - 1};
  return box;
}

// Stores labels, as far as their pixels lie in the grid.
static inline void store_in_row(uint_v labels, global uint* image, int x, int y, int width) {
  if (x + VOROCL_WIDTH <= width) {
    STORE_WHOLE_VECTOR(labels, image + y * width + x);
    return;
  }
  uint label[VOROCL_WIDTH];
  STORE_VECTOR(labels, label);
  for (int lane = 0; x + lane < width; ++lane) image[y * width + x + lane] = label[lane];
}

static inline void fill_box(Box box, uint label, global uint* labels, int width) {
  const int whole = (box.right + 1 - box.left) / VOROCL_WIDTH * VOROCL_WIDTH, columns = box.right + 1 - box.left;
  for (int y = box.top; y <= box.bottom; ++y) {
    global uint* const row = labels + y * width + box.left;
    for (int x = 0; x < whole; x += VOROCL_WIDTH) STORE_WHOLE_VECTOR((uint_v)label, row + x);
    for (int x = whole; x < columns; ++x) row[x] = label;
  }
}

#endif
