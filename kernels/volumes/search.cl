// The seeds that can win in a box of voxels: searched in the index, blocks, regions, bins, seeds, or taken from
// those of a box around it.
//
// DOMINANCE. A seed d rules out a seed s in a box if it is nearer at all 8 corners. The least lag over the corners,
// |s - c|^2 - |d - c|^2, is a sum of least lags along the axes: with coordinates from the box's first corner and h its
// last one, |s|^2 - |d|^2 - sum of max(0, 2 h (s - d)). So a corner costs nothing: 10 operations for all 8.
// Equal distances rule nothing out, so no proof needs the tie rule.

#ifndef VOROCL_VOLUMES_SEARCH
#define VOROCL_VOLUMES_SEARCH

#include "volumes/index.cl"

// Tests have short lists.
#ifndef MOST_SEEDS
#define MOST_SEEDS 4096  // in a list
#define MOST_NODES 4096  // in a search's list of regions or of bins
#endif
#define FEW_IN_REGION 64  // seeds: so many are taken without a look at the bins
#define SEED_ROOM (MOST_SEEDS + 1024)  // of a list: two bins more, and a vector behind them
#define PLACES 9          // the centre and the corners of a box
#define OVERFLOW (-1)     // instead of a number of seeds

typedef struct {
  extent_t extent;
  global const uint* starts;
  global const uint* low;
  global const uint* high;
  global const uint* seed;
  global const ulong* list;
} index_t;

typedef struct {
  int x, y, z;     // the first corner
  int hx, hy, hz;  // from it to the last corner
} box_t;

// The seed nearest to each place, as far as known.
typedef struct {
  box_t box;
  int distance[PLACES];
  uint seed[PLACES];
  // The different ones among them, relative to the box's first corner.
  int count;
  int n[PLACES], x[PLACES], y[PLACES], z[PLACES];
} dominators_t;

static inline void begin_dominators(dominators_t* d, box_t box) {
  d->box = box;
  d->count = 0;
#pragma unroll
  for (int i = 0; i < PLACES; ++i) d->distance[i] = INT_MAX, d->seed[i] = EMPTY;
}

// Distances to the places, less what is the same for all seeds. The centre is half way to the last corner.
typedef struct {
  iv best[PLACES];
  uv seed[PLACES];
} nearest_t;

static inline void begin_nearest(nearest_t* nearest, const dominators_t* d) {
#pragma unroll
  for (int i = 0; i < PLACES; ++i) nearest->best[i] = (iv)d->distance[i], nearest->seed[i] = (uv)d->seed[i];
}

static inline iv is_empty(uv seeds) { return as_int8(seeds) < 0; }

static inline void take_nearest(nearest_t* nearest, box_t b, uv seed) {
  const iv x = xs_of(seed) - b.x, y = ys_of(seed) - b.y, z = zs_of(seed) - b.z;
  const iv n = (x * x + y * y + z * z) | (is_empty(seed) & 0x3fffffff);  // the squared sides are below that
  const iv x2 = x * (2 * b.hx), y2 = y * (2 * b.hy), z2 = z * (2 * b.hz);
  iv to[PLACES];
  to[1] = n;
  to[2] = n - x2;
  to[3] = to[1] - y2;
  to[4] = to[2] - y2;
#pragma unroll
  for (int i = 1; i < 5; ++i) to[4 + i] = to[i] - z2;
  to[0] = n - ((x2 + y2 + z2) >> 1);
#pragma unroll
  for (int i = 0; i < PLACES; ++i) {
    nearest->seed[i] = select(nearest->seed[i], seed, to[i] < nearest->best[i]);
    nearest->best[i] = min(nearest->best[i], to[i]);
  }
}

static inline void end_nearest(const nearest_t* nearest, dominators_t* d) {
#pragma unroll
  for (int i = 0; i < PLACES; ++i) {
    const int least = least_lane(nearest->best[i]);
    d->distance[i] = least;
    d->seed[i] = least_lane_u(select((uv)0xffffffffu, nearest->seed[i], nearest->best[i] == least));
  }
  d->count = 0;
  for (int i = 0; i < PLACES; ++i) {
    const uint s = d->seed[i];
    if (s & EMPTY) continue;
    bool known = false;
    for (int j = 0; j < i; ++j) known |= d->seed[j] == s;
    if (known) continue;
    const int x = x_of(s) - d->box.x, y = y_of(s) - d->box.y, z = z_of(s) - d->box.z;
    d->x[d->count] = x, d->y[d->count] = y, d->z[d->count] = z, d->n[d->count] = x * x + y * y + z * z;
    ++d->count;
  }
}

