// The nearest of a short list at each pixel of a box, by keys of 32 bits: one addition and one minimum per
// place and vector of pixels.
//
// KEYS. With the origin at a pixel centre, a place c in units of 2^-FRACTION_BITS and a pixel p in whole
// units of the spacing, |c - p|^2 less |p|^2, which is the same for all places, is |c|^2 - 2^(FRACTION_BITS +
// 1) p.c, and lags come on top. So the low FRACTION_BITS + 1 bits are those of |c|^2 at every pixel. They go
// into the RANK of a place: its number in the order of (these bits, z, y, x, id). A key is the other bits,
// and below them the rank. By the Manhattan metric a key is the distance and the rank. All are less those of
// the list's first place.

#ifndef VOROCL_EXACT_KEYS
#define VOROCL_EXACT_KEYS

#include "exact/gather.cl"

#ifndef MOST_OF_KEYS
#define MOST_OF_KEYS 128
#endif
#define RANK_ROOM (MOST_OF_KEYS + 8)
#define FAR_BITS (32 - LOW_BITS)

#if SIDE_BITS > 15
#error "What orders seeds at the centres of pixels does not fit in an int"
#endif

typedef struct {
  int x[RANK_ROOM], y[RANK_ROOM], z[RANK_ROOM];  // Euclidean: less those of the first place
  uint high[RANK_ROOM];  // less that of the first place: |c|^2 >> LOW_BITS; Manhattan: less its distance
  int low[RANK_ROOM];    // |c|^2's low bits; Manhattan: 0
  uint rank[RANK_ROOM], labels[RANK_ROOM];
} places_t;

NOINLINE static void rank_to_the_end(const scene_t* scene, const uint* at, places_t* places, int count) {
  int x[RANK_ROOM], y[RANK_ROOM], z[RANK_ROOM];
  uint id[RANK_ROOM];
  for (int i = 0; i < count; ++i) {
    x[i] = own_x(scene, at[i]), y[i] = own_y(scene, at[i]), z[i] = IS_VOLUME ? scene->z[at[i]] : 0;
    id[i] = scene->ids[at[i]];
  }
  for (int k = 0; k < count; k += 8) {
    const int8 own_low = vload8(0, places->low + k), own_z = vload8(0, z + k);
    const int8 own_y = vload8(0, y + k), own_x = vload8(0, x + k);
    const uint8 own_id = vload8(0, id + k);
    int8 rank = 0;
    for (int i = 0; i < count; ++i) {
      const int8 by_id = (id[i] < own_id) | ((id[i] == own_id) & (i < EIGHT + k));
      const int8 by_x = (x[i] < own_x) | ((x[i] == own_x) & by_id);
      const int8 by_y = (y[i] < own_y) | ((y[i] == own_y) & by_x);
      const int8 by_z = (z[i] < own_z) | ((z[i] == own_z) & by_y);
      const int8 before = (places->low[i] < own_low) | ((places->low[i] == own_low) & by_z);
      rank = select(rank, rank + 1, before);
    }
    store_uints(as_uint8(rank), places->rank + k);
  }
}

static inline bool differ(const int* values, int count) {
  int8 other = 0;
  for (int k = 0; k < count; k += 8) other |= (vload8(0, values + k) != values[0]) & (EIGHT + k < count);
  return SOME(other);
}

