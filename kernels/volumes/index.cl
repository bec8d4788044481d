// The index of a volume's seeds, which exact labels are found by.
//
// Bins of 8 x 8 x 8 voxels, one bit each: the bits of a bin fill a cache line. 64 bins are a region of 32 x 32 x 32,
// and 64 regions a block. All are row-major: voxels in their bin, bins in their region, regions in the volume. A bin's
// seeds stand in the list in the order of their bits, an entry is the id above the position. Of each bin, region and
// block (the nodes) the index has the box around its seeds and one of them.
//
// Seeds are sorted into regions first, chunk by chunk and in their order, as a radix sort does. All else is done region
// by region in a core's own caches, without atomics. Of the seeds on one voxel the first one is listed, which has the
// lowest id.

#ifndef VOROCL_VOLUMES_INDEX
#define VOROCL_VOLUMES_INDEX

#include "volumes/position.cl"
#include "volumes/sizes.cl"

// Eight voxels, seeds or nodes at once.
typedef uint8 uv;
typedef int8 iv;
#define LANES_8 ((int8)(0, 1, 2, 3, 4, 5, 6, 7))
typedef struct __attribute__((packed)) { uv v; } unaligned_uv;

static inline iv xs_of(uv p) { return as_int8(p & MASK_X); }
static inline iv ys_of(uv p) { return as_int8(p >> VOROCL_BITS_X & MASK_Y); }
static inline iv zs_of(uv p) { return as_int8(p >> SHIFT_Z & MASK_Z); }
static inline int least_lane(iv v) {
  const int4 a = min(v.lo, v.hi);
  const int2 b = min(a.lo, a.hi);
  return min(b.x, b.y);
}
static inline uint least_lane_u(uv v) {
  const uint4 a = min(v.lo, v.hi);
  const uint2 b = min(a.lo, a.hi);
  return min(b.x, b.y);
}

// A volume of regions.
typedef struct {
  int width, height, depth;  // voxels
  int rx, ry, rz;            // regions along the axes
  int bx, by, bz;            // blocks
} extent_t;
static inline int along(int size, int part) { return (size + part - 1) / part; }
static inline extent_t extent_of(int width, int height, int depth) {
  const int rx = along(width, REGION), ry = along(height, REGION), rz = along(depth, REGION);
  const extent_t e = {width, height, depth, rx, ry, rz, along(rx, BLOCK), along(ry, BLOCK), along(rz, BLOCK)};
  return e;
}
static inline int regions_of(extent_t e) { return e.rx * e.ry * e.rz; }
static inline int blocks_of(extent_t e) { return e.bx * e.by * e.bz; }

static inline uint region_of(uint p, extent_t e) {
  return (uint)((z_of(p) / REGION * e.ry + y_of(p) / REGION) * e.rx + x_of(p) / REGION);
}
static inline uint bin_of(uint p) {  // in its region
  return (uint)((z_of(p) / BIN & 3) << 4 | (y_of(p) / BIN & 3) << 2 | (x_of(p) / BIN & 3));
}
// A voxel's bit among those of its region.
static inline uint bit_of(uint p) {
  return bin_of(p) * (WORDS * 32) | (uint)((z_of(p) & 7) << 6 | (y_of(p) & 7) << 3 | (x_of(p) & 7));
}

static inline uint chunk_begin(uint count, uint chunk, uint chunks) { return (uint)((ulong)count * chunk / chunks); }

// How many seeds of each chunk are in each region. `across` is the number of regions, padded to whole vectors.
kernel void count_chunks(global const uint* restrict positions, uint count, uint chunks, global uint* restrict counts,
                         uint across, int width, int height, int depth) {
  const uint chunk = (uint)get_global_id(0), end = chunk_begin(count, chunk + 1, chunks);
  if (chunk >= chunks) return;
  const extent_t e = extent_of(width, height, depth);
  global uint* const own = counts + chunk * across;
  for (uint i = 0; i < across; ++i) own[i] = 0;
  for (uint i = chunk_begin(count, chunk, chunks); i < end; ++i) {
    if (!(positions[i] & EMPTY)) ++own[region_of(positions[i], e)];
  }
}

// Where a chunk's seeds begin among those of a region; and how many a region has.
kernel void sum_chunks(global uint* restrict counts, uint chunks, uint across, global uint* restrict totals) {
  const uint first = (uint)get_global_id(0) * 8;
  if (first >= across) return;
  uv sum = (uv)0;
  for (uint chunk = 0; chunk < chunks; ++chunk) {
    const uv own = vload8(0, counts + chunk * across + first);
    vstore8(sum, 0, counts + chunk * across + first);
    sum += own;
  }
  vstore8(sum, 0, totals + first);
}

