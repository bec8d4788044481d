// The mask engine: of each pixel the nearest mark, by one pass along each axis. docs/masks.md says how and why.
//
// A row's nearest marks follow from its bits (rows.cl), those of the rows of a strip from these (lines.cl), those of
// the slices from those. Each item has working memory of its own and takes its share of slices, strips or rows.

#include "core/abi.cl"
#include "masks/targets.cl"

#define ITEM (int)get_global_id(0)
#define ITEMS (int)get_global_size(0)
// Kernels with keys of 64 bits come second, and take what was left to them.
#ifdef VOROCL_FAR
#define IS_SECOND 1
#else
#define IS_SECOND 0
#endif
#define ITEM_KERNEL kernel __attribute__((reqd_work_group_size(1, 1, 1)))

// Working memory.
#define MEMORY_PARAMETERS \
  global const one_key *costs, global keys *keys_of_items, global int16 *ints_of_items, global uchar *flags
typedef struct {
  global keys* keys;
  global int16* packed;
  global int* ints;
} memory_t;
static inline memory_t memory_of_item(global keys* all_keys, global int16* all_ints, int longest) {
  memory_t m;
  m.keys = all_keys + (size_t)ITEM * (size_t)VECTORS_OF_KEYS(longest);
  m.packed = all_ints + (size_t)ITEM * (size_t)VECTORS_OF_INTS(longest);
  m.ints = (global int*)(m.packed + longest);
  return m;
}

// Makes a line whose sites are the places that have marks, and whose sites have no keys yet. They are listed in `site`.
static line_t line_of(memory_t m, int longest, int size, int period, int bits, bool saturates, long limit,
                      global const one_key* costs, global const uint* counts, global int** site) {
  line_t l;
  l.size = size;
  l.period = period;
  l.bits = bits;
  l.saturates = saturates;
  l.limit = (one_key)limit;
  l.cost = costs + REACH_OF_COSTS(size);
  l.key = m.keys + PAD + longest / 2;
  l.best = m.keys + KEYS_OF_LINE(longest);
  l.from = m.ints;
  l.to = l.from + longest + 2;
  l.index = l.to + longest + 2;
  l.at = l.index + longest + longest;
  global int* const list = l.index + longest + 3 * longest;
  l.count = 0;
  for (int p = 0; p < size; ++p) {
    list[l.count] = p;
    l.count += counts[p] != 0;
  }
  *site = list;
#ifdef VOROCL_MANHATTAN
  l.is_listed = false;
#else
  l.is_listed = l.count * 2 < size;
#endif
  l.first = 0;
  l.last = l.count - 1;
  if (!l.is_listed) return l;
  for (int i = 0; i < l.count; ++i) {
    l.index[list[i]] = i;
    l.at[i] = list[i];
    l.at[i - l.count] = list[i] - period;
    l.at[i + l.count] = list[i] + period;
  }
  if (period != 0) {
    while (l.first > -l.count && l.at[l.first - 1] >= -(period / 2)) --l.first;
    while (l.last < 2 * l.count - 1 && l.at[l.last + 1] < size + period / 2) ++l.last;
  }
  return l;
}

// Before the keys of sites are set: those of places that are none.
static inline void begin_keys(const line_t* l) {
  if (l->is_listed || l->count == l->size) return;
  for (int p = 0; p < l->size; ++p) l->key[p] = (keys)(l->limit << l->bits | (one_key)p);
}
INLINE void set_key(const line_t* l, int i, int place, keys distance) {
  const keys key = min(distance, (keys)l->limit) << (keys)(one_key)l->bits | (keys)(one_key)place;
  if (!l->is_listed) {
    l->key[place] = key;
    return;
  }
  l->key[i] = key;
  if (l->period != 0) l->key[i - l->count] = l->key[i + l->count] = key;
}

// The least keys of a strip's rows. Returns whether all sums held.
static bool find_along_y(const line_t* l, global const int* site, const images_t* e, global const ushort* columns,
                         int x0) {
  begin_keys(l);
  for (int i = 0; i < l->count; ++i) {
    const int16 far = convert_int16(LOAD_SHORTS(columns + site[i] * STRIP)) - (LANE + x0);
    set_key(l, i, site[i], part_of(way_of(far, e->period_x), e->most_x_of_y, (one_key)e->square_x));
  }
  return find_along_line(l);
}

