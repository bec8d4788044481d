// Exact labels where seeds are dense: three passes of minima with 16-bit lanes, one per axis, that look `reach` voxels
// far. A voxel's key is distance * K^3 + the place of its seed among the K^3 voxels within reach, K = 2 * reach + 1, z
// above y above x: so the least key is the nearest seed by the tie rule, and says where it stands. A voxel is done if
// its distance is below that of any seed out of reach, (reach + 1)^2 where voxels have a side of 1. For a reach of 5
// that is 36 * 1331 < 65536; greater distances saturate, and passes for which they leave no room are not made. A box
// with a voxel that is not done is left to boxes.cl.
//
// Along a periodic axis the voxels within reach go on behind an end, with images of the seeds at the other one. There
// the tie rule, which goes by the places in the volume, has them in another order: the K places along an axis turn, as
// on a ring, and are turned back before seeds are looked up by them. In a period shorter than the longer reach's K a
// voxel may see two images of a seed, and there are no passes.

#ifndef VOROCL_VOLUMES_DENSE
#define VOROCL_VOLUMES_DENSE

#include "volumes/boxes.cl"

typedef ushort16 near_keys;
#define KEY_LANES ((ushort16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))
// PoCL 3.1 makes vload16() and vstore16() of 16-bit lanes element by element: this is one instruction.
typedef struct __attribute__((packed)) { near_keys v; } unaligned_keys;
#define LOAD_KEYS(pointer) (((const unaligned_keys*)(pointer))->v)
#define STORE_KEYS(values, pointer) (((unaligned_keys*)(pointer))->v = (values))

#define NO_KEY 0xffff
#define LONG_REACH 5
#define SHORT_REACH 3
#define LONG_SIDE (REGION + 2 * LONG_REACH)  // of a region with what is within reach
#define STRIP 16                             // columns that the passes take at once
#define CROWDED (BIN * BIN * BIN * 3 / 4)    // so many seeds of a bin are taken in rows
#define STRIDE 48                            // of a row in the table of ids: 8 voxels more at both ends

// The least key of a seed out of reach, or more than any key.
#define KEYS_PER_DISTANCE(reach) ((2 * (reach) + 1) * (2 * (reach) + 1) * (2 * (reach) + 1))
#define LEAST_SPACING min(SPACING_X, min(SPACING_Y, SPACING_Z))
#define FIRST_FAR_KEY(reach) (ALONG(((reach) + 1) * LEAST_SPACING) * KEYS_PER_DISTANCE(reach))
#define HAS_ROOM(reach) (FIRST_FAR_KEY(reach) <= NO_KEY)

// Regions with so many seeds try a reach: one per 18 voxels, one per 90; more where voxels are long, of which fewer are
// nearer than all that is out of reach.
#define SEEDS_FOR(voxels_per_seed)                                                    \
  (REGION * REGION * REGION / (voxels_per_seed) * (SPACING_X * SPACING_Y * SPACING_Z) / \
   (LEAST_SPACING * LEAST_SPACING * LEAST_SPACING))
#define DENSE_FOR_SHORT SEEDS_FOR(18)
#define DENSE_FOR_LONG SEEDS_FOR(90)

// The part of an axis in a key, which saturates.
static inline near_keys part_of_key(int along, int unit, int place) {
  return (near_keys)(ushort)min(along * unit + place, NO_KEY);
}

#define IS_PERIODIC (PERIODIC_X || PERIODIC_Y || PERIODIC_Z)
#define MOST_PLACES (2 * LONG_REACH + 1)  // along an axis

// How far the places within reach of a voxel turn, from 0 to all but one: those behind the first voxel of the axis come
// last, those behind the last one first.
static inline int turn_at(int at, int size, int reach, int periodic) {
  if (!periodic) return 0;
  return at < reach ? reach + 1 + at : max(at + reach + 1 - size, 0) % (2 * reach + 1);
}

// Of a region with a periodic axis: how far places turn at its voxels, and the parts of keys that follow from it.
typedef struct {
  ushort turn_x[REGION], turn_y[REGION], turn_z[REGION];
  ushort x[MOST_PLACES * REGION], y[REGION * MOST_PLACES], z[REGION * MOST_PLACES];
} turns_t;

