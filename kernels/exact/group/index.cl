// The index of places on GPUs: a counting sort whose items take one place each.
//
// The entry behind that of a bin counts its places, then is the next place of the bin's in the list, and in
// the end where the bin ends. Rows of bins stand in any order in the list, and so do the places of one bin.
// Of places at one point (with one lag, where there are weights) one stands for all, with the lowest id: only
// that can win.

#ifndef VOROCL_EXACT_GROUP_INDEX
#define VOROCL_EXACT_GROUP_INDEX

#include "exact/bins.cl"

// Finds who stands for each place, and counts those of each bin. A table of 2^table_bits places by their hashes is
// NOT_SEEN at first, as is what stands behind it, `lowest`: that gets the lowest id of the places that one stands for,
// and stays so of all others. (Ids are the places' own numbers unless they are given.)
static inline int4 place_and_lag(given_t given, uint id, global const int* lags) {
  const int4 place = place_of(given);
  return (int4)(place.xyz, IS_WEIGHTED ? lags[id] : 0);
}
kernel void find_repeats(global const given_t* restrict given, global const uint* restrict ids, int has_ids,
                         global const int* restrict lags, uint count, uint table_bits, global uint* restrict table,
                         int4 bits, int4 size, global uint* restrict starts) {
  const bins_t bins = bins_of(bits, size);
  const uint item = (uint)get_global_id(0);
  if (item >= count || !is_given(given[item])) return;
  const uint id = has_ids ? ids[item] : item;
  const int4 own = place_and_lag(given[item], id, lags);
  const uint hash = (uint)own.x * 0x9e3779b1u ^ (uint)own.y * 0x85ebca77u ^ (uint)own.z * 0xc2b2ae3du ^
                    (uint)own.w * 0x27d4eb2fu;
  uint at = hash * 0x165667b1u >> (32 - table_bits);
  uint first = atomic_cmpxchg(table + at, NOT_SEEN, item);
  while (first != NOT_SEEN && any(place_and_lag(given[first], has_ids ? ids[first] : first, lags) != own)) {
    at = (at + 1) & ((1u << table_bits) - 1);
    first = atomic_cmpxchg(table + at, NOT_SEEN, item);
  }
  atomic_min(table + (1u << table_bits) + (first == NOT_SEEN ? item : first), id);
  if (first == NOT_SEEN) atomic_inc(starts + bin_of(&bins, own) + 1);
}

// A work-group gives a row of bins its part of the list. Behind the bins stands how much is given.
kernel void start_bins(global uint* restrict starts, int4 bits, int4 size) {
  local uint
      ends_of_items[MOST_ITEMS_OF_ROW];  // how many places the bins of each have, and of those before it
  local uint begin[1];
  const bins_t bins = bins_of(bits, size);
  const uint row = (uint)get_group_id(0), rows = (uint)(bins.rows * bins.slices),
             columns = (uint)bins.columns;
  const uint item = (uint)get_local_id(0), items = (uint)get_local_size(0),
             some_bins = (columns - 1) / items + 1;
  global uint* const own = starts + row * (columns + 1);
  const uint first = min(item * some_bins, columns), last = min(first + some_bins, columns);
  uint all = 0;
  for (uint x = first; x < last; ++x) all += own[x + 1];
  const uint of_item = all;
  ends_of_items[item] = all;
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint step = 1; step < items; step *= 2) {
    if (item >= step) all += ends_of_items[item - step];
    barrier(CLK_LOCAL_MEM_FENCE);
    ends_of_items[item] = all;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  if (item == items - 1) begin[0] = own[0] = atomic_add(starts + rows * (columns + 1), all);
  barrier(CLK_LOCAL_MEM_FENCE);
  uint at = begin[0] + all - of_item;
  for (uint x = first; x < last; ++x) {
    const uint of_bin = own[x + 1];
    own[x + 1] = at;
    at += of_bin;
  }
}

// Of what is labelled then nothing is queued as yet.
kernel void list_places(global const given_t* restrict given, uint table_bits,
                        global const uint* restrict table, uint count, int4 bits, int4 size,
                        global const int* restrict lags_of_seeds, global uint* restrict starts,
                        global int* restrict xs, global int* restrict ys, global int* restrict zs,
                        global uint* restrict ids, global int* restrict lags, global uint* restrict queue) {
  const bins_t bins = bins_of(bits, size);
  const places_of_bins_t places = {xs, ys, zs, ids, lags};
  const uint item = (uint)get_global_id(0);
  global const uint* const lowest = table + (1u << table_bits);
  if (item < BEFORE_QUEUE) queue[item] = 0;
  if (item >= count || lowest[item] == NOT_SEEN) return;
  const int4 place = place_of(given[item]);
  put(&places, atomic_inc(starts + bin_of(&bins, place) + 1), place, lowest[item], lags_of_seeds);
}

#endif