// Lists are read in whole vectors, so they are padded with positions that are empty.
static inline uv load_seeds(const ulong* list) {
  const uint16 both = vload16(0, (const uint*)list);
  return both.even;
}
static inline void pad(ulong* list, int count) { vstore8((ulong8)EMPTY, 0, list + count); }

// How far a seed is behind the one that rules it out the most; above 0: it wins nowhere in the box.
static inline iv greatest_lag(const dominators_t* d, uv seed) {
  const box_t b = d->box;
  const iv x = xs_of(seed) - b.x, y = ys_of(seed) - b.y, z = zs_of(seed) - b.z;
  const iv n = x * x + y * y + z * z;
  iv lag = select((iv)INT_MIN, (iv)1, is_empty(seed));
  const int hx = 2 * b.hx, hy = 2 * b.hy, hz = 2 * b.hz;
  const iv x2 = x * hx, y2 = y * hy, z2 = z * hz;
  for (int i = 0; i < d->count; ++i) {
    lag = max(lag, n - d->n[i] - max(x2 - d->x[i] * hx, (iv)0) - max(y2 - d->y[i] * hy, (iv)0) -
                       max(z2 - d->z[i] * hz, (iv)0));
  }
  return lag;
}

// Copies the seeds of a padded list that are not ruled out (in place where the lists are one), and pads.
static inline int filter(const dominators_t* d, const ulong* from, int count, ulong* to) {
  int kept = 0;
  for (int i = 0; i < count; i += 8) {
    int keep[8];
    vstore8(greatest_lag(d, load_seeds(from + i)) <= 0, 0, keep);
#pragma unroll
    for (int lane = 0; lane < 8; ++lane) {
      to[kept] = from[i + lane];
      kept += keep[lane] & 1;
    }
  }
  pad(to, kept);
  return kept;
}

static inline void improve(dominators_t* d, const ulong* list, int count) {
  nearest_t nearest;
  begin_nearest(&nearest, d);
  for (int i = 0; i < count; i += 8) take_nearest(&nearest, d->box, load_seeds(list + i));
  end_nearest(&nearest, d);
}

// Of 8 nodes, by their boxes: which may hold a seed that wins. Along an axis a node's least lag is that of its point
// nearest to either end.
static inline iv nodes_left(const dominators_t* d, uv low, uv high) {
  const box_t b = d->box;
  const iv lx = xs_of(low) - b.x, hx = xs_of(high) - b.x, ly = ys_of(low) - b.y, hy = ys_of(high) - b.y;
  const iv lz = zs_of(low) - b.z, hz = zs_of(high) - b.z;
#define TO(at, l, h) max(max(l - (at), (at) - h), (iv)0)
  iv x0 = TO(0, lx, hx), x1 = TO(b.hx, lx, hx), y0 = TO(0, ly, hy), y1 = TO(b.hy, ly, hy);
  iv z0 = TO(0, lz, hz), z1 = TO(b.hz, lz, hz);
#undef TO
  x0 *= x0, x1 *= x1, y0 *= y0, y1 *= y1, z0 *= z0, z1 *= z1;
  iv lag = select((iv)INT_MIN, (iv)1, is_empty(low));
  for (int i = 0; i < d->count; ++i) {
    const int x = d->x[i], y = d->y[i], z = d->z[i];
    lag = max(lag, min(x0 - x * x, x1 - (b.hx - x) * (b.hx - x)) + min(y0 - y * y, y1 - (b.hy - y) * (b.hy - y)) +
                       min(z0 - z * z, z1 - (b.hz - z) * (b.hz - z)));
  }
  return lag <= 0;
}

static inline int keep_nodes(uint first, iv condition, uint* nodes, int kept) {
  int keep[8];
  vstore8(condition, 0, keep);
#pragma unroll
  for (int i = 0; i < 8; ++i) {
    nodes[kept] = first + (uint)i;
    kept += keep[i] & 1;
  }
  return kept;
}