static inline void rank_places(const scene_t* scene, const uint* at, places_t* places, int count) {
  const bool has_images = has_images_of(scene);
  int order[RANK_ROOM];
#if !IS_VOLUME && FRACTION_BITS == 1
  // All have the same low bits; ways of whole pixels take 16 bits and leave no ties but on one pixel.
  int of_x[RANK_ROOM], of_y[RANK_ROOM];
  for (int i = 0; has_images && i < count; ++i) of_x[i] = own_x(scene, at[i]), of_y[i] = own_y(scene, at[i]);
  const int *const x = has_images ? of_x : places->x, *const y = has_images ? of_y : places->y;
  for (int k = 0; k < count; k += 8) {
    const int8 way_x = (vload8(0, x + k) - x[0]) >> 1, way_y = (vload8(0, y + k) - y[0]) >> 1;
    store_ints(way_y * (1 << 16) + way_x, order + k);
  }
#else
  // By the low bits and the first axis of the tie rule along which places differ, as far as these are enough.
  const bool by_z = IS_VOLUME && differ(places->z, count);
  int of_seeds[RANK_ROOM];  // images, whose seeds' positions decide
  for (int i = 0; has_images && i < count; ++i) of_seeds[i] = by_z ? scene->z[at[i]] : own_y(scene, at[i]);
  const int* const own = has_images ? of_seeds : by_z ? places->z : places->y;
  const int most = 1 << (FAR_BITS - 1), first = own[0];
  for (int k = 0; k < count; k += 8) {
    const int8 way = clamp(sub_sat(vload8(0, own + k), (int8)first), (int8)-most, (int8)(most - 1)) + most;
    store_ints(((vload8(0, places->low + k) - ONE) << FAR_BITS) + way, order + k);
  }
#endif
  int8 sum = 0;
  for (int k = 0; k < count; k += 8) {
    const int8 mine = vload8(0, order + k);
    int8 rank = 0;
    for (int i = 0; i < count; ++i) rank = select(rank, rank + 1, order[i] < mine);
    store_uints(as_uint8(rank), places->rank + k);
    sum += select((int8)0, rank, EIGHT + k < count);
  }
  if (sum_of(sum) != count * (count - 1) / 2) rank_to_the_end(scene, at, places, count);
}

INLINE uint8 look_up(const uint* table, int vectors, uint8 rank) {
  uint8 value = permuted(vload8(0, table), rank & 7u);
#pragma unroll
  for (int t = 1; t < vectors; ++t) {
    value = select(value, permuted(vload8(0, table + 8 * t), rank & 7u), rank >= (uint)(8 * t));
  }
  return value;
}
static inline uint8 look_up_one_by_one(const uint* table, uint8 rank) {
  uint lane[8];
  store_uints(rank, lane);
  for (int i = 0; i < 8; ++i) lane[i] = table[lane[i]];
  return vload8(0, lane);
}

// --- labels ---

static inline size_t index_of(const scene_t* scene, int x, int y, int z) {
  return ((size_t)z * (size_t)scene->size.y + (size_t)y) * (size_t)scene->size.x + (size_t)x;
}
NOINLINE static void show_some(const scene_t* scene, int x, int y, int z, uint8 labels) {
  if (y >= scene->size.y || z >= scene->size.z) return;
  uint lane[8];
  store_uints(labels, lane);
  for (int i = 0; i < 8 && x + i < scene->size.x; ++i) {
    scene->labels[index_of(scene, x + i, y, z)] = has_label(scene, x + i, y, z) ? lane[i] : NO_LABEL;
  }
}
// Eight labels, in one piece if all pixels are known to get one. Others of the grid get none.
static inline void show_eight(const scene_t* scene, bool is_inside, int x, int y, int z, uint8 labels) {
  if (is_inside) {
    ((global unaligned_uints*)(scene->labels + index_of(scene, x, y, z)))->v = labels;
  } else {
    show_some(scene, x, y, z, labels);
  }
}
static inline bool is_inside(const scene_t* scene, box_t b) {
  return has_label(scene, b.x, b.y, b.z) && has_label(scene, b.x + b.sx - 1, b.y + b.sy - 1, b.z + b.sz - 1);
}
// Whether a box of one label is whole lines of an image that no cache is taken to hold.
static inline bool has_lines(const scene_t* scene, box_t b) {
  return b.sx % 16 == 0 && scene->size.x % 16 == 0 && (size_t)scene->labels % BYTES_OF_LINE == 0 &&
         IS_STREAMED(index_of(scene, 0, 0, scene->size.z));
}
NOINLINE static void show_one(const scene_t* scene, box_t b, uint label) {
  const bool inside = is_inside(scene, b), streams = inside && has_lines(scene, b);
  for (int z = b.z; z < min(b.z + b.sz, scene->size.z); ++z) {
    for (int y = b.y; y < min(b.y + b.sy, scene->size.y); ++y) {
      if (streams) {
        global uint16* const lines = (global uint16*)(scene->labels + index_of(scene, b.x, y, z));
        for (int i = 0; i < b.sx / 16; ++i) STREAM((uint16)label, lines + i);
        continue;
      }
      for (int x = b.x; x < b.x + b.sx; x += 8) show_eight(scene, inside, x, y, z, (uint8)label);
    }
  }
}

