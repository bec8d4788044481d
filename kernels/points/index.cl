// The index of places: a counting sort by bins, boxes of 2^bits voxels along each axis that hold about PLACES_OF_BIN.
// Bins of a row stand next to each other, so a run of them is one range of the list. A row has an entry of `starts` for
// each of its bins and one for its end.
//
// Places are sorted into buckets of rows chunk by chunk, and then bucket by bucket, without atomics.

#ifndef VOROCL_POINTS_INDEX
#define VOROCL_POINTS_INDEX

#include "points/place.cl"

typedef struct {
  int4 bits;
  int columns, rows, slices;
} bins_t;

static inline bins_t bins_of(int4 bits, int4 size) {
  const bins_t bins = {bits, ((size.x - 1) >> bits.x) + 1, ((size.y - 1) >> bits.y) + 1, ((size.z - 1) >> bits.z) + 1};
  return bins;
}
static inline uint row_of(const bins_t* bins, int4 place) {
  return (uint)((place.z >> (FRACTION_BITS + bins->bits.z)) * bins->rows + (place.y >> (FRACTION_BITS + bins->bits.y)));
}
static inline uint bin_of(const bins_t* bins, int4 place) {
  return row_of(bins, place) * (uint)(bins->columns + 1) + (uint)(place.x >> (FRACTION_BITS + bins->bits.x));
}

static inline uint chunk_begin(uint count, uint chunk, uint chunks) { return (uint)((ulong)count * chunk / chunks); }

// How many places of each chunk are in each bucket; `shift`: of a row's number, for that of its bucket.
kernel void count_chunks(global const given_t* restrict given, uint count, uint chunks, int4 bits, int4 size,
                         uint shift, global uint* restrict counts) {
  const bins_t bins = bins_of(bits, size);
  const uint chunk = (uint)get_global_id(0);
  if (chunk >= chunks) return;
  uint own[BUCKETS];
  for (int i = 0; i < BUCKETS; ++i) own[i] = 0;
  for (uint i = chunk_begin(count, chunk, chunks); i < chunk_begin(count, chunk + 1, chunks); ++i) {
    if (is_given(given[i])) ++own[row_of(&bins, place_of(given[i])) >> shift];
  }
  for (uint i = 0; i < BUCKETS; ++i) counts[chunk * BUCKETS + i] = own[i];
}

// Where a chunk's places begin among those of a bucket; and where buckets end. One work-item.
kernel void sum_chunks(uint chunks, global uint* restrict counts, global uint* restrict ends) {
  if (get_global_id(0) > 0) return;
  uint sum = 0;
  for (uint i = 0; i < BUCKETS; ++i) {
    for (uint chunk = 0; chunk < chunks; ++chunk) {
      const uint some = counts[chunk * BUCKETS + i];
      counts[chunk * BUCKETS + i] = sum;
      sum += some;
    }
    ends[i] = sum;
  }
}

// The fourth value of a place that is sorted is the id.
kernel void sort_chunks(global const given_t* restrict given, uint count, uint chunks, int4 bits, int4 size, uint shift,
                        global const uint* restrict counts, global int4* restrict sorted) {
  const bins_t bins = bins_of(bits, size);
  const uint chunk = (uint)get_global_id(0);
  if (chunk >= chunks) return;
  uint next[BUCKETS];
  for (uint i = 0; i < BUCKETS; ++i) next[i] = counts[chunk * BUCKETS + i];
  for (uint i = chunk_begin(count, chunk, chunks); i < chunk_begin(count, chunk + 1, chunks); ++i) {
    if (!is_given(given[i])) continue;
    const int4 place = place_of(given[i]);
    sorted[next[row_of(&bins, place) >> shift]++] = (int4)(place.xyz, (int)i);
  }
}

// The lists of the index, by place.
typedef struct {
  global int *x, *y, *z;
  global uint* id;
} table_t;

