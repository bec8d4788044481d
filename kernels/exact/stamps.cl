// Dense places: an image of keys of a tile, into which each place of the tile and around it takes minima,
// `side` rows by `side` rows, one or two vectors each. The `side` pixels of an axis that are nearest to a
// place hold all pixel centres that are less than side / 2 away, so a pixel whose least distance is below
// that is done, whatever has a lag of that or more. Others are searched.
//
// Keys are as in keys.cl, with the origin of each place at the first pixel of its stamp: that moves by whole
// pixels, so the low bits of |c|^2 stay, and |p|^2 is added, so that keys of places with other origins
// compare.

#ifndef VOROCL_EXACT_STAMPS
#define VOROCL_EXACT_STAMPS

#include "exact/keys.cl"

#define STAMP_PAD 16
#define STAMP_SIDE (IS_VOLUME ? SIDE_OF_VOLUME : SIDE_OF_PLANE)  // of the image
#define STAMP_ROW (STAMP_SIDE + STAMP_PAD)  // what sticks out at the left lies behind the row before
#define SLICE_PAD 16
#define STAMP_SLICE \
  (STAMP_ROW * STAMP_SIDE + SLICE_PAD)  // no multiple of 4096 bytes: stores would wait for each other
#define STAMP_SLICES (IS_VOLUME ? STAMP_SIDE : 1)
#ifndef MOST_STAMPS
#define MOST_STAMPS 12288
#endif
#define STAMP_ROOM (MOST_STAMPS + 16)
#define MOST_STAMP_SIDE (IS_VOLUME ? 12 : 14)
#define NO_KEY 0xffffffffu  // in the image
#define LEFT_PART 32        // a tile of which a greater part is left by its stamps is left to lists
#define SORT_BITS 12
#define SORT_BUCKETS (1 << SORT_BITS)

typedef struct {
  int x[STAMP_ROOM], y[STAMP_ROOM];  // units from the tile's corner; then from the first pixel's centre
  int first_y[STAMP_ROOM];           // first pixels, from the tile's corner
#if IS_VOLUME
  int z[STAMP_ROOM], first_z[STAMP_ROOM];
#endif
  int offset[STAMP_ROOM];  // of the first pixel in the image
  uint high[STAMP_ROOM];   // the lag; then that and |c|^2 without its low bits
  int low[STAMP_ROOM];
  int along[STAMP_ROOM];  // own positions along the first axis of the tie rule
  uint at[STAMP_ROOM];
  uint labels[STAMP_ROOM];  // by rank
  uint rank[STAMP_ROOM];
  ulong order[STAMP_ROOM];
  uint image[STAMP_SLICE * STAMP_SLICES];
} stamps_t;

// The first of the `side` pixels of an axis that are nearest to a place.
#define FIRST_OF(place, side) ((((place) + ((side) % 2 ? 0 : HALF)) >> FRACTION_BITS) - (side) / 2)

// (side / 2)^2 without the low bits, rounded up.
static inline uint limit_of(int side) { return ((uint)(side * side << FRACTION_BITS) + 7) / 8; }