// Rows of a box stand one after another, slice after slice; eight of them, or four, have their least keys at
// once.
INLINE void label_rows(const scene_t* scene, box_t b, const places_t* places, int count, int bits,
                       const int columns) {
  uint8 of_columns[MOST_OF_KEYS * 2];
  uint of_rows[MOST_OF_KEYS * 8], steps[MOST_OF_KEYS];  // of eight rows, and from them to the next eight
  const uint8 mask = (1u << bits) - 1;
  const bool inside = is_inside(scene, b);
  const size_t row = (size_t)scene->size.x, slice = row * (size_t)scene->size.y;
  global uint* const out = scene->labels + index_of(scene, b.x, b.y, b.z);
  const int vectors = (count + 7) / 8, rows = b.sy * b.sz, shift = 31 - (int)clz((uint)b.sy);
  const uint8 y = (as_uint8(EIGHT) & (uint)(b.sy - 1)) - (uint)(b.sy / 2);
  const uint8 z = (as_uint8(EIGHT) >> (uint)shift) - (uint)(b.sz / 2);
  for (int i = 0; i < count; ++i) {
    const uint from_x = (uint)places->x[i] * SPACING_X, from_y = (uint)places->y[i] * SPACING_Y << bits;
    const uint from_z = IS_VOLUME ? (uint)places->z[i] * SPACING_Z << bits : 0;
#pragma unroll
    for (int q = 0; q < columns; ++q) {
      const uint8 x = as_uint8(EIGHT + (8 * q - 4 * columns));
#if IS_MANHATTAN
      of_columns[i * columns + q] =
          ((places->high[i] + absolute(as_int8(from_x - x * ONE))) << bits) + places->rank[i];
#else
      of_columns[i * columns + q] = ((places->high[i] - x * from_x) << bits) + places->rank[i];
#endif
    }
    store_uints(IS_VOLUME ? 0u - y * from_y - z * from_z : 0u - y * from_y, of_rows + 8 * i);
    steps[i] = IS_VOLUME ? from_z << (3 - shift) : from_y << 3;
  }
  for (int top = 0; top < rows && b.z + (top >> shift) < scene->size.z; top += 8) {
#if IS_MANHATTAN
    for (int i = 0; i < count; ++i) {
      store_uints(absolute(places->y[i] - as_int8(y + (uint)top) * ONE) << bits, of_rows + 8 * i);
    }
#else
    for (int i = 0; top > 0 && i < count; ++i)
      store_uints(vload8(0, of_rows + 8 * i) - steps[i], of_rows + 8 * i);
#endif
    for (int part = 0; part < 8; part += 8 / columns) {
      int8 least[8];
#pragma unroll
      for (int k = 0; k < 8; ++k) least[k] = INT_MAX;
      for (int i = 0; i < count; ++i) {
        const uint* const own = of_rows + 8 * i + part;
        const uint8 left = of_columns[i * columns], right = of_columns[i * columns + columns - 1];
#pragma unroll
        for (int k = 0; k < 8; ++k) {
          least[k] = min(least[k], as_int8((columns == 2 && k % 2 ? right : left) + own[k / columns]));
        }
      }
      uint8 found[8];
#define LOOK_UP(n)                                         \
  _Pragma("unroll") for (int k = 0; k < 8; ++k) found[k] = \
      look_up(places->labels, n, as_uint8(least[k]) & mask)
      switch (vectors) {
        case 1:
          LOOK_UP(1);
          break;
        case 2:
          LOOK_UP(2);
          break;
        case 3:
          LOOK_UP(3);
          break;
        case 4:
          LOOK_UP(4);
          break;
        case 5:
        case 6:
          LOOK_UP(6);
          break;
        default:
#pragma unroll
          for (int k = 0; k < 8; ++k)
            found[k] = look_up_one_by_one(places->labels, as_uint8(least[k]) & mask);
      }
      if (inside) {
#pragma unroll
        for (int k = 0; k < 8; ++k) {
          const int r = top + part + k / columns;
          global uint* const to = out + (size_t)(r & (b.sy - 1)) * row + (size_t)(r >> shift) * slice;
          ((global unaligned_uints*)(to + (columns == 2 ? k % 2 * 8 : 0)))->v = found[k];
        }
      } else {
        for (int k = 0; k < 8; ++k) {
          const int r = top + part + k / columns;
          show_some(scene, b.x + (columns == 2 ? k % 2 * 8 : 0), b.y + (r & (b.sy - 1)), b.z + (r >> shift),
                    found[k]);
        }
      }
    }
  }
}
NOINLINE static void label_rows_of_8(const scene_t* scene, box_t b, const places_t* places, int count,
                                     int bits) {
  label_rows(scene, b, places, count, bits, 1);
}
NOINLINE static void label_rows_of_16(const scene_t* scene, box_t b, const places_t* places, int count,
                                      int bits) {
  label_rows(scene, b, places, count, bits, 2);
}