__attribute__((always_inline)) static inline void find_turns(const int reach, extent_t e, int4 at, turns_t* turns) {
  const int k = 2 * reach + 1, unit = KEYS_PER_DISTANCE(reach);
  for (int i = 0; i < REGION; ++i) {
    const int of_x = turn_at(at.x + i, e.width, reach, PERIODIC_X);
    const int of_y = turn_at(at.y + i, e.height, reach, PERIODIC_Y);
    const int of_z = turn_at(at.z + i, e.depth, reach, PERIODIC_Z);
    turns->turn_x[i] = (ushort)of_x;
    turns->turn_y[i] = (ushort)of_y;
    turns->turn_z[i] = (ushort)of_z;
    for (int j = 0; j < k; ++j) {
      turns->x[j * REGION + i] = (ushort)min(ALONG_X(j - reach) * unit + (j + of_x) % k, NO_KEY);
      turns->y[i * k + j] = (ushort)min(ALONG_Y(j - reach) * unit + (j + of_y) % k * k, NO_KEY);
      turns->z[i * k + j] = (ushort)min(ALONG_Z(j - reach) * unit + (j + of_z) % k * k * k, NO_KEY);
    }
  }
}

static inline near_keys turned_back(near_keys place, near_keys turn, ushort k) {
  return place - turn + select((near_keys)0, (near_keys)k, place < turn);
}

// Places that have turned, as they are where nothing turns.
__attribute__((always_inline)) static inline near_keys places_turned_back(const int reach, near_keys place,
                                                                          const turns_t* turns, int strip, int y,
                                                                          int z) {
  const ushort k = (ushort)(2 * reach + 1), area = (ushort)(k * k);
  const near_keys of_z = mul_hi(place, (near_keys)(ushort)(65536 / area + 1)), in_slice = place - of_z * area;
  const near_keys of_y = mul_hi(in_slice, (near_keys)(ushort)(65536 / k + 1)), of_x = in_slice - of_y * k;
  return turned_back(of_z, (near_keys)turns->turn_z[z], k) * area +
         turned_back(of_y, (near_keys)turns->turn_y[y], k) * k +
         turned_back(of_x, LOAD_KEYS(turns->turn_x + strip * STRIP), k);
}

// What is known of the seeds of a region and around it.
typedef struct {
  uint id[LONG_SIDE * LONG_SIDE * STRIDE + STRIP];  // at the seeds' voxels; others are never looked up
  uint words[2 * LONG_SIDE * LONG_SIDE];            // of a row, the bits of each strip and of 8 voxels at its sides
} surroundings_t;

// The six bins of a row of bins from the one before a region to the one behind it, as their numbers in the index.
typedef struct {
  uint bin[6];
  uchar there[6];  // 0xff where there is one
} bin_row_t;

static inline bin_row_t bins_of_row(extent_t e, int4 at, int by, int bz) {
  const int y = at.y / BIN + by, z = at.z / BIN + bz;
  const bool inside = y >= 0 && y < e.ry * 4 && z >= 0 && z < e.rz * 4;
  bin_row_t row;
  for (int i = 0; i < 6; ++i) {
    const int x = at.x / BIN + i - 1;
    const bool there = inside && x >= 0 && x < e.rx * 4;
    row.there[i] = there ? 0xff : 0;
    row.bin[i] = there ? (uint)(((z >> 2) * e.ry + (y >> 2)) * e.rx + (x >> 2)) * BINS +
                             (uint)((z & 3) << 4 | (y & 3) << 2 | (x & 3))
                       : 0;
  }
  return row;
}

// The ids of a bin of which most voxels are seeds, row by row: one without a gap is a vector of them. The bin's first
// voxel is at (x, y, z) in the table.
static inline void gather_rows(global const uchar* bytes, global const ulong* seeds, int x, int y, int z, int side,
                               uint* id) {
  for (int row = 0; row < BIN * BIN; ++row) {
    const int row_y = y + row % BIN, row_z = z + row / BIN;
    const uint byte = bytes[row];
    global const ulong* seed = seeds;
    seeds += popcount(byte);
    if ((uint)row_y >= (uint)side || (uint)row_z >= (uint)side) continue;
    uint* const out = id + (row_z * side + row_y) * STRIDE + x;
    if (byte == 0xff) {
      const uint16 both = vload16(0, (global const uint*)seed);
      vstore8(both.odd, 0, out);
      continue;
    }
    for (uint rest = byte; rest != 0; rest &= rest - 1) out[first_bit(rest)] = (uint)(*seed++ >> 32);
  }
}