#define OVERFLOW (-1)
// The seeds whose stamps meet the tile; OVERFLOW if there are too many.
NOINLINE static int gather_stamps(const scene_t* scene, box_t tile, int side, stamps_t* s) {
  const int m = side / 2 + 1;
  const cuboid_t limits = limits_around(scene, tile);
  walk_t walk = walk_over(scene, clamped(span_of(tile.x - m, tile.x + tile.sx - 1 + m), limits.x),
                          clamped(span_of(tile.y - m, tile.y + tile.sy - 1 + m), limits.y),
                          clamped(span_of(tile.z - m, tile.z + tile.sz - 1 + m), limits.z));
  const int4 corner = (int4)(tile.x, tile.y, tile.z, 0) * ONE;
  uint from, to;
  int4 origin;
  int count = 0;
  while (next_range(scene, &walk, corner, &from, &to, &origin)) {
    for (uint at = from; at < to; at += 8) {
      if (count > MOST_STAMPS - 8) return OVERFLOW;
      const places8_t p = load_from_index(scene, at, origin);
      const int8 x = FIRST_OF(p.x, side), y = FIRST_OF(p.y, side), z = FIRST_OF(p.z, side);
      int8 meets = (x > -side) & (x < tile.sx) & (y > -side) & (y < tile.sy) & (EIGHT < (int)(to - at));
      if (IS_VOLUME) meets &= (z > -side) & (z < tile.sz);
#if IS_WEIGHTED
      meets &= p.lag < (int)limit_of(side);
#endif
      const uint mask = mask_of(meets);
      const uint8 lanes = lanes_of(mask);
#if IS_WEIGHTED
      store_uints(permuted(as_uint8(p.lag), lanes), s->high + count);
#endif
      store_ints(permuted_ints(p.x, lanes), s->x + count),
          store_ints(permuted_ints(p.y, lanes), s->y + count);
      store_uints(permuted(at + as_uint8(EIGHT), lanes), s->at + count);
#if IS_VOLUME
      store_ints(permuted_ints(p.z, lanes), s->z + count);
      store_ints(permuted_ints(p.z + origin.z, lanes), s->along + count);
#else
      store_ints(permuted_ints(p.y + origin.y, lanes), s->along + count);
#endif
      count += (int)popcount(mask);
    }
  }
  for (int i = 0; !IS_VOLUME && scene->order && i < count; ++i) s->along[i] = own_y(scene, s->at[i]);
  return count;
}

// What the stamps begin with.
NOINLINE static void prepare_stamps(int count, int side, stamps_t* s) {
  for (int k = 0; k < count; k += 8) {
    const int8 px = vload8(0, s->x + k), py = vload8(0, s->y + k);
    const int8 x = FIRST_OF(px, side), y = FIRST_OF(py, side);
    const int8 ax = px - x * ONE - HALF, ay = py - y * ONE - HALF;
    uint8 square = as_uint8(ax * ax + ay * ay);
    int8 offset = y * STAMP_ROW + STAMP_PAD + x;
    store_ints(ax, s->x + k), store_ints(ay, s->y + k), store_ints(y, s->first_y + k);
#if IS_VOLUME
    const int8 pz = vload8(0, s->z + k), z = FIRST_OF(pz, side), az = pz - z * ONE - HALF;
    square += as_uint8(az * az), offset += z * STAMP_SLICE;
    store_ints(az, s->z + k), store_ints(z, s->first_z + k);
#endif
    store_ints(offset, s->offset + k);
    store_uints(IS_WEIGHTED ? vload8(0, s->high + k) + (square >> LOW_BITS) : square >> LOW_BITS,
                s->high + k);
    store_ints(as_int8(square & ((1u << LOW_BITS) - 1)), s->low + k);
  }
}

// How far numbers are shifted right for so many bits, less the first.
static inline uint shift_to(extent_t extent, uint bits) {
  const uint size = 32 - clz((uint)extent.last - (uint)extent.first);
  return size > bits ? size - bits : 0;
}

