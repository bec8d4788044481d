// The nearest of a short list at each pixel of a box, by keys of 32 bits: one addition and one minimum per place and
// vector of pixels.
//
// KEYS. With the origin at a pixel centre, a place c in units of 2^-F pixels (F: FRACTION_BITS) and a pixel p in whole
// pixels, |c - p|^2 less |p|^2, which is the same for all places, is |c|^2 - 2^(F + 1) p.c. The low F + 1 bits of it
// are those of |c|^2 at every pixel. They go into the RANK of a place: its number in the order of (these bits, y, x,
// id). A key is the other bits, and below them the rank. The least key is that of the nearest seed, by the tie rule of
// design: the first in the order (y, x) of its position in the grid, then that of the lowest id.
// By the Manhattan metric a key is the distance, less that of one place from the box's centre, and the rank.

#ifndef VOROCL_EXACT_KEYS
#define VOROCL_EXACT_KEYS

#include "exact/gather.cl"

#ifndef MOST_OF_KEYS
#define MOST_OF_KEYS 128
#endif
#define RANK_ROOM (MOST_OF_KEYS + LANES_OF_POINTS)
#define LOW_BITS (FRACTION_BITS + 1)
#define Y_BITS (32 - LOW_BITS)  // of the difference of two coordinates beside them

#if SIDE_BITS > 15
#error "What orders seeds at the centres of pixels does not fit in an int"
#endif
#if 2 * FRACTION_BITS + 2 > 31
#error "The sum of two squared fractions must fit in 31 bits"
#endif

// The places of a list, exactly: units from the origin, and what orders them.
typedef struct {
  int x[RANK_ROOM], y[RANK_ROOM];
  uint high[RANK_ROOM];  // Euclidean: |c|^2 >> LOW_BITS
  int low[RANK_ROOM];    // Euclidean: its low bits, in order; Manhattan: 0
  uint rank[RANK_ROOM];
  uint values[RANK_ROOM];  // by rank: what is written for a place
} places_t;

// Ranks where the order by low bits and near rows leaves ties, by places of which `x` and `y` have the order. Images of
// one seed stand in the order of the list.
NOINLINE static void rank_to_the_end(const scene_t* scene, const uint* at, const int* x, const int* y, places_t* places,
                                     int count) {
  uint id[RANK_ROOM];
  for (int i = 0; i < count; ++i) id[i] = scene->ids[at[i]];
  for (int k = 0; k < count; k += 8) {
    const int8 own_low = vload8(0, places->low + k), own_y = vload8(0, y + k), own_x = vload8(0, x + k);
    const uint8 own_id = vload8(0, id + k);
    int8 rank = 0;
    for (int i = 0; i < count; ++i) {
      const int8 by_id = (id[i] < own_id) | ((id[i] == own_id) & (i < EIGHT + k));
      const int8 by_x = (x[i] < own_x) | ((x[i] == own_x) & by_id);
      const int8 by_y = (y[i] < own_y) | ((y[i] == own_y) & by_x);
      const int8 comes_before = (places->low[i] < own_low) | ((places->low[i] == own_low) & by_y);
      rank = select(rank, rank + 1, comes_before);
    }
    store_uints(as_uint8(rank), places->rank + k);
  }
}