// By how much the keys of two places of a list differ at a pixel of its box, at most, before ranks.
static inline float spread_of_keys(const list_t* list, int count, box_t b) {
  // From the box's centre to the origin and to any of its pixels it is at most half a side and one along an
  // axis.
  const float4 reach =
      convert_float4((int4)(b.sx / 2 + 1, b.sy / 2 + 1, b.sz / 2 + 1, 0) * SPACINGS) * (2.f * ONE);
  const float4 first = place_in(list, 0);
  float8 most = 0;
  for (int k = 0; k < count; k += 8) {
    const places8_t p = load_from_list(list, k);
    const floats8_t f = floats_of(p);
#if IS_MANHATTAN
    const float8 lead = fabs(f.n - distance_of(first)) + (reach.x + reach.y);
#else
    // |c|^2 less that of the first place is (c - d).(c + d), and the way to a pixel comes on top. Differences of
    // whole numbers: floats of near places keep their digits.
    const float8 x = convert_float8(p.x - list->x[0]), y = convert_float8(p.y - list->y[0]);
    float8 lead = fma(x, f.x + first.x, y * (f.y + first.y)), to_pixels = fma(fabs(x), reach.x, fabs(y) * reach.y);
    float8 terms = fma(fabs(x), fabs(f.x) + fabs(first.x), fabs(y) * (fabs(f.y) + fabs(first.y)));
#if IS_VOLUME
    const float8 z = convert_float8(p.z - list->z[0]);
    lead = fma(z, f.z + first.z, lead), to_pixels = fma(fabs(z), reach.z, to_pixels);
    terms = fma(fabs(z), fabs(f.z) + fabs(first.z), terms);
#endif
    lead = fabs(lead) + to_pixels + terms * 0x1p-20f;
    if (IS_WEIGHTED) lead += lead_of_lags(list, k, 0).terms;
#endif
    most = fmax(most, select(lead, (float8)0, EIGHT + k >= count));
  }
  return -least_float(-most) * (IS_MANHATTAN ? 1 : 1.f / (1 << LOW_BITS)) * (1 + 0x1p-10f) + 4;
}
#define MOST_SPREAD 0x1.fp30f

