// The mask engine: of each pixel the nearest mark, by one pass along each axis. docs/masks.md says how and why.
//
// A row's nearest marks follow from its bits (rows.cl), those of the rows of a strip from these (lines.cl), those of
// the slices from those. Each item has working memory of its own and takes its share of slices, strips or rows.

#include "masks/lines.cl"
#include "masks/marking.cl"
#include "masks/targets.cl"

#define ITEM (int)get_global_id(0)
#define ITEMS (int)get_global_size(0)
// Kernels with keys of 64 bits come second, and take what was left to them.
#ifdef VOROCL_FAR
#define IS_SECOND 1
#else
#define IS_SECOND 0
#endif

// Working memory.
#define MEMORY_PARAMETERS \
  global const one_key *costs, global keys *keys_of_items, global int16 *ints_of_items, global uchar *flags
typedef struct {
  global keys* keys;
  global int16* carried;
  global int* ints;
} memory_t;
static inline memory_t memory_of_item(global keys* all_keys, global int16* all_ints, const images_t* e) {
  memory_t m;
  m.keys = all_keys + (size_t)ITEM * (size_t)VECTORS_OF_KEYS(e->longest, e->strips_at_once);
  m.carried = all_ints + (size_t)ITEM * (size_t)VECTORS_OF_INTS(e->longest, e->strips_at_once) + PAD;
  m.ints = (global int*)(m.carried - PAD + e->strips_at_once * (CARRIED_BY_LINE(e->longest) + e->longest));
  return m;
}

