// The program of exact diagrams of points in planes in the group shape, for devices whose work-items have
// little memory each: a work-item labels a pixel, by all places of the bins around it, in integers.

#include "exact/walk.cl"

// --- the index: a counting sort whose items take one place each ---
//
// The entry behind that of a bin counts its places, then is the next place of the bin's in the list, and in
// the end where the bin ends. Rows of bins stand in any order in the list, and so do the places of one bin.
// Of places at one point (with one lag, where there are weights) one stands for all, with the lowest id: only
// that can win.

// Finds who stands for each place in a table of 2^table_bits places by their hashes, which is NOT_SEEN at first, as
// `lowest` is: that gets the lowest id of the places that one stands for, and stays so of all others. (Ids are the
// places' own numbers unless they are given.)
static inline int4 place_and_lag(given_t given, uint id, global const int* lags) {
  const int4 place = place_of(given);
  return (int4)(place.xy, 0, IS_WEIGHTED ? lags[id] : 0);
}
kernel void find_repeats(global const given_t* restrict given, global const uint* restrict ids, int has_ids,
                         global const int* restrict lags, uint count, uint table_bits,
                         global uint* restrict table, global uint* restrict lowest) {
  const uint item = (uint)get_global_id(0);
  if (item >= count || !is_given(given[item])) return;
  const uint id = has_ids ? ids[item] : item;
  const int4 own = place_and_lag(given[item], id, lags);
  const uint hash = (uint)own.x * 0x9e3779b1u ^ (uint)own.y * 0x85ebca77u ^ (uint)own.w * 0x27d4eb2fu;
  uint at = hash * 0xc2b2ae3du >> (32 - table_bits);
  uint first = atomic_cmpxchg(table + at, NOT_SEEN, item);
  while (first != NOT_SEEN && any(place_and_lag(given[first], has_ids ? ids[first] : first, lags) != own)) {
    at = (at + 1) & ((1u << table_bits) - 1);
    first = atomic_cmpxchg(table + at, NOT_SEEN, item);
  }
  atomic_min(lowest + (first == NOT_SEEN ? item : first), id);
}

kernel void count_places(global const given_t* restrict given, global const uint* restrict lowest, uint count,
                         int4 bits, int4 size, global uint* restrict starts) {
  const bins_t bins = bins_of(bits, size);
  const uint item = (uint)get_global_id(0);
  if (item >= count || lowest[item] == NOT_SEEN) return;
  atomic_inc(starts + bin_of(&bins, place_of(given[item])) + 1);
}

