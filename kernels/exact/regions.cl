// A work-item labels a region: dense ones by stamps, tile by tile, others from lists that are handed down to
// tiles, boxes and parts of boxes. Where a list overflows, smaller boxes gather for themselves, and parts at
// last go on with another list.

#ifndef VOROCL_EXACT_REGIONS
#define VOROCL_EXACT_REGIONS

#include "exact/index.cl"
#include "exact/stamps.cl"

// Sides of boxes. A work-item has a region of a volume, or a tile of a plane; the first tile's has the whole
// region where that has few places.
#if IS_VOLUME
#define IS_LONG (2 * SPACING_Z >= 5 * SPACING_X)  // so are voxels, along z
#define REGION SIDE_OF_VOLUME
#define TILE 16
#define BOX_X 16
#define BOX_Y 8
#define BOX_Z (IS_LONG ? 4 : 8)  // nearer to cubes
#define PART_X 8
#define PART_Y 4
#define PART_Z (IS_LONG ? 2 : 4)
#define FEW_OF_TILE (IS_LONG ? 40 : UINT_MAX)
#define MANY_OF_TILE 100
#define MOST_OF_BOX 64
#else
#define REGION (4 * SIDE_OF_PLANE)
#define TILE SIDE_OF_PLANE
#define BOX_X 16
#define BOX_Y 16
#define BOX_Z 1
#define PART_X 8
#define PART_Y 8
#define PART_Z 1
#define FEW_OF_TILE 40
#define MANY_OF_TILE MOST_IN_LIST
#define MOST_OF_BOX 48
#endif
#define SIDE (IS_VOLUME ? REGION : TILE)  // of what a work-item has
#define REGION_Z (IS_VOLUME ? REGION : 1)
#define TILE_Z (IS_VOLUME ? TILE : 1)
// A region with fewer places is labelled from one list, and so is a tile; the boxes of a tile with many are
// half as long; a box with more than MOST_OF_BOX is labelled in parts.
#define FEW_OF_REGION 40

typedef struct {
  list_t of_region, of_tile, of_box, of_part;
  blocks_t blocks;
} lists_t;

// A side of a box, halved while its second half lies beyond the grid: in a flat periodic one there are images of all
// places. It stays a power of two, whole vectors of columns or of rows.
static inline int side_in_grid(int at, int side, int size, int least) {
  while (side > least && at + side / 2 >= size) side /= 2;
  return side;
}
static inline box_t cut_to_grid(const scene_t* scene, box_t b) {
  return box_at(b.x, b.y, b.z, side_in_grid(b.x, b.sx, scene->size.x, PART_X),
                side_in_grid(b.y, b.sy, scene->size.y, PART_Y),
                IS_VOLUME ? side_in_grid(b.z, b.sz, scene->size.z, 2) : 1);
}

// Child i of a box, by x, y, z.
static inline box_t child_of(const scene_t* scene, box_t b, int i, int sx, int sy, int sz) {
  sx = min(sx, b.sx), sy = min(sy, b.sy), sz = min(sz, b.sz);
  const int nx = b.sx / sx, ny = b.sy / sy;
  return cut_to_grid(scene, box_at(b.x + i % nx * sx, b.y + i / nx % ny * sy, b.z + i / nx / ny * sz, sx, sy, sz));
}
static inline int children_of(box_t b, int sx, int sy, int sz) {
  return max(b.sx / sx, 1) * max(b.sy / sy, 1) * max(b.sz / sz, 1);
}

// Copies to `list` what may win in a box within another one.
NOINLINE static int narrow(const scene_t* scene, const list_t* from, int count, box_t outer, box_t box,
                           list_t* list) {
  const int4 way = centre_of(box) - centre_of(outer);
  int8 nearest = INT_MAX;
  for (int k = 0; k < count; k += 8) {
    nearest = min(nearest, nearness_of(floats_of(moved(load_from_list(from, k), way)).n, k, count));
  }
  const float4 place = place_in(from, number_of(nearest)) - convert_float4(way);
  count = drop_by(from, count, list, way, place, box);
  return drop_beaten(scene, list, count, box);
}

static inline bool label_if_one(const scene_t* scene, const list_t* list, int count, box_t b) {
  if (count != 1) return false;
  show_one(scene, b, scene->ids[list->at[0]]);
  return true;
}

// Pixels have the places that win there.
#define PIXELS_OF_PART (PART_X * PART_Y * PART_Z)
NOINLINE static void show_winners(const scene_t* scene, box_t part, uint* winners) {
  const bool inside = is_inside(scene, part);
  for (int row = 0; row < part.sy * part.sz; ++row) {
    uint* const of_row = winners + row * 8;
    for (int i = 0; i < 8; ++i) of_row[i] = scene->ids[of_row[i]];
    show_eight(scene, inside, part.x, part.y + row % part.sy, part.z + row / part.sy, vload8(0, of_row));
  }
}

