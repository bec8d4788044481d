// The seeds that can win in a box of voxels: searched in the index, blocks, regions, bins, seeds, or taken from
// those of a box around it.
//
// DOMINANCE. A seed d rules out a seed s in a box if it is nearer at all 8 corners. The least lag over the corners,
// |s - c|^2 - |d - c|^2, is a sum of least lags along the axes: with coordinates from the box's first corner and h its
// last one, |s|^2 - |d|^2 - sum of max(0, 2 h (s - d)). So a corner costs nothing: 10 operations for all 8.
// Equal distances rule nothing out, so no proof needs the tie rule.
//
// PLACES. Along a periodic axis a seed has images, a period before and behind it, and the candidates are images: a box
// may have two of one seed. They are seeds like others to all proofs, for the nearest image is as far as the shorter
// way round. Their places are coordinates that start half a period before the volume (MARGIN_X and so on, 0 along other
// axes), packed as positions are; an image that is farther from all voxels is none. Boxes are in places.

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

#define MARGIN_X(e) (PERIODIC_X ? (e).width / 2 : 0)
#define MARGIN_Y(e) (PERIODIC_Y ? (e).height / 2 : 0)
#define MARGIN_Z(e) (PERIODIC_Z ? (e).depth / 2 : 0)

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

// What is added to positions for the places of an image. Images have numbers: a digit of base 3 for each axis, of which
// 1 is the seed itself.
typedef struct {
  int x, y, z;
} image_t;
#ifdef VOROCL_PERIODIC
#define FIRST_IMAGE 0u
#define LAST_IMAGE 26u
#else
#define FIRST_IMAGE 13u
#define LAST_IMAGE 13u
#endif

// The same of 8 images.
typedef struct {
  iv x, y, z;
} images_t;

static inline images_t images_of(extent_t e, uv numbers) {
  const images_t images = {as_int8(numbers % 3 - 1) * e.width + MARGIN_X(e),
                           as_int8(numbers / 3 % 3 - 1) * e.height + MARGIN_Y(e),
                           as_int8(numbers / 9 - 1) * e.depth + MARGIN_Z(e)};
  return images;
}
static inline image_t image_of(extent_t e, uint number) {
  const image_t image = {((int)(number % 3) - 1) * e.width + MARGIN_X(e),
                         ((int)(number / 3 % 3) - 1) * e.height + MARGIN_Y(e),
                         ((int)(number / 9) - 1) * e.depth + MARGIN_Z(e)};
  return image;
}

// Whether the image before (digit 0) or behind (2) is the nearest one of some seed to some voxel of a box, along an
// axis.
static inline bool has_near_image(uint digit, int first, int h, int size, int periodic) {
  const int at = first - size / 2;  // the box's first voxel in the volume
  return digit == 1 || (periodic && (digit == 0 ? 2 * at < size : 2 * (at + h) >= size));
}
static inline bool is_near_image(extent_t e, box_t b, uint number) {
  return has_near_image(number % 3, b.x, b.hx, e.width, PERIODIC_X) &&
         has_near_image(number / 3 % 3, b.y, b.hy, e.height, PERIODIC_Y) &&
         has_near_image(number / 9, b.z, b.hz, e.depth, PERIODIC_Z);
}

// Coordinates from a box's first corner, and its last corner, in units of distances.
static inline iv from_x(box_t b, uv p) { return (xs_of(p) - b.x) * SPACING_X; }
static inline iv from_y(box_t b, uv p) { return (ys_of(p) - b.y) * SPACING_Y; }
static inline iv from_z(box_t b, uv p) { return (zs_of(p) - b.z) * SPACING_Z; }
static inline int last_x(box_t b) { return b.hx * SPACING_X; }
static inline int last_y(box_t b) { return b.hy * SPACING_Y; }
static inline int last_z(box_t b) { return b.hz * SPACING_Z; }

static inline iv is_empty(uv seeds) { return as_int8(seeds) < 0; }

// The places of images of seeds; EMPTY where there is none.
static inline uv places_of(extent_t e, images_t images, uv seeds) {
#ifdef VOROCL_PERIODIC
  const iv x = xs_of(seeds) + images.x, y = ys_of(seeds) + images.y, z = zs_of(seeds) + images.z;
  const iv none = is_empty(seeds) | (x < 0) | (y < 0) | (z < 0) | (x >= e.width + 2 * MARGIN_X(e)) |
                  (y >= e.height + 2 * MARGIN_Y(e)) | (z >= e.depth + 2 * MARGIN_Z(e));
  return select(as_uint8(z) << SHIFT_Z | as_uint8(y) << VOROCL_BITS_X | as_uint8(x), (uv)EMPTY, none);
#else
  (void)e, (void)images;
  return seeds;
#endif
}