// The columns of the nearest marks of a strip's row `y`, in the rows of their sites.
INLINE int16 columns_of(int16 site, int y, global const ushort* columns) {
  if (!some_of(site != (int16)y)) return convert_int16(LOAD_SHORTS(columns + y * STRIP));
  int from[STRIP];
  ushort found[STRIP];
  vstore16(site, 0, from);
#pragma unroll
  for (int i = 0; i < STRIP; ++i) found[i] = columns[from[i] * STRIP + i];
  return convert_int16(vload16(0, found));
}

// --- Planes: rows, then strips. ---

ITEM_KERNEL void nearest_in_rows(global const images_t* images, global const ushort* restrict marks,
                                 global const uint* restrict counts, global ushort* restrict columns) {
  const int height = images->height, width = images->width, words = SHORTS_OF_ROW(width);
  const int end = (int)((long)(ITEM + 1) * height / ITEMS);
  for (int y = (int)((long)ITEM * height / ITEMS); y < end; ++y) {
    if (counts[y] == 0) continue;
    find_in_row(marks + (size_t)y * (size_t)words, width, images->period_x != 0, columns + y * STRIP,
                (size_t)SHORTS_OF_STRIP(height));
  }
}

ITEM_KERNEL void nearest_in_strips(global const images_t* images, MEMORY_PARAMETERS, global const ushort* marks,
                                   global const uint* counts, global const ushort* columns, TARGET_PARAMETERS) {
  const images_t e = *images;
  const targets_t t = TARGETS_OF_PARAMETERS;
  global int* site;
  const line_t l = line_of(memory_of_item(keys_of_items, ints_of_items, e.longest), e.longest, e.height, e.period_y,
                           e.bits_y, e.saturates_y, e.limit_y, costs, counts, &site);
  const int strips = STRIPS_OF(e.width), end = (int)((long)(ITEM + 1) * strips / ITEMS);
  for (int s = (int)((long)ITEM * strips / ITEMS); s < end; ++s) {
    if (IS_SECOND && flags[s] == 0) continue;
    const int x0 = s * STRIP, lanes = min(STRIP, e.width - x0);
    global const ushort* const of_strip = columns + (size_t)s * (size_t)SHORTS_OF_STRIP(e.height);
    const bool held = l.count == 0 || find_along_y(&l, site, &e, of_strip, x0);
    flags[s] = !held;
    if (!held) continue;
    for (int y = 0; y < e.height; ++y) {
      if (l.count == 0) {
        store_none(x0, y, 0, lanes, &e, &t);
        continue;
      }
      const keys best = l.best[y];
      nearest_t n = {0, x0, y, 0, lanes, (int16)0, sites_of(best, l.bits), (int16)0, (int16)0, square_of(best, l.bits)};
      n.column = columns_of(n.row, y, of_strip);
      n.none = too_far(n.square, &e);
      store_nearest(&n, &e, &t);
    }
  }
}

// --- Volumes: slices, then lines along z. ---

// What is known of a voxel in its slice stands in an image: row << 16 | column, in every value or every second one.
INLINE void store_packed(uint16 packed, global uint* between, size_t at, int step, int lanes) {
  if (step == 1) {
    STORE_LANES(uint, packed, between + at, lanes);
  } else {
    STORE_LANES(ulong, convert_ulong16(packed), (global ulong*)between + at, lanes);
  }
}
INLINE uint16 load_packed(global const uint* between, size_t at, int step, int lanes) {
  if (lanes == STRIP) {
    if (step == 1) return vload16(0, between + at);
    return convert_uint16(vload16(0, (global const ulong*)between + at));
  }
  uint value[STRIP];
  for (int i = 0; i < STRIP; ++i) value[i] = between[(at + (size_t)min(i, lanes - 1)) * (size_t)step];
  return vload16(0, value);
}

