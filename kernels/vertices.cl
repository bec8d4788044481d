// Vertices: pixel corners where three or more cells meet.

#include "position.cl"

// Each work-item counts a chunk of the corners below one row; corner x is between the pixels x and x + 1.
VECTOR_KERNEL void find_vertices(global const uint* restrict labels, int width, int height, uint chunk,
                                 global uint* restrict vertices) {
  const int across = (width - 2) / (int)chunk + 1;
  const int begin = (int)(get_global_id(0) % (size_t)across) * (int)chunk, y = (int)(get_global_id(0) / (size_t)across);
  if (y >= height - 1) return;
  const int end = min(begin + (int)chunk, width - 1);
  uint_v found = (uint_v)0;
  uint few = 0;
  int x = begin;
  global const uint* const row = labels + y * width;
  for (; x + VOROCL_WIDTH <= end; x += VOROCL_WIDTH) {
    const uint_v a = LOAD_VECTOR(row + x), b = LOAD_VECTOR(row + x + 1);
    const uint_v c = LOAD_VECTOR(row + width + x), d = LOAD_VECTOR(row + width + x + 1);
    const uint_v none = (uint_v)NO_LABEL, zero = (uint_v)0, one = (uint_v)1;
    const uint_v cells = select(one, zero, a == none) + select(one, zero, b == none || b == a) +
                           select(one, zero, c == none || c == a || c == b) +
                           select(one, zero, d == none || d == a || d == b || d == c);
    found += select(zero, one, cells >= 3);
  }
  for (; x < end; ++x) {
    const uint a = row[x], b = row[x + 1], c = row[width + x], d = row[width + x + 1];
    few += (uint)((a != NO_LABEL) + (b != NO_LABEL && b != a) + (c != NO_LABEL && c != a && c != b) +
                  (d != NO_LABEL && d != a && d != b && d != c) >= 3);
  }
  few += lane_sum(found);
  if (few > 0) atomic_add(vertices, few);
}
