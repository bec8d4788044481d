// The nearest of a short list at each pixel of a box, by keys of 32 bits: one addition and one minimum per place and
// vector of pixels.
//
// KEYS. With the origin at a pixel centre, a place c in units of 2^-F pixels (F: FRACTION_BITS) and a pixel p in whole
// pixels, |c - p|^2 less |p|^2, which is the same for all places, is |c|^2 - 2^(F + 1) p.c. The low F + 1 bits of it
// are those of |c|^2 at every pixel. They go into the RANK of a place: its number in the order of (these bits, y, x,
// id). A key is the other bits, and below them the rank. The least key is that of the nearest seed, by the tie rule of
// design: the first in the order (y, x) of its position in the grid, then that of the lowest id.
// By the Manhattan metric a key is the distance, less that of one place from the box's centre, and the rank.

#ifndef VOROCL_POINTS_KEYS
#define VOROCL_POINTS_KEYS

#include "exact/points/gather.cl"

#ifndef MOST_OF_KEYS
#define MOST_OF_KEYS 128
#endif
#define RANK_ROOM (MOST_OF_KEYS + LANES_OF_POINTS)
#define LOW_BITS (FRACTION_BITS + 1)
#define Y_BITS (32 - LOW_BITS)  // of the difference of two coordinates beside them

#if 2 * FRACTION_BITS + 2 > 31
#error "The sum of two squared fractions must fit in 31 bits"
#endif

// The places of a list, exactly: units from the origin, and what orders them.
typedef struct {
  int x[RANK_ROOM], y[RANK_ROOM];
  uint high[RANK_ROOM];  // Euclidean: |c|^2 >> LOW_BITS
  int low[RANK_ROOM];    // Euclidean: its low bits; Manhattan: 0
  uint rank[RANK_ROOM];
  uint values[RANK_ROOM];  // by rank: what is written for a place
} places_t;

// A place of the list from the centre that the list is relative to, in units: its floats say which image of it.
static inline int unwrapped(int way, float pixels, int size, int periodic) {
  if (!periodic) return way;
  const float periods = (pixels * ONE_PIXEL - (float)way) / ((float)size * ONE_PIXEL);
  return way + convert_int_rte(periods) * size * ONE_PIXEL;
}
static inline int2 way_to(const scene_t* scene, const list_t* list, int i, int2 centre) {
  const int2 way = scene->list[list->at[i]] - centre;
  return (int2)(unwrapped(way.x, list->x[i], scene->width, PERIODIC_X),
                unwrapped(way.y, list->y[i], scene->height, PERIODIC_Y));
}

// Ranks where the order by low bits and near rows leaves ties. Images of one seed stand in the order of the list.
NOINLINE static void rank_to_the_end(const scene_t* scene, const uint* at, places_t* places, int count) {
  for (int i = 0; i < count; ++i) {
    uint rank = 0;
    for (int j = 0; j < count; ++j) {
      const int way = places->low[j] - places->low[i];
      rank += way < 0 || (way == 0 && (j < i ? !comes_first(scene, at[i], at[j]) : comes_first(scene, at[j], at[i])));
    }
    places->rank[i] = rank;
  }
}

// Ranks the places, and says which labels the ranks have. Two places of one seed, which are images, have two ranks.
static inline void rank_places(const scene_t* scene, const list_t* list, int from, places_t* places, int count) {
  int order[RANK_ROOM];
  const uint* const at = list->at + from;
  const int first_y = own_position(scene, at[0]).y;
  const int most = 1 << (Y_BITS - 1);
  for (int i = 0; i < count; ++i) {
    const int way = clamp(sub_sat(own_position(scene, at[i]).y, first_y), -most, most - 1);
    order[i] = (int)(((uint)places->low[i] << Y_BITS) + (uint)(way + most)) ^ INT_MIN;
  }
  int8 sum = 0;
  for (int k = 0; k < count; k += 8) {
    const int8 own = vload8(0, order + k);
    int8 rank = 0;
    for (int i = 0; i < count; ++i) rank -= (int8)order[i] < own;
    vstore8(as_uint8(rank), 0, places->rank + k);
    sum += select((int8)0, rank, EIGHT + k < count);
  }
  const int4 half_sums = sum.lo + sum.hi;
  const bool has_ties = half_sums.x + half_sums.y + half_sums.z + half_sums.w != count * (count - 1) / 2;
  if (has_ties) rank_to_the_end(scene, at, places, count);
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

NOINLINE static void look_up_many(const uint* table, uint8 mask, const int8* keys, uint8* values) {
  for (int k = 0; k < 8; ++k) {
    uint lane[8];
    vstore8(as_uint8(keys[k]) & mask, 0, lane);
    for (int i = 0; i < 8; ++i) lane[i] = table[lane[i]];
    values[k] = vload8(0, lane);
  }
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
  NOINLINE static void name(const places_t* places, int count, int bits, uint base, uint* out, int stride) {       \
    uint8 columns[MOST_OF_KEYS * (SIDE / 8)];                                                                       \
    uint rows[MOST_OF_KEYS * 8];                                                                                    \
    const uint8 mask = (1u << bits) - 1;                                                                           \
    for (int i = 0; i < count; ++i) {                                                                              \
      for (int q = 0; q < SIDE / 8; ++q) {                                                                         \
        columns[i * (SIDE / 8) + q] = key_of_columns(places, i, 8 * q - SIDE / 2, bits, base);                     \
      }                                                                                                            \
    }                                                                                                              \
    for (int top = 0; top < SIDE; top += 8) {                                                                      \
      for (int i = 0; i < count; ++i) vstore8(key_of_rows(places, i, top - SIDE / 2, bits), 0, rows + 8 * i);      \
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
          default: look_up_many(places->values, mask, keys, found);                                                \
        }                                                                                                          \
        _Pragma("unroll") for (int k = 0; k < 8; ++k) {                                                            \
          const int y = top + part + (SIDE == 16 ? k / 2 : k), x = SIDE == 16 ? k % 2 * 8 : 0;                     \
          vstore8(found[k], 0, out + y * stride + x);                                                              \
        }                                                                                                          \
      }                                                                                                            \
    }                                                                                                              \
  }