static inline bool comes_before(const table_t* t, uint a, uint b) {
  if (t->z[a] != t->z[b]) return t->z[a] < t->z[b];
  if (t->y[a] != t->y[b]) return t->y[a] < t->y[b];
  if (t->x[a] != t->x[b]) return t->x[a] < t->x[b];
  return t->id[a] < t->id[b];
}
static inline bool are_equal(const table_t* t, uint a, uint b) {
  return t->x[a] == t->x[b] && t->y[a] == t->y[b] && t->z[a] == t->z[b];
}
static inline void move(const table_t* t, uint from, uint to) {
  t->x[to] = t->x[from], t->y[to] = t->y[from], t->z[to] = t->z[from], t->id[to] = t->id[from];
}
static inline void exchange(const table_t* t, uint a, uint b) {
  const int x = t->x[a], y = t->y[a], z = t->z[a];
  const uint id = t->id[a];
  move(t, b, a);
  t->x[b] = x, t->y[b] = y, t->z[b] = z, t->id[b] = id;
}

// A heap sort, for bins of any size.
static inline void sift(const table_t* t, uint begin, uint at, uint count) {
  while (2 * at + 1 < count) {
    uint child = 2 * at + 1;
    if (child + 1 < count && comes_before(t, begin + child, begin + child + 1)) ++child;
    if (!comes_before(t, begin + at, begin + child)) return;
    exchange(t, begin + at, begin + child);
    at = child;
  }
}
NOINLINE static void sort_bin(const table_t* t, uint begin, uint count) {
  for (uint i = count / 2; i-- > 0;) sift(t, begin, i, count);
  for (uint last = count; --last > 0;) {
    exchange(t, begin, begin + last);
    sift(t, begin, 0, last);
  }
}

// Only the first of several places that are equal can win. Of bins with more than MANY_OF_BIN such repeats go: many
// seeds at one place would be in every list around it.
#ifndef MANY_OF_BIN
#define MANY_OF_BIN 16
#endif
NOINLINE static void drop_repeats(const table_t* t, global uint* restrict starts, int columns) {
  uint kept = starts[0], begin = kept;
  for (int i = 0; i < columns; ++i) {
    const uint end = starts[i + 1], first = kept;
    const bool is_crowded = end - begin > MANY_OF_BIN;
    if (is_crowded) sort_bin(t, begin, end - begin);
    for (uint at = begin; at < end; ++at) {
      if (is_crowded && kept > first && are_equal(t, at, kept - 1)) continue;
      if (at != kept) move(t, at, kept);
      ++kept;
    }
    begin = end;
    starts[i + 1] = kept;
  }
}

kernel void sort_buckets(global const int4* restrict sorted, int4 bits, int4 size, uint shift,
                         global const uint* restrict ends, global uint* restrict starts, global int* restrict xs,
                         global int* restrict ys, global int* restrict zs, global uint* restrict ids) {
  const bins_t bins = bins_of(bits, size);
  const uint bucket = (uint)get_global_id(0), rows = (uint)(bins.rows * bins.slices), each = (uint)bins.columns + 1;
  const uint first = bucket << shift, last = min((bucket + 1) << shift, rows);
  if (bucket >= BUCKETS || first >= rows) return;
  const uint begin = bucket == 0 ? 0 : ends[bucket - 1], end = ends[bucket];
  // The entry behind a bin counts its places, then says where the next one of them goes, and so at last where it ends.
  global uint* const next = starts + 1;
  for (uint i = first * each; i < last * each; ++i) starts[i] = 0;
  for (uint i = begin; i < end; ++i) ++next[bin_of(&bins, sorted[i])];
  uint sum = begin, most = 0;
  for (uint row = first; row < last; ++row) {
    starts[row * each] = sum;
    for (uint i = row * each; i < row * each + each - 1; ++i) {
      const uint some = next[i];
      next[i] = sum;
      sum += some;
      most = max(most, some);
    }
  }
  for (uint i = begin; i < end; ++i) {
    const int4 place = sorted[i];
    const uint at = next[bin_of(&bins, place)]++;
    xs[at] = place.x * SPACING_X, ys[at] = place.y * SPACING_Y, zs[at] = place.z * SPACING_Z, ids[at] = (uint)place.w;
  }
  if (most <= MANY_OF_BIN) return;
  const table_t table = {xs, ys, zs, ids};
  for (uint row = first; row < last; ++row) drop_repeats(&table, starts + row * each, bins.columns);
}

#endif
