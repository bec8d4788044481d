// Exact diagrams of points: a work-item labels a tile, by one list if few places are there, else box by box, each by
// the places around it.

#ifndef VOROCL_POINTS_TILES
#define VOROCL_POINTS_TILES

#include "exact/points/keys.cl"

#define FEW_PLACES 8      // of which more are not dropped by corners
#define MOST_OF_BOX 48    // a box of 16 pixels with more is labelled in quarters
#define MOST_OF_WIDE 32   // likewise, where keys do not hold the distances
#define FEW_OF_TILE 24    // a tile of fewer is labelled from one list

static inline ulong distance_in_units(long x, long y) {
#ifdef VOROCL_EUCLIDEAN
  return (ulong)(x * x) + (ulong)(y * y);
#else
  return (ulong)(abs(x) + abs(y));
#endif
}

// The nearest so far of each pixel of 4 x 4, in 64 bits.
typedef struct {
  ulong distance[16];
  uint at[16];
} found_t;

// Holds a place against what is found. (x, y) is its way from the centre of the 4 x 4 pixels.
static inline void hold_against(const scene_t* scene, found_t* found, long x, long y, uint at) {
  for (int i = 0; i < 16; ++i) {
    const ulong distance = distance_in_units(x - (i % 4 - 2) * ONE_PIXEL - HALF_PIXEL,
                                             y - (i / 4 - 2) * ONE_PIXEL - HALF_PIXEL);
    if (distance > found->distance[i]) continue;
    if (distance == found->distance[i] && !comes_first(scene, at, found->at[i])) continue;
    found->distance[i] = distance;
    found->at[i] = at;
  }
}

static inline void write_found(const scene_t* scene, const found_t* found, uint* labels) {
  for (int i = 0; i < 16; ++i) labels[i / 4 * POINTS_TILE + i % 4] = scene->ids[found->at[i]];
}

// Labels a box by any list, in 64 bits.
NOINLINE static void label_wide(const scene_t* scene, const list_t* list, int count, int2 centre, int side,
                                uint* labels) {
  for (int top = 0; top < side; top += 4) {
    for (int left = 0; left < side; left += 4) {
      const int2 from_centre = (int2)(left + 2 - side / 2, top + 2 - side / 2) * ONE_PIXEL;
      found_t found;
      for (int i = 0; i < 16; ++i) found.distance[i] = ULONG_MAX;
      for (int i = 0; i < count; ++i) {
        const int2 way = way_to(scene, list, i, centre);
        hold_against(scene, &found, (long)way.x - from_centre.x, (long)way.y - from_centre.y, list->at[i]);
      }
      write_found(scene, &found, labels + top * POINTS_TILE + left);
    }
  }
}

// The distances from eight places to a pixel of 4 x 4 around the origin, as floats.
static inline float8 float_distance(float8 x, float8 y, int pixel) {
  return away_from(x - (float)(pixel % 4 - 2) - 0.5f, y - (float)(pixel / 4 - 2) - 0.5f);
}

// Labels 4 x 4 pixels by all places of a rectangle, where so many may win that no list holds them. The first walk finds
// the least distances as floats, the second looks at what may be as near.
NOINLINE static void search_square(const scene_t* scene, span_t x, span_t y, int2 centre, uint* labels) {
  float8 least[16];
  for (int i = 0; i < 16; ++i) least[i] = INFINITY;
  walk_t walk = walk_over(scene, x, y);
  uint2 range;
  while (next_range(scene, &walk, &range)) {
    const int2 origin = origin_of(scene, &walk, centre);
    for (uint at = range.s0; at < range.s1; at += 8) {
      float8 px, py;
      load_places(scene, at, origin, &px, &py);
      px = select(px, (float8)INFINITY, as_uint8(EIGHT) >= range.s1 - at);
#pragma unroll
      for (int i = 0; i < 16; ++i) least[i] = fmin(least[i], float_distance(px, py, i));
    }
  }
  float limits[16];
  found_t found;
  for (int i = 0; i < 16; ++i) {
    const float4 halves = fmin(least[i].lo, least[i].hi);
    limits[i] = fmin(fmin(halves.x, halves.y), fmin(halves.z, halves.w)) * (1 + 0x1p-18f) + 0x1p-9f;
    found.distance[i] = ULONG_MAX;
  }
  walk = walk_over(scene, x, y);
  while (next_range(scene, &walk, &range)) {
    const int2 origin = origin_of(scene, &walk, centre);
    for (uint at = range.s0; at < range.s1; at += 8) {
      float8 px, py;
      load_places(scene, at, origin, &px, &py);
      int8 is_near = 0;
#pragma unroll
      for (int i = 0; i < 16; ++i) is_near |= float_distance(px, py, i) <= limits[i];
      if (!any(is_near)) continue;
      for (uint i = at; i < min(at + 8, range.s1); ++i) {
        const int2 way = scene->list[i] - origin;
        hold_against(scene, &found, way.x, way.y, i);
      }
    }
  }
  write_found(scene, &found, labels);
}