// Ranks the places. Two places of one seed, which are images, have two ranks.
static inline void rank_places(const scene_t* scene, const uint* at, places_t* places, int count) {
  int own_x[RANK_ROOM], own_y[RANK_ROOM];
  const int *x = places->x, *y = places->y;
  if (PERIODIC_X || PERIODIC_Y || scene->order) {  // images, whose seeds' positions decide
    for (int i = 0; i < count; ++i) {
      const int2 own = own_position(scene, at[i]);
      own_x[i] = own.x;
      own_y[i] = own.y;
    }
    x = own_x;
    y = own_y;
  }
  int order[RANK_ROOM];
#ifdef VOROCL_FRACTIONS
  const int most = 1 << (Y_BITS - 1), first_y = y[0];
  for (int k = 0; k < count; k += 8) {
    const int8 way = clamp(sub_sat(vload8(0, y + k), (int8)first_y), (int8)-most, (int8)(most - 1)) + most;
    store_ints((vload8(0, places->low + k) << Y_BITS) + way, order + k);
  }
#else
  // All have the same low bits; ways of whole pixels take 16 bits and leave no ties but on one pixel.
  const int first_x = x[0], first_y = y[0];
  for (int k = 0; k < count; k += 8) {
    const int8 way_x = (vload8(0, x + k) - first_x) >> 1, way_y = (vload8(0, y + k) - first_y) >> 1;
    store_ints(way_y * (1 << 16) + way_x, order + k);
  }
#endif
  int8 sum = 0;
  for (int k = 0; k < count; k += 8) {
    const int8 own = vload8(0, order + k);
    int8 rank = 0;
    for (int i = 0; i < count; ++i) rank = select(rank, rank + 1, order[i] < own);
    store_uints(as_uint8(rank), places->rank + k);
    sum += select((int8)0, rank, EIGHT + k < count);
  }
  const int4 half_sums = sum.lo + sum.hi;
  const bool has_ties = half_sums.x + half_sums.y + half_sums.z + half_sums.w != count * (count - 1) / 2;
  if (has_ties) rank_to_the_end(scene, at, x, y, places, count);
}

// A table of up to 8 x `vectors` values at vectors of ranks.
static inline __attribute__((always_inline)) void look_up_values(const uint* table, int vectors, uint8 mask,
                                                                 const int8* keys, uint8* values) {
#pragma unroll
  for (int k = 0; k < 8; ++k) {
    const uint8 rank = as_uint8(keys[k]) & mask;
    uint8 value = permuted(vload8(0, table), rank & 7u);
#pragma unroll
    for (int t = 1; t < vectors; ++t) {
      value = select(value, permuted(vload8(0, table + 8 * t), rank & 7u), rank >= (uint)(8 * t));
    }
    values[k] = value;
  }
}

static inline uint8 look_up_one_by_one(const uint* table, uint8 rank) {
  uint lane[8];
  store_uints(rank, lane);
  for (int i = 0; i < 8; ++i) lane[i] = table[lane[i]];
  return vload8(0, lane);
}

// The parts of a place's key that its column and its row give, for the pixels of a box whose centre is the corner of
// four pixels; the origin is the centre of that on the lower right.
static inline uint8 key_of_columns(const places_t* places, int i, int first, int bits, uint base) {
#ifdef VOROCL_EUCLIDEAN
  return ((places->high[i] - base) << bits) + places->rank[i] - (as_uint8(EIGHT + first) * (uint)places->x[i] << bits);
#else
  return ((abs(places->x[i] - (EIGHT + first) * ONE_PIXEL) - base) << bits) + places->rank[i];
#endif
}
static inline uint8 key_of_rows(const places_t* places, int i, int first, int bits) {
#ifdef VOROCL_EUCLIDEAN
  return 0u - (as_uint8(EIGHT + first) * (uint)places->y[i] << bits);
#else
  return abs(places->y[i] - (EIGHT + first) * ONE_PIXEL) << bits;
#endif
}

