// Walking the bins around a box, row by row, images of them along periodic axes included.
// Each row of bins has its own stretch along x in the balls of the box, or none.

#ifndef VOROCL_EXACT_WALK
#define VOROCL_EXACT_WALK

#include "exact/balls.cl"

typedef struct {
  int from, to;  // pixels of an axis, both ends included
} span_t;
typedef struct {
  span_t x, y, z;
} cuboid_t;

static inline span_t span_of(int from, int to) {
  const span_t span = {from, to};
  return span;
}
static inline span_t clamped(span_t s, span_t limits) {
  return span_of(clamp(s.from, limits.from, limits.to), clamp(s.to, limits.from, limits.to));
}
static inline bool holds(span_t outer, span_t inner) {
  return inner.from >= outer.from && inner.to <= outer.to;
}
static inline span_t with_bins_around(span_t s, int rings, int bits) {
  return span_of(((s.from >> bits) - rings) * (1 << bits), ((s.to >> bits) + rings + 1) * (1 << bits) - 1);
}
// What a box can need: the axis, or along a periodic one all that is at most half a period away, in a tilted grid all
// that the nearest image of a place can be away.
static inline span_t limits_of(int from, int to, int size, int periodic, int reach) {
  return periodic ? span_of(from - reach - 1, to + reach + 1) : span_of(0, size - 1);
}
static inline cuboid_t limits_around(const scene_t* scene, box_t b) {
  int4 reach = scene->size / 2;
#if IS_TILTED
  // An axis that no tilt names is one for itself.
  const int xy = TILT_XY(scene), xz = TILT_XZ(scene), yz = TILT_YZ(scene), farthest = REACH_OF_TILTS(scene);
  if (xy != 0 || xz != 0) reach.x = farthest / SPACING_X + 1;
  if (xy != 0 || yz != 0) reach.y = farthest / SPACING_Y + 1;
  if (xz != 0 || yz != 0) reach.z = farthest / SPACING_Z + 1;
#endif
  cuboid_t c;
  c.x = limits_of(b.x, b.x + b.sx - 1, scene->size.x, IS_PERIODIC(scene, x), reach.x);
  c.y = limits_of(b.y, b.y + b.sy - 1, scene->size.y, IS_PERIODIC(scene, y), reach.y);
  c.z = limits_of(b.z, b.z + b.sz - 1, scene->size.z, IS_PERIODIC(scene, z), reach.z);
  return c;
}
// at / size, rounded down.
static inline int image_at(int at, int size, int periodic) {
  const int is_before = at >> 31;
  return periodic ? (int)((uint)(at ^ is_before) / (uint)size) ^ is_before : 0;
}
static inline span_t of_image(span_t s, int image, int size, int periodic) {
  return periodic ? span_of(max(s.from - image * size, 0), min(s.to - image * size, size - 1)) : s;
}

// IMAGES. One lies `image` periods away, and in a tilted grid so many units further along x and y. The host sees to it
// that those of all images that are walked fit in an int.
static inline int tilt_of_slice(const scene_t* scene, int image_z) { return IS_TILTED ? image_z * TILT_YZ(scene) : 0; }
static inline int tilt_of_row(const scene_t* scene, int image_y, int image_z) {
  return IS_TILTED ? image_z * TILT_XZ(scene) + image_y * TILT_XY(scene) : 0;
}
static inline int4 way_to_image(const scene_t* scene, int image_x, int image_y, int image_z) {
  const int4 tilts = (int4)(tilt_of_row(scene, image_y, image_z), tilt_of_slice(scene, image_z), 0, 0);
  return ((int4)(image_x, image_y, image_z, 0) * scene->size * ONE + tilts) * SPACINGS;
}
// The whole pixels that hold a span which is moved by so many units, or back by them.
static inline span_t moved_on(span_t s, int units) {
  return span_of(s.from + (units >> FRACTION_BITS), s.to + ((units + ONE - 1) >> FRACTION_BITS));
}
static inline span_t moved_back(span_t s, int units) { return IS_TILTED ? moved_on(s, -units) : s; }

#define ROWS_OF_BALLS 6

// What of a source may lie in balls: ranges of the index, and where the images of their places lie. Of the index itself
// it is a box of bins.
typedef struct {
  span_t x, y, z;
  balls_t balls;
  bool has_balls, cuts_rows;  // balls leave out blocks of long ranges, and may cut rows of bins
  uint from, to;              // of a long range, what is left
  source_t list;              // and of a list
  uint some;                  // those of the eight ranges before list.begin that the balls meet, as bits
  span_t row;                                             // along x, of the present row
  int image_x, image_y, image_z, last_x, last_y, last_z;  // images
  int row_y, row_z, end_y, end_z;                         // bins
} walk_t;