static inline int copy_seeds(const index_t* index, uint begin, uint end, ulong* seeds, int found) {
  for (uint j = begin; j < end; j += 4) vstore4(vload4(0, index->list + j), 0, seeds + found + (int)(j - begin));
  return found + (int)(end - begin);
}

// The regions with seeds of the blocks that may hold a seed that wins; OVERFLOW if there are too many.
static inline int regions_of_blocks(const index_t* index, dominators_t* d, nearest_t* nearest, uint* regions) {
  const extent_t e = index->extent;
  const int blocks = blocks_of(e);
  const size_t region_nodes = (size_t)regions_of(e) * BINS, start = region_nodes + (size_t)regions_of(e);
  for (int i = 0; i < blocks; i += 8) take_nearest(nearest, d->box, vload8(0, index->seed + start + i));
  end_nearest(nearest, d);
  int count = 0;
  for (int i = 0; i < blocks; i += 8) {
    int keep[8];
    vstore8(nodes_left(d, vload8(0, index->low + start + i), vload8(0, index->high + start + i)), 0, keep);
    for (int lane = 0; lane < 8; ++lane) {
      if (!keep[lane]) continue;
      if (count > MOST_NODES - BLOCK * BLOCK * BLOCK) return OVERFLOW;
      const int block = i + lane;
      const int x = block % e.bx * BLOCK, y = block / e.bx % e.by * BLOCK, z = block / e.bx / e.by * BLOCK;
      for (int k = z; k < min(z + BLOCK, e.rz); ++k) {
        for (int j = y; j < min(y + BLOCK, e.ry); ++j) {
          for (int l = x; l < min(x + BLOCK, e.rx); ++l) {
            regions[count] = (uint)((k * e.ry + j) * e.rx + l);
            count += index->low[region_nodes + regions[count]] != EMPTY;
          }
        }
      }
    }
  }
  return count;
}

// The values of 8 regions of a list; EMPTY behind its end.
static inline uv of_regions(global const uint* values, const uint* regions, int i, int count) {
  uint lane[8];
  for (int l = 0; l < 8; ++l) lane[l] = i + l < count ? values[regions[i + l]] : EMPTY;
  return vload8(0, lane);
}

// Of a list of regions those that may hold a seed that wins.
static inline int regions_left(const index_t* index, dominators_t* d, nearest_t* nearest, uint* regions, int count) {
  const size_t first = (size_t)regions_of(index->extent) * BINS;
  for (int i = 0; i < count; i += 8) take_nearest(nearest, d->box, of_regions(index->seed + first, regions, i, count));
  end_nearest(nearest, d);
  int kept = 0;
  for (int i = 0; i < count; i += 8) {
    int keep[8];
    const uv low = of_regions(index->low + first, regions, i, count);
    vstore8(nodes_left(d, low, of_regions(index->high + first, regions, i, count)), 0, keep);
    for (int lane = 0; lane < 8; ++lane) {
      regions[kept] = regions[i + lane];
      kept += keep[lane] & 1;
    }
  }
  return kept;
}

// The bins of regions that may hold a seed that wins; OVERFLOW if there are too many.
static inline int bins_left(const index_t* index, dominators_t* d, nearest_t* nearest, const uint* regions, int count,
                            uint* bins) {
  for (int i = 0; i < count; ++i) {
    for (uint j = 0; j < BINS; j += 8) take_nearest(nearest, d->box, vload8(0, index->seed + regions[i] * BINS + j));
  }
  end_nearest(nearest, d);
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    if (kept > MOST_NODES - BINS) return OVERFLOW;
    for (uint j = 0; j < BINS; j += 8) {
      const uint at = regions[i] * BINS + j;
      kept = keep_nodes(at, nodes_left(d, vload8(0, index->low + at), vload8(0, index->high + at)), bins, kept);
    }
  }
  return kept;
}