// Puts the numbers of the seeds in the order of (low bits, z, y, x, id): by buckets of low bits, then by
// insertion.
NOINLINE static void order_stamps(const scene_t* scene, int count, stamps_t* s) {
  uint next[SORT_BUCKETS + 1];
  for (int i = 0; i <= SORT_BUCKETS; ++i) next[i] = 0;
  // Buckets: by the low bits, and two more by the first axis of the tie rule, as far as there is room. Of a
  // lattice all have the same low bits: by the first two axes.
  const extent_t along = extent_of(s->along, count), lows = extent_of(s->low, count);
  uint bucket[STAMP_ROOM];
  if (lows.last > lows.first) {
    const uint shift = shift_to(along, 2);
    for (int k = 0; k < count; k += 8) {
      const uint8 by_axis = min(as_uint8(vload8(0, s->along + k) - along.first) >> shift, (uint8)3u);
      const uint8 composite = as_uint8(vload8(0, s->low + k)) << 2 | by_axis;
      store_uints(LOW_BITS + 2 > SORT_BITS ? composite >> (LOW_BITS + 2 - SORT_BITS) : composite, bucket + k);
    }
  } else {
    const uint shift = shift_to(along, SORT_BITS - 5);
    uint8 lost = 0;
    for (int k = 0; k < count; k += 8) {
      const uint8 way = as_uint8(vload8(0, s->along + k) - along.first);
      lost |= select((uint8)0, way & ((1u << shift) - 1), EIGHT + k < count);
      store_uints(min(way >> shift, (uint8)((1u << (SORT_BITS - 5)) - 1)) << 5, bucket + k);
    }
    if (!SOME(lost != 0u)) {
      int other[STAMP_ROOM];
      for (int i = 0; i < count; ++i) other[i] = IS_VOLUME ? scene->y[s->at[i]] : own_x(scene, s->at[i]);
      const extent_t others = extent_of(other, count);
      const uint other_shift = shift_to(others, 5);
      for (int i = 0; i < count; ++i) bucket[i] |= (uint)(other[i] - others.first) >> other_shift;
    }
  }
  for (int i = 0; i < count; ++i) ++next[bucket[i] + 1];
  for (int i = 0; i < SORT_BUCKETS; ++i) next[i + 1] += next[i];
  // A key: low bits, then that axis, then the number.
  for (int i = 0; i < count; ++i) {
    s->order[next[bucket[i]]++] =
        (ulong)s->low[i] << 48 | (ulong)(uint)(s->along[i] - along.first) << 16 | (ulong)i;
  }
  for (int i = 1; i < count; ++i) {
    const ulong own = s->order[i];
    int k = i;
    for (; k > 0; --k) {
      const ulong other = s->order[k - 1];
      if (other >> 16 < own >> 16) break;
      if (other >> 16 == own >> 16 && comes_first(scene, s->at[other & 0xffff], s->at[own & 0xffff])) break;
      s->order[k] = other;
    }
    s->order[k] = own;
  }
}

// A part of a key: that of the first eight pixels of an axis, of which the first one's centre is so far from
// the seed.
static inline uint8 parts_of(uint8 lanes, uint from_first, int bits) {
  return ((lanes * lanes << (FRACTION_BITS - 1)) - lanes * from_first) << bits;
}

// How many rows at either end of slice k are farther than side / 2 from the seed, wherever it is: the first
// pixels of an axis are at least side / 2 - 1 away, the next ones a pixel less.
static inline int rows_out(int side, int k) {
  if (!IS_VOLUME) return 0;
  const int at = min(k, side - 1 - k);
  return side < 8 ? 0 : side == 8 ? (at == 0) : at == 0 ? 2 : at == 1 ? 1 : 0;
}

// How many rows and slices at either end are so far from the seed that the eight pixels of a row that are nearest to it
// hold all that are less than side / 2 away.
static inline int rows_narrow(int side) { return side <= 8 ? side : side == 10 ? 2 : 1; }

typedef struct {
  uint8 narrow, first, second;  // of the eight nearest pixels, and of the first 16
} columns_t;

INLINE void stamp_vector(uint* row, uint8 keys) { store_uints(min(vload8(0, row), keys), row); }
INLINE void stamp_row(uint* row, columns_t columns, uint more, const int side, bool is_narrow) {
  if (is_narrow) {
    stamp_vector(row + max(side / 2 - 4, 0), columns.narrow + more);
  } else {
    stamp_vector(row, columns.first + more);
    stamp_vector(row + 8, columns.second + more);
  }
}

// All rows of a slice but so many at either end.
INLINE void stamp_slice(uint* rows, columns_t columns, const uint* of_y, const int side, const int out,
                        const bool is_narrow) {
#pragma unroll
  for (int j = out; j < side - out; ++j) {
    stamp_row(rows + j * STAMP_ROW, columns, of_y[j], side, is_narrow || min(j, side - 1 - j) < rows_narrow(side));
  }
}

