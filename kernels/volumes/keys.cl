// Labels of the voxels of a box, or of a part of one, whose candidates are known.
//
// KEYS. A candidate's key at a voxel is by how much farther it is than one of them, the base, above its rank by the tie
// rule. It is the sum of a part for each axis: an addition and a minimum for 8 voxels and a candidate.

#ifndef VOROCL_VOLUMES_KEYS
#define VOROCL_VOLUMES_KEYS

#include "volumes/search.cl"
#include "volumes/search_voxel.cl"

// Candidates: ranks of 8 bits leave 23 and a sign for differences of squared distances in a box of 16 x 8 x 8. Where
// voxels are longer than 1, by up to 16, there are 24.
#ifndef MOST_OF_KEYS
#if SPACING_X == 1 && SPACING_Y == 1 && SPACING_Z == 1
#define MOST_OF_KEYS 256
#else
#define MOST_OF_KEYS 128
#endif
#endif
#define BOX_X 16
#define BOX_Y 8
#define BOX_Z 8

// The ends of the volume, in places.
#define END_X(e) ((e).width + MARGIN_X(e))
#define END_Y(e) ((e).height + MARGIN_Y(e))
#define END_Z(e) ((e).depth + MARGIN_Z(e))

// The label of the voxel at a place.
static inline global uint* label_at(extent_t e, global uint* labels, int x, int y, int z) {
  const size_t row = (size_t)(z - MARGIN_Z(e)) * (size_t)e.height + (size_t)(y - MARGIN_Y(e));
  return labels + row * (size_t)e.width + (x - MARGIN_X(e));
}

static inline void fill(const index_t* index, box_t b, uint label, global uint* labels) {
  const extent_t e = index->extent;
  const int columns = min(b.hx + 1, END_X(e) - b.x);
  for (int z = b.z; z < min(b.z + b.hz + 1, END_Z(e)); ++z) {
    for (int y = b.y; y < min(b.y + b.hy + 1, END_Y(e)); ++y) {
      global uint* const row = label_at(e, labels, b.x, y, z);
      int x = 0;
      for (; x + 8 <= columns; x += 8) ((global unaligned_uv*)(row + x))->v = (uv)label;
      for (; x < columns; ++x) row[x] = label;
    }
  }
}

// A permutation of a vector, which the compiler makes of this.
static inline uv permuted(uv t, uv at) {
  at &= 7u;
  return (uv)(t[at.s0], t[at.s1], t[at.s2], t[at.s3], t[at.s4], t[at.s5], t[at.s6], t[at.s7]);
}

// The entries of so many vectors; of no known number of them: lane by lane.
__attribute__((always_inline)) static inline uv look_up(const uint* table, int vectors, uv at) {
  if (vectors == 0) {
    uint a[8];
    vstore8(at, 0, a);
#pragma unroll
    for (int i = 0; i < 8; ++i) a[i] = table[a[i]];
    return vload8(0, a);
  }
  uv v = permuted(vload8(0, table), at);
#pragma unroll
  for (int i = 1; i < vectors; ++i) v = select(v, permuted(vload8((size_t)i, table), at), as_int8(at) >= i * 8);
  return v;
}

#define ROWS 4  // of a block: 4 rows of 16 voxels have their least keys in 8 registers
__attribute__((always_inline)) static inline void label_block(const uint* table, int vectors, uv mask, const iv* least,
                                                              global uint* first, int stride) {
#pragma unroll
  for (int i = 0; i < 2 * ROWS; ++i) {
    const uv at = as_uint8(least[i]) & mask;
    ((global unaligned_uv*)(first + i / 2 * stride + i % 2 * 8))->v = look_up(table, vectors, at);
  }
}

// The parts of the candidates' keys in a box.
typedef struct {
  int count;
  uv rank_mask;
  uv of_column[MOST_OF_KEYS * 2];  // 16 columns, with the ranks
  uv of_y[MOST_OF_KEYS];
  uint of_z[MOST_OF_KEYS * BOX_Z];
  uint label_of[MOST_OF_KEYS + 32];  // by rank; read in whole vectors
} keys_t;

// Images of one seed have one rank, and one label.
static inline void make_keys(extent_t e, const dominators_t* d, const ulong* list, int count, keys_t* keys) {
  const box_t b = d->box;
  uint seed[MOST_OF_KEYS + 8], rank[MOST_OF_KEYS + 8];
  for (int i = 0; i < count; i += 8) vstore8(load_seeds(list + i), 0, seed + i);
#ifdef VOROCL_PERIODIC
  uint position[MOST_OF_KEYS + 8];
  for (int i = 0; i < count; i += 8) vstore8(positions_of(e, vload8(0, seed + i)), 0, position + i);
#else
  (void)e;
  const uint* const position = seed;
#endif
  for (int i = 0; i < count; i += 8) {
    const uv own = vload8(0, position + i);
    uv r = (uv)0;  // counted by select(): Oclgrind takes the true of a comparison that is added for 255
    for (int j = 0; j < count; ++j) r += select((uv)0, (uv)1, (uv)position[j] < own);
    vstore8(r, 0, rank + i);
  }
  for (int i = 0; i < count; ++i) keys->label_of[rank[i]] = (uint)(list[i] >> 32);
  const uint rank_bits = 32 - clz((uint)count - 1);
  keys->count = count;
  keys->rank_mask = (uv)((1u << rank_bits) - 1);
  const uint base = d->seed[0];
  const iv x0 = LANES_8 + b.x, x1 = x0 + 8, y0 = LANES_8 + b.y, z0 = LANES_8 + b.z;
  const iv base_x0 = ALONG_X(x0 - x_of(base)), base_x1 = ALONG_X(x1 - x_of(base));
  const iv base_y = ALONG_Y(y0 - y_of(base)), base_z = ALONG_Z(z0 - z_of(base));
  for (int i = 0; i < count; ++i) {
    const int x = x_of(seed[i]), y = y_of(seed[i]), z = z_of(seed[i]);
    keys->of_column[2 * i] = (as_uint8(ALONG_X(x0 - x) - base_x0) << rank_bits) + rank[i];
    keys->of_column[2 * i + 1] = (as_uint8(ALONG_X(x1 - x) - base_x1) << rank_bits) + rank[i];
    keys->of_y[i] = as_uint8(ALONG_Y(y0 - y) - base_y) << rank_bits;
    vstore8(as_uint8(ALONG_Z(z0 - z) - base_z) << rank_bits, (size_t)i, keys->of_z);
  }
}