// |c|^2, and the lag, without 64 bits, from the origin, next to a box's centre: c is whole * 2^FRACTION_BITS
// + rest along each axis.
typedef struct {
  uint8 high, low;
} squares_t;
static inline squares_t squares_of(places8_t p) {
  p = moved(p, (int4)(HALF, HALF, HALF, 0) * SPACINGS);
  const uint8 wx = as_uint8(p.x >> FRACTION_BITS), rx = as_uint8(p.x) & (ONE - 1u);
  const uint8 wy = as_uint8(p.y >> FRACTION_BITS), ry = as_uint8(p.y) & (ONE - 1u);
  uint8 rests = rx * rx + ry * ry, wholes = wx * wx + wy * wy, mixed = wx * rx + wy * ry;
  if (IS_VOLUME) {
    const uint8 wz = as_uint8(p.z >> FRACTION_BITS), rz = as_uint8(p.z) & (ONE - 1u);
    rests += rz * rz, wholes += wz * wz, mixed += wz * rz;
  }
  squares_t squares;
  squares.high = (wholes << (FRACTION_BITS - 1)) + mixed + (rests >> LOW_BITS);
#if IS_WEIGHTED
  squares.high += as_uint8(p.lag);
#endif
  squares.low = rests & ((1u << LOW_BITS) - 1);
  return squares;
}

// Labels a box of which a list has the places, relative to its centre; false if keys do not hold them.
NOINLINE static bool label_by_keys(const scene_t* scene, const list_t* list, int count, box_t b) {
  if (count > MOST_OF_KEYS) return false;
  const int bits = 32 - (int)clz((uint)max(count - 1, 1));
  if (is_inside(scene, b)) {  // the labels' lines come while keys are made
    for (int z = 0; z < b.sz; ++z) {
      for (int y = 0; y < b.sy; ++y) {
        PREFETCH(scene->labels + index_of(scene, b.x, b.y + y, b.z + z));
      }
    }
  }
  if (spread_of_keys(list, count, b) * (float)(1 << bits) >= MOST_SPREAD) return false;
  places_t places;
  uint base = 0;
  for (int k = 0; k < count; k += 8) {
    const places8_t p = load_from_list(list, k);
#if IS_MANHATTAN
    const int8 x = p.x - HALF, y = p.y - HALF;
    const uint8 high = 0, low = 0;
    if (k == 0) base = abs(list->x[0] - HALF) + abs(list->y[0] - HALF);
#else
    const int8 x = p.x - list->x[0], y = p.y - list->y[0];
    const squares_t squares = squares_of(p);
    const uint8 high = squares.high, low = squares.low;
    if (k == 0) base = high.s0;
#endif
    store_ints(x, places.x + k), store_ints(y, places.y + k);
#if IS_VOLUME
    store_ints(p.z - list->z[0], places.z + k);
#endif
    store_uints(high - base, places.high + k);
    store_ints(as_int8(low), places.low + k);
  }
  rank_places(scene, list->at, &places, count);
  for (int i = 0; i < count; ++i) places.labels[places.rank[i]] = scene->ids[list->at[i]];
  if (b.sx == 16) {
    label_rows_of_16(scene, b, &places, count, bits);
  } else {
    label_rows_of_8(scene, b, &places, count, bits);
  }
  return true;
}

// --- more places ---
//
// Keys without ranks, which take as many of the low bits as there is room for. Of eight places at a time the
// least key is taken. Where the first eight and the last eight stand that have the least key of all is kept, and
// which of their places have it is looked up at the end. Of several that do the tie rule decides by the Manhattan
// metric, whose keys are whole distances; else they are compared in 64 bits.

// Keys are those of the origin less so much per pixel; by the Manhattan metric they are distances.
typedef struct {
  uint of_first;
  uint more;  // low bits
#if IS_MANHATTAN
  int own_y[LIST_ROOM], own_x[LIST_ROOM];  // what orders seeds
  uint id[LIST_ROOM];
#else
  uint high[LIST_ROOM];
  uint x[LIST_ROOM], y[LIST_ROOM], z[LIST_ROOM];  // what keys lose from pixel to pixel
#endif
} keys_t;