static inline void enter_y(const scene_t* scene, walk_t* w) {
  const span_t own = moved_back(w->y, tilt_of_slice(scene, w->image_z));
  const span_t y = of_image(own, w->image_y, scene->size.y, IS_PERIODIC(scene, y));
  w->row_y = (y.from >> scene->bins.bits.y) - 1;
  w->end_y = y.to >> scene->bins.bits.y;
}
static inline void enter_slice(const scene_t* scene, walk_t* w) {
  const span_t own = moved_back(w->y, tilt_of_slice(scene, w->image_z));
  w->image_y = image_at(own.from, scene->size.y, IS_PERIODIC(scene, y));
  w->last_y = image_at(own.to, scene->size.y, IS_PERIODIC(scene, y));
  enter_y(scene, w);
}
static inline void enter_z(const scene_t* scene, walk_t* w) {
  const span_t z = of_image(w->z, w->image_z, scene->size.z, IS_PERIODIC(scene, z));
  w->row_z = z.from >> scene->bins.bits.z;
  w->end_z = z.to >> scene->bins.bits.z;
}

static inline walk_t walk_over(const scene_t* scene, span_t x, span_t y, span_t z) {
  walk_t w;
  w.x = x, w.y = y, w.z = z;
  w.has_balls = w.cuts_rows = false;
  w.from = w.to = 0;
  w.list.blocks = 0;
  w.image_x = 1, w.last_x = 0;
  w.image_z = image_at(z.from, scene->size.z, IS_PERIODIC(scene, z)),
  w.last_z = image_at(z.to, scene->size.z, IS_PERIODIC(scene, z));
  enter_z(scene, &w);
  enter_slice(scene, &w);
  return w;
}

// How far outside a range centres are.
static inline corners_t outside(corners_t at, float from, float to) {
  return fmax(fmax(from - at, at - to), 0.f);
}

// The pixels along x of the present row that the balls meet; false if there are none.
static inline bool row_in_balls(const scene_t* scene, walk_t* w) {
  w->row = w->x;
  if (!w->cuts_rows) return true;
  const int4 bits = scene->bins.bits;
  const int first_y = (w->row_y << bits.y) + w->image_y * scene->size.y;
  const span_t y = moved_on(span_of(first_y, first_y + (1 << bits.y)), tilt_of_slice(scene, w->image_z));
  const int z = (w->row_z << bits.z) + w->image_z * scene->size.z;
  // Places outside a window stand in the bins at its border.
  const float north = !IS_PERIODIC(scene, y) && w->row_y == 0 ? -INFINITY : (float)(y.from * SPACING_Y);
  const float south =
      !IS_PERIODIC(scene, y) && w->row_y == scene->bins.rows - 1 ? INFINITY : (float)(y.to * SPACING_Y);
  const corners_t dy = outside(w->balls.y, north, south);
  corners_t rest = w->balls.n - (IS_MANHATTAN ? dy : dy * dy);
  if (IS_VOLUME) {
    const corners_t dz =
        outside(w->balls.z, (float)(z * SPACING_Z), (float)((z + (1 << bits.z)) * SPACING_Z));
    rest -= dz * dz;
  }
#if IS_WEIGHTED
  if (scene->row_lags != 0)
    rest -= (float)scene->row_lags[w->row_z * scene->bins.rows + w->row_y] * (LAG_UNIT * SQUARED_UNIT);
#endif
  const corners_t reach = radius_of(fmax(rest, 0.f));
  const int_corners_t misses = rest < 0.f;
  const float west =
      least_of_corners(select(w->balls.x - reach, (corners_t)INFINITY, misses)) * (1.f / SPACING_X);
  const float east =
      -least_of_corners(select(-w->balls.x - reach, (corners_t)INFINITY, misses)) * (1.f / SPACING_X);
  if (west > east) return false;
  const float most = 1 << 20;
  w->row = span_of(max(w->x.from, (int)fmax(west - 1, -most)), min(w->x.to, (int)fmin(east + 1, most)));
  return w->row.from <= w->row.to;
}

// So many units less than a few bits: whole units of the spacing first, which leave no more of them.
static inline corners_t less(corners_t at, int units) {
  return at - (float)(units >> FRACTION_BITS) - (float)(units & (ONE - 1)) * (1.f / ONE);
}

// The next of a long range's blocks that the balls meet, as a range.
#define LONG_RANGE (4 * PLACES_OF_BLOCK)
NOINLINE static bool next_blocks(const scene_t* scene, walk_t* w, uint* from, uint* to) {
  balls_t balls = w->balls;
  const int4 way = way_to_image(scene, w->image_x - 1, w->image_y, w->image_z);  // the range's image is the one before
  balls.x = less(balls.x, way.x), balls.y = less(balls.y, way.y), balls.z = less(balls.z, way.z);
  while (w->from < w->to) {
    const uint block = w->from / PLACES_OF_BLOCK, lane = block % BLOCKS_AT_ONCE, eight = block - lane;
    const uint there = (2u << min((w->to - 1) / PLACES_OF_BLOCK - eight, BLOCKS_AT_ONCE - 1u)) - (1u << lane);
    const uint meets = blocks_in_balls(bounds_in_index(scene->bounds + FIRST_BOUND(eight)), &balls) & there;
    const uint first = lowest_bit(meets | 1u << BLOCKS_AT_ONCE), end = first + lowest_bit(~(meets >> first));
    *from = max(w->from, (eight + first) * PLACES_OF_BLOCK);
    *to = w->from = min(w->to, (eight + end) * PLACES_OF_BLOCK);
    if (*from < *to) return true;
  }
  return false;
}