INLINE void stamp_all(int count, int bits, const int side, box_t tile, stamps_t* s) {
  const uint8 lane_0 = as_uint8(EIGHT), lane_1 = lane_0 + 8u;
  for (int i = 0; i < count; ++i) {
    const uint ax = (uint)s->x[i], ay = (uint)s->y[i];
    const int y = s->first_y[i];
#if IS_VOLUME
    const uint az = (uint)s->z[i];
    const int z = s->first_z[i];
#else
    const uint az = 0;
    const int z = 0;
#endif
    const uint all = (s->high[i] << bits) + s->rank[i];
    const columns_t columns = {all + parts_of(lane_0 + (uint)max(side / 2 - 4, 0), ax, bits),
                               all + parts_of(lane_0, ax, bits), all + parts_of(lane_1, ax, bits)};
    uint of_y[16], of_z[16];
    store_uints(parts_of(lane_0, ay, bits), of_y);
    store_uints(parts_of(lane_0, az, bits), of_z);
    if (side > 8) {
      store_uints(parts_of(lane_1, ay, bits), of_y + 8);
      store_uints(parts_of(lane_1, az, bits), of_z + 8);
    }
    const int first_y = max(-y, 0), last_y = min(side, tile.sy - y);
    const int first_z = max(-z, 0), last_z = min(side, tile.sz - z);
    uint* const image = s->image + s->offset[i];
    for (int k = first_z; k < last_z; ++k) {
      uint* const rows = image + k * STAMP_SLICE;
      const uint of_slice = of_z[k];
      const columns_t in_slice = {columns.narrow + of_slice, columns.first + of_slice, columns.second + of_slice};
      const int out = rows_out(side, k);
      if (last_y - first_y < side) {
        const bool is_narrow = IS_VOLUME && min(k, side - 1 - k) < rows_narrow(side);
        for (int j = max(first_y, out); j < min(last_y, side - out); ++j) {
          stamp_row(rows + j * STAMP_ROW, in_slice, of_y[j], side,
                    is_narrow || min(j, side - 1 - j) < rows_narrow(side));
        }
      } else if (out == 0) {
        stamp_slice(rows, in_slice, of_y, side, 0, side <= 8);
      } else if (out == 1) {
        stamp_slice(rows, in_slice, of_y, side, 1, side <= 10);
      } else {
        stamp_slice(rows, in_slice, of_y, side, 2, true);
      }
    }
  }
}
#if IS_VOLUME
#define EACH_SIDE(DO) DO(3) DO(4) DO(5) DO(6) DO(7) DO(8) DO(10) DO(12)
#else
#define EACH_SIDE(DO) DO(3) DO(4) DO(5) DO(6) DO(7) DO(8) DO(10) DO(12) DO(14)
#endif
#define DEFINE_STAMP(side)                                                          \
  NOINLINE static void stamp_##side(int count, int bits, box_t tile, stamps_t* s) { \
    stamp_all(count, bits, side, tile, s);                                          \
  }
EACH_SIDE(DEFINE_STAMP)
#define CASE_OF_STAMP(side)             \
  case side:                            \
    stamp_##side(count, bits, tile, s); \
    break;

