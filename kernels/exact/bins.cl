// Bins: boxes of 2^bits pixels along each axis, in which the index has its places. Bins of a row stand next
// to each other, so a run of them is one range of the list. A row has an entry of `starts` for each of its
// bins and one for its end.
//
// Places outside a window's pixels stand in the bin at the border that is nearest to them. Rounding a
// coordinate into a range keeps order, so that the bins of a box hold all places of that box, also where it
// ends outside.

#ifndef VOROCL_EXACT_BINS
#define VOROCL_EXACT_BINS

#include "exact/place.cl"

typedef struct {
  int4 bits;
  int columns, rows, slices;
} bins_t;

static inline bins_t bins_of(int4 bits, int4 size) {
  const bins_t bins = {bits, ((size.x - 1) >> bits.x) + 1, ((size.y - 1) >> bits.y) + 1,
                       ((size.z - 1) >> bits.z) + 1};
  return bins;
}
static inline uint row_of(const bins_t* bins, int4 place) {
  const int row = clamp(place.y >> (FRACTION_BITS + bins->bits.y), 0, bins->rows - 1);
  return (uint)((IS_VOLUME ? (place.z >> (FRACTION_BITS + bins->bits.z)) * bins->rows : 0) + row);
}
static inline uint bin_of(const bins_t* bins, int4 place) {
  const int column = clamp(place.x >> (FRACTION_BITS + bins->bits.x), 0, bins->columns - 1);
  return row_of(bins, place) * (uint)(bins->columns + 1) + (uint)column;
}

// The lists of the index, by place.
typedef struct {
  global int *x, *y, *z;
  global uint* ids;
  global int* lags;  // if there are weights
} places_of_bins_t;

// `lags`: by id.
static inline void put(const places_of_bins_t* p, uint at, int4 place, uint id, global const int* lags) {
  p->x[at] = place.x * SPACING_X, p->y[at] = place.y * SPACING_Y, p->ids[at] = id;
  if (IS_VOLUME) p->z[at] = place.z * SPACING_Z;
  if (IS_WEIGHTED) p->lags[at] = lags[id];
}
static inline void move_place(const places_of_bins_t* p, uint at, uint to) {
  p->x[to] = p->x[at], p->y[to] = p->y[at], p->ids[to] = p->ids[at];
  if (IS_VOLUME) p->z[to] = p->z[at];
  if (IS_WEIGHTED) p->lags[to] = p->lags[at];
}

// --- blocks of places ---
//
// Of each block of PLACES_OF_BLOCK places of the index the bounds are known on CPUs where bins have many places, with a
// margin for floats: a walk leaves out the blocks that its balls miss.

#define BOUNDS_OF_BLOCK (2 * AXES_OF_PLACES + IS_WEIGHTED)
#define FIRST_BOUND(block) \
  ((size_t)((block) / BLOCKS_AT_ONCE) * (BLOCKS_AT_ONCE * BOUNDS_OF_BLOCK) + (size_t)((block) % BLOCKS_AT_ONCE))
#define UNITS_OF_BOUNDS (1.f / ONE)
static inline float2 bounds_of(global const int* along, int count) {  // along an axis, of some places
  const extent_t extent = extent_in_index(along, count);
  const float2 ends = (float2)((float)extent.first, (float)extent.last) * UNITS_OF_BOUNDS;
  return ends + fabs(ends) * (float2)(-0x1p-22f, 0x1p-22f);
}

// --- seeds at one place ---
//
// Only that of the lowest id can win (of the least lag, where there are weights), and lists could drop none
// of the others. In bins of many places only that one stays: a table holds where a place of some hash stands.
// (Where it has another one of that hash, repeats stay, which costs time alone.)

#ifndef MANY_OF_BIN
#define MANY_OF_BIN 16
#endif
#define TABLE_BITS 11
#define NOT_SEEN 0xffffffffu

// Whether of two seeds at one place the first one wins.
static inline bool is_better(const places_of_bins_t* p, uint at, uint than) {
  if (IS_WEIGHTED && p->lags[at] != p->lags[than]) return p->lags[at] < p->lags[than];
  return p->ids[at] < p->ids[than];
}
static inline bool is_at(const places_of_bins_t* p, uint at, int x, int y, int z) {
  if (IS_VOLUME && p->z[at] != z) return false;
  return p->x[at] == x && p->y[at] == y;
}

// Moves the places of a range to the front, those that stay; returns where they end.
static inline uint move_first_of_places(const places_of_bins_t* p, local uint* seen, uint begin, uint end,
                                        uint to) {
  const uint bits = min(33 - clz(end - begin), (uint)TABLE_BITS);
  for (int i = 0; i < 1 << bits; ++i) seen[i] = NOT_SEEN;
  for (uint at = begin; at < end; ++at) {
    const int x = p->x[at], y = p->y[at], z = IS_VOLUME ? p->z[at] : 0;
    const uint hash = ((uint)x * 0x9e3779b1u ^ (uint)y * 0x85ebca77u ^ (uint)z * 0xc2b2ae3du) >> (32 - bits);
    const uint first = seen[hash];
    if (first != NOT_SEEN && is_at(p, first, x, y, z)) {
      if (is_better(p, at, first)) move_place(p, at, first);
      continue;
    }
    move_place(p, at, to);
    seen[hash] = to++;
  }
  return to;
}

// Drops repeats of a row of bins.
static inline void drop_repeats_of_row(const places_of_bins_t* p, global uint* starts, int columns,
                                       local uint* seen) {
  uint begin = starts[0], to = begin;
  for (int i = 1; i <= columns; ++i) {
    const uint end = starts[i];
    if (end - begin > MANY_OF_BIN) {
      to = move_first_of_places(p, seen, begin, end, to);
    } else if (to == begin) {
      to = end;
    } else {
      for (uint at = begin; at < end; ++at, ++to) move_place(p, at, to);
    }
    starts[i] = to;
    begin = end;
  }
}

#endif
