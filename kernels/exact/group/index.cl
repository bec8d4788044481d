// Making the parts of the index that have to do with bins, in few launches: what find_representatives(),
// find_representatives_above(), share_out_list() and start_words() of make_index.cl do one after the other.

#include "exact/make_index.cl"
#include "exact/group/sizes.cl"

// A work-group has a row of bins, and each item some of them, one beside the other. The items' numbers of seeds are
// scanned in local memory.
kernel void index_bins(global uint* restrict bits, global uint* restrict pyramid, global uint* restrict starts,
                       global uint* restrict word_starts, int counters, int width) {
  local uint sums[MOST_ITEMS];
  local uint start_of_row[1];
  const int item = (int)get_local_id(0), items = (int)get_local_size(0), columns = columns_of(width, 0);
  const int y = (int)get_group_id(0);
  global uint* const row = starts + start_of(0, y, columns);
  const int bins = (columns - 1) / items + 1;
  const int first = min(item * bins, columns), last = min(first + bins, columns);
  uint own = 0;
  for (int x = first; x < last; ++x) {
    uint count;
    pyramid[y * columns + x] = representative_of_bin(bits, x, y, columns, &count);
    row[x] = count;
    own += count;
  }
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
    if (count > 0) start_words_of_bin(bits, word_starts, y * columns + x, start);
    start += count;
  }
  if (item == items - 1) row[columns] = start;
}

// A level above 0, and the next one unless the first is the top. A work-group has a bin of the higher level, and its
// items make the parts.
kernel void find_representatives_in_groups(global uint* pyramid, int width, int height, int level, int top_level) {
  local uint of_parts[FAN * FAN];
  const int bin = (int)get_group_id(0), columns = columns_of(width, level + 1);
  for (int part = (int)get_local_id(0); part < FAN * FAN; part += (int)get_local_size(0)) {
    const int x = bin % columns * FAN + part % FAN, y = bin / columns * FAN + part / FAN;
    const bool inside = x < columns_of(width, level) && y < rows_of(height, level);
    of_parts[part] = inside ? representative_above(pyramid, x, y, width, height, level) : EMPTY;
    if (inside) pyramid[level_start(width, height, level) + y * columns_of(width, level) + x] = of_parts[part];
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (get_local_id(0) == 0 && level < top_level) {
    uint representative = EMPTY;
    for (int part = 0; part < FAN * FAN; ++part) representative = joined(representative, of_parts[part]);
    pyramid[level_start(width, height, level + 1) + bin] = representative;
  }
}
