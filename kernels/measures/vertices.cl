// Vertices: pixel corners where three or more cells meet.

#include "core/position.cl"

// Corner (x, y) is between the pixels x and x + 1, y and y + 1. Along a periodic axis the last pixel's neighbour is the
// first one.
static inline int corners_along(int size, int periodic) { return periodic ? size : size - 1; }

// Corners are marked by the chunk of a row: 32 vectors of them. Bit k of a chunk's word i is the corner of lane i of
// vector k, so that marking works in vectors.
#define VECTORS_OF_CHUNK 32
#define CHUNK (VECTORS_OF_CHUNK * VOROCL_WIDTH)

static inline bool is_vertex(uint a, uint b, uint c, uint d) {
  return (a != NO_LABEL) + (b != NO_LABEL && b != a) + (c != NO_LABEL && c != a && c != b) +
             (d != NO_LABEL && d != a && d != b && d != c) >=
         3;
}

// The words of the chunk of corners from `first` on, between two rows of pixels; no more than `columns` corners are in
// the row.
static inline uint_v mark_vertices(global const uint* row, global const uint* below, int first, int columns,
                                   int width) {
  const int end = min(first + CHUNK, columns), end_of_vectors = min(end, width - 1);
  uint_v words = (uint_v)0;
  int x = first, vector = 0;
  for (; x + VOROCL_WIDTH <= end_of_vectors; x += VOROCL_WIDTH, ++vector) {
    const uint_v a = LOAD_VECTOR(row + x), b = LOAD_VECTOR(row + x + 1);
    const uint_v c = LOAD_VECTOR(below + x), d = LOAD_VECTOR(below + x + 1);
    const uint_v none = (uint_v)NO_LABEL, zero = (uint_v)0, one = (uint_v)1;
    const uint_v cells = select(one, zero, a == none) + select(one, zero, b == none || b == a) +
                         select(one, zero, c == none || c == a || c == b) +
                         select(one, zero, d == none || d == a || d == b || d == c);
    words |= select(zero, (uint_v)(1u << vector), cells >= 3);
  }
  if (x == end) return words;
  uint lane[VOROCL_WIDTH];
  STORE_VECTOR(words, lane);
  for (; x < end; ++x) {
    const int right = wrapped(x + 1, width, PERIODIC_X), at = x - first;
    if (is_vertex(row[x], row[right], below[x], below[right])) lane[at % VOROCL_WIDTH] |= 1u << at / VOROCL_WIDTH;
  }
  return LOAD_VECTOR(lane);
}

// Each work-item marks the vertices of some chunks of one row of corners, and counts them. Behind the last row of
// labels comes, along a periodic y, the first one, in a tilted grid shifted.
VECTOR_KERNEL void find_vertices(global const uint* restrict labels, global const uint* restrict behind, int width,
                                 int height, int chunks_of_item, global uint* restrict words,
                                 global uint* restrict count) {
  const int columns = corners_along(width, PERIODIC_X), chunks_of_row = (columns - 1) / CHUNK + 1;
  const int across = (chunks_of_row - 1) / chunks_of_item + 1;
  const int y = (int)(get_global_id(0) / (size_t)across);
  if (y >= corners_along(height, PERIODIC_Y)) return;
  const int begin = (int)(get_global_id(0) % (size_t)across) * chunks_of_item;
  global const uint* const row = labels + y * width;
  global const uint* const below = y + 1 < height ? row + width : behind;
  uint_v found = (uint_v)0;
  for (int chunk = begin; chunk < min(begin + chunks_of_item, chunks_of_row); ++chunk) {
    const uint_v marks = mark_vertices(row, below, chunk * CHUNK, columns, width);
    STORE_VECTOR(marks, words + ((size_t)y * (size_t)chunks_of_row + (size_t)chunk) * VOROCL_WIDTH);
    found += popcount(marks);
  }
  const uint sum = lane_sum(found);
  if (sum > 0) atomic_add(count, sum);
}