// Writes the values of the nearest places of a box of SIDE x SIDE pixels.
#define DEFINE_FIND_BY_KEYS(name, SIDE)                                                                           \
  NOINLINE static void name(const places_t* places, int count, int bits, uint base, uint* out) {                   \
    uint8 columns[MOST_OF_KEYS * (SIDE / 8)];                                                                       \
    uint rows[MOST_OF_KEYS * 8];                                                                                    \
    const uint8 mask = (1u << bits) - 1;                                                                           \
    for (int i = 0; i < count; ++i) {                                                                              \
      _Pragma("unroll") for (int q = 0; q < SIDE / 8; ++q) {                                                       \
        columns[i * (SIDE / 8) + q] = key_of_columns(places, i, 8 * q - SIDE / 2, bits, base);                     \
      }                                                                                                            \
    }                                                                                                              \
    for (int top = 0; top < SIDE; top += 8) {                                                                      \
      for (int i = 0; i < count; ++i) store_uints(key_of_rows(places, i, top - SIDE / 2, bits), rows + 8 * i);      \
      for (int part = 0; part < 8; part += 64 / SIDE) {                                                            \
        int8 a = INT_MAX, b = a, c = a, d = a, e = a, f = a, g = a, h = a;                                         \
        for (int i = 0; i < count; ++i) {                                                                          \
          const uint* const row = rows + 8 * i + part;                                                             \
          const uint8 left = columns[i * (SIDE / 8)];                                                              \
          if (SIDE == 16) {                                                                                        \
            const uint8 right = columns[i * (SIDE / 8) + SIDE / 8 - 1];                                            \
            a = min(a, as_int8(left + row[0])), b = min(b, as_int8(right + row[0]));                               \
            c = min(c, as_int8(left + row[1])), d = min(d, as_int8(right + row[1]));                               \
            e = min(e, as_int8(left + row[2])), f = min(f, as_int8(right + row[2]));                               \
            g = min(g, as_int8(left + row[3])), h = min(h, as_int8(right + row[3]));                               \
          } else {                                                                                                 \
            a = min(a, as_int8(left + row[0])), b = min(b, as_int8(left + row[1]));                                \
            c = min(c, as_int8(left + row[2])), d = min(d, as_int8(left + row[3]));                                \
            e = min(e, as_int8(left + row[4])), f = min(f, as_int8(left + row[5]));                                \
            g = min(g, as_int8(left + row[6])), h = min(h, as_int8(left + row[7]));                                \
          }                                                                                                        \
        }                                                                                                          \
        const int8 keys[8] = {a, b, c, d, e, f, g, h};                                                             \
        uint8 found[8];                                                                                            \
        switch ((count + 7) / 8) {                                                                                 \
          case 1: look_up_values(places->values, 1, mask, keys, found); break;                                     \
          case 2: look_up_values(places->values, 2, mask, keys, found); break;                                     \
          case 3: look_up_values(places->values, 3, mask, keys, found); break;                                     \
          case 4: look_up_values(places->values, 4, mask, keys, found); break;                                     \
          case 5:                                                                                                  \
          case 6: look_up_values(places->values, 6, mask, keys, found); break;                                     \
          case 7:                                                                                                  \
          case 8: look_up_values(places->values, 8, mask, keys, found); break;                                     \
          default:                                                                                                 \
            _Pragma("unroll") for (int k = 0; k < 8; ++k) {                                                        \
              found[k] = look_up_one_by_one(places->values, as_uint8(keys[k]) & mask);                              \
            }                                                                                                      \
        }                                                                                                          \
        _Pragma("unroll") for (int k = 0; k < 8; ++k) {                                                            \
          const int y = top + part + (SIDE == 16 ? k / 2 : k), x = SIDE == 16 ? k % 2 * 8 : 0;                     \
          store_uints(found[k], out + y * SIDE + x);                                                                \
        }                                                                                                          \
      }                                                                                                            \
    }                                                                                                              \
  }
DEFINE_FIND_BY_KEYS(find_8_by_keys, 8)
DEFINE_FIND_BY_KEYS(find_16_by_keys, 16)

