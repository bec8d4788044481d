// A work-item labels a region: dense ones by stamps, tile by tile, others from lists that are handed down to tiles,
// boxes and parts of boxes. Where a list overflows, smaller boxes gather for themselves, and at last voxels search.

#ifndef VOROCL_POINTS_REGIONS
#define VOROCL_POINTS_REGIONS

#include "points/stamps.cl"

#define TILE 16    // along the sides of a tile
#define BOX_X 16   // of a box
#define BOX_Y 8
#define BOX_Z 8
#define PART_X 8   // of a part
#define PART_Y 4
#define PART_Z 4

#define MOST_OF_BOX 64    // a box with more is labelled in parts
#define MANY_OF_TILE 100  // the boxes of a tile with more are half as long
#define FEW_OF_REGION 40  // a region with fewer is labelled from one list

typedef struct {
  list_t of_region, of_tile, of_box, of_part;
} lists_t;

// Child i of a box, by x, y, z.
static inline box_t child_of(box_t b, int i, int sx, int sy, int sz) {
  const int nx = b.sx / sx, ny = b.sy / sy;
  return box_at(b.x + i % nx * sx, b.y + i / nx % ny * sy, b.z + i / nx / ny * sz, sx, sy, sz);
}
static inline int children_of(box_t b, int sx, int sy, int sz) { return (b.sx / sx) * (b.sy / sy) * (b.sz / sz); }

// Copies to `list` what may win in a box within another one.
NOINLINE static int narrow(const list_t* from, int count, box_t outer, box_t box, list_t* list) {
  const int4 way = centre_of(box) - centre_of(outer);
  const float x = (float)way.x, y = (float)way.y, z = (float)way.z;
  int8 nearest = INT_MAX;
  for (int k = 0; k < count; k += 8) {
    floats8_t f = floats_of(load_from_list(from, k));
    // |c - way|^2
    float8 n = fma((float8)(-2 * x), f.x, fma((float8)(-2 * y), f.y, f.n + (x * x + y * y + z * z)));
    n = fma((float8)(-2 * z), f.z, n);
    nearest = min(nearest, nearness_of(n, k, count));
  }
  const float4 place = place_in(from, number_of(nearest)) - (float4)(x, y, z, 0);
  count = drop_by(from, count, list, way, place, box);
  return drop_beaten(list, count, box);
}

NOINLINE static void search_all(const scene_t* scene, box_t b) {
  for (int z = b.z; z < min(b.z + b.sz, scene->size.z); ++z) {
    for (int y = b.y; y < min(b.y + b.sy, scene->size.y); ++y) {
      for (int x = b.x; x < min(b.x + b.sx, scene->size.x); ++x) {
        scene->labels[index_of(scene, x, y, z)] = search_voxel(scene, x, y, z, NO_PLACE);
      }
    }
  }
}

static inline bool label_if_one(const scene_t* scene, const list_t* list, int count, box_t b) {
  if (count != 1) return false;
  show_one(scene, b, scene->ids[list->at[0]]);
  return true;
}

// More than keys hold: voxel by voxel.
NOINLINE static void compare_list(const scene_t* scene, box_t b, const list_t* list, int count) {
  for (int z = b.z; z < min(b.z + b.sz, scene->size.z); ++z) {
    for (int y = b.y; y < min(b.y + b.sy, scene->size.y); ++y) {
      for (int x = b.x; x < min(b.x + b.sx, scene->size.x); ++x) {
        scene->labels[index_of(scene, x, y, z)] = compare_at(scene, b, list, count, x, y, z);
      }
    }
  }
}