ITEM_KERNEL void nearest_in_slices(global const images_t* images, MEMORY_PARAMETERS,
                                   global const ushort* restrict marks, global const uint* restrict counts,
                                   global ushort* restrict columns_of_items, global uint* restrict counts_of_slices,
                                   global uint* restrict between, int step) {
  const images_t e = *images;
  const memory_t m = memory_of_item(keys_of_items, ints_of_items, e.longest);
  const int strips = STRIPS_OF(e.width);
  const size_t of_strip = (size_t)SHORTS_OF_STRIP(e.height);
  global ushort* const columns = columns_of_items + (size_t)ITEM * (size_t)strips * of_strip;
  for (int z = ITEM; z < e.depth; z += ITEMS) {
    global uchar* const flag = flags + (size_t)z * (size_t)strips;
    uint some = !IS_SECOND;
    for (int s = 0; IS_SECOND && s < strips; ++s) some |= flag[s];
    if (some == 0) continue;
    global const uint* const of_rows = counts + (size_t)z * (size_t)e.height;
    global int* site;
    const line_t l = line_of(m, e.longest, e.height, e.period_y, e.bits_y, e.saturates_y, e.limit_y, costs, of_rows,
                             &site);
    counts_of_slices[z] = (uint)l.count;
    for (int i = 0; i < l.count; ++i) {
      const size_t row = (size_t)z * (size_t)e.height + (size_t)site[i];
      find_in_row(marks + row * (size_t)SHORTS_OF_ROW(e.width), e.width, e.period_x != 0, columns + site[i] * STRIP,
                  of_strip);
    }
    for (int s = 0; s < strips && l.count != 0; ++s) {
      if (IS_SECOND && flag[s] == 0) continue;
      const int x0 = s * STRIP, lanes = min(STRIP, e.width - x0);
      global const ushort* const found = columns + (size_t)s * of_strip;
      const bool held = find_along_y(&l, site, &e, found, x0);
      flag[s] = !held;
      if (!held) continue;
      for (int y = 0; y < e.height; ++y) {
        const int16 row = sites_of(l.best[y], l.bits);
        const size_t at = ((size_t)z * (size_t)e.height + (size_t)y) * (size_t)e.width + (size_t)x0;
        store_packed(as_uint16(row << 16 | columns_of(row, y, found)), between, at, step, lanes);
      }
    }
  }
}

// The least keys of a line along z.
static bool find_along_z(const line_t* l, global const int* site, const images_t* e, global const int16* packed,
                         int x0, int y) {
  begin_keys(l);
  for (int i = 0; i < l->count; ++i) {
    const int16 p = packed[site[i]];
    const int16 dx = way_of((p & 0xffff) - (LANE + x0), e->period_x), dy = way_of((p >> 16) - y, e->period_y);
    set_key(l, i, site[i],
            part_of(dx, e->most_x_of_z, (one_key)e->square_x) + part_of(dy, e->most_y_of_z, (one_key)e->square_y));
  }
  return find_along_line(l);
}

INLINE int16 packed_of(int16 site, int z, global const int16* packed) {
  if (!some_of(site != (int16)z)) return packed[z];
  int from[STRIP], found[STRIP];
  vstore16(site, 0, from);
#pragma unroll
  for (int i = 0; i < STRIP; ++i) found[i] = ((global const int*)packed)[from[i] * STRIP + i];
  return vload16(0, found);
}

ITEM_KERNEL void nearest_along_z(global const images_t* images, MEMORY_PARAMETERS, global const ushort* marks,
                                 global const uint* counts_of_slices, global const uint* between, int step,
                                 TARGET_PARAMETERS) {
  const images_t e = *images;
  const targets_t t = TARGETS_OF_PARAMETERS;
  const memory_t m = memory_of_item(keys_of_items, ints_of_items, e.longest);
  global int* site;
  const line_t l = line_of(m, e.longest, e.depth, e.period_z, e.bits_z, e.saturates_z, e.limit_z, costs,
                           counts_of_slices, &site);
  const int strips = STRIPS_OF(e.width);
  for (int y = ITEM; y < e.height; y += ITEMS) {
    for (int s = 0; s < strips; ++s) {
      global uchar* const flag = flags + (size_t)y * (size_t)strips + s;
      if (IS_SECOND && *flag == 0) continue;
      const int x0 = s * STRIP, lanes = min(STRIP, e.width - x0);
      for (int i = 0; i < l.count; ++i) {
        const size_t at = ((size_t)site[i] * (size_t)e.height + (size_t)y) * (size_t)e.width + (size_t)x0;
        m.packed[site[i]] = as_int16(load_packed(between, at, step, lanes));
      }
      const bool held = l.count == 0 || find_along_z(&l, site, &e, m.packed, x0, y);
      *flag = !held;
      if (!held) continue;
      for (int z = 0; z < e.depth; ++z) {
        if (l.count == 0) {
          store_none(x0, y, z, lanes, &e, &t);
          continue;
        }
        const keys best = l.best[z];
        const keys square = square_of(best, l.bits);
        nearest_t n = {0, x0, y, z, lanes, (int16)0, (int16)0, sites_of(best, l.bits), (int16)0, square};
        const int16 packed = packed_of(n.slice, z, m.packed);
        n.column = packed & 0xffff;
        n.row = packed >> 16;
        n.none = too_far(n.square, &e);
        store_nearest(&n, &e, &t);
      }
    }
  }
}