static inline void gather_ids(bin_row_t row, global const uchar* bytes, global const uint* starts,
                              global const ulong* list, int4 at, int by, int bz, int reach, surroundings_t* around) {
  const int side = REGION + 2 * reach;
  for (int i = 0; i < 6; ++i) {
    if (!row.there[i]) continue;
    const uint first = row.bin[i] / BINS * (BINS + 1) + row.bin[i] % BINS;
    const uint begin = starts[first], end = starts[first + 1];
    if (end - begin >= CROWDED) {
      gather_rows(bytes + (size_t)row.bin[i] * (WORDS * 4), list + begin, i * BIN, by * BIN + reach, bz * BIN + reach,
                  side, around->id);
      continue;
    }
    for (uint j = begin; j < end; ++j) {
      const uint p = (uint)list[j];
      const int x = x_of(p) - at.x + 8, y = y_of(p) - at.y + reach, z = z_of(p) - at.z + reach;
      if ((uint)y < (uint)side && (uint)z < (uint)side) around->id[(z * side + y) * STRIDE + x] = (uint)(list[j] >> 32);
    }
  }
}

__attribute__((always_inline)) static inline void gather(const int reach, extent_t e, global const uint* bits,
                                                         global const uint* starts, global const ulong* list, int4 at,
                                                         surroundings_t* around) {
  const int side = REGION + 2 * reach;
  global const uchar* const bytes = (global const uchar*)bits;  // a byte is a row of a bin
  for (int bz = -1; bz <= 4; ++bz) {
    for (int by = -1; by <= 4; ++by) {
      const bin_row_t row = bins_of_row(e, at, by, bz);
      gather_ids(row, bytes, starts, list, at, by, bz, reach, around);
      for (int z = max(bz * BIN, -reach); z < min(bz * BIN + BIN, REGION + reach); ++z) {
        for (int y = max(by * BIN, -reach); y < min(by * BIN + BIN, REGION + reach); ++y) {
          uint byte[6];
#pragma unroll
          for (int i = 0; i < 6; ++i) {
            byte[i] = bytes[(size_t)row.bin[i] * (WORDS * 4) + (uint)((z & 7) * 8 + (y & 7))] & row.there[i];
          }
          uint* const word = around->words + ((z + reach) * side + y + reach) * 2;
          word[0] = byte[0] | byte[1] << 8 | byte[2] << 16 | byte[3] << 24;
          word[1] = byte[2] | byte[3] << 8 | byte[4] << 16 | byte[5] << 24;
        }
      }
    }
  }
}

static inline bool has_images(int along, int periodic) { return along == 0 || periodic; }

// The images of seeds that lie behind the ends of periodic axes, at most a period away.
__attribute__((noinline)) static void gather_images(int reach, extent_t e, global const uint* starts,
                                                    global const ulong* list, int4 at, surroundings_t* around) {
  const int side = REGION + 2 * reach;
  for (int image = 0; image < 27; ++image) {
    const int along_x = image % 3 - 1, along_y = image / 3 % 3 - 1, along_z = image / 9 - 1;
    const bool repeats =
        has_images(along_x, PERIODIC_X) && has_images(along_y, PERIODIC_Y) && has_images(along_z, PERIODIC_Z);
    if (image == 13 || !repeats) continue;
    // Where the region's surroundings begin, in the volume that the image is of.
    const int x0 = at.x - reach - along_x * e.width, y0 = at.y - reach - along_y * e.height;
    const int z0 = at.z - reach - along_z * e.depth;
    for (int bz = max(z0, 0) / BIN; bz * BIN < min(z0 + side, e.depth); ++bz) {
      for (int by = max(y0, 0) / BIN; by * BIN < min(y0 + side, e.height); ++by) {
        for (int bx = max(x0, 0) / BIN; bx * BIN < min(x0 + side, e.width); ++bx) {
          const uint bin = bin_of(pack(bx * BIN, by * BIN, bz * BIN));
          const uint first = region_of(pack(bx * BIN, by * BIN, bz * BIN), e) * (BINS + 1) + bin;
          for (uint j = starts[first]; j < starts[first + 1]; ++j) {
            const uint p = (uint)list[j];
            const int x = x_of(p) - x0, y = y_of(p) - y0, z = z_of(p) - z0;
            if ((uint)x >= (uint)side || (uint)y >= (uint)side || (uint)z >= (uint)side) continue;
            const int row = z * side + y, column = x + 8 - reach;
            around->id[row * STRIDE + column] = (uint)(list[j] >> 32);
            if (column < 32) around->words[row * 2] |= 1u << column;
            if (column >= STRIP) around->words[row * 2 + 1] |= 1u << (column - STRIP);
          }
        }
      }
    }
  }
}

