// Making the index of the seeds and its pyramid, kernel by kernel in the order of their launches.

#ifndef VOROCL_EXACT_GROUP_INDEX
#define VOROCL_EXACT_GROUP_INDEX

#include "exact/group/seed_index.cl"

// Sets the seeds' bits, and keeps their indices. Of the seeds on one pixel the first one that comes sets it; the others
// are duplicates, which get NO_BIT and queue up.
#define NO_BIT 0xffffffffu
kernel void set_bits(global const uint* restrict positions, uint count, global uint* restrict bits,
                     global uint* restrict bit_of_seed, global uint* restrict duplicates, int counters, int width,
                     int height) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  bit_of_seed[id] = NO_BIT;
  if (positions[id] & EMPTY_BIT) return;
  const int columns = columns_of(width, 0);
  const uint in_frame = positions[id] + pack(margin_x(width), margin_y(height));
  const uint index = BIT_INDEX(in_frame, columns), bit = 1u << index % 32;
  if (atomic_or(bits + index / 32, bit) & bit) {
    duplicates[atomic_inc(bits + counters + DUPLICATE_COUNT)] = id;
    return;
  }
  bit_of_seed[id] = index;
#ifdef VOROCL_PERIODIC
  FOR_EACH_IMAGE(x, y, positions[id], width, height) {
    const uint of_image = BIT_INDEX(pack(x, y), columns);
    if (of_image != index) atomic_or(bits + of_image / 32, 1u << of_image % 32);
  }
#else
  (void)height;
#endif
}

// The pixel of a word's bit, as an offset from the word's first pixel.
static inline uint pixel_of_bit(uint bit) { return pack((int)(bit % BIN), (int)(bit / BIN)); }

// The first seed of a bin, and how many it has.
static inline uint representative_of_bin(global const uint* bits, int x, int y, int columns, uint* count) {
  global const uint* const words = bits + (y * columns + x) * WORDS;
  uint representative = EMPTY, any = 0;
  *count = 0;
  for (int word = 0; word < WORDS; ++word) any |= words[word];
  if (any != 0) {
    for (int word = WORDS - 1; word >= 0; --word) {
      const uint first_pixel = pack(x * BIN, y * BIN + word * ROWS_OF_WORD);
      representative = words[word] == 0 ? representative : first_pixel + pixel_of_bit(lowest_bit(words[word]));
      *count += popcount(words[word]);
    }
    representative |= *count > 1 ? MORE : 0;
  }
  return representative;
}

// Says where the seeds of each word of a bin begin in the list, given where the first of them is.
static inline void start_words_of_bin(global const uint* bits, global uint* word_starts, int bin, uint start) {
  for (int word = 0; word < WORDS; ++word) {
    word_starts[bin * WORDS + word] = start;
    start += popcount(bits[bin * WORDS + word]);
  }
}

// Level 0 of the pyramid, the numbers of seeds of bins, and each row's part of the list, in the order in which rows
// come. A work-group has a row of bins, and each item some of them, one beside the other. The items' numbers
// of seeds are scanned in local memory.
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

// The representative of two parts.
static inline uint joined(uint a, uint b) { return min(a, b) | (a != EMPTY && b != EMPTY ? MORE : 0); }

// A level above 0: one of the representatives of a bin's FAN x FAN parts.
static inline uint representative_above(global const uint* pyramid, int x, int y, int width, int height, int level) {
  const int parts_across = columns_of(width, level - 1), parts_down = rows_of(height, level - 1);
  const int below = level_start(width, height, level - 1);
  uint representative = EMPTY;
  for (int part_y = y * FAN; part_y < min((y + 1) * FAN, parts_down); ++part_y) {
    for (int part_x = x * FAN; part_x < min((x + 1) * FAN, parts_across); ++part_x) {
      representative = joined(representative, pyramid[below + part_y * parts_across + part_x]);
    }
  }
  return representative;
}

// A level above 0, and the next one unless the first is the top. A work-group has a bin of the higher level, and its
// items make the parts.
kernel void find_representatives(global uint* pyramid, int width, int height, int level, int top_level) {
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

// Lists the seeds and their ids, but not the duplicates ...
kernel void list_seeds(global const uint* restrict positions, global const uint* restrict bit_of_seed, uint count,
                       global const uint* restrict bits, global const uint* restrict word_starts,
                       global uint* restrict list, global uint* restrict ids, int width, int height) {
  const uint id = (uint)get_global_id(0);
  if (id >= count || bit_of_seed[id] == NO_BIT) return;
#ifdef VOROCL_PERIODIC
  FOR_EACH_IMAGE(x, y, positions[id], width, height) {
    const uint at = list_index(bits, word_starts, BIT_INDEX(pack(x, y), columns_of(width, 0)));
    list[at] = pack(x, y);
    ids[at] = id;
  }
#else
  (void)width, (void)height;
  const uint at = list_index(bits, word_starts, bit_of_seed[id]);
  list[at] = positions[id];
  ids[at] = id;
#endif
}

// ... and the seed with the lowest id takes the place.
kernel void keep_lowest_ids(global const uint* restrict positions, global const uint* restrict duplicates,
                            global const uint* restrict bits, global const uint* restrict word_starts,
                            global uint* restrict ids, int counters, int width, int height) {
  const uint count = bits[counters + DUPLICATE_COUNT];
  for (uint i = (uint)get_global_id(0); i < count; i += (uint)get_global_size(0)) {
    const uint id = duplicates[i];
    FOR_EACH_IMAGE(x, y, positions[id], width, height) {
      atomic_min(ids + list_index(bits, word_starts, BIT_INDEX(pack(x, y), columns_of(width, 0))), id);
    }
  }
}

#endif