// The keys of eight places at a pixel, which is so far from that of the origin.
static inline int8 keys_at(const list_t* list, const keys_t* keys, int k, int x, int y, int z) {
#if IS_MANHATTAN
  (void)z;
  return as_int8(absolute(vload8(0, list->x + k) - HALF - x * ONE) +
                 absolute(vload8(0, list->y + k) - HALF - y * ONE) - keys->of_first);
#else
  (void)list;
  uint8 own = vload8(0, keys->high + k) - vload8(0, keys->x + k) * (uint)x - vload8(0, keys->y + k) * (uint)y;
  if (IS_VOLUME) own -= vload8(0, keys->z + k) * (uint)z;
  return as_int8(own);
#endif
}

// Which of the places wins that have the key at a pixel of a box, which is so far from the origin; they stand in the
// eights from the first to the last. By the Manhattan metric there may be hundreds, as near as each other.
static inline uint first_of_ties(const scene_t* scene, const list_t* list, const keys_t* keys, int count, box_t b,
                                 int first, int last, int key, int x, int y, int z) {
#if IS_MANHATTAN
  (void)b;
  int8 best_y = INT_MAX, best_x = INT_MAX;
  uint8 best_id = UINT_MAX, place = NO_PLACE;
  for (int k = first; k <= last; k += 8) {
    const int8 own_y = vload8(0, keys->own_y + k), own_x = vload8(0, keys->own_x + k);
    const uint8 id = vload8(0, keys->id + k);
    int8 wins = (own_x < best_x) | ((own_x == best_x) & (id < best_id));
    wins = (own_y < best_y) | ((own_y == best_y) & wins);
    wins &= (keys_at(list, keys, k, x, y, z) == key) & (EIGHT + k < count);
    best_y = select(best_y, own_y, wins), best_x = select(best_x, own_x, wins);
    best_id = select(best_id, id, as_uint8(wins)), place = select(place, vload8(0, list->at + k), as_uint8(wins));
  }
  uint lane[8], best = NO_PLACE;
  store_uints(place, lane);
  for (int i = 0; i < 8; ++i) {
    if (lane[i] == NO_PLACE || lane[i] == best) continue;
    if (best == NO_PLACE || comes_first(scene, lane[i], best)) best = lane[i];
  }
#else
  uint best = NO_PLACE;
  for (int k = first; k <= last; k += 8) {
    uint mask = mask_of((keys_at(list, keys, k, x, y, z) == key) & (EIGHT + k < count));
    for (; mask != 0; mask &= mask - 1) {
      const uint at = list->at[k + (int)lowest_bit(mask)];
      const int4 pixel = (int4)(b.x + b.sx / 2 + x, b.y + b.sy / 2 + y, b.z + b.sz / 2 + z, 0);
      if (best == NO_PLACE || is_nearer(scene, pixel.x, pixel.y, pixel.z, at, best)) best = at;
    }
  }
#endif
  return best;
}