// A work-group gives a row of bins its part of the list. Behind the bins stands how much is given.
kernel void start_bins(global uint* restrict starts, int4 bits, int4 size) {
  local uint starts_of_items[MOST_ITEMS_OF_ROW];  // first how many places the bins of each have
  const bins_t bins = bins_of(bits, size);
  const uint row = (uint)get_group_id(0), rows = (uint)bins.rows, columns = (uint)bins.columns;
  const uint item = (uint)get_local_id(0), items = (uint)get_local_size(0), some_bins = (columns - 1) / items + 1;
  global uint* const own = starts + row * (columns + 1);
  const uint first = min(item * some_bins, columns), last = min(first + some_bins, columns);
  uint sum = 0;
  for (uint x = first; x < last; ++x) sum += own[x + 1];
  starts_of_items[item] = sum;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (item == 0) {
    uint all = 0;
    for (uint i = 0; i < items; ++i) all += starts_of_items[i];
    uint begin = atomic_add(starts + rows * (columns + 1), all);
    own[0] = begin;
    for (uint i = 0; i < items; ++i) {
      const uint of_item = starts_of_items[i];
      starts_of_items[i] = begin;
      begin += of_item;
    }
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  uint at = starts_of_items[item];
  for (uint x = first; x < last; ++x) {
    const uint of_bin = own[x + 1];
    own[x + 1] = at;
    at += of_bin;
  }
}

kernel void list_places(global const given_t* restrict given, global const uint* restrict lowest, uint count,
                        int4 bits, int4 size, global uint* restrict starts, global int* restrict xs,
                        global int* restrict ys, global uint* restrict ids) {
  const bins_t bins = bins_of(bits, size);
  const uint item = (uint)get_global_id(0);
  if (item >= count || lowest[item] == NOT_SEEN) return;
  const int4 place = place_of(given[item]);
  const uint at = atomic_inc(starts + bin_of(&bins, place) + 1);
  xs[at] = place.x * SPACING_X, ys[at] = place.y * SPACING_Y, ids[at] = lowest[item];
}

// --- labels ---

typedef struct {
  ulong distance;  // squared if Euclidean, and the lag
  uint place;
} winner_t;

static inline ulong length_of(int x, int y) {
#if IS_MANHATTAN
  return (ulong)abs(x) + (ulong)abs(y);
#else
  return (ulong)((long)x * x) + (ulong)((long)y * y);
#endif
}

static inline winner_t nearest_in(const scene_t* scene, span_t x, span_t y, int4 centre) {
  winner_t best = {ULONG_MAX, 0};
  walk_t walk = walk_over(scene, x, y, span_of(0, 0));
  uint from, to;
  int4 origin;
  while (next_range(scene, &walk, centre, &from, &to, &origin)) {
    for (uint at = from; at < to; ++at) {
      const ulong lag = IS_WEIGHTED ? (ulong)scene->lags[scene->ids[at]] * LAG_UNIT : 0;
      const ulong distance = length_of(scene->x[at] - origin.x, scene->y[at] - origin.y) + lag;
      if (distance > best.distance) continue;
      if (distance == best.distance && !comes_first(scene, at, best.place)) continue;
      best.distance = distance;
      best.place = at;
    }
  }
  return best;
}

// How many pixels away a place may be that is no farther than so many units.
static inline float pixels_of(ulong distance) {
  return (IS_MANHATTAN ? (float)distance : sqrt((float)distance)) * ((1 + 0x1p-20f) / ONE);
}

static inline span_t joined(span_t a, span_t b) { return span_of(min(a.from, b.from), max(a.to, b.to)); }
// So many pixels more at both ends, within limits. A reach can be longer than the numbers of pixels.
static inline span_t widened(span_t span, float reach, span_t limits) {
  const int more = (int)fmin(reach, (float)(1 << 21)) + 2;
  return clamped(span_of(span.from - more, span.to + more), limits);
}

static inline uint label_of(const scene_t* scene, int column, int row) {
  const box_t own = box_at(column, row, 0, 1, 1, 1);
  const cuboid_t limits = limits_around(scene, own);
  const int4 bits = scene->bins.bits, centre = centre_of(own);
  const span_t own_x = span_of(column, column), own_y = span_of(row, row);
  span_t x = clamped(with_bins_around(own_x, 1, bits.x), limits.x);
  span_t y = clamped(with_bins_around(own_y, 1, bits.y), limits.y);
  while (true) {
    const winner_t best = nearest_in(scene, x, y, centre);
    const bool has_none = best.distance == ULONG_MAX;
    const float reach = pixels_of(best.distance);
    const span_t needed_x =
        has_none ? widened(x, (float)(x.to - x.from), limits.x) : widened(own_x, reach, limits.x);
    const span_t needed_y =
        has_none ? widened(y, (float)(y.to - y.from), limits.y) : widened(own_y, reach, limits.y);
    if (holds(x, needed_x) && holds(y, needed_y)) return has_none ? NO_LABEL : scene->ids[best.place];
    x = joined(x, needed_x);
    y = joined(y, needed_y);
  }
}

// Labels all pixels, with lags by id; those outside the region from `first` to `last` get no label.
kernel void label_pixels(global const uint* restrict starts, global const int* restrict xs,
                         global const int* restrict ys, global const uint* restrict ids,
                         global const int* restrict lags, global const int2* restrict order, int has_images,
                         int4 bits, int4 size, int4 first, int4 last, global uint* restrict out) {
  const int item = (int)get_global_id(0), column = item % size.x, row = item / size.x;
  if (row >= size.y) return;
  const scene_t scene = {bins_of(bits, size),    size,  starts, xs, ys, 0, ids, lags, 0,
                         has_images ? order : 0, first, last,   out};
  out[item] = has_label(&scene, column, row, 0) ? label_of(&scene, column, row) : NO_LABEL;
}
