// The index of places: a counting sort by bins, squares of pixels whose side is a power of two. The places of a row of
// bins stand next to each other, so that a range of bins of a row is one range of the list; the rows stand in any
// order, and so do the places of one bin.
//
// Places outside the pixels stand in the bin at the border that is nearest to them. Rounding a coordinate into a range
// keeps order, so that the bins of a rectangle hold all places of that rectangle, also where it ends outside.

#ifndef VOROCL_EXACT_INDEX
#define VOROCL_EXACT_INDEX

#include "core/plane.cl"
#include "exact/sizes.cl"

// Places are whole numbers of 2^-FRACTION_BITS pixels. With the build option VOROCL_FRACTIONS they come as such. Else
// they come as packed positions of pixels, whose centres a single bit is enough for.
#ifdef VOROCL_FRACTIONS
#define FRACTION_BITS MOST_FRACTION_BITS
typedef int2 given_t;
static inline bool is_given(given_t given) { return given.x != ABSENT; }
static inline int2 place_of(given_t given) { return given; }
#else
#define FRACTION_BITS 1
typedef uint given_t;
static inline bool is_given(given_t given) { return !(given & EMPTY_BIT); }
static inline int2 place_of(given_t given) { return (int2)(packed_x(given), packed_y(given)) * 2 + 1; }
#endif
#define ONE_PIXEL (1 << FRACTION_BITS)
#define HALF_PIXEL (ONE_PIXEL / 2)
#define NOINLINE __attribute__((noinline))

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
kernel void count_places(global const given_t* restrict places, uint count, uint chunk, int bits, int width, int height,
                         global uint* restrict tables) {
  const bins_t bins = bins_of(bits, width, height);
  const uint item = (uint)get_global_id(0);
  if (item * chunk >= count) return;
  global uint* const table = table_of(tables, item, chunk, &bins);
  for (uint i = item * chunk; i < min((item + 1) * chunk, count); ++i) {
    if (is_given(places[i])) take_one(table + bin_of(&bins, place_of(places[i])) + 1, chunk);
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
kernel void list_places(global const given_t* restrict places, global const uint* restrict ids, int has_ids, uint count,
                        uint chunk, int bits, int width, int height, global uint* restrict tables,
                        global int2* restrict list, global uint* restrict list_ids) {
  const bins_t bins = bins_of(bits, width, height);
  const uint item = (uint)get_global_id(0);
  if (item * chunk >= count) return;
  global uint* const table = table_of(tables, item, chunk, &bins);
  for (uint i = item * chunk; i < min((item + 1) * chunk, count); ++i) {
    if (!is_given(places[i])) continue;
    const int2 place = place_of(places[i]);
    const uint at = take_one(table + bin_of(&bins, place) + 1, chunk);
    list[at] = place;
    list_ids[at] = has_ids ? ids[i] : i;
  }
}

// --- seeds on one point ---
//
// None of them is nearer than another, so that lists could drop none. In bins of many places only the lowest id of a
// point stays: a table holds where a place of some hash stands. (Where it has another one of that hash, repeats stay,
// which costs time alone.)

#define MANY_IN_BIN 64
#define TABLE_BITS 11
#define NOT_SEEN 0xffffffffu

static inline uint hash_of(int2 place) {
  return ((uint)place.x * 0x9e3779b1u ^ (uint)place.y * 0x85ebca77u) >> (32 - TABLE_BITS);
}

// Moves the places of a range to the front, those that stay; returns where they end.
static inline uint move_first_of_points(global int2* list, global uint* ids, local uint* seen, uint begin, uint end,
                                        uint to) {
  for (int i = 0; i < 1 << TABLE_BITS; ++i) seen[i] = NOT_SEEN;
  for (uint at = begin; at < end; ++at) {
    const int2 place = list[at];
    const uint id = ids[at], hash = hash_of(place), first = seen[hash];
    if (first != NOT_SEEN && all(list[first] == place)) {
      ids[first] = min(ids[first], id);
      continue;
    }
    list[to] = place;
    ids[to] = id;
    seen[hash] = to++;
  }
  return to;
}

// A work-group of one item has a row of bins.
kernel void drop_repeats(global uint* restrict starts, int bits, int width, int height, global int2* restrict list,
                         global uint* restrict ids) {
  local uint seen[1 << TABLE_BITS];
  const bins_t bins = bins_of(bits, width, height);
  const int row = (int)get_global_id(0);
  if (row >= bins.rows) return;
  uint begin = starts[start_of(&bins, 0, row)], to = begin;
  for (int x = 0; x < bins.columns; ++x) {
    global uint* const next = starts + start_of(&bins, x + 1, row);
    const uint end = *next;
    if (end - begin > MANY_IN_BIN) {
      to = move_first_of_points(list, ids, seen, begin, end, to);
    } else if (to == begin) {
      to = end;
    } else {
      for (uint at = begin; at < end; ++at, ++to) list[to] = list[at], ids[to] = ids[at];
    }
    *next = to;
    begin = end;
  }
}

#endif
