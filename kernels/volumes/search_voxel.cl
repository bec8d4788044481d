// The nearest seed of a voxel, without lists that could overflow. In positions, not in places.

#ifndef VOROCL_VOLUMES_SEARCH_VOXEL
#define VOROCL_VOLUMES_SEARCH_VOXEL

#include "volumes/index.cl"

// The least way along an axis from a coordinate to a stretch of it.
static inline int way_to(int at, int low, int high, int size, int periodic) {
  const int inside = max(max(low - at, at - high), 0);
  if (!periodic) return inside;
  return min(inside, size - max(high - at, at - low));
}

// The squared distance of a voxel to the box around a node's seeds.
static inline uint distance_to_node(const index_t* index, size_t node, int x, int y, int z) {
  const uint low = index->low[node], high = index->high[node];
  const extent_t e = index->extent;
  const int dx = way_to(x, x_of(low), x_of(high), e.width, PERIODIC_X);
  const int dy = way_to(y, y_of(low), y_of(high), e.height, PERIODIC_Y);
  const int dz = way_to(z, z_of(low), z_of(high), e.depth, PERIODIC_Z);
  return (uint)(ALONG_X(dx) + ALONG_Y(dy) + ALONG_Z(dz));
}

// The nearest seed so far. The search walks through all nodes that may be as near, and takes only seeds that come
// before.
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