// Finds the places that win at the pixels of a box of eight columns, pixel by pixel; false if keys do not
// hold them.
#define ROWS 8  // of a part, at once
#define ROWS_OF_SLICE (IS_VOLUME ? 4 : 8)
NOINLINE static bool find_by_keys(const scene_t* scene, const list_t* list, int count, box_t b, uint* found) {
  const float spread = spread_of_keys(list, count, b);
  if (spread >= MOST_SPREAD) return false;
  keys_t keys;
#if IS_MANHATTAN
  keys.of_first = abs(list->x[0] - HALF) + abs(list->y[0] - HALF), keys.more = 0;
  for (int i = 0; i < count; ++i) {
    const uint at = list->at[i];
    keys.own_y[i] = own_y(scene, at), keys.own_x[i] = own_x(scene, at), keys.id[i] = scene->ids[at];
  }
#else
  keys.more = (uint)min(ilogb(MOST_SPREAD / spread), LOW_BITS);
  for (int k = 0; k < count; k += 8) {
    const places8_t p = load_from_list(list, k);
    const squares_t squares = squares_of(p);
    const uint8 high = squares.high << keys.more | squares.low >> (LOW_BITS - keys.more);
    if (k == 0) keys.of_first = high.s0;
    store_uints(high - keys.of_first, keys.high + k);
    store_uints(as_uint8(p.x - list->x[0]) * SPACING_X << keys.more, keys.x + k);
    store_uints(as_uint8(p.y - list->y[0]) * SPACING_Y << keys.more, keys.y + k);
#if IS_VOLUME
    store_uints(as_uint8(p.z - list->z[0]) * SPACING_Z << keys.more, keys.z + k);
#endif
  }
#endif
  const uint8 columns = as_uint8(EIGHT - 4);
  for (int row = 0; row < b.sy * b.sz; row += ROWS) {
    const int y = row % b.sy - b.sy / 2, z = row / b.sy - b.sz / 2;
    int8 least[ROWS], first[ROWS], last[ROWS];  // and the first and the last eight that have it
#pragma unroll
    for (int r = 0; r < ROWS; ++r) least[r] = INT_MAX, first[r] = last[r] = 0;
    for (int k = 0; k < count; k += 8) {
      int8 least_of_eight[ROWS];
#pragma unroll
      for (int r = 0; r < ROWS; ++r) least_of_eight[r] = INT_MAX;
      for (int i = k; i < min(k + 8, count); ++i) {
#if IS_MANHATTAN
        const uint8 of_columns = absolute(list->x[i] - HALF - as_int8(columns) * ONE) - keys.of_first;
#else
        const uint from_y = keys.y[i], from_z = IS_VOLUME ? keys.z[i] : 0;
        uint8 of_slice = keys.high[i] - (uint)y * from_y - (IS_VOLUME ? (uint)z * from_z : 0) - columns * keys.x[i];
        uint8 own = of_slice;
#endif
#pragma unroll
        for (int r = 0; r < ROWS; ++r) {
#if IS_MANHATTAN
          const uint8 own = of_columns + abs(list->y[i] - HALF - (y + r) * ONE);
#endif
          least_of_eight[r] = min(least_of_eight[r], as_int8(own));
#if !IS_MANHATTAN
          if (r % ROWS_OF_SLICE < ROWS_OF_SLICE - 1) {
            own -= from_y;
          } else {
            own = of_slice -= from_z;
          }
#endif
        }
      }
#pragma unroll
      for (int r = 0; r < ROWS; ++r) {
        first[r] = select(first[r], (int8)k, least_of_eight[r] < least[r]);
        last[r] = select(last[r], (int8)k, least_of_eight[r] <= least[r]);
        least[r] = min(least[r], least_of_eight[r]);
      }
    }
    for (int r = 0; r < ROWS; ++r) {
      int lane[8], from[8], to[8];
      store_ints(least[r], lane), store_ints(first[r], from), store_ints(last[r], to);
      for (int i = 0; i < 8; ++i) {
        found[(row + r) * 8 + i] = first_of_ties(scene, list, &keys, count, b, from[i], to[i], lane[i], i - 4,
                                                 y + r % ROWS_OF_SLICE, z + r / ROWS_OF_SLICE);
      }
    }
  }
  return true;
}

// Finds the places that win at the pixels of a box of eight columns.
static inline void find_winners(const scene_t* scene, const list_t* list, int count, box_t b, uint* found) {
  if (find_by_keys(scene, list, count, b, found)) return;
  for (int i = 0; i < b.sx * b.sy * b.sz; ++i) {
    found[i] = nearest_at(scene, b, list, count, b.x + i % 8, b.y + i / 8 % b.sy, b.z + i / 8 / b.sy);
  }
}

#endif
