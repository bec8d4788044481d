// The index of places on CPUs: a counting sort by bins that hold about PLACES_OF_BIN. Places are sorted into
// buckets of rows of bins chunk by chunk, and then bucket by bucket, without atomics.

#ifndef VOROCL_EXACT_INDEX
#define VOROCL_EXACT_INDEX

#include "exact/bins.cl"

static inline uint chunk_begin(uint count, uint chunk, uint chunks) {
  return (uint)((ulong)count * chunk / chunks);
}

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

// The fourth value of a place that is sorted is the id, which is the place's own number unless ids are given.
kernel void sort_chunks(global const given_t* restrict given, global const uint* restrict ids, int has_ids,
                        uint count, uint chunks, int4 bits, int4 size, uint shift,
                        global const uint* restrict counts, global int4* restrict sorted) {
  const bins_t bins = bins_of(bits, size);
  const uint chunk = (uint)get_global_id(0);
  if (chunk >= chunks) return;
  uint next[BUCKETS];
  for (uint i = 0; i < BUCKETS; ++i) next[i] = counts[chunk * BUCKETS + i];
  for (uint i = chunk_begin(count, chunk, chunks); i < chunk_begin(count, chunk + 1, chunks); ++i) {
    if (!is_given(given[i])) continue;
    const int4 place = place_of(given[i]);
    sorted[next[row_of(&bins, place) >> shift]++] = (int4)(place.xyz, (int)(has_ids ? ids[i] : i));
  }
}

// Notes the bounds of the blocks that begin in a range, if that has crowds. One that ends behind it, where another item
// sorts, is taken to be everywhere.
static inline void bound_blocks(const places_of_bins_t* p, uint begin, uint end, bool has_crowds,
                                global float* bounds) {
  global const int* const along[3] = {p->x, p->y, p->z};
  for (uint block = (begin + PLACES_OF_BLOCK - 1) / PLACES_OF_BLOCK; block * PLACES_OF_BLOCK < end; ++block) {
    const uint at = block * PLACES_OF_BLOCK;
    const bool is_bound = has_crowds && at + PLACES_OF_BLOCK <= end;
    global float* out = bounds + FIRST_BOUND(block);
    for (int i = 0; i < AXES_OF_PLACES; ++i, out += 2 * BLOCKS_AT_ONCE) {
      float2 ends = (float2)(-INFINITY, INFINITY);
      if (is_bound) ends = bounds_of(along[i] + at, PLACES_OF_BLOCK);
      out[0] = ends.x, out[BLOCKS_AT_ONCE] = ends.y;
    }
#if IS_WEIGHTED
    const int lag = is_bound ? extent_in_index(p->lags + at, PLACES_OF_BLOCK).first : 0;
    out[0] = (float)lag * ((1 - 0x1p-22f) * LAG_UNIT * UNITS_OF_BOUNDS * UNITS_OF_BOUNDS);
#endif
  }
}

// A work-group of one item has a bucket. `lags`: of rows, then of places.
kernel void sort_buckets(global const int4* restrict sorted, int4 bits, int4 size, uint shift,
                         global const uint* restrict ends, global const int* restrict lags_of_seeds,
                         global uint* restrict starts, global int* restrict xs, global int* restrict ys,
                         global int* restrict zs, global uint* restrict ids, global int* restrict lags,
                         global float* restrict bounds) {
  local uint seen[1 << TABLE_BITS];
  const bins_t bins = bins_of(bits, size);
  const uint bucket = (uint)get_global_id(0), rows = (uint)(bins.rows * bins.slices),
             each = (uint)bins.columns + 1;
  const places_of_bins_t places = {xs, ys, zs, ids, IS_WEIGHTED ? lags + rows : lags};
  const uint first = bucket << shift, last = min((bucket + 1) << shift, rows);
  if (bucket >= BUCKETS || first >= rows) return;
  const uint begin = bucket == 0 ? 0 : ends[bucket - 1], end = ends[bucket];
  // The entry behind a bin counts its places, then says where the next one of them goes, and so at last where
  // it ends.
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
    put(&places, next[bin_of(&bins, place)]++, place, (uint)place.w, lags_of_seeds);
  }
#if IS_WEIGHTED
  for (uint row = first; row < last; ++row) {
    int least = INT_MAX;
    for (uint at = starts[row * each]; at < starts[(row + 1) * each - 1]; ++at)
      least = min(least, places.lags[at]);
    lags[row] = least;
  }
#endif
  for (uint row = first; most > MANY_OF_BIN && row < last; ++row)
    drop_repeats_of_row(&places, starts + row * each, bins.columns, seen);
  bound_blocks(&places, begin, end, most > MANY_OF_BIN, bounds);
}

#endif
