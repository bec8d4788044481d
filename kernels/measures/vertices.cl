// Vertices: pixel corners where three or more cells meet.

#include "core/position.cl"

// Corner (x, y) is between the pixels x and x + 1, y and y + 1. Along a periodic axis the last pixel's neighbour is the
// first one.
static inline int corners_along(int size, int periodic) { return periodic ? size : size - 1; }

#define WORD_BITS 32

// The corners of a word, of the row between two rows of pixels: bit i is that at x = first + i. Corners from
// `end_of_vectors` on may have their right neighbour at the row's other end.
static inline uint vertices_of_word(global const uint* row, global const uint* below, int first, int end,
                                    int end_of_vectors, int width) {
  uint bits = 0;
  int x = first;
  for (; x + VOROCL_WIDTH <= min(end, end_of_vectors); x += VOROCL_WIDTH) {
    const uint_v a = LOAD_VECTOR(row + x), b = LOAD_VECTOR(row + x + 1);
    const uint_v c = LOAD_VECTOR(below + x), d = LOAD_VECTOR(below + x + 1);
    const uint_v none = (uint_v)NO_LABEL, zero = (uint_v)0, one = (uint_v)1;
    const uint_v cells = select(one, zero, a == none) + select(one, zero, b == none || b == a) +
                         select(one, zero, c == none || c == a || c == b) +
                         select(one, zero, d == none || d == a || d == b || d == c);
    if (ANY(cells >= 3)) bits |= lane_sum(select(zero, one << LANES, cells >= 3)) << (x - first);
  }
  for (; x < end; ++x) {
    const int right = wrapped_x(x + 1, width);
    const uint a = row[x], b = row[right], c = below[x], d = below[right];
    const int cells = (a != NO_LABEL) + (b != NO_LABEL && b != a) + (c != NO_LABEL && c != a && c != b) +
                      (d != NO_LABEL && d != a && d != b && d != c);
    bits |= (uint)(cells >= 3) << (x - first);
  }
  return bits;
}

// Each work-item finds those of some words of one row of corners, and counts them.
VECTOR_KERNEL void find_vertices(global const uint* restrict labels, int width, int height, int words_of_item,
                                 global uint* restrict words, global uint* restrict count) {
  const int columns = corners_along(width, PERIODIC_X), words_of_row = (columns - 1) / WORD_BITS + 1;
  const int across = (words_of_row - 1) / words_of_item + 1;
  const int y = (int)(get_global_id(0) / (size_t)across);
  if (y >= corners_along(height, PERIODIC_Y)) return;
  const int begin = (int)(get_global_id(0) % (size_t)across) * words_of_item;
  global const uint* const row = labels + y * width;
  global const uint* const below = labels + wrapped_y(y + 1, height) * width;
  uint found = 0;
  for (int word = begin; word < min(begin + words_of_item, words_of_row); ++word) {
    const int first = word * WORD_BITS;
    const uint bits =
        vertices_of_word(row, below, first, min(first + WORD_BITS, columns), min(columns, width - 1), width);
    words[(size_t)y * (size_t)words_of_row + (size_t)word] = bits;
    found += popcount(bits);
  }
  if (found > 0) atomic_add(count, found);
}
