// Exact diagrams of points in the vector shape: a work-item labels a tile, by one list if few places are there, else
// box by box, each by the places around it.

#ifndef VOROCL_POINTS_TILES
#define VOROCL_POINTS_TILES

#include "exact/points/keys.cl"

#define FEW_PLACES 8      // of which more are not dropped by corners
#define MOST_OF_BOX 48    // a box of 16 pixels with more is labelled in quarters
#define MOST_OF_PARTS 32  // likewise, where keys do not hold the distances
#define FEW_OF_TILE 24    // a tile of fewer is labelled from one list

// The nearest so far of a box's pixels.
typedef struct {
  ulong distance[16 * 16];
  uint place[16 * 16];  // its number, in a list or in the index
} found_t;

static inline void find_nothing(found_t* found, int side) {
  for (int i = 0; i < side * side; ++i) found->distance[i] = ULONG_MAX;
}

// From the centre of a box to a pixel's.
static inline int2 way_to_pixel(int pixel, int side) {
  return (int2)(pixel % side - side / 2, pixel / side - side / 2) * ONE_PIXEL + HALF_PIXEL;
}

// The distance from a pixel of a box to a place, given the place's way from the box's centre.
static inline ulong distance_from(int pixel, int side, int2 way) {
  const int2 to = way_to_pixel(pixel, side);
  return distance_in_units((long)way.x - to.x, (long)way.y - to.y);
}

// Labels a box of at most 16 pixels a side by any list: its places stand against each other in parts, the winners of
// the parts in 64 bits.
NOINLINE static void label_in_parts(const scene_t* scene, const list_t* list, int count, int2 centre, int side,
                                    float reach, uint* labels) {
  found_t found;
  find_nothing(&found, side);
  uint winners[16 * 16];
  for (int from = 0; from < count; from += MOST_OF_KEYS) {
    const int some = min(count - from, MOST_OF_KEYS);
    const bool has_winners =
        side >= 8 && find_by_keys(scene, list, from, some, centre, side, reach, NUMBERS, winners, side);
    for (int pixel = 0; pixel < side * side; ++pixel) {
      const int first = has_winners ? (int)winners[pixel] : from, end = has_winners ? first + 1 : from + some;
      for (int i = first; i < end; ++i) {
        const ulong distance = distance_from(pixel, side, way_to(scene, list, i, centre));
        if (distance > found.distance[pixel]) continue;
        if (distance == found.distance[pixel] &&
            !comes_first(scene, list->at[i], list->at[found.place[pixel]])) {
          continue;
        }
        found.distance[pixel] = distance;
        found.place[pixel] = (uint)i;
      }
    }
  }
  for (int pixel = 0; pixel < side * side; ++pixel) {
    labels[pixel / side * POINTS_TILE + pixel % side] = scene->ids[list->at[found.place[pixel]]];
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
  find_nothing(&found, 4);
  for (int i = 0; i < 16; ++i) {
    const float4 halves = fmin(least[i].lo, least[i].hi);
    limits[i] = fmin(fmin(halves.x, halves.y), fmin(halves.z, halves.w)) * (1 + 0x1p-18f) + 0x1p-9f;
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
        for (int pixel = 0; pixel < 16; ++pixel) {
          const ulong distance = distance_from(pixel, 4, scene->list[i] - origin);
          if (distance > found.distance[pixel]) continue;
          if (distance == found.distance[pixel] && !comes_first(scene, i, found.place[pixel])) continue;
          found.distance[pixel] = distance;
          found.place[pixel] = i;
        }
      }
    }
  }
  for (int pixel = 0; pixel < 16; ++pixel) {
    labels[pixel / 4 * POINTS_TILE + pixel % 4] = scene->ids[found.place[pixel]];
  }
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
    if (count > MOST_IN_LIST) {
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
    if (side >= 8 && find_by_keys(scene, b, 0, count, centre, side, most_reach, IDS, labels, POINTS_TILE)) return 0;
    if (side > 8 && count > MOST_OF_PARTS) return all;
    label_in_parts(scene, b, count, centre, side, most_reach, labels);
    return 0;
  }

  uint left_over = 0;
  for (int v = 0; v < boxes; ++v) {
    for (int u = 0; u < boxes; ++u) {
      if (left + u * side_of_box >= scene->width || top + v * side_of_box >= scene->height) continue;
      const int2 from_centre = (int2)(u, v) * side_of_box + side_of_box / 2 - side / 2;
      const float mx = (float)from_centre.x, my = (float)from_centre.y;
      const int i = nearest_of(b, count, mx, my);
      const rival_t here = rival_at(b->x[i] - mx, b->y[i] - my);
      int some = drop_by(b, count, a, mx, my, here, w_of_box, w_of_box);
      if (some > FEW_PLACES) some = drop_by_corners(a, some, w_of_box, w_of_box);
      const float reach_here = fmin(most_reach, longest(reach_of(here, w_of_box)) + (float)side_of_box);
      const int2 centre_here = centre + from_centre * ONE_PIXEL;
      uint* const labels_here = labels + v * side_of_box * POINTS_TILE + u * side_of_box;
      if (find_by_keys(scene, a, 0, some, centre_here, side_of_box, reach_here, IDS, labels_here, POINTS_TILE)) {
        continue;
      }
      if (some <= MOST_OF_PARTS || side_of_box == 8) {
        label_in_parts(scene, a, some, centre_here, side_of_box, reach_here, labels_here);
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
  const scene_t scene = {bins_of(bits, width, height), width, height, starts, list, ids, has_images ? seeds : 0};
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
