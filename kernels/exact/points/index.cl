// The index of points: a counting sort by bins, squares of pixels whose side is a power of two. The places of a row of
// bins stand next to each other, so that a range of bins of a row is one range of the list; the rows stand in any
// order, and so do the places of one bin.
//
// Places outside the pixels stand in the bin at the border that is nearest to them. Rounding a coordinate into a range
// keeps order, so that the bins of a rectangle hold all places of that rectangle, also where it ends outside.

#ifndef VOROCL_POINTS_INDEX
#define VOROCL_POINTS_INDEX

#include "core/plane.cl"
#include "exact/points/sizes.cl"

#define ONE_PIXEL (1 << FRACTION_BITS)
#define HALF_PIXEL (ONE_PIXEL / 2)

// Bins have 2^bits pixels along a side. `starts` has one value more for each row of bins: its end.
typedef struct {
  int bits, columns, rows;
} bins_t;

static inline bins_t bins_of(int bits, int width, int height) {
  const bins_t bins = {bits, ((width - 1) >> bits) + 1, ((height - 1) >> bits) + 1};
  return bins;
}

static inline int column_of(const bins_t* bins, int x) { return clamp(x >> bins->bits, 0, bins->columns - 1); }
static inline int row_of(const bins_t* bins, int y) { return clamp(y >> bins->bits, 0, bins->rows - 1); }

static inline uint start_of(const bins_t* bins, int column, int row) {
  return (uint)(row * (bins->columns + 1) + column);
}

static inline uint bin_of(const bins_t* bins, int2 place) {
  return start_of(bins, column_of(bins, place.x >> FRACTION_BITS), row_of(bins, place.y >> FRACTION_BITS));
}

// --- making it ---
//
// Items count the places of their chunks by bins, each in a table of its own, so that they need no atomics, which take
// a CPU as long as all else. Where many items take one place each they share a table. The value behind that of a bin
// is the next place of the bin's in the list, and in the end where the bin ends, which is where the next one begins.

static inline uint take_one(global uint* next, uint chunk) { return chunk == 1 ? atomic_inc(next) : (*next)++; }

static inline global uint* table_of(global uint* tables, uint item, uint chunk, const bins_t* bins) {
  return tables + (chunk == 1 ? 0 : item * start_of(bins, 0, bins->rows));
}

// Counts the places of each bin.
kernel void count_points(global const int2* restrict places, uint count, uint chunk, int bits, int width, int height,
                         global uint* restrict tables) {
  const bins_t bins = bins_of(bits, width, height);
  const uint item = (uint)get_global_id(0);
  if (item * chunk >= count) return;
  global uint* const table = table_of(tables, item, chunk, &bins);
  for (uint i = item * chunk; i < min((item + 1) * chunk, count); ++i) {
    if (places[i].x != ABSENT) take_one(table + bin_of(&bins, places[i]) + 1, chunk);
  }
}

// Gives each row of bins its part of the list, and each table its part of a bin's, that of the first one last: it has
// the ends of bins when all is listed. Behind the tables stands how much is given.
kernel void start_bins(global uint* restrict tables, uint count, int bits, int width, int height) {
  const bins_t bins = bins_of(bits, width, height);
  const int row = (int)get_global_id(0);
  if (row >= bins.rows) return;
  const uint size = start_of(&bins, 0, bins.rows), first = start_of(&bins, 0, row);
  uint sum = 0;
  for (uint t = 0; t < count; ++t) {
    for (uint x = 1; x <= (uint)bins.columns; ++x) sum += tables[t * size + first + x];
  }
  uint at = atomic_add(tables + count * size, sum);
  tables[first] = at;
  for (uint x = 1; x <= (uint)bins.columns; ++x) {
    for (uint t = count; t-- > 0;) {
      global uint* const next = tables + t * size + first + x;
      const uint some = *next;
      *next = at;
      at += some;
    }
  }
}

// Writes the list: places, and the ids of their seeds, which are the places' own numbers unless they are given.
kernel void list_points(global const int2* restrict places, global const uint* restrict ids, int has_ids, uint count,
                        uint chunk, int bits, int width, int height, global uint* restrict tables,
                        global int2* restrict list, global uint* restrict list_ids) {
  const bins_t bins = bins_of(bits, width, height);
  const uint item = (uint)get_global_id(0);
  if (item * chunk >= count) return;
  global uint* const table = table_of(tables, item, chunk, &bins);
  for (uint i = item * chunk; i < min((item + 1) * chunk, count); ++i) {
    const int2 place = places[i];
    if (place.x == ABSENT) continue;
    const uint at = take_one(table + bin_of(&bins, place) + 1, chunk);
    list[at] = place;
    list_ids[at] = has_ids ? ids[i] : i;
  }
}

// --- seeds on one point ---
//
// None of them is nearer than another, so that lists could drop none. In bins of many places all but the lowest id are
// moved so far away that they are never nearest.

#define MANY_IN_BIN 64
#define NOWHERE (0x7fffffff - (1 << 28))
#if NOWHERE + (1 << (SIDE_BITS + FRACTION_BITS)) > 0x7fffffff
#error "The way from a pixel to what is nowhere does not fit in an int"
#endif
#if NOWHERE - (1 << (SIDE_BITS + FRACTION_BITS)) <= ((1 << AWAY_BITS) + (1 << SIDE_BITS)) << FRACTION_BITS
#error "A place that is taken may be farther than what is nowhere"
#endif

static inline bool stands_before(int2 a, uint id_of_a, int2 b, uint id_of_b) {
  if (a.y != b.y) return a.y < b.y;
  if (a.x != b.x) return a.x < b.x;
  return id_of_a < id_of_b;
}

// Lets the element of a heap that is being made sink to its place.
static inline void sink(global int2* list, global uint* ids, uint root, uint count) {
  const int2 place = list[root];
  const uint id = ids[root];
  for (uint child = 2 * root + 1; child < count; child = 2 * root + 1) {
    if (child + 1 < count && stands_before(list[child], ids[child], list[child + 1], ids[child + 1])) ++child;
    if (!stands_before(place, id, list[child], ids[child])) break;
    list[root] = list[child];
    ids[root] = ids[child];
    root = child;
  }
  list[root] = place;
  ids[root] = id;
}

static void sort_bin(global int2* list, global uint* ids, uint count) {
  for (uint root = count / 2; root-- > 0;) sink(list, ids, root, count);
  for (uint last = count - 1; last > 0; --last) {
    const int2 place = list[0];
    const uint id = ids[0];
    list[0] = list[last];
    ids[0] = ids[last];
    list[last] = place;
    ids[last] = id;
    sink(list, ids, 0, last);
  }
}

kernel void drop_repeats(global const uint* restrict starts, int bits, int width, int height,
                         global int2* restrict list, global uint* restrict ids) {
  const bins_t bins = bins_of(bits, width, height);
  const int row = (int)get_global_id(0);
  if (row >= bins.rows) return;
  for (int x = 0; x < bins.columns; ++x) {
    const uint begin = starts[start_of(&bins, x, row)], count = starts[start_of(&bins, x + 1, row)] - begin;
    if (count <= MANY_IN_BIN) continue;
    sort_bin(list + begin, ids + begin, count);
    int2 last = list[begin];
    for (uint i = begin + 1; i < begin + count; ++i) {
      const int2 place = list[i];
      if (all(place == last)) list[i] = (int2)(NOWHERE, NOWHERE);
      last = place;
    }
  }
}

#endif