NOINLINE static void label_part(const scene_t* scene, box_t part, const list_t* list, int count) {
  if (label_if_one(scene, list, count, part) || label_by_keys(scene, list, count, part)) return;
  uint winners[PIXELS_OF_PART];
  find_winners(scene, list, count, part, winners);
  show_winners(scene, part, winners);
}

// The same of more places than a list holds: list by list, and pixels have the places that won so far.
NOINLINE static void label_crowd(const scene_t* scene, box_t part, float4 place, gathering_t* gathering,
                                 list_t* list, int count) {
  uint winners[PIXELS_OF_PART], others[PIXELS_OF_PART];
  find_winners(scene, list, count, part, winners);
  bool is_all;
  do {
    is_all = gather(scene, part, place, gathering, list, &count);
    if (count == 0) continue;
    find_winners(scene, list, count, part, others);
    for (int i = 0; i < part.sx * part.sy * part.sz; ++i) {
      const int x = part.x + i % 8, y = part.y + i / 8 % part.sy, z = part.z + i / 8 / part.sy;
      if (is_nearer(scene, x, y, z, others[i], winners[i])) winners[i] = others[i];
    }
  } while (!is_all);
  show_winners(scene, part, winners);
}
NOINLINE static void label_box(const scene_t* scene, box_t box, const list_t* list, int count,
                               lists_t* lists) {
  if (label_if_one(scene, list, count, box)) return;
  if (count <= MOST_OF_BOX && label_by_keys(scene, list, count, box)) return;
  for (int i = 0; i < children_of(box, PART_X, PART_Y, PART_Z); ++i) {
    const box_t part = child_of(scene, box, i, PART_X, PART_Y, PART_Z);
    if (!is_in_grid(scene, part)) continue;
    const int some = narrow(scene, list, count, box, part, &lists->of_part);
    label_part(scene, part, &lists->of_part, some);
  }
}
NOINLINE static void label_tile(const scene_t* scene, box_t tile, const list_t* list, int count,
                                lists_t* lists) {
  if (label_if_one(scene, list, count, tile)) return;
  const int side = count > MANY_OF_TILE ? BOX_X / 2 : BOX_X;
  for (int i = 0; i < children_of(tile, side, BOX_Y, BOX_Z); ++i) {
    const box_t box = child_of(scene, tile, i, side, BOX_Y, BOX_Z);
    if (!is_in_grid(scene, box)) continue;
    const int some = narrow(scene, list, count, tile, box, &lists->of_box);
    label_box(scene, box, &lists->of_box, some, lists);
  }
}
NOINLINE static void label_region(const scene_t* scene, box_t region, const list_t* list, int count,
                                  lists_t* lists) {
  if (label_if_one(scene, list, count, region)) return;
  for (int i = 0; i < children_of(region, TILE, TILE, TILE_Z); ++i) {
    const box_t tile = child_of(scene, region, i, TILE, TILE, TILE_Z);
    if (!is_in_grid(scene, tile)) continue;
    const int some = narrow(scene, list, count, region, tile, &lists->of_tile);
    label_tile(scene, tile, &lists->of_tile, some, lists);
  }
}

typedef enum { A_REGION, A_TILE, A_BOX, A_PART } level_t;

// Labels a box from a list of its own; false if the list overflows and the box is no part. `near`: a known place, or
// NO_PLACE, and then one near the box.
NOINLINE static bool label_alone(const scene_t* scene, box_t b, level_t level, uint* near, source_t source,
                                 lists_t* lists) {
  const cuboid_t limits = limits_around(scene, b);
  *near = find_near(scene, b, &limits, *near, source);
  if (*near == NO_PLACE) {
    show_one(scene, b, NO_LABEL);
    return true;
  }
  const float4 place = way_to(scene, *near, centre_of(b));
  list_t* const list = level == A_REGION ? &lists->of_region
                       : level == A_TILE ? &lists->of_tile
                       : level == A_BOX  ? &lists->of_box
                                         : &lists->of_part;
  gathering_t gathering = gathering_in(scene, b, &limits, place, source);
  int count;
  if (!gather(scene, b, place, &gathering, list, &count)) {
    if (level != A_PART) return false;
    label_crowd(scene, b, place, &gathering, list, count);
    return true;
  }
  switch (level) {
    case A_REGION:
      label_region(scene, b, list, count, lists);
      break;
    case A_TILE:
      label_tile(scene, b, list, count, lists);
      break;
    case A_BOX:
      label_box(scene, b, list, count, lists);
      break;
    default:
      label_part(scene, b, list, count);
      break;
  }
  return true;
}