// The seeds that may win in a box; OVERFLOW if a list is too short. None at all only where the volume has no seed.
__attribute__((noinline)) static int search(const index_t* index, box_t box, dominators_t* d, ulong* seeds) {
  uint regions[MOST_NODES + 8], bins[MOST_NODES + 8];
  begin_dominators(d, box);
  nearest_t nearest;
  begin_nearest(&nearest, d);
  int count = regions_of_blocks(index, d, &nearest, regions);
  if (count == OVERFLOW) return OVERFLOW;
  count = regions_left(index, d, &nearest, regions, count);
  // The seeds of a region with few of them are taken as they are. Of others the bins are tested.
  int found = 0, crowded = 0;
  for (int i = 0; i < count; ++i) {
    const uint begin = index->starts[regions[i] * (BINS + 1)], end = index->starts[regions[i] * (BINS + 1) + BINS];
    if (end - begin <= FEW_IN_REGION && found <= MOST_SEEDS - FEW_IN_REGION) {
      found = copy_seeds(index, begin, end, seeds, found);
    } else {
      regions[crowded++] = regions[i];
    }
  }
  if (crowded > 0) {
    count = bins_left(index, d, &nearest, regions, crowded, bins);
    if (count == OVERFLOW) return OVERFLOW;
    for (int i = 0; i < count; ++i) {
      const uint at = bins[i] / BINS * (BINS + 1) + bins[i] % BINS;
      found = copy_seeds(index, index->starts[at], index->starts[at + 1], seeds, found);
      if (found <= MOST_SEEDS) continue;
      pad(seeds, found);
      improve(d, seeds, found);
      found = filter(d, seeds, found, seeds);
      if (found > MOST_SEEDS / 2) return OVERFLOW;
    }
  }
  pad(seeds, found);
  improve(d, seeds, found);
  return filter(d, seeds, found, seeds);
}

// The squared distance of a voxel to the box around a node's seeds.
static inline uint distance_to_node(const index_t* index, size_t node, int x, int y, int z) {
  const uint low = index->low[node], high = index->high[node];
  const int dx = max(max(x_of(low) - x, x - x_of(high)), 0), dy = max(max(y_of(low) - y, y - y_of(high)), 0);
  const int dz = max(max(z_of(low) - z, z - z_of(high)), 0);
  return (uint)(dx * dx + dy * dy + dz * dz);
}

// The nearest seed of a voxel, without lists that could overflow: walks through all nodes that may be as near as the
// nearest seed so far. Takes only seeds that come before.
typedef struct {
  uint distance;
  ulong seed;
} nearest_seed_t;

static inline bool may_win(const index_t* index, size_t node, int x, int y, int z, const nearest_seed_t* nearest) {
  return index->low[node] != EMPTY && distance_to_node(index, node, x, y, z) <= nearest->distance;
}

static inline void search_bin(const index_t* index, uint bin, int x, int y, int z, nearest_seed_t* nearest) {
  const uint first = bin / BINS * (BINS + 1) + bin % BINS, end = index->starts[first + 1];
  for (uint i = index->starts[first]; i < end; ++i) {
    const ulong seed = index->list[i];
    const int dx = x_of((uint)seed) - x, dy = y_of((uint)seed) - y, dz = z_of((uint)seed) - z;
    const uint distance = (uint)(dx * dx + dy * dy + dz * dz);
    if (distance > nearest->distance) continue;
    if (distance == nearest->distance && (uint)seed > (uint)nearest->seed) continue;
    nearest->distance = distance;
    nearest->seed = seed;
  }
}

static inline uint search_voxel(const index_t* index, int x, int y, int z) {
  const extent_t e = index->extent;
  const size_t region_nodes = (size_t)regions_of(e) * BINS, block_nodes = (size_t)regions_of(e) * (BINS + 1);
  nearest_seed_t nearest = {0xffffffffu, (ulong)NO_LABEL << 32 | 0xffffffffu};
  for (int block = 0; block < blocks_of(e); ++block) {
    if (!may_win(index, block_nodes + (size_t)block, x, y, z, &nearest)) continue;
    const int first_x = block % e.bx * BLOCK, first_y = block / e.bx % e.by * BLOCK;
    const int first_z = block / e.bx / e.by * BLOCK;
    for (int k = first_z; k < min(first_z + BLOCK, e.rz); ++k) {
      for (int j = first_y; j < min(first_y + BLOCK, e.ry); ++j) {
        for (int i = first_x; i < min(first_x + BLOCK, e.rx); ++i) {
          const uint region = (uint)((k * e.ry + j) * e.rx + i);
          if (!may_win(index, region_nodes + region, x, y, z, &nearest)) continue;
          for (uint bin = region * BINS; bin < (region + 1) * BINS; ++bin) {
            if (may_win(index, bin, x, y, z, &nearest)) search_bin(index, bin, x, y, z, &nearest);
          }
        }
      }
    }
  }
  return (uint)(nearest.seed >> 32);
}

#endif
