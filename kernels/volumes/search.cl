// The seeds that can win in a box of voxels: searched in the index, blocks, regions, bins, seeds.

#ifndef VOROCL_VOLUMES_SEARCH
#define VOROCL_VOLUMES_SEARCH

#include "volumes/dominance.cl"

// Tests have short lists.
#ifndef MOST_SEEDS
#define MOST_SEEDS 4096  // in a list
#define MOST_NODES 4096  // in a search's list of regions or of bins
#endif
#define FEW_IN_REGION 64  // seeds: so many are taken without a look at the bins
#define SEED_ROOM (MOST_SEEDS + 1024)  // of a list: two bins more, and a vector behind them
#define OVERFLOW (-1)  // instead of a number of seeds

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

#endif