// What lies in the bins of a box: so many places, their mean lag in squared pixels if it is wanted, and the bins'
// pixels. A place whose lag no stamp holds counts with the least such lag: a few of them do not decide.
#define MOST_LAG ((MOST_STAMP_SIDE * MOST_STAMP_SIDE / 4) << LAG_BITS)
typedef struct {
  uint places, pixels;
  float lag;
} around_t;
static inline around_t around(const scene_t* scene, box_t b, const bool wants_lag) {
  const bins_t* const bins = &scene->bins;
  const int x0 = b.x >> bins->bits.x, x1 = min(b.x + b.sx - 1, scene->size.x - 1) >> bins->bits.x;
  const int y0 = b.y >> bins->bits.y, y1 = min(b.y + b.sy - 1, scene->size.y - 1) >> bins->bits.y;
  const int z0 = b.z >> bins->bits.z, z1 = min(b.z + b.sz - 1, scene->size.z - 1) >> bins->bits.z;
  around_t found = {0, 0, 0};
  float8 lags = 0;
  for (int z = z0; z <= z1; ++z) {
    for (int y = y0; y <= y1; ++y) {
      const uint first = (uint)((z * bins->rows + y) * (bins->columns + 1));
      const uint from = scene->starts[first + (uint)x0], to = scene->starts[first + (uint)x1 + 1];
      found.places += to - from;
      for (uint at = from; wants_lag && at < to; at += 8) {
        const int8 lag = min(vload8(0, scene->lags + at), (int8)MOST_LAG);
        lags += convert_float8(select((int8)0, lag, EIGHT < (int)(to - at)));
      }
    }
  }
  const float4 sums = lags.lo + lags.hi;
  found.lag = (sums.x + sums.y + sums.z + sums.w) / (float)((ulong)max(found.places, 1u) << LAG_BITS);
  found.pixels = (uint)((x1 + 1 - x0) * (y1 + 1 - y0) * (z1 + 1 - z0))
                 << (bins->bits.x + bins->bits.y + bins->bits.z);
  return found;
}

static inline bool is_empty(const scene_t* scene, box_t b) { return around(scene, b, false).places == 0; }

NOINLINE static void label_by_lists(const scene_t* scene, box_t outer, lists_t* lists) {
  for (int i = 0; i < children_of(outer, TILE, TILE, TILE_Z); ++i) {
    const box_t tile = child_of(scene, outer, i, TILE, TILE, TILE_Z);
    if (!is_in_grid(scene, tile)) continue;
    uint near = NO_PLACE;
    source_t source = THE_INDEX;
    const bool has_few = around(scene, tile, false).places < FEW_OF_TILE;
    if (has_few && label_alone(scene, tile, A_TILE, &near, THE_INDEX, lists)) continue;
    for (int j = 0; j < children_of(tile, BOX_X, BOX_Y, BOX_Z); ++j) {
      const box_t box = child_of(scene, tile, j, BOX_X, BOX_Y, BOX_Z);
      if (!is_in_grid(scene, box)) continue;
      // Where the box has places itself bins are small enough.
      const bool is_listed = source.blocks && is_empty(scene, box);
      source_t of_box = is_listed ? list_blocks(scene, box, near, source, &lists->blocks) : THE_INDEX;
      const bool may_fit = of_box.end - of_box.begin < MOST_IN_LIST / PLACES_OF_BLOCK;
      if (may_fit && label_alone(scene, box, A_BOX, &near, of_box, lists)) continue;
      if (!source.blocks && is_empty(scene, box)) {
        source = list_blocks(scene, tile, near, THE_INDEX, &lists->blocks);
        of_box = list_blocks(scene, box, near, source, &lists->blocks);
      }
      for (int k = 0; k < children_of(box, PART_X, PART_Y, PART_Z); ++k) {
        const box_t part = child_of(scene, box, k, PART_X, PART_Y, PART_Z);
        if (is_in_grid(scene, part)) label_alone(scene, part, A_PART, &near, of_box, lists);
      }
    }
  }
}

// The side of stamps for places as dense as these: of few pixels the squared distance and the lag of each place is more
// than the square of half of it. 0: none.
#define STAMP_FACTOR 7.f  // times the pixels of a place are those of a ball of that radius
static inline int stamp_side(around_t there) {
  if (IS_SPACED || IS_MANHATTAN) return 0;
  const float of_ball = (float)there.pixels / (float)max(there.places, 1u) * STAMP_FACTOR;
  const float radius = IS_VOLUME ? cbrt(of_ball / 4.18879f) : sqrt(of_ball / 3.14159f);
  const float side = 2 * sqrt(radius * radius + there.lag);
  return side > MOST_STAMP_SIDE ? 0 : max(3, (int)(IS_WEIGHTED ? round(side) : ceil(side)));
}