// The next range of a list that the balls meet.
NOINLINE static bool next_listed(walk_t* w, int4 centre, uint* from, uint* to, int4* origin) {
  while (w->some == 0) {
    if (w->list.begin >= w->list.end) return false;
    const bounds8_t bounds = bounds_in_list(w->list.blocks->bounds + FIRST_BOUND(w->list.begin));
    w->some = blocks_in_balls(bounds, &w->balls) & ((1u << min(w->list.end - w->list.begin, BLOCKS_AT_ONCE)) - 1);
    w->list.begin += BLOCKS_AT_ONCE;
  }
  const blocks_t* const b = w->list.blocks;
  const int i = w->list.begin - BLOCKS_AT_ONCE + (int)lowest_bit(w->some);
  w->some &= w->some - 1;
  *from = b->from[i], *to = b->to[i], *origin = centre + (int4)(b->x[i], b->y[i], b->z[i], 0);
  return true;
}

// The next range that is not empty; false at the end. `origin`: what is subtracted from its places, a centre
// in the image's place. It is that of the range before where that goes on.
static inline bool next_range(const scene_t* scene, walk_t* w, int4 centre, uint* from, uint* to,
                              int4* origin) {
  const bins_t* const bins = &scene->bins;
  if (w->list.blocks) return next_listed(w, centre, from, to, origin);
  while (true) {
    if (w->from < w->to && next_blocks(scene, w, from, to)) return true;
    while (w->image_x <= w->last_x) {
      const int image = w->image_x++;
      const span_t x = of_image(w->row, image, scene->size.x, IS_PERIODIC(scene, x));
      const uint first = (uint)((w->row_z * bins->rows + w->row_y) * (bins->columns + 1));
      *from = scene->starts[first + (uint)(x.from >> bins->bits.x)];
      *to = scene->starts[first + (uint)(x.to >> bins->bits.x) + 1];
      if (*from == *to) continue;
      *origin = centre - way_to_image(scene, image, w->image_y, w->image_z);
      if (!w->has_balls || *to - *from < LONG_RANGE) return true;
      w->from = *from, w->to = *to;
      if (next_blocks(scene, w, from, to)) return true;
    }
    while (++w->row_y > w->end_y) {
      if (IS_PERIODIC(scene, y) && w->image_y < w->last_y) {
        ++w->image_y;
        enter_y(scene, w);
        continue;
      }
      if (++w->row_z > w->end_z) {
        if (!IS_PERIODIC(scene, z) || w->image_z == w->last_z) return false;
        ++w->image_z;
        enter_z(scene, w);
      }
      enter_slice(scene, w);
    }
    if (!row_in_balls(scene, w)) continue;
    w->row = moved_back(w->row, tilt_of_row(scene, w->image_y, w->image_z));
    w->image_x = image_at(w->row.from, scene->size.x, IS_PERIODIC(scene, x));
    w->last_x = image_at(w->row.to, scene->size.x, IS_PERIODIC(scene, x));
  }
}

// The pixels of an axis that balls meet, and one more at both ends.
static inline span_t span_of_balls(corners_t at, corners_t reach, int spacing, span_t limits) {
  const float most = 1 << 20;
  const float from = least_of_corners(at - reach) / (float)spacing,
              to = -least_of_corners(-at - reach) / (float)spacing;
  return clamped(span_of((int)fmax(from - 1, -most), (int)fmin(to + 1, most)), limits);
}
static inline walk_t walk_over_balls(const scene_t* scene, const cuboid_t* limits, balls_t balls, source_t source) {
  if (source.blocks) {
    walk_t walk;
    walk.balls = balls, walk.has_balls = true, walk.list = source, walk.some = 0;
    return walk;
  }
  const corners_t reach = radius_of(balls.n);
  walk_t walk = walk_over(scene, span_of_balls(balls.x, reach, SPACING_X, limits->x),
                          span_of_balls(balls.y, reach, SPACING_Y, limits->y),
                          IS_VOLUME ? span_of_balls(balls.z, reach, SPACING_Z, limits->z) : span_of(0, 0));
  walk.balls = balls;
  walk.has_balls = true;
  walk.cuts_rows = IS_VOLUME || ((walk.y.to - walk.y.from) >> scene->bins.bits.y) >= ROWS_OF_BALLS;
  return walk;
}

#endif