static inline void label_nothing(int side, uint* labels) {
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) labels[y * POINTS_TILE + x] = NO_LABEL;
  }
}

// Labels a square of pixels in boxes, and returns which of them are not labelled yet, a bit each: too many places may
// win there.
static inline __attribute__((always_inline)) uint label_square(const scene_t* scene, int left, int top, int side,
                                                               int side_of_box, list_t* a, list_t* b, uint* labels) {
  const int boxes = side / side_of_box;
  const uint all = (1u << boxes * boxes) - 1;
  const float w = (float)(side - 1), w_of_box = (float)(side_of_box - 1);
  const span_t own_x = span_of(left, left + side - 1), own_y = span_of(top, top + side - 1);
  const span_t limits_x = limits_of(own_x, scene->width, PERIODIC_X);
  const span_t limits_y = limits_of(own_y, scene->height, PERIODIC_Y);
  const int2 centre = (int2)(left + side / 2, top + side / 2) * ONE_PIXEL;
  const int bits = scene->bins.bits;
  int rings = 1, count, nearest = 0;
  span_t x = clamped(with_bins_around(own_x, rings, bits), limits_x);
  span_t y = clamped(with_bins_around(own_y, rings, bits), limits_y);
  rival_t rival;
  reach_t reach;
  while (true) {
    count = gather(scene, a, x, y, centre, w, &nearest);
    if (count == 0) {
      if (holds(x, limits_x) && holds(y, limits_y)) {
        label_nothing(side, labels);
        return 0;
      }
      rings *= 2;
      x = clamped(with_bins_around(own_x, rings, bits), limits_x);
      y = clamped(with_bins_around(own_y, rings, bits), limits_y);
      continue;
    }
    rival = rival_of(a, nearest);
    reach = reach_of(rival, w);
    const span_t needed_x = clamped(span_of_reach(own_x, reach.west, reach.east), limits_x);
    const span_t needed_y = clamped(span_of_reach(own_y, reach.north, reach.south), limits_y);
    if (count > MOST_LISTED) {
      if (side > 4) return all;
      search_square(scene, needed_x, needed_y, centre, labels);
      return 0;
    }
    if (holds(x, needed_x) && holds(y, needed_y)) break;
    x = joined(x, needed_x);
    y = joined(y, needed_y);
  }
  const float most_reach = longest(reach) + (float)side;
  count = drop_by(a, count, b, 0, 0, rival, w, w);
  if (count > FEW_PLACES) count = drop_by_corners(b, count, w, w);
  if (side <= 16 && (count <= MOST_OF_BOX || side == side_of_box)) {
    if (side >= 8 && label_by_keys(scene, b, count, centre, side, most_reach, labels)) return 0;
    if (side > 8 && count > MOST_OF_WIDE) return all;
    label_wide(scene, b, count, centre, side, labels);
    return 0;
  }

  uint left_over = 0;
  for (int v = 0; v < boxes; ++v) {
    for (int u = 0; u < boxes; ++u) {
      if (left + u * side_of_box >= scene->width || top + v * side_of_box >= scene->height) continue;
      const int2 from_centre = (int2)(u, v) * side_of_box + side_of_box / 2 - side / 2;
      const float mx = (float)from_centre.x, my = (float)from_centre.y;
      const int i = nearest_to(b, count, mx, my);
      const rival_t here = rival_at(b->x[i] - mx, b->y[i] - my);
      int some = drop_by(b, count, a, mx, my, here, w_of_box, w_of_box);
      if (some > FEW_PLACES) some = drop_by_corners(a, some, w_of_box, w_of_box);
      const float reach_here = fmin(most_reach, longest(reach_of(here, w_of_box)) + (float)side_of_box);
      const int2 centre_here = centre + from_centre * ONE_PIXEL;
      uint* const labels_here = labels + v * side_of_box * POINTS_TILE + u * side_of_box;
      if (label_by_keys(scene, a, some, centre_here, side_of_box, reach_here, labels_here)) continue;
      if (some <= MOST_OF_WIDE) {
        label_wide(scene, a, some, centre_here, side_of_box, labels_here);
      } else {
        left_over |= 1u << (v * boxes + u);
      }
    }
  }
  return left_over;
}