// Labels a box of at most SIDE by stamps; false if places are not dense there, or too many.
static inline bool label_if_dense(const scene_t* scene, box_t b, stamps_t* stamps) {
  const around_t there = around(scene, b, IS_WEIGHTED);
  const int side = stamp_side(there);
  if (side == 0) return false;
  for (int i = 0; !IS_VOLUME && i < children_of(b, BOX_X, BOX_Y, 1); ++i) {
    const box_t box = child_of(scene, b, i, BOX_X, BOX_Y, 1);
    if (!is_in_grid(scene, box)) continue;
    const around_t of_box = around(scene, box, false);
    if ((ulong)of_box.places * there.pixels * 4 < (ulong)there.places * of_box.pixels) return false;
  }
  // The seeds of the bins, and those whose stamps reach into the box.
  const float reached = (float)(b.sx + side) * (float)(b.sy + side) * (IS_VOLUME ? (float)(b.sz + side) : 1.f);
  if (reached * (float)there.places >= 0.9f * MOST_STAMPS * (float)there.pixels) return false;
  return label_by_stamps(scene, b, side, stamps);
}

// Labels what a work-item has from one list where heavy seeds from far away win against those that lie there,
// however many these are; false elsewhere, and if the list overflows.
static inline bool label_if_heavy(const scene_t* scene, box_t own, lists_t* lists) {
  const cuboid_t limits = limits_around(scene, own);
  uint near = find_near(scene, own, &limits, NO_PLACE, THE_INDEX);
  return near != NO_PLACE && is_far_by_weights(way_to(scene, near, centre_of(own))) &&
         label_alone(scene, own, SIDE == REGION ? A_REGION : A_TILE, &near, THE_INDEX, lists);
}

typedef union {
  lists_t lists;
  stamps_t stamps;
} rooms_t;

// `lags` are of rows, then of places; `bounds` of blocks; `zs` is for volumes, `order` for planes, where places may be
// images of seeds.
kernel void label_regions(global const uint* restrict starts, global const int* restrict xs,
                          global const int* restrict ys, global const int* restrict zs,
                          global const uint* restrict ids, global const int* restrict lags,
                          global const float* restrict bounds, global const int2* restrict order,
                          int has_images, int4 bits, int4 size, int4 tilts, int4 first, int4 last,
                          global uint* restrict labels) {
  const int item = (int)get_global_id(0), columns = (size.x - 1) / SIDE + 1, rows = (size.y - 1) / SIDE + 1;
  const box_t whole = box_at(item % columns * SIDE, item / columns % rows * SIDE, item / columns / rows * SIDE,
                           SIDE, SIDE, IS_VOLUME ? SIDE : 1);
  const bins_t bins = bins_of(bits, size);
  global const int* const of_places = IS_WEIGHTED ? lags + bins.rows * bins.slices : lags;
  const scene_t scene = {bins, size, AXES_OF(size), tilts, starts, xs, ys, zs, ids, of_places,
                         lags, bounds, has_images ? order : 0, first, last, labels};
  if (!is_in_grid(&scene, whole)) return;
  const box_t own = cut_to_grid(&scene, whole);
  const box_t region = cut_to_grid(
      &scene, box_at(own.x / REGION * REGION, own.y / REGION * REGION, own.z, REGION, REGION, REGION_Z));
  rooms_t rooms __attribute__((aligned(64)));  // vectors of eight do not cross lines of the cache
  const around_t there = around(&scene, region, false);
  const bool has_few = (ulong)there.places * (REGION * REGION * REGION_Z) < (ulong)FEW_OF_REGION * there.pixels;
  if (has_few && (IS_VOLUME || (region.x + REGION <= size.x && region.y + REGION <= size.y))) {
    const bool is_first = own.x == region.x && own.y == region.y;
    uint near = NO_PLACE;
    if (is_first && !label_alone(&scene, region, A_REGION, &near, THE_INDEX, &rooms.lists)) {
      label_by_lists(&scene, region, &rooms.lists);
    }
    return;
  }
  if (IS_WEIGHTED && label_if_heavy(&scene, own, &rooms.lists)) return;
  if (label_if_dense(&scene, own, &rooms.stamps)) return;
  for (int i = 0; i < children_of(own, TILE, TILE, TILE_Z); ++i) {
    const box_t tile = child_of(&scene, own, i, TILE, TILE, TILE_Z);
    if (!is_in_grid(&scene, tile)) continue;
    if (SIDE > TILE && label_if_dense(&scene, tile, &rooms.stamps)) continue;
    label_by_lists(&scene, tile, &rooms.lists);
  }
}

#endif