// A slice of a strip: the least keys along x of each row, then along y.
__attribute__((always_inline)) static inline void pass_slice(const int reach, const uint* words,
                                                             const turns_t* turns, int strip, near_keys* after_y) {
  const int k = 2 * reach + 1, side = REGION + 2 * reach, unit = KEYS_PER_DISTANCE(reach);
  ushort absent[LONG_SIDE * 32];  // all ones where there is no seed
  near_keys after_x[LONG_SIDE];
  for (int y = 0; y < side; ++y) {
    const uint word = words[y * 2];
    const near_keys bit = (near_keys)1 << KEY_LANES;
    STORE_KEYS(as_ushort16(((near_keys)(ushort)word & bit) == (near_keys)0), absent + y * 32);
    STORE_KEYS(as_ushort16(((near_keys)(ushort)(word >> 16) & bit) == (near_keys)0), absent + y * 32 + 16);
  }
  for (int y = 0; y < side; ++y) {
    near_keys least = (near_keys)NO_KEY;
#pragma unroll
    for (int dx = -reach; dx <= reach; ++dx) {
      const near_keys part =
          IS_PERIODIC ? LOAD_KEYS(turns->x + (dx + reach) * REGION + strip * STRIP)
                      : part_of_key(ALONG_X(dx), unit, dx + reach);
      least = min(least, LOAD_KEYS(absent + y * 32 + 8 + dx) | part);
    }
    after_x[y] = least;
  }
  for (int y = 0; y < REGION; ++y) {
    near_keys least = (near_keys)NO_KEY;
#pragma unroll
    for (int dy = 0; dy < k; ++dy) {
      const near_keys part =
          IS_PERIODIC ? (near_keys)turns->y[y * k + dy] : part_of_key(ALONG_Y(dy - reach), unit, dy * k);
      least = min(least, add_sat(after_x[y + dy], part));
    }
    after_y[y] = least;
  }
}

// Stores the labels of row (y, z) of a strip, whose first voxel has this id; whether some of them are not done.
__attribute__((always_inline)) static inline bool store_row(const int reach, near_keys least, const turns_t* turns,
                                                            int strip, int y, int z, const int* offset, const uint* id,
                                                            global uint* out, int columns) {
  const int unit = KEYS_PER_DISTANCE(reach);
  const near_keys distance = mul_hi(least, (near_keys)(ushort)((65536 + unit - 1) / unit));
  near_keys rest = least - distance * (ushort)unit;
  const short16 over = as_short16(rest) < (short16)0;  // the reciprocal is a little too great
  rest += select((near_keys)0, (near_keys)(ushort)unit, over);
  const short16 far = least >= (near_keys)(ushort)FIRST_FAR_KEY(reach);
  ushort place[STRIP];
  STORE_KEYS(IS_PERIODIC ? places_turned_back(reach, rest, turns, strip, y, z) : rest, place);
  if (columns >= STRIP) {
    uint label[STRIP];
#pragma unroll
    for (int i = 0; i < STRIP; ++i) label[i] = (id + i)[offset[place[i]]];
    ((global unaligned_uv*)out)->v = vload8(0, label);
    ((global unaligned_uv*)(out + 8))->v = vload8(1, label);
    return any(far);
  }
  ushort is_far[STRIP];
  STORE_KEYS(as_ushort16(far), is_far);
  bool some_far = false;
  for (int i = 0; i < columns; ++i) {
    some_far |= is_far[i] != 0;
    out[i] = (id + i)[offset[place[i]]];
  }
  return some_far;
}

