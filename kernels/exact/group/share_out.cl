// Giving each bin its part of the list of seeds by a parallel scan.

#include "exact/seed_index.cl"
#include "exact/group/sizes.cl"

// As share_out_list() of make_index.cl, with a work-group for each row of bins. An item has some bins, one beside the
// other; their sums are scanned in local memory.
kernel void share_out_list_in_groups(global uint* restrict bits, global uint* restrict starts, int counters,
                                     int width) {
  local uint sums[MOST_ITEMS];
  local uint start_of_row[1];
  const int item = (int)get_local_id(0), items = (int)get_local_size(0), columns = columns_of(width, 0);
  global uint* const row = starts + start_of(0, (int)get_group_id(0), columns);
  const int bins = (columns - 1) / items + 1;
  const int first = min(item * bins, columns), last = min(first + bins, columns);
  uint own = 0;
  for (int x = first; x < last; ++x) own += row[x];
  sums[item] = own;
  barrier(CLK_LOCAL_MEM_FENCE);
  for (int step = 1; step < items; step *= 2) {
    const uint before = item >= step ? sums[item - step] : 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    sums[item] += before;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  if (item == items - 1) *start_of_row = atomic_add(bits + counters + LIST_END, sums[item]);
  barrier(CLK_LOCAL_MEM_FENCE);
  uint start = *start_of_row + sums[item] - own;
  for (int x = first; x < last; ++x) {
    const uint count = row[x];
    row[x] = start;
    start += count;
  }
  if (item == items - 1) row[columns] = start;
}