// The least keys of ROWS rows of 16 voxels.
static inline void find_least(const keys_t* keys, const uint* of_row, int first, iv* least) {
#pragma unroll
  for (int i = 0; i < 2 * ROWS; ++i) least[i] = (iv)INT_MAX;
  for (int c = 0; c < keys->count; ++c) {
    const uv left = keys->of_column[2 * c], right = keys->of_column[2 * c + 1];
    const uint* const rows = of_row + c * BOX_Y + first;
#pragma unroll
    for (int i = 0; i < ROWS; ++i) {
      least[2 * i] = min(least[2 * i], as_int8(left + rows[i]));
      least[2 * i + 1] = min(least[2 * i + 1], as_int8(right + rows[i]));
    }
  }
}

__attribute__((noinline)) static void label_by_keys(const index_t* index, const dominators_t* d, const ulong* list,
                                                    int count, global uint* labels) {
  const box_t b = d->box;
  const extent_t e = index->extent;
  keys_t keys;
  make_keys(e, d, list, count, &keys);
  const int vectors = (count + 7) / 8;
  const bool whole = b.x + BOX_X <= END_X(e) && b.y + BOX_Y <= END_Y(e);
  for (int z = 0; z < min(BOX_Z, END_Z(e) - b.z); ++z) {
    uint of_row[MOST_OF_KEYS * BOX_Y];
    for (int i = 0; i < count; ++i) vstore8(keys.of_y[i] + keys.of_z[i * BOX_Z + z], (size_t)i, of_row);
    for (int first = 0; first < BOX_Y; first += ROWS) {
      iv least[2 * ROWS];
      find_least(&keys, of_row, first, least);
      global uint* const out = label_at(e, labels, b.x, b.y + first, b.z + z);
      if (whole) {
        switch (vectors) {
          case 1: label_block(keys.label_of, 1, keys.rank_mask, least, out, e.width); break;
          case 2: label_block(keys.label_of, 2, keys.rank_mask, least, out, e.width); break;
          case 3: label_block(keys.label_of, 3, keys.rank_mask, least, out, e.width); break;
          case 4: label_block(keys.label_of, 4, keys.rank_mask, least, out, e.width); break;
          default: label_block(keys.label_of, 0, keys.rank_mask, least, out, e.width);
        }
        continue;
      }
      for (int i = 0; i < ROWS && b.y + first + i < END_Y(e); ++i) {
        uint at[BOX_X];
        vstore8(as_uint8(least[2 * i]) & keys.rank_mask, 0, at);
        vstore8(as_uint8(least[2 * i + 1]) & keys.rank_mask, 1, at);
        global uint* const row = out + (size_t)i * (size_t)e.width;
        for (int x = 0; x < min(BOX_X, END_X(e) - b.x); ++x) row[x] = keys.label_of[at[x]];
      }
    }
  }
}

// A part of a box with more candidates than ranks, voxel by voxel. Rare, so plain.
static inline void label_plainly(const index_t* index, box_t b, const ulong* list, int count, global uint* labels) {
  const extent_t e = index->extent;
  for (int z = b.z; z < min(b.z + b.hz + 1, END_Z(e)); ++z) {
    for (int y = b.y; y < min(b.y + b.hy + 1, END_Y(e)); ++y) {
      for (int x = b.x; x < min(b.x + b.hx + 1, END_X(e)); x += 8) {
        iv least = (iv)INT_MAX;
        uv best = (uv)EMPTY, label = (uv)0;
        for (int i = 0; i < count; ++i) {
          const uint seed = (uint)list[i];
          const iv dx = LANES_8 + (x - x_of(seed));
          const int dy = y - y_of(seed), dz = z - z_of(seed);
          const iv distance = ALONG_X(dx) + (ALONG_Y(dy) + ALONG_Z(dz));
          const uv position = positions_of(e, (uv)seed);
          const iv wins = (distance < least) | ((distance == least) & as_int8(position < best));
          least = min(least, distance);
          best = select(best, position, wins);
          label = select(label, (uv)(uint)(list[i] >> 32), wins);
        }
        uint l[8];
        vstore8(label, 0, l);
        global uint* const out = label_at(e, labels, x, y, z);
        for (int i = 0; i < min(8, END_X(e) - x); ++i) out[i] = l[i];
      }
    }
  }
}

// A part whose list overflowed, voxel by voxel.
static inline void label_by_voxels(const index_t* index, box_t b, global uint* labels) {
  const extent_t e = index->extent;
  for (int z = b.z; z < min(b.z + b.hz + 1, END_Z(e)); ++z) {
    for (int y = b.y; y < min(b.y + b.hy + 1, END_Y(e)); ++y) {
      for (int x = b.x; x < min(b.x + b.hx + 1, END_X(e)); ++x) {
        *label_at(e, labels, x, y, z) = search_voxel(index, x - MARGIN_X(e), y - MARGIN_Y(e), z - MARGIN_Z(e));
      }
    }
  }
}

#endif