// The same of the boxes of nodes, cut at the ends of the places.
static inline void place_boxes(extent_t e, images_t images, uv* low, uv* high) {
#ifdef VOROCL_PERIODIC
  const iv lx = max(xs_of(*low) + images.x, 0), hx = min(xs_of(*high) + images.x, e.width + 2 * MARGIN_X(e) - 1);
  const iv ly = max(ys_of(*low) + images.y, 0), hy = min(ys_of(*high) + images.y, e.height + 2 * MARGIN_Y(e) - 1);
  const iv lz = max(zs_of(*low) + images.z, 0), hz = min(zs_of(*high) + images.z, e.depth + 2 * MARGIN_Z(e) - 1);
  const iv none = is_empty(*low) | (lx > hx) | (ly > hy) | (lz > hz);
  *low = select(as_uint8(lz) << SHIFT_Z | as_uint8(ly) << VOROCL_BITS_X | as_uint8(lx), (uv)EMPTY, none);
  *high = select(as_uint8(hz) << SHIFT_Z | as_uint8(hy) << VOROCL_BITS_X | as_uint8(hx), (uv)EMPTY, none);
#else
  (void)e, (void)images, (void)low, (void)high;
#endif
}

// The positions of the seeds whose images are at these places.
static inline uv positions_of(extent_t e, uv places) {
#ifdef VOROCL_PERIODIC
  iv x = xs_of(places) - MARGIN_X(e), y = ys_of(places) - MARGIN_Y(e), z = zs_of(places) - MARGIN_Z(e);
  x += select((iv)0, (iv)e.width, x < 0) - select((iv)0, (iv)e.width, x >= e.width);
  y += select((iv)0, (iv)e.height, y < 0) - select((iv)0, (iv)e.height, y >= e.height);
  z += select((iv)0, (iv)e.depth, z < 0) - select((iv)0, (iv)e.depth, z >= e.depth);
  return as_uint8(z) << SHIFT_Z | as_uint8(y) << VOROCL_BITS_X | as_uint8(x);
#else
  (void)e;
  return places;
#endif
}

// The entries of a search's lists: the number of an image, above a node's. Without periodic axes the node alone.
#ifdef VOROCL_PERIODIC
#define NODE_BITS 26  // there are at most 2^24 bins
#else
#define NODE_BITS 0
#endif
static inline uint entry_of(uint image, uint node) { return NODE_BITS == 0 ? node : image << NODE_BITS | node; }
static inline uint node_of(uint entry) { return NODE_BITS == 0 ? entry : entry & ((1u << NODE_BITS) - 1); }
static inline uint image_in(uint entry) { return NODE_BITS == 0 ? FIRST_IMAGE : entry >> NODE_BITS; }

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

