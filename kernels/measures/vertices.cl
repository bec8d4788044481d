// Vertices: pixel corners where three or more cells meet.

#include "core/position.cl"

// Corner (x, y) is between the pixels x and x + 1, y and y + 1. Along a periodic axis the last pixel's neighbour is the
// first one.
static inline int corners_along(int size, int periodic) { return periodic ? size : size - 1; }

// Each work-item counts a chunk of the corners below one row.
VECTOR_KERNEL void find_vertices(global const uint* restrict labels, int width, int height, uint chunk,
                                 global uint* restrict vertices) {
  const int columns = corners_along(width, PERIODIC_X), across = (columns - 1) / (int)chunk + 1;
  const int begin = (int)(get_global_id(0) % (size_t)across) * (int)chunk, y = (int)(get_global_id(0) / (size_t)across);
  if (y >= corners_along(height, PERIODIC_Y)) return;
  const int end = min(begin + (int)chunk, columns), end_of_vectors = min(end, width - 1);
  uint_v found = (uint_v)0;
  uint few = 0;
  int x = begin;
  global const uint* const row = labels + y * width;
  global const uint* const below = labels + wrapped_y(y + 1, height) * width;
  for (; x + VOROCL_WIDTH <= end_of_vectors; x += VOROCL_WIDTH) {
    const uint_v a = LOAD_VECTOR(row + x), b = LOAD_VECTOR(row + x + 1);
    const uint_v c = LOAD_VECTOR(below + x), d = LOAD_VECTOR(below + x + 1);
    const uint_v none = (uint_v)NO_LABEL, zero = (uint_v)0, one = (uint_v)1;
    const uint_v cells = select(one, zero, a == none) + select(one, zero, b == none || b == a) +
                           select(one, zero, c == none || c == a || c == b) +
                           select(one, zero, d == none || d == a || d == b || d == c);
    found += select(zero, one, cells >= 3);
  }
  for (; x < end; ++x) {
    const int right = wrapped_x(x + 1, width);
    const uint a = row[x], b = row[right], c = below[x], d = below[right];
    few += (uint)((a != NO_LABEL) + (b != NO_LABEL && b != a) + (c != NO_LABEL && c != a && c != b) +
                  (d != NO_LABEL && d != a && d != b && d != c) >= 3);
  }
  few += lane_sum(found);
  if (few > 0) atomic_add(vertices, few);
}
