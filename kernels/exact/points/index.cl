// The index of points: a counting sort by bins, squares of pixels whose side is a power of two. The places of a row of
// bins stand next to each other, so that a range of bins of a row is one range of the list; the rows stand in any order,
// and so do the places of one bin.
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

// Counts the places of each bin, and numbers them there.
kernel void count_points(global const int2* restrict places, uint count, int bits, int width, int height,
                         global uint* restrict counts, global uint* restrict numbers) {
  const uint i = (uint)get_global_id(0);
  if (i >= count || places[i].x == ABSENT) return;
  const bins_t bins = bins_of(bits, width, height);
  numbers[i] = atomic_inc(counts + bin_of(&bins, places[i]));
}

// Gives each row of bins its part of the list. `starts` holds the counts, and one more value: how much is given.
kernel void start_bins(global uint* restrict starts, int bits, int width, int height) {
  const bins_t bins = bins_of(bits, width, height);
  const int row = (int)get_global_id(0);
  if (row >= bins.rows) return;
  global uint* const of_row = starts + start_of(&bins, 0, row);
  uint sum = 0;
  for (int x = 0; x < bins.columns; ++x) sum += of_row[x];
  uint at = atomic_add(starts + start_of(&bins, 0, bins.rows), sum);
  for (int x = 0; x < bins.columns; ++x) {
    const uint of_bin = of_row[x];
    of_row[x] = at;
    at += of_bin;
  }
  of_row[bins.columns] = at;
}

// Writes the list: places, and the ids of their seeds, which are the places' own numbers unless they are given.
kernel void list_points(global const int2* restrict places, global const uint* restrict ids, int has_ids, uint count,
                        int bits, int width, int height, global const uint* restrict starts,
                        global const uint* restrict numbers, global int2* restrict list,
                        global uint* restrict list_ids) {
  const uint i = (uint)get_global_id(0);
  if (i >= count || places[i].x == ABSENT) return;
  const bins_t bins = bins_of(bits, width, height);
  const uint at = starts[bin_of(&bins, places[i])] + numbers[i];
  list[at] = places[i];
  list_ids[at] = has_ids ? ids[i] : i;
}

#endif