NOINLINE static void label_part(const scene_t* scene, box_t part, const list_t* list, int count) {
  if (label_if_one(scene, list, count, part) || label_by_keys(scene, list, count, part)) return;
  if (!label_many(scene, list, count, part)) compare_list(scene, part, list, count);
}
NOINLINE static void label_box(const scene_t* scene, box_t box, const list_t* list, int count, lists_t* lists) {
  if (label_if_one(scene, list, count, box)) return;
  if (count <= MOST_OF_BOX && label_by_keys(scene, list, count, box)) return;
  for (int i = 0; i < children_of(box, PART_X, PART_Y, PART_Z); ++i) {
    const box_t part = child_of(box, i, PART_X, PART_Y, PART_Z);
    if (!is_in_grid(scene, part)) continue;
    const int some = narrow(list, count, box, part, &lists->of_part);
    label_part(scene, part, &lists->of_part, some);
  }
}
NOINLINE static void label_tile(const scene_t* scene, box_t tile, const list_t* list, int count, lists_t* lists) {
  if (label_if_one(scene, list, count, tile)) return;
  const int side = count > MANY_OF_TILE ? BOX_X / 2 : BOX_X;
  for (int i = 0; i < children_of(tile, side, BOX_Y, BOX_Z); ++i) {
    const box_t box = child_of(tile, i, side, BOX_Y, BOX_Z);
    if (!is_in_grid(scene, box)) continue;
    const int some = narrow(list, count, tile, box, &lists->of_box);
    label_box(scene, box, &lists->of_box, some, lists);
  }
}
NOINLINE static void label_region(const scene_t* scene, box_t region, const list_t* list, int count, lists_t* lists) {
  if (label_if_one(scene, list, count, region)) return;
  for (int i = 0; i < children_of(region, TILE, TILE, TILE); ++i) {
    const box_t tile = child_of(region, i, TILE, TILE, TILE);
    if (!is_in_grid(scene, tile)) continue;
    const int some = narrow(list, count, region, tile, &lists->of_tile);
    label_tile(scene, tile, &lists->of_tile, some, lists);
  }
}

typedef enum { A_REGION, A_TILE, A_BOX, A_PART } level_t;

// Labels a box from a list of its own; false if the list overflows.
NOINLINE static bool label_alone(const scene_t* scene, box_t b, level_t level, lists_t* lists) {
  const cuboid_t limits = limits_around(scene, b);
  float4 place;
  if (!find_near(scene, b, &limits, &place)) {
    show_one(scene, b, NO_LABEL);
    return true;
  }
  list_t* const list = level == A_REGION ? &lists->of_region
                       : level == A_TILE ? &lists->of_tile
                       : level == A_BOX  ? &lists->of_box
                                         : &lists->of_part;
  int count = gather(scene, b, &limits, place, list);
  if (count == OVERFLOW) return false;
  count = drop_beaten(list, count, b);
  switch (level) {
    case A_REGION: label_region(scene, b, list, count, lists); break;
    case A_TILE: label_tile(scene, b, list, count, lists); break;
    case A_BOX: label_box(scene, b, list, count, lists); break;
    default: label_part(scene, b, list, count); break;
  }
  return true;
}

NOINLINE static void label_by_lists(const scene_t* scene, box_t outer, lists_t* lists) {
  for (int i = 0; i < children_of(outer, TILE, TILE, TILE); ++i) {
    const box_t tile = child_of(outer, i, TILE, TILE, TILE);
    if (!is_in_grid(scene, tile) || label_alone(scene, tile, A_TILE, lists)) continue;
    for (int j = 0; j < children_of(tile, BOX_X, BOX_Y, BOX_Z); ++j) {
      const box_t box = child_of(tile, j, BOX_X, BOX_Y, BOX_Z);
      if (!is_in_grid(scene, box) || label_alone(scene, box, A_BOX, lists)) continue;
      for (int k = 0; k < children_of(box, PART_X, PART_Y, PART_Z); ++k) {
        const box_t part = child_of(box, k, PART_X, PART_Y, PART_Z);
        if (!is_in_grid(scene, part) || label_alone(scene, part, A_PART, lists)) continue;
        search_all(scene, part);
      }
    }
  }
}