// Where regions begin: one work-item.
kernel void sum_regions(global uint* restrict totals, uint across) {
  if (get_global_id(0) > 0) return;
  uint at = 0;
  for (uint i = 0; i < across; ++i) {
    const uint own = totals[i];
    totals[i] = at;
    at += own;
  }
  totals[across] = at;
}

kernel void sort_seeds(global const uint* restrict positions, uint count, uint chunks, global uint* restrict counts,
                       uint across, global const uint* restrict totals, global ulong* restrict sorted, int width,
                       int height, int depth) {
  const uint chunk = (uint)get_global_id(0), end = chunk_begin(count, chunk + 1, chunks);
  if (chunk >= chunks) return;
  const extent_t e = extent_of(width, height, depth);
  global uint* const own = counts + chunk * across;
  for (uint i = chunk_begin(count, chunk, chunks); i < end; ++i) {
    const uint p = positions[i];
    if (p & EMPTY) continue;
    const uint region = region_of(p, e);
    sorted[totals[region] + own[region]++] = (ulong)i << 32 | p;
  }
}

// The first and the last of the bits that are set, of one or more.
static inline int first_bit(uint bits) { return 31 - (int)clz(bits & (0u - bits)); }
static inline int last_bit(uint bits) { return 31 - (int)clz(bits); }

// What a node knows of its seeds: all EMPTY where it has none.
typedef struct {
  uint low, high, seed;  // the corners of the box around them, and one of them
} node_t;

// A bin, whose first voxel is at (x, y, z). Counts its seeds.
static inline node_t make_bin(global const uint* word, int x, int y, int z, uint* count) {
  const node_t none = {EMPTY, EMPTY, EMPTY};
  const uint16 all = vload16(0, word);
  const uint8 o8 = all.lo | all.hi;
  const uint4 o4 = o8.lo | o8.hi;
  const uint2 o2 = o4.lo | o4.hi;  // a slice has two words: rows 0 to 3 are in o2.x, rows 4 to 7 in o2.y
  *count = 0;
  if ((o2.x | o2.y) == 0) return none;
  uint row = o2.x | o2.y, rows = 0, slices = 0;
  row |= row >> 16;
  row = (row | row >> 8) & 0xff;
  for (int i = 0; i < 4; ++i) {
    rows |= (o2.x >> 8 * i & 0xff) != 0 ? 1u << i : 0;
    rows |= (o2.y >> 8 * i & 0xff) != 0 ? 16u << i : 0;
  }
  for (int i = 0; i < WORDS; ++i) {
    *count += popcount(word[i]);
    slices |= word[i] != 0 ? 1u << i / 2 : 0;
  }
  // The seed: the first one in the middle one of the slices that have any.
  int w = (first_bit(slices) + last_bit(slices)) / 2 * 2;
  while (w < WORDS && word[w] == 0) ++w;
  if (w == WORDS) {
    for (w = 0; word[w] == 0; ++w) {}
  }
  const int bit = w * 32 + first_bit(word[w]);
  const node_t bin = {pack(x + first_bit(row), y + first_bit(rows), z + first_bit(slices)),
                      pack(x + last_bit(row), y + last_bit(rows), z + last_bit(slices)),
                      pack(x + (bit & 7), y + (bit >> 3 & 7), z + (bit >> 6))};
  return bin;
}

// The box around boxes, by its corners.
typedef struct {
  int4 low, high;
} bounds_t;
static inline bounds_t no_bounds(void) {
  const bounds_t none = {(int4)INT_MAX, (int4)-1};
  return none;
}
static inline void widen(bounds_t* bounds, uint low, uint high) {
  bounds->low = min(bounds->low, (int4)(x_of(low), y_of(low), z_of(low), 0));
  bounds->high = max(bounds->high, (int4)(x_of(high), y_of(high), z_of(high), 0));
}
static inline void store_node(global uint* low, global uint* high, global uint* seed, uint at, const bounds_t* bounds,
                              uint of_node) {
  const bool none = of_node == EMPTY;
  low[at] = none ? EMPTY : pack(bounds->low.x, bounds->low.y, bounds->low.z);
  high[at] = none ? EMPTY : pack(bounds->high.x, bounds->high.y, bounds->high.z);
  seed[at] = of_node;
}