NOINLINE static uint label_64(const scene_t* scene, int left, int top, list_t* a, list_t* b, uint* labels) {
  return label_square(scene, left, top, 64, 16, a, b, labels);
}
NOINLINE static uint label_16(const scene_t* scene, int left, int top, list_t* a, list_t* b, uint* labels) {
  return label_square(scene, left, top, 16, 8, a, b, labels);
}
NOINLINE static uint label_8(const scene_t* scene, int left, int top, list_t* a, list_t* b, uint* labels) {
  return label_square(scene, left, top, 8, 8, a, b, labels);
}
NOINLINE static void label_4(const scene_t* scene, int left, int top, list_t* a, list_t* b, uint* labels) {
  label_square(scene, left, top, 4, 4, a, b, labels);
}

static inline int lowest_bit(uint bits) { return 31 - (int)clz(bits & -bits); }

// The places in the bins of a tile.
static inline uint places_of_tile(const scene_t* scene, int left, int top) {
  const bins_t* const bins = &scene->bins;
  const int first = column_of(bins, left), last = column_of(bins, left + POINTS_TILE - 1);
  uint count = 0;
  for (int row = row_of(bins, top); row <= row_of(bins, top + POINTS_TILE - 1); ++row) {
    count += scene->starts[start_of(bins, last, row) + 1] - scene->starts[start_of(bins, first, row)];
  }
  return count;
}

static inline bool is_shown(const scene_t* scene, int x, int y) { return x < scene->width && y < scene->height; }

static inline void label_tile(const scene_t* scene, int left, int top, uint* labels) {
  list_t a, b;
  uint boxes = 0xffffu;
  if (places_of_tile(scene, left, top) < FEW_OF_TILE) boxes = label_64(scene, left, top, &a, &b, labels);
  for (; boxes != 0; boxes &= boxes - 1) {
    const int box = lowest_bit(boxes), x = box % 4 * 16, y = box / 4 * 16;
    if (!is_shown(scene, left + x, top + y)) continue;
    uint quarters = label_16(scene, left + x, top + y, &a, &b, labels + y * POINTS_TILE + x);
    for (; quarters != 0; quarters &= quarters - 1) {
      const int quarter = lowest_bit(quarters), qx = x + quarter % 2 * 8, qy = y + quarter / 2 * 8;
      if (!is_shown(scene, left + qx, top + qy)) continue;
      if (!label_8(scene, left + qx, top + qy, &a, &b, labels + qy * POINTS_TILE + qx)) continue;
      for (int i = 0; i < 4; ++i) {
        const int sx = qx + i % 2 * 4, sy = qy + i / 2 * 4;
        label_4(scene, left + sx, top + sy, &a, &b, labels + sy * POINTS_TILE + sx);
      }
    }
  }
}

// Labels all tiles. Pixels outside the region (left, top, right, bottom, both ends included) get no label.
kernel void label_tiles(global const uint* restrict starts, global const int2* restrict list,
                        global const uint* restrict ids, global const int2* restrict seeds, int has_images, int bits,
                        int width, int height, int4 region, global uint* restrict out) {
  const int across = ((width - 1) >> POINTS_TILE_BITS) + 1, item = (int)get_global_id(0);
  const int left = item % across * POINTS_TILE, top = item / across * POINTS_TILE;
  if (top >= height) return;
  uint labels[POINTS_TILE * POINTS_TILE];
  const scene_t scene = {bins_of(bits, width, height), width, height, starts, list, ids, has_images ? seeds : 0, labels};
  label_tile(&scene, left, top, labels);
  const int end = min(POINTS_TILE, width - left), bottom = min(POINTS_TILE, height - top);
  const bool is_inside = left >= region.s0 && top >= region.s1 && left + end - 1 <= region.s2 &&
                         top + bottom - 1 <= region.s3;
  for (int y = 0; y < bottom; ++y) {
    global uint* const row = out + (size_t)(top + y) * (size_t)width + (size_t)left;
    if (is_inside && end == POINTS_TILE) {
      for (int x = 0; x < POINTS_TILE; x += 8) vstore8(vload8(0, labels + y * POINTS_TILE + x), 0, row + x);
      continue;
    }
    for (int x = 0; x < end; ++x) {
      const bool has_label = left + x >= region.s0 && left + x <= region.s2 && top + y >= region.s1 &&
                             top + y <= region.s3;
      row[x] = has_label ? labels[y * POINTS_TILE + x] : NO_LABEL;
    }
  }
}

#endif