// Whether keys of so many rank bits hold what can be found in a list: differences of distances from all pixels of the
// box. `reach`: no place is farther along an axis from a pixel. `is_relative`: less those of the list's first place.
static inline bool keys_hold(const list_t* list, int from, int count, int side, float reach, int bits,
                             bool* is_relative) {
  const float most = 0x1.fp30f / (float)(1 << bits);
#ifdef VOROCL_EUCLIDEAN
  const float of_square = (float)(1 << (2 * FRACTION_BITS - LOW_BITS));
  *is_relative = 2 * reach * reach * of_square + 2 >= most;
  if (!*is_relative) return true;
  const float first_x = (float)list->x[from], first_y = (float)list->y[from];
  float8 greatest = 0;
  for (int k = 0; k < count; k += 8) {
    float8 x, y;
    load_floats(list, from + k, &x, &y);
    const float8 way_x = fabs(x - first_x), way_y = fabs(y - first_y);
    const float8 lag = fma(way_x, fabs(x + first_x), way_y * fabs(y + first_y)) * (1.f / (1 << LOW_BITS)) +
                       (way_x + way_y) * (float)(side / 2 + 1);
    greatest = max(greatest, select(lag, (float8)0, EIGHT + k >= count));
  }
  const float4 halves = max(greatest.lo, greatest.hi);
  return fmax(fmax(halves.x, halves.y), fmax(halves.z, halves.w)) < most;
#else
  (void)list;
  (void)from;
  (void)count;
  (void)side;
  (void)reach;
  // What may win in a box is at most twice the box's ways nearer or farther than another place that may.
  *is_relative = true;
  return 256.f * ONE_PIXEL < most;
#endif
}

// What is written for a place: the id of its seed, or where it stands in the index.
typedef enum { IDS, PLACES } values_t;

// Finds the nearest at each pixel of a box of 8 or 16 pixels a side, of `count` places of a list relative to its
// centre, from the number `from` on; false if keys do not hold them.
NOINLINE static bool find_by_keys(const scene_t* scene, const list_t* list, int from, int count, int side, float reach,
                                  values_t values, uint* out) {
  const uint* const at = list->at + from;
  if (count > MOST_OF_KEYS) return false;
  const int bits = 32 - (int)clz((uint)max(count - 1, 1));
  bool is_relative;
  if (!keys_hold(list, from, count, side, reach, bits, &is_relative)) return false;

  places_t places;
  for (int k = 0; k < count; k += 8) {
    const int8 x = vload8(0, list->x + from + k) - HALF_PIXEL, y = vload8(0, list->y + from + k) - HALF_PIXEL;
    store_ints(x, places.x + k);
    store_ints(y, places.y + k);
#ifdef VOROCL_EUCLIDEAN
    // |c|^2 without 64 bits: c is whole * 2^F + rest along each axis.
    const uint8 whole_x = as_uint8(x >> FRACTION_BITS), whole_y = as_uint8(y >> FRACTION_BITS);
    const uint8 rest_x = as_uint8(x) & (ONE_PIXEL - 1u), rest_y = as_uint8(y) & (ONE_PIXEL - 1u);
    const uint8 rests = rest_x * rest_x + rest_y * rest_y;
    store_uints(((whole_x * whole_x + whole_y * whole_y) << (FRACTION_BITS - 1)) + whole_x * rest_x + whole_y * rest_y +
                (rests >> LOW_BITS), places.high + k);
    store_ints(as_int8(rests & ((1u << LOW_BITS) - 1)) - (1 << (LOW_BITS - 1)), places.low + k);
#else
    store_ints((int8)0, places.low + k);
#endif
  }
  rank_places(scene, at, &places, count);
  for (int i = 0; i < count; ++i) places.values[places.rank[i]] = values == IDS ? scene->ids[at[i]] : at[i];
  uint subtracted = 0;
#ifdef VOROCL_EUCLIDEAN
  if (is_relative) {
    const int first_x = places.x[0], first_y = places.y[0];
    subtracted = places.high[0];
    for (int k = 0; k < count; k += 8) {
      store_ints(vload8(0, places.x + k) - first_x, places.x + k);
      store_ints(vload8(0, places.y + k) - first_y, places.y + k);
    }
  }
#else
  subtracted = abs(places.x[0]) + abs(places.y[0]);
#endif
  if (side == 8) {
    find_8_by_keys(&places, count, bits, subtracted, out);
  } else {
    find_16_by_keys(&places, count, bits, subtracted, out);
  }
  return true;
}

#endif