// The places in the bins of a box.
static inline uint places_around(const scene_t* scene, box_t b, uint* voxels) {
  const bins_t* const bins = &scene->bins;
  const int x0 = b.x >> bins->bits.x, x1 = min(b.x + b.sx - 1, scene->size.x - 1) >> bins->bits.x;
  const int y0 = b.y >> bins->bits.y, y1 = min(b.y + b.sy - 1, scene->size.y - 1) >> bins->bits.y;
  const int z0 = b.z >> bins->bits.z, z1 = min(b.z + b.sz - 1, scene->size.z - 1) >> bins->bits.z;
  uint count = 0;
  for (int z = z0; z <= z1; ++z) {
    for (int y = y0; y <= y1; ++y) {
      const uint first = (uint)((z * bins->rows + y) * (bins->columns + 1));
      count += scene->starts[first + (uint)x1 + 1] - scene->starts[first + (uint)x0];
    }
  }
  *voxels = (uint)((x1 + 1 - x0) * (y1 + 1 - y0) * (z1 + 1 - z0)) << (bins->bits.x + bins->bits.y + bins->bits.z);
  return count;
}

// The side of stamps for so many voxels per place: few voxels are farther from all places than half of it. 0: none.
#define STAMP_FACTOR 7.f  // times the voxels of a place are those of a ball of that radius
static inline int stamp_side(uint voxels, uint places) {
  if (IS_SPACED) return 0;
  const float side = 2 * cbrt((float)voxels / (float)max(places, 1u) * (STAMP_FACTOR / 4.18879f));
  return side > MOST_STAMP_SIDE ? 0 : max(3, (int)ceil(side));
}

typedef union {
  lists_t lists;
  stamps_t stamps;
} rooms_t;

kernel void label_regions(global const uint* restrict starts, global const int* restrict xs,
                          global const int* restrict ys, global const int* restrict zs,
                          global const uint* restrict ids, int4 bits, int4 size, global uint* restrict labels) {
  const int item = (int)get_global_id(0);
  const int regions_x = (size.x - 1) / REGION + 1, regions_y = (size.y - 1) / REGION + 1;
  if (item >= regions_x * regions_y * ((size.z - 1) / REGION + 1)) return;
  const scene_t scene = {bins_of(bits, size), size, starts, xs, ys, zs, ids, labels};
  const box_t region = box_at(item % regions_x * REGION, item / regions_x % regions_y * REGION,
                              item / regions_x / regions_y * REGION, REGION, REGION, REGION);
  rooms_t rooms;
  uint voxels;
  const uint count = places_around(&scene, region, &voxels);
  const int side = stamp_side(voxels, count);
  if (side > 0) {
    // The seeds of the bins, and those whose stamps reach into the region.
    const float around = (float)(REGION + side) * (float)(REGION + side) * (float)(REGION + side);
    if (around * (float)count < 0.9f * MOST_STAMPS * (float)voxels) {
      if (!label_by_stamps(&scene, region, side, &rooms.stamps)) label_by_lists(&scene, region, &rooms.lists);
      return;
    }
    for (int i = 0; i < children_of(region, TILE, TILE, TILE); ++i) {
      const box_t tile = child_of(region, i, TILE, TILE, TILE);
      if (!is_in_grid(&scene, tile)) continue;
      const uint some = places_around(&scene, tile, &voxels);
      const int of_tile = stamp_side(voxels, some);
      if (of_tile > 0 && label_by_stamps(&scene, tile, of_tile, &rooms.stamps)) continue;
      label_by_lists(&scene, tile, &rooms.lists);
    }
    return;
  }
  const bool has_few = (ulong)count * (REGION * REGION * REGION) < (ulong)FEW_OF_REGION * voxels;
  if (has_few && label_alone(&scene, region, A_REGION, &rooms.lists)) return;
  label_by_lists(&scene, region, &rooms.lists);
}

#endif