// Returns a bit for each box that is left, in the same order.
__attribute__((always_inline)) static inline uint label_by_passes(const int reach, extent_t e, global const uint* bits,
                                                                  global const uint* starts, global const ulong* list,
                                                                  int4 at, global uint* labels) {
  const int k = 2 * reach + 1, side = REGION + 2 * reach, unit = KEYS_PER_DISTANCE(reach);
  surroundings_t around;
  gather(reach, e, bits, starts, list, at, &around);
  turns_t turns;
  if (IS_PERIODIC) {
    gather_images(reach, e, starts, list, at, &around);
    find_turns(reach, e, at, &turns);
  }
  int offset[(2 * LONG_REACH + 1) * (2 * LONG_REACH + 1) * (2 * LONG_REACH + 1)];  // in the table, of a place in reach
  for (int i = 0; i < k * k * k; ++i) {
    offset[i] = ((i / (k * k) - reach) * side + i / k % k - reach) * STRIDE + i % k - reach;
  }
  near_keys after_y[LONG_SIDE * REGION];
  uint left = 0;
  for (int strip = 0; strip < 2; ++strip) {
    for (int z = 0; z < side; ++z) {
      pass_slice(reach, around.words + z * side * 2 + strip, &turns, strip, after_y + z * REGION);
    }
    // All of a strip has its keys before labels are stored.
    const int x = at.x + strip * STRIP;
    if (x >= e.width) break;
    for (int z = 0; z < min(REGION, e.depth - at.z); ++z) {
      for (int y = 0; y < min(REGION, e.height - at.y); ++y) {
        near_keys least = (near_keys)NO_KEY;
#pragma unroll
        for (int dz = 0; dz < k; ++dz) {
          const near_keys part =
              IS_PERIODIC ? (near_keys)turns.z[z * k + dz] : part_of_key(ALONG_Z(dz - reach), unit, dz * k * k);
          least = min(least, add_sat(after_y[(z + dz) * REGION + y], part));
        }
        const size_t row = (size_t)(at.z + z) * (size_t)e.height + (size_t)(at.y + y);
        const uint* const id = around.id + ((z + reach) * side + y + reach) * STRIDE + strip * STRIP + 8;
        const bool some_far = store_row(reach, least, &turns, strip, y, z, offset, id,
                                        labels + row * (size_t)e.width + x, e.width - x);
        const int tile = strip | y / TILE << 1 | z / TILE << 2, part = y / BOX_Y % 2 | z / BOX_Z % 2 << 1;
        left |= some_far ? 1u << (tile * BOXES + part) : 0;
      }
    }
  }
  return left;
}

__attribute__((noinline)) static uint label_near(extent_t e, global const uint* bits, global const uint* starts,
                                                 global const ulong* list, int4 at, global uint* labels) {
  return label_by_passes(SHORT_REACH, e, bits, starts, list, at, labels);
}
__attribute__((noinline)) static uint label_less_near(extent_t e, global const uint* bits, global const uint* starts,
                                                      global const ulong* list, int4 at, global uint* labels) {
  return label_by_passes(LONG_REACH, e, bits, starts, list, at, labels);
}

// Whether of each seed one image at most is within reach of a voxel, along an axis.
static inline bool has_one_image(int size, int periodic) { return !periodic || size >= MOST_PLACES; }

// Labels dense regions; says which boxes of each region are left.
kernel void label_dense(global const uint* restrict bits, global const uint* restrict starts,
                        global const ulong* restrict list, int width, int height, int depth,
                        global uint* restrict labels, global uint* restrict boxes_left) {
  const extent_t e = extent_of(width, height, depth);
  const int region = (int)get_global_id(0);
  if (region >= regions_of(e)) return;
  const int4 at = (int4)(region % e.rx * REGION, region / e.rx % e.ry * REGION, region / e.rx / e.ry * REGION, 0);
  const uint first = (uint)region * (BINS + 1);
  const bool one_image = has_one_image(e.width, PERIODIC_X) && has_one_image(e.height, PERIODIC_Y) &&
                         has_one_image(e.depth, PERIODIC_Z);
  const int seeds = one_image ? (int)(starts[first + BINS] - starts[first]) : 0;
  uint left = ALL_LEFT;
  if (HAS_ROOM(SHORT_REACH) && seeds >= DENSE_FOR_SHORT) {
    left = label_near(e, bits, starts, list, at, labels);
  } else if (HAS_ROOM(LONG_REACH) && seeds >= DENSE_FOR_LONG) {
    left = label_less_near(e, bits, starts, list, at, labels);
  }
  boxes_left[region] = left;
}

#endif