// The bits, bins and seeds of a region. `starts` has 65 entries per region: where the seeds of its bins begin. `low`,
// `high` and `seed` have the bins, then the regions, then the blocks.
kernel void make_bins(global uint* restrict bits, global uint* restrict starts, global uint* restrict low,
                      global uint* restrict high, global uint* restrict seed, global const ulong* restrict sorted,
                      global const uint* restrict totals, global ulong* restrict list, int width, int height,
                      int depth) {
  const extent_t e = extent_of(width, height, depth);
  const uint region = (uint)get_global_id(0), regions = (uint)regions_of(e);
  if (region >= regions) return;
  const int rx = (int)region % e.rx, ry = (int)region / e.rx % e.ry, rz = (int)region / e.rx / e.ry;
  const uint begin = totals[region], end = totals[region + 1];
  global uint* const own = bits + (size_t)region * BINS * WORDS;
  for (uint i = 0; i < BINS * WORDS; i += 8) vstore8((uv)0, 0, own + i);
  uint at_word = 0, bits_of_word = 0;  // neighbours share a word, which is not to be loaded for each of them
  for (uint i = begin; i < end; ++i) {
    const uint bit = bit_of((uint)sorted[i]);
    if (bit / 32 != at_word) {
      own[at_word] |= bits_of_word;
      at_word = bit / 32, bits_of_word = 0;
    }
    bits_of_word |= 1u << bit % 32;
  }
  own[at_word] |= bits_of_word;
  bounds_t bounds = no_bounds();
  uint of_region = EMPTY, at = begin;
  for (int b = 0; b < BINS; ++b) {
    uint count;
    const node_t bin = make_bin(own + b * WORDS, rx * REGION + (b & 3) * BIN, ry * REGION + (b >> 2 & 3) * BIN,
                                rz * REGION + (b >> 4) * BIN, &count);
    const uint node = region * BINS + (uint)b;
    low[node] = bin.low, high[node] = bin.high, seed[node] = bin.seed;
    starts[region * (BINS + 1) + (uint)b] = at;
    at += count;
    if (count == 0) continue;
    widen(&bounds, bin.low, bin.high);
    if (b <= MIDDLE_BIN || of_region == EMPTY) of_region = bin.seed;
  }
  starts[region * (BINS + 1) + BINS] = at;
  store_node(low, high, seed, regions * BINS + region, &bounds, of_region);
  if (begin == end) return;
  uint before[BINS * WORDS];  // seeds before each word
  at = begin;
  for (uint i = 0; i < BINS * WORDS; ++i) {
    before[i] = at;
    at += popcount(own[i]);
  }
  for (uint i = end; i-- > begin;) {  // backwards: of the seeds on one voxel the lowest id is the last one, and stays
    const uint bit = bit_of((uint)sorted[i]);
    list[before[bit / 32] + popcount(own[bit / 32] & ((1u << bit % 32) - 1))] = sorted[i];
  }
}

// Blocks, and as many without seeds behind them as fill a vector.
kernel void make_blocks(global uint* restrict low, global uint* restrict high, global uint* restrict seed, int width,
                        int height, int depth) {
  const extent_t e = extent_of(width, height, depth);
  const int block = (int)get_global_id(0);
  const uint regions = (uint)regions_of(e);
  if (block >= along(blocks_of(e), 8) * 8) return;
  bounds_t bounds = no_bounds();
  uint of_block = EMPTY;
  if (block < blocks_of(e)) {
    const int x = block % e.bx * BLOCK, y = block / e.bx % e.by * BLOCK, z = block / e.bx / e.by * BLOCK;
    for (int k = z; k < min(z + BLOCK, e.rz); ++k) {
      for (int j = y; j < min(y + BLOCK, e.ry); ++j) {
        for (int i = x; i < min(x + BLOCK, e.rx); ++i) {
          const uint at = regions * BINS + (uint)((k * e.ry + j) * e.rx + i);
          if (low[at] == EMPTY) continue;
          widen(&bounds, low[at], high[at]);
          of_block = seed[at];
        }
      }
    }
  }
  store_node(low, high, seed, regions * (BINS + 1) + (uint)block, &bounds, of_block);
}

// What searches read of the index.
typedef struct {
  extent_t extent;
  global const uint* starts;
  global const uint* low;
  global const uint* high;
  global const uint* seed;
  global const ulong* list;
} index_t;

#endif