static inline void take_nearest(nearest_t* nearest, box_t b, uv seed) {
  const iv x = from_x(b, seed), y = from_y(b, seed), z = from_z(b, seed);
  const iv n = (x * x + y * y + z * z) | (is_empty(seed) & 0x3fffffff);  // the squared sides are below that
  const iv x2 = x * (2 * last_x(b)), y2 = y * (2 * last_y(b)), z2 = z * (2 * last_z(b));
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
    const int x = (x_of(s) - d->box.x) * SPACING_X, y = (y_of(s) - d->box.y) * SPACING_Y;
    const int z = (z_of(s) - d->box.z) * SPACING_Z;
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
  const iv x = from_x(b, seed), y = from_y(b, seed), z = from_z(b, seed);
  const iv n = x * x + y * y + z * z;
  iv lag = select((iv)INT_MIN, (iv)1, is_empty(seed));
  const int hx = 2 * last_x(b), hy = 2 * last_y(b), hz = 2 * last_z(b);
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
  const iv lx = from_x(b, low), hx = from_x(b, high), ly = from_y(b, low), hy = from_y(b, high);
  const iv lz = from_z(b, low), hz = from_z(b, high);
  const int ex = last_x(b), ey = last_y(b), ez = last_z(b);
#define TO(at, l, h) max(max(l - (at), (at) - h), (iv)0)
  iv x0 = TO(0, lx, hx), x1 = TO(ex, lx, hx), y0 = TO(0, ly, hy), y1 = TO(ey, ly, hy);
  iv z0 = TO(0, lz, hz), z1 = TO(ez, lz, hz);
#undef TO
  x0 *= x0, x1 *= x1, y0 *= y0, y1 *= y1, z0 *= z0, z1 *= z1;
  iv lag = select((iv)INT_MIN, (iv)1, is_empty(low));
  for (int i = 0; i < d->count; ++i) {
    const int x = d->x[i], y = d->y[i], z = d->z[i];
    lag = max(lag, min(x0 - x * x, x1 - (ex - x) * (ex - x)) + min(y0 - y * y, y1 - (ey - y) * (ey - y)) +
                       min(z0 - z * z, z1 - (ez - z) * (ez - z)));
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

// Adds the images of these seeds of the index to a list.
static inline int copy_seeds(const index_t* index, image_t image, uint begin, uint end, ulong* seeds, int found) {
#ifdef VOROCL_PERIODIC
  const extent_t e = index->extent;
  for (uint j = begin; j < end; ++j) {
    const ulong seed = index->list[j];
    const int x = x_of((uint)seed) + image.x, y = y_of((uint)seed) + image.y, z = z_of((uint)seed) + image.z;
    seeds[found] = (seed >> 32) << 32 | pack(x, y, z);
    found += x >= 0 && x < e.width + 2 * MARGIN_X(e) && y >= 0 && y < e.height + 2 * MARGIN_Y(e) && z >= 0 &&
             z < e.depth + 2 * MARGIN_Z(e);
  }
  return found;
#else
  (void)image;
  for (uint j = begin; j < end; j += 4) vstore4(vload4(0, index->list + j), 0, seeds + found + (int)(j - begin));
  return found + (int)(end - begin);
#endif
}

// The regions with seeds of the blocks that may hold a seed that wins; OVERFLOW if there are too many.
static inline int regions_of_blocks(const index_t* index, dominators_t* d, nearest_t* nearest, uint* regions) {
  const extent_t e = index->extent;
  const int blocks = blocks_of(e);
  const size_t region_nodes = (size_t)regions_of(e) * BINS, start = region_nodes + (size_t)regions_of(e);
  for (uint number = FIRST_IMAGE; number <= LAST_IMAGE; ++number) {
    if (!is_near_image(e, d->box, number)) continue;
    const images_t images = images_of(e, (uv)number);
    for (int i = 0; i < blocks; i += 8) {
      take_nearest(nearest, d->box, places_of(e, images, vload8(0, index->seed + start + i)));
    }
  }
  end_nearest(nearest, d);
  int count = 0;
  for (uint number = FIRST_IMAGE; number <= LAST_IMAGE; ++number) {
    if (!is_near_image(e, d->box, number)) continue;
    const images_t images = images_of(e, (uv)number);
    for (int i = 0; i < blocks; i += 8) {
      int keep[8];
      uv low = vload8(0, index->low + start + i), high = vload8(0, index->high + start + i);
      place_boxes(e, images, &low, &high);
      vstore8(nodes_left(d, low, high), 0, keep);
      for (int lane = 0; lane < 8; ++lane) {
        if (!keep[lane]) continue;
        if (count > MOST_NODES - BLOCK * BLOCK * BLOCK) return OVERFLOW;
        const int block = i + lane;
        const int x = block % e.bx * BLOCK, y = block / e.bx % e.by * BLOCK, z = block / e.bx / e.by * BLOCK;
        for (int k = z; k < min(z + BLOCK, e.rz); ++k) {
          for (int j = y; j < min(y + BLOCK, e.ry); ++j) {
            for (int l = x; l < min(x + BLOCK, e.rx); ++l) {
              const uint region = (uint)((k * e.ry + j) * e.rx + l);
              regions[count] = entry_of(number, region);
              count += index->low[region_nodes + region] != EMPTY;
            }
          }
        }
      }
    }
  }
  return count;
}

// The images of 8 regions of a list.
static inline images_t images_of_regions(extent_t e, const uint* regions, int i) {
  return images_of(e, NODE_BITS == 0 ? (uv)FIRST_IMAGE : vload8(0, regions + i) >> NODE_BITS);
}

// The values of 8 regions of a list; EMPTY behind its end.
static inline uv of_regions(global const uint* values, const uint* regions, int i, int count) {
  uint lane[8];
  for (int l = 0; l < 8; ++l) lane[l] = i + l < count ? values[node_of(regions[i + l])] : EMPTY;
  return vload8(0, lane);
}

// Of a list of regions those that may hold a seed that wins.
static inline int regions_left(const index_t* index, dominators_t* d, nearest_t* nearest, uint* regions, int count) {
  const extent_t e = index->extent;
  const size_t first = (size_t)regions_of(e) * BINS;
  for (int i = 0; i < count; i += 8) {
    const uv seeds = of_regions(index->seed + first, regions, i, count);
    take_nearest(nearest, d->box, places_of(e, images_of_regions(e, regions, i), seeds));
  }
  end_nearest(nearest, d);
  int kept = 0;
  for (int i = 0; i < count; i += 8) {
    int keep[8];
    uv low = of_regions(index->low + first, regions, i, count);
    uv high = of_regions(index->high + first, regions, i, count);
    place_boxes(e, images_of_regions(e, regions, i), &low, &high);
    vstore8(nodes_left(d, low, high), 0, keep);
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
  const extent_t e = index->extent;
  for (int i = 0; i < count; ++i) {
    const images_t images = images_of(e, (uv)image_in(regions[i]));
    global const uint* const seeds = index->seed + node_of(regions[i]) * BINS;
    for (uint j = 0; j < BINS; j += 8) take_nearest(nearest, d->box, places_of(e, images, vload8(0, seeds + j)));
  }
  end_nearest(nearest, d);
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    if (kept > MOST_NODES - BINS) return OVERFLOW;
    const uint number = image_in(regions[i]);
    for (uint j = 0; j < BINS; j += 8) {
      const uint at = node_of(regions[i]) * BINS + j;
      uv low = vload8(0, index->low + at), high = vload8(0, index->high + at);
      place_boxes(e, images_of(e, (uv)number), &low, &high);
      kept = keep_nodes(entry_of(number, at), nodes_left(d, low, high), bins, kept);
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
    const uint first = node_of(regions[i]) * (BINS + 1);
    const uint begin = index->starts[first], end = index->starts[first + BINS];
    if (end - begin <= FEW_IN_REGION && found <= MOST_SEEDS - FEW_IN_REGION) {
      found = copy_seeds(index, image_of(index->extent, image_in(regions[i])), begin, end, seeds, found);
    } else {
      regions[crowded++] = regions[i];
    }
  }
  if (crowded > 0) {
    count = bins_left(index, d, &nearest, regions, crowded, bins);
    if (count == OVERFLOW) return OVERFLOW;
    for (int i = 0; i < count; ++i) {
      const uint bin = node_of(bins[i]), at = bin / BINS * (BINS + 1) + bin % BINS;
      const image_t image = image_of(index->extent, image_in(bins[i]));
      found = copy_seeds(index, image, index->starts[at], index->starts[at + 1], seeds, found);
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

// The least way along an axis from a coordinate to a stretch of it.
static inline int way_to(int at, int low, int high, int size, int periodic) {
  const int inside = max(max(low - at, at - high), 0);
  if (!periodic) return inside;
  return min(inside, size - max(high - at, at - low));
}

// The squared distance of a voxel to the box around a node's seeds. The search of a voxel is in positions.
static inline uint distance_to_node(const index_t* index, size_t node, int x, int y, int z) {
  const uint low = index->low[node], high = index->high[node];
  const extent_t e = index->extent;
  const int dx = way_to(x, x_of(low), x_of(high), e.width, PERIODIC_X);
  const int dy = way_to(y, y_of(low), y_of(high), e.height, PERIODIC_Y);
  const int dz = way_to(z, z_of(low), z_of(high), e.depth, PERIODIC_Z);
  return (uint)(ALONG_X(dx) + ALONG_Y(dy) + ALONG_Z(dz));
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
    const int inside_x = x_of((uint)seed) - x, inside_y = y_of((uint)seed) - y, inside_z = z_of((uint)seed) - z;
    const int dx = SHORTER(inside_x, index->extent.width, PERIODIC_X);
    const int dy = SHORTER(inside_y, index->extent.height, PERIODIC_Y);
    const int dz = SHORTER(inside_z, index->extent.depth, PERIODIC_Z);
    const uint distance = (uint)(ALONG_X(dx) + ALONG_Y(dy) + ALONG_Z(dz));
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