// Labels a tile; false if it is left to lists.
NOINLINE static bool label_by_stamps(const scene_t* scene, box_t tile, int side, stamps_t* s) {
  if (side > 8) side += side % 2;
  const int count = gather_stamps(scene, tile, side, s);
  if (count <= 0) return false;
  const int bits = 32 - (int)clz((uint)max(count - 1, 1));
  // The greatest distance of a lane, squared, and lag.
  const int lanes = side > 8 ? 16 : 8, far_x = max(lanes - side / 2, side / 2) + 1, far_y = side / 2 + 1;
  const int most_lag = IS_WEIGHTED ? side * side / 4 + 1 : 0;
  const int most = far_x * far_x + (AXES_OF_PLACES - 1) * far_y * far_y + most_lag;
  if ((ulong)most << (FRACTION_BITS - 1 + bits) >> 32) return false;
  prepare_stamps(count, side, s);
  order_stamps(scene, count, s);
  const bool inside = is_inside(scene, tile), streams = inside && has_lines(scene, tile);
  for (int z = 0; z < tile.sz; ++z) {
    for (int y = 0; y < tile.sy; ++y) {
      uint* const row = s->image + z * STAMP_SLICE + y * STAMP_ROW + STAMP_PAD;
      for (int x = 0; x < tile.sx; x += 8) store_uints((uint8)NO_KEY, row + x);
      // The labels' lines come while stamps are made.
      global uint* const out = scene->labels + index_of(scene, tile.x, tile.y + y, tile.z + z);
      for (int x = 0; inside && !streams && x < tile.sx; x += 16) PREFETCH(out + x);
    }
  }
  for (int i = 0; i < count; ++i) {
    const uint number = (uint)(s->order[i] & 0xffff);
    s->rank[number] = (uint)i;
    s->labels[i] = scene->ids[s->at[number]];
  }
  switch (side) { EACH_SIDE(CASE_OF_STAMP) }
  const uint limit = limit_of(side) << bits, mask = (1u << bits) - 1;
  const int sx = min(tile.sx, scene->size.x - tile.x), sy = min(tile.sy, scene->size.y - tile.y);
  const int sz = min(tile.sz, scene->size.z - tile.z);
  int8 far = 0;
  for (int z = 0; z < sz; ++z) {
    for (int y = 0; y < sy; ++y) {
      const uint* const row = s->image + z * STAMP_SLICE + y * STAMP_ROW + STAMP_PAD;
      for (int x = 0; x < sx; x += 8) far -= (vload8(0, row + x) >= limit) & (EIGHT < sx - x);
    }
  }
  const int left = sum_of(far);
  if (left > sx * sy * sz / LEFT_PART) return false;
  for (int z = 0; z < sz; ++z) {
    // Labels take the places of the keys, and are stored when the whole slice has them: what was written a while ago is
    // read in vectors at once.
    for (int y = 0; y < sy; ++y) {
      uint* const row = s->image + z * STAMP_SLICE + y * STAMP_ROW + STAMP_PAD;
      for (int x = 0; x < sx; x += 8) {
        const uint8 keys = vload8(0, row + x);
        uint rank[8];  // of pixels without a stamp it may be too great
        store_uints(min(keys & mask, (uint8)(uint)(count - 1)), rank);
#pragma unroll
        for (int i = 0; i < 8; ++i) row[x + i] = s->labels[rank[i]];
        if (left == 0) continue;
        for (uint rest = mask_of((keys >= limit) & (EIGHT < sx - x)); rest != 0; rest &= rest - 1) {
          const int lane = (int)lowest_bit(rest);
          const uint number = (uint)(s->order[rank[lane]] & 0xffff);
          const uint known = mask_of(keys == NO_KEY) >> lane & 1u ? NO_PLACE : s->at[number];
          row[x + lane] = search_pixel(scene, tile.x + x + lane, tile.y + y, tile.z + z, known);
        }
      }
    }
    for (int y = 0; y < sy; ++y) {
      const uint* const row = s->image + z * STAMP_SLICE + y * STAMP_ROW + STAMP_PAD;
      if (streams) {
        global uint16* const lines = (global uint16*)(scene->labels + index_of(scene, tile.x, tile.y + y, tile.z + z));
        for (int i = 0; i < tile.sx / 16; ++i) STREAM(vload16(0, row + 16 * i), lines + i);
        continue;
      }
      for (int x = 0; x < sx; x += 8) {
        show_eight(scene, inside, tile.x + x, tile.y + y, tile.z + z, vload8(0, row + x));
      }
    }
  }
  return true;
}

#endif