DEFINE_FIND_BY_KEYS(find_8_by_keys, 8)
DEFINE_FIND_BY_KEYS(find_16_by_keys, 16)

// Whether keys of so many rank bits hold what can be found in a list: differences of distances from all pixels of the
// box. `reach`: no place is farther along an axis from a pixel. `base` is the place that is subtracted, of this part of
// the list; -1: none.
static inline bool keys_hold(const list_t* list, int from, int count, float w, float reach, int bits, int* base) {
  const float ranks = (float)(1 << bits);
#ifdef VOROCL_EUCLIDEAN
  const float of_unit = (float)(1 << (2 * FRACTION_BITS - LOW_BITS));
  *base = -1;
  if ((2 * reach * reach * of_unit + 2) * ranks < 0x1.fp30f) return true;
  *base = nearest_to(list->x + from, list->y + from, count, 0, 0);
  const rival_t rival = rival_of(list, from + *base);
  float8 most = 0;
  for (int k = 0; k < count; k += 8) {
    const float8 x = vload8(0, list->x + from + k), y = vload8(0, list->y + from + k), along = fma(x, x, y * y);
    const float8 lag = fabs(along - rival.along) + (along + rival.along) * 0x1p-19f +
                       (fabs(x - rival.x) + fabs(y - rival.y)) * (w + 2);
    most = max(most, select(lag, (float8)0, EIGHT + k >= count));
  }
  const float4 halves = max(most.lo, most.hi);
  const float greatest = fmax(fmax(halves.x, halves.y), fmax(halves.z, halves.w));
  return (greatest + 8) * of_unit * ranks < 0x1.fp30f;
#else
  (void)w;
  (void)reach;
  // What may win is at most twice the box's ways farther than the place nearest to the centre.
  *base = nearest_to(list->x + from, list->y + from, count, 0, 0);
  return 256.f * ONE_PIXEL * ranks < 0x1.fp30f;
#endif
}

// What is written for a place: the id of its seed, or its number in the list.
typedef enum { IDS, NUMBERS } values_t;

// Finds the nearest at each pixel of a box of 8 or 16 pixels a side, of `count` places of a list relative to its
// centre, from the number `from` on; false if keys do not hold them.
NOINLINE static bool find_by_keys(const scene_t* scene, const list_t* list, int from, int count, int2 centre, int side,
                                  float reach, values_t values, uint* out, int stride) {
  if (count == 1) {
    const uint8 value = values == IDS ? scene->ids[list->at[from]] : (uint)from;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; x += 8) vstore8(value, 0, out + y * stride + x);
    }
    return true;
  }
  if (count > MOST_OF_KEYS) return false;
  const int bits = 32 - (int)clz((uint)count - 1);
  int base;
  if (!keys_hold(list, from, count, (float)(side - 1), reach, bits, &base)) return false;

  places_t places;
  for (int i = 0; i < count; ++i) {
    const int2 way = way_to(scene, list, from + i, centre) - HALF_PIXEL;
    places.x[i] = way.x;
    places.y[i] = way.y;
  }
  for (int k = 0; k < count; k += 8) {
#ifdef VOROCL_EUCLIDEAN
    // |c|^2 without 64 bits: c is whole * 2^F + rest along each axis.
    const int8 x = vload8(0, places.x + k), y = vload8(0, places.y + k);
    const uint8 whole_x = as_uint8(x >> FRACTION_BITS), whole_y = as_uint8(y >> FRACTION_BITS);
    const uint8 rest_x = as_uint8(x) & (ONE_PIXEL - 1u), rest_y = as_uint8(y) & (ONE_PIXEL - 1u);
    const uint8 rests = rest_x * rest_x + rest_y * rest_y;
    vstore8(((whole_x * whole_x + whole_y * whole_y) << (FRACTION_BITS - 1)) + whole_x * rest_x + whole_y * rest_y +
                (rests >> LOW_BITS),
            0, places.high + k);
    vstore8(as_int8(rests & ((1u << LOW_BITS) - 1)), 0, places.low + k);
#else
    vstore8((int8)0, 0, places.low + k);
#endif
  }
  rank_places(scene, list, from, &places, count);
  for (int i = 0; i < count; ++i) {
    places.values[places.rank[i]] = values == IDS ? scene->ids[list->at[from + i]] : (uint)(from + i);
  }
  uint subtracted = 0;
#ifdef VOROCL_EUCLIDEAN
  if (base >= 0) {
    const int base_x = places.x[base], base_y = places.y[base];
    subtracted = places.high[base];
    for (int i = 0; i < count; ++i) {
      places.x[i] -= base_x;
      places.y[i] -= base_y;
    }
  }
#else
  subtracted = abs(places.x[base]) + abs(places.y[base]);
#endif
  if (side == 8) {
    find_8_by_keys(&places, count, bits, subtracted, out, stride);
  } else {
    find_16_by_keys(&places, count, bits, subtracted, out, stride);
  }
  return true;
}

#endif