// Makes a line whose sites are the places that have marks, and whose sites have no keys yet. They are listed in `site`.
static line_t line_of(memory_t m, int longest, int size, int period, int bits, bool saturates, long limit, bool takes,
                      global const one_key* costs, global const uint* counts, global int** site) {
  line_t l;
  l.takes = takes;
  l.carried = m.carried;
  l.found = m.carried + longest + PAD;
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

// The line of a further strip of a row, which has what it finds and carries for itself.
static inline line_t line_of_strip(const line_t* first, int strip, int longest) {
  line_t l = *first;
  l.best += strip * longest;
  l.carried += strip * (CARRIED_BY_LINE(longest) + longest);
  l.found += strip * (CARRIED_BY_LINE(longest) + longest);
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

// The columns of the nearest marks of a strip's row `y`, in the rows of their sites. They stand in the strip.
INLINE int16 columns_of(int16 row, int y, global const ushort* columns) {
  if (!SOME(row != (int16)y)) return convert_int16(LOAD_SHORTS(columns + y * STRIP));
  int from[STRIP];
  ushort found[STRIP];
  vstore16(row, 0, from);
#pragma unroll
  for (int i = 0; i < STRIP; ++i) found[i] = columns[from[i] * STRIP + i];
  return convert_int16(vload16(0, found));
}

// Values of pixels of a row, of each pixel or of every second one.
INLINE void store_lanes(uint16 values, global uint* image, size_t at, int step, int lanes, const images_t* e) {
  if (step == 1) {
    STREAM_LANES(e, uint, values, image + at, lanes);
  } else {
    STREAM_LANES(e, ulong, convert_ulong16(values), (global ulong*)image + at, lanes);
  }
}
INLINE uint16 load_lanes(global const uint* image, size_t at, int step, int lanes) {
  if (lanes == STRIP) {
    if (step == 1) return vload16(0, image + at);
    return convert_uint16(vload16(0, (global const ulong*)image + at));
  }
  uint value[STRIP];
  for (int i = 0; i < STRIP; ++i) value[i] = image[(at + (size_t)min(i, lanes - 1)) * (size_t)step];
  return vload16(0, value);
}

// The columns of a strip. Lanes behind the row's end are as its last pixel: the host says how far a mark may be, and a
// lane that is farther would find no site.
INLINE int16 columns_from(int x0, const images_t* e) { return min(LANE + x0, (int16)(e->width - 1)); }

// Rows lie on pages of their own, which no processor loads ahead by itself.
#define ROWS_AHEAD 32

// The least keys of a strip's rows, and what they carry: columns, or labels of a slice. Returns whether all sums held.
static bool find_along_y(const line_t* l, global const int* site, const images_t* e, global const ushort* columns,
                         global const uint* labels, int x0, int lanes) {
  const int16 x = columns_from(x0, e);
  begin_keys(l);
  for (int i = 0; i < l->count; ++i) {
    const int y = site[i];
    const int16 column = convert_int16(LOAD_SHORTS(columns + y * STRIP));
    if (e->carried == CARRIES_LABELS) {
      PREFETCH(labels + (size_t)min(y + ROWS_AHEAD, e->height - 1) * (size_t)e->width + (size_t)x0);
      l->carried[y] = as_int16(load_lanes(labels, (size_t)y * (size_t)e->width + (size_t)x0, 1, lanes));
    }
    set_key(l, i, y, part_of(way_of(column - x, e->period_x), e->most_x_of_y, (one_key)e->square_x));
  }
  return find_along_line(l);
}

// --- Planes: rows, then strips. ---

ITEM_KERNEL void nearest_in_rows(global const images_t* images, global const ushort* restrict marks,
                                 global const uint* restrict counts, global ushort* restrict columns,
                                 global uint* restrict labels) {
  const int height = images->height, width = images->width, words = SHORTS_OF_ROW(width);
  const int end = (int)((long)(ITEM + 1) * height / ITEMS);
  for (int y = (int)((long)ITEM * height / ITEMS); y < end; ++y) {
    if (counts[y] == 0) continue;
    find_in_row(marks + (size_t)y * (size_t)words, width, images->period_x != 0, columns + y * STRIP,
                (size_t)SHORTS_OF_STRIP(height),
                images->carried == CARRIES_LABELS ? labels + (size_t)y * (size_t)width : 0);
  }
}

ITEM_KERNEL void nearest_in_strips(global const images_t* images, MEMORY_PARAMETERS, global const ushort* marks,
                                   global const uint* counts, global const ushort* columns, TARGET_PARAMETERS) {
  const images_t e = *images;
  const targets_t t = TARGETS_OF_PARAMETERS;
  global int* site;
  const line_t l = line_of(memory_of_item(keys_of_items, ints_of_items, &e), e.longest, e.height, e.period_y,
                           e.bits_y, e.saturates_y, e.limit_y, e.carried == CARRIES_LABELS, costs, counts, &site);
  const int strips = STRIPS_OF(e.width), end = (int)((long)(ITEM + 1) * strips / ITEMS);
  for (int s = (int)((long)ITEM * strips / ITEMS); s < end; ++s) {
    if (IS_SECOND && flags[s] == 0) continue;
    const int x0 = s * STRIP, lanes = min(STRIP, e.width - x0);
    global const ushort* const of_strip = columns + (size_t)s * (size_t)SHORTS_OF_STRIP(e.height);
    const bool held = l.count == 0 || find_along_y(&l, site, &e, of_strip, labels, x0, lanes);
    flags[s] = !held;
    if (!held) continue;
    for (int y = 0; y < e.height; ++y) {
      if (l.count == 0) {
        store_none(x0, y, 0, lanes, &e, &t);
      } else if (e.carried == CARRIES_LABELS) {
        store_labels(l.found[y], x0, y, 0, lanes, &e, &t);
      } else {
        const keys best = l.best[y], square = square_of(best, l.bits);
        const int16 row = sites_of(best, l.bits);
        nearest_t n = {0, x0, y, 0, lanes, (int16)0, row, (int16)0, too_far(square, &e), square};
        if (e.carried == CARRIES_PLACES) n.column = columns_of(row, y, of_strip);
        store_nearest(&n, &e, &t);
      }
    }
  }
}

// --- Volumes: slices, then lines along z. What is known of a voxel in its slice stands in an image: row << 16 | column
// where places are carried, else the squared distance. ---

ITEM_KERNEL void nearest_in_slices(global const images_t* images, MEMORY_PARAMETERS,
                                   global const ushort* restrict marks, global const uint* restrict counts,
                                   global ushort* restrict columns_of_items, global uint* restrict counts_of_slices,
                                   global uint* restrict between, int step, global uint* restrict labels) {
  const images_t e = *images;
  const memory_t m = memory_of_item(keys_of_items, ints_of_items, &e);
  const int strips = STRIPS_OF(e.width);
  const size_t of_strip = (size_t)SHORTS_OF_STRIP(e.height);
  const bool has_labels = e.carried == CARRIES_LABELS;
  global ushort* const columns = columns_of_items + (size_t)ITEM * (size_t)strips * of_strip;
  for (int z = ITEM; z < e.depth; z += ITEMS) {
    global uchar* const flag = flags + (size_t)z * (size_t)strips;
    uint some = !IS_SECOND;
    for (int s = 0; IS_SECOND && s < strips; ++s) some |= flag[s];
    if (some == 0) continue;
    global const uint* const of_rows = counts + (size_t)z * (size_t)e.height;
    global uint* const labels_of_slice = labels + (has_labels ? index_of_pixel(0, 0, z, &e) : 0);
    global int* site;
    const line_t l = line_of(m, e.longest, e.height, e.period_y, e.bits_y, e.saturates_y, e.limit_y,
                             e.carried == CARRIES_LABELS, costs, of_rows, &site);
    counts_of_slices[z] = (uint)l.count;
    for (int i = 0; i < l.count; ++i) {
      const size_t row = (size_t)z * (size_t)e.height + (size_t)site[i];
      find_in_row(marks + row * (size_t)SHORTS_OF_ROW(e.width), e.width, e.period_x != 0, columns + site[i] * STRIP,
                  of_strip, has_labels && !IS_SECOND ? labels_of_slice + (size_t)site[i] * (size_t)e.width : 0);
    }
    for (int s = 0; s < strips && l.count != 0; ++s) {
      if (IS_SECOND && flag[s] == 0) continue;
      const int x0 = s * STRIP, lanes = min(STRIP, e.width - x0);
      global const ushort* const found = columns + (size_t)s * of_strip;
      const bool held = find_along_y(&l, site, &e, found, labels_of_slice, x0, lanes);
      flag[s] = !held;
      if (!held) continue;
      for (int y = 0; y < e.height; ++y) {
        const keys best = l.best[y];
        const size_t at = index_of_pixel(x0, y, z, &e);
        const int16 row = sites_of(best, l.bits);
        const bool has_places = e.carried == CARRIES_PLACES;
        uint16 known = convert_uint16(square_of(best, l.bits));
        if (has_places) known = as_uint16(row << 16 | columns_of(row, y, found));
        store_lanes(known, between, at, step, lanes, &e);
        if (has_labels) STORE_LANES(uint, as_uint16(l.found[y]), labels + at, lanes);
      }
    }
  }
}

// Loads what is known of the voxels of a row of strips in the slices that are sites, which lie as far apart as rows.
#define SLICES_AHEAD 4
static void load_along_z(const line_t* l, global const int* site, const images_t* e, global const uint* between,
                         int step, global const uint* labels, int first, int end, int y) {
  const bool has_places = e->carried == CARRIES_PLACES, has_labels = e->carried == CARRIES_LABELS;
  for (int i = 0; i < l->count; ++i) {
    const int ahead = site[min(i + SLICES_AHEAD, l->count - 1)];
    for (int s = first; s < end; ++s) {
      const size_t soon = index_of_pixel(s * STRIP, y, ahead, e);
      PREFETCH(between + soon * (size_t)step);
      if (has_labels) PREFETCH(labels + soon);
      const line_t of_strip = line_of_strip(l, s - first, e->longest);
      const int lanes = min(STRIP, e->width - s * STRIP);
      const size_t at = index_of_pixel(s * STRIP, y, site[i], e);
      global int16* const known = has_places ? of_strip.carried : of_strip.found;
      known[site[i]] = as_int16(load_lanes(between, at, step, lanes));
      if (has_labels) of_strip.carried[site[i]] = as_int16(load_lanes(labels, at, 1, lanes));
    }
  }
}

// The least keys of a line along z, and what they carry. Returns whether all sums held.
static bool find_along_z(const line_t* l, global const int* site, const images_t* e, int x0, int y) {
  const bool has_places = e->carried == CARRIES_PLACES;
  const int16 x = columns_from(x0, e);
  begin_keys(l);
  for (int i = 0; i < l->count; ++i) {
    const int z = site[i];
    if (!has_places) {
      set_key(l, i, z, TO_KEYS(as_uint16(l->found[z])));
      continue;
    }
    const int16 p = l->carried[z];
    const int16 dx = way_of((p & 0xffff) - x, e->period_x), dy = way_of((p >> 16) - y, e->period_y);
    set_key(l, i, z,
            part_of(dx, e->most_x_of_z, (one_key)e->square_x) + part_of(dy, e->most_y_of_z, (one_key)e->square_y));
  }
  return find_along_line(l);
}

INLINE void store_along_z(const line_t* l, const images_t* e, const targets_t* t, int x0, int y, int z) {
  const int lanes = min(STRIP, e->width - x0);
  if (l->count == 0) {
    store_none(x0, y, z, lanes, e, t);
  } else if (e->carried == CARRIES_LABELS) {
    store_labels(l->found[z], x0, y, z, lanes, e, t);
  } else {
    const keys best = l->best[z], square = square_of(best, l->bits);
    const int16 slice = sites_of(best, l->bits);
    const int16 place = e->carried == CARRIES_PLACES ? carried_by(slice, z, l->carried) : (int16)0;
    nearest_t n = {0, x0, y, z, lanes, place & 0xffff, place >> 16, slice, too_far(square, e), square};
    store_nearest(&n, e, t);
  }
}

ITEM_KERNEL void nearest_along_z(global const images_t* images, MEMORY_PARAMETERS, global const ushort* marks,
                                 global const uint* counts_of_slices, global const uint* between, int step,
                                 TARGET_PARAMETERS) {
  const images_t e = *images;
  const targets_t t = TARGETS_OF_PARAMETERS;
  global int* site;
  const line_t l = line_of(memory_of_item(keys_of_items, ints_of_items, &e), e.longest, e.depth, e.period_z, e.bits_z,
                           e.saturates_z, e.limit_z, e.carried == CARRIES_LABELS, costs, counts_of_slices, &site);
  const int strips = STRIPS_OF(e.width);
  for (int y = ITEM; y < e.height; y += ITEMS) {
    global uchar* const flag = flags + (size_t)y * (size_t)strips;
    for (int first = 0; first < strips; first += e.strips_at_once) {
      const int end = min(first + e.strips_at_once, strips);
      bool some = !IS_SECOND;
      for (int s = first; IS_SECOND && s < end; ++s) some |= flag[s] != 0;
      if (!some) continue;
      load_along_z(&l, site, &e, between, step, labels, first, end, y);
      bool shows[MOST_AT_ONCE];
      for (int s = first; s < end; ++s) {
        shows[s - first] = false;
        if (IS_SECOND && flag[s] == 0) continue;
        const line_t of_strip = line_of_strip(&l, s - first, e.longest);
        const bool held = l.count == 0 || find_along_z(&of_strip, site, &e, s * STRIP, y);
        flag[s] = !held;
        shows[s - first] = held;
      }
      for (int z = 0; z < e.depth; ++z) {
        for (int s = first; s < end; ++s) {
          if (!shows[s - first]) continue;
          const line_t of_strip = line_of_strip(&l, s - first, e.longest);
          store_along_z(&of_strip, &e, &t, s * STRIP, y, z);
        }
      }
    }
  }
}
