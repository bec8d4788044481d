// Collecting the places around a box of pixels from the index.

#ifndef VOROCL_EXACT_GATHER
#define VOROCL_EXACT_GATHER

#include "exact/candidates.cl"

// What a work-item reads.
typedef struct {
  bins_t bins;
  int width, height;  // of the grid, which is its period along periodic axes
  global const uint* starts;
  global const int2* list;
  global const uint* ids;
  global const int2* order;  // by id, if places may be images of seeds: what orders these; else null
  global uint* labels;       // written
  int4 region;               // the pixels that get labels: left, top, right, bottom, both ends included
} scene_t;

// What orders a place's seed by its own position in the grid.
static inline int2 own_position(const scene_t* scene, uint at) {
  return scene->order ? scene->order[scene->ids[at]] : scene->list[at];
}

static inline bool comes_first(const scene_t* scene, uint at, uint other) {
  const int2 a = own_position(scene, at), b = own_position(scene, other);
  if (a.y != b.y) return a.y < b.y;
  if (a.x != b.x) return a.x < b.x;
  return scene->ids[at] < scene->ids[other];
}

// What orders places by their ways from a pixel, in units.
static inline ulong length_of(int2 way) {
#ifdef VOROCL_EUCLIDEAN
  return (ulong)((long)way.x * way.x) + (ulong)((long)way.y * way.y);
#else
  return (ulong)abs(way.x) + (ulong)abs(way.y);
#endif
}

// Pixels of an axis, both ends included.
typedef struct {
  int from, to;
} span_t;

static inline span_t span_of(int from, int to) {
  const span_t span = {from, to};
  return span;
}
static inline bool holds(span_t outer, span_t inner) { return inner.from >= outer.from && inner.to <= outer.to; }
static inline span_t joined(span_t a, span_t b) { return span_of(min(a.from, b.from), max(a.to, b.to)); }
static inline span_t clamped(span_t span, span_t limits) {
  return span_of(clamp(span.from, limits.from, limits.to), clamp(span.to, limits.from, limits.to));
}
static inline span_t with_bins_around(span_t span, int rings, int bits) {
  return span_of(((span.from >> bits) - rings) * (1 << bits), ((span.to >> bits) + rings + 1) * (1 << bits) - 1);
}

// All that a box needs: the axis, or along a periodic one all that is at most half a period away.
static inline span_t limits_of(span_t box, int size, int periodic) {
  if (!periodic) return span_of(0, size - 1);
  return span_of(box.from - size / 2 - 1, box.to + size / 2 + 1);
}

// The images of the pixels of a periodic axis that a span meets, by the number of periods that they are away.
static inline int images_from(int at, int size, int periodic) {
  return periodic ? (at >= 0 ? at / size : -((size - 1 - at) / size)) : 0;
}
static inline span_t of_image(span_t span, int image, int size, int periodic) {
  if (!periodic) return span;
  return span_of(max(span.from - image * size, 0), min(span.to - image * size, size - 1));
}

// A rectangle of bins, walked row by row: ranges of the list, and where the images of their places lie.
typedef struct {
  span_t x, y;
  int image_x, image_y, last_image_x, last_image_y;
  global const uint* first;  // of the next row's bins
  int rows, columns;         // rows that are left
} walk_t;

static inline void enter_image(const scene_t* scene, walk_t* walk) {
  const span_t x = of_image(walk->x, walk->image_x, scene->width, PERIODIC_X);
  const span_t y = of_image(walk->y, walk->image_y, scene->height, PERIODIC_Y);
  const bins_t* const bins = &scene->bins;
  const int column = column_of(bins, x.from), row = row_of(bins, y.from);
  walk->first = scene->starts + start_of(bins, column, row);
  walk->columns = column_of(bins, x.to) + 1 - column;
  walk->rows = row_of(bins, y.to) + 1 - row;
}

static inline walk_t walk_over(const scene_t* scene, span_t x, span_t y) {
  walk_t walk;
  walk.x = x;
  walk.y = y;
  walk.image_x = images_from(x.from, scene->width, PERIODIC_X);
  walk.image_y = images_from(y.from, scene->height, PERIODIC_Y);
  walk.last_image_x = images_from(x.to, scene->width, PERIODIC_X);
  walk.last_image_y = images_from(y.to, scene->height, PERIODIC_Y);
  enter_image(scene, &walk);
  return walk;
}

// The next range; false at the end.
static inline bool next_range(const scene_t* scene, walk_t* walk, uint2* range) {
  while (walk->rows <= 0) {
    if (!(PERIODIC_X || PERIODIC_Y)) return false;
    if (walk->image_x < walk->last_image_x) {
      ++walk->image_x;
    } else if (walk->image_y < walk->last_image_y) {
      walk->image_x = images_from(walk->x.from, scene->width, PERIODIC_X);
      ++walk->image_y;
    } else {
      return false;
    }
    enter_image(scene, walk);
  }
  --walk->rows;
  range->s0 = walk->first[0];
  range->s1 = walk->first[walk->columns];
  walk->first += scene->bins.columns + 1;
  return true;
}

// What is subtracted from the places of a range: the centre of a box, in the image's place.
static inline int2 origin_of(const scene_t* scene, const walk_t* walk, int2 centre) {
  if (!(PERIODIC_X || PERIODIC_Y)) return centre;
  return centre - (int2)(walk->image_x * scene->width, walk->image_y * scene->height) * ONE_PIXEL;
}

// Eight places of the list, in units from an origin.
static inline void load_places(const scene_t* scene, uint from, int2 origin, int8* x, int8* y) {
  // Not one vector of 16, in which processors of 256-bit vectors return nothing.
  const int8 first = vload8(0, (global const int*)(scene->list + from));
  const int8 second = vload8(1, (global const int*)(scene->list + from));
  *x = (int8)(first.even, second.even) - origin.x;
  *y = (int8)(first.odd, second.odd) - origin.y;
}

static inline bool is_full(int count) { return count > MOST_IN_LIST - 8; }

// Gathers what a rival does not drop until the list is full, and returns how many; the walk goes on from there.
NOINLINE static int gather(const scene_t* scene, walk_t* walk, uint2* range, list_t* list, int2 centre, rival_t rival) {
  int count = 0;
  do {
    const int2 origin = origin_of(scene, walk, centre);
    const uint end = range->s1;
    for (uint at = range->s0; at < end; at += 8) {
      if (is_full(count)) {
        range->s0 = at;
        return count;
      }
      int8 x, y;
      load_places(scene, at, origin, &x, &y);
      const int8 stays = may_win(convert_float8(x), convert_float8(y), rival) & (EIGHT < (int)(end - at));
      count = keep(list, count, stays, x, y, at + as_uint8(EIGHT));
    }
    range->s0 = end;
  } while (next_range(scene, walk, range));
  return count;
}

// How far the discs reach, in pixels beyond a box, that go through a place and have their centres at the box's pixels:
// what may win is in them. (In the Manhattan metric they are diamonds.)
typedef struct {
  float west, east, north, south;
} reach_t;

static inline float radius_of(float x, float y) {
#ifdef VOROCL_EUCLIDEAN
  return sqrt(fma(x, x, y * y)) * (1 + 0x1p-20f) + 0x1p-7f;
#else
  return (x + y) * (1 + 0x1p-20f) + 0x1p-7f;
#endif
}

static inline reach_t reach_of(int2 place, int side) {
  const float x = fabs((float)place.x) / ONE_PIXEL, y = fabs((float)place.y) / ONE_PIXEL;
  const float corner = (float)(side - 1) / 2, farthest = radius_of(corner + x, corner + y);
  const float beside_x = radius_of(fabs(corner - x), corner + y), beside_y = radius_of(corner + x, fabs(corner - y));
  const reach_t reach = {place.x > 0 ? farthest : beside_x, place.x > 0 ? beside_x : farthest,
                         place.y > 0 ? farthest : beside_y, place.y > 0 ? beside_y : farthest};
  return reach;
}

// How far from any pixel of a box a place can be that is not dropped by another one: at some corner it is no farther
// than that one, which is at most so far from the corners.
static inline float reach_over(int2 place, int side) {
  const float corner = (float)(side - 1) / 2;
  return radius_of(corner + fabs((float)place.x) / ONE_PIXEL, corner + fabs((float)place.y) / ONE_PIXEL) + (float)side;
}

// The pixels of an axis that a box of pixels needs to know. A reach can be longer than the numbers of pixels.
static inline span_t span_of_reach(span_t box, float before, float behind) {
  const int most = 1 << 21;
  return span_of(box.from - (int)fmin(before, (float)most) - 2, box.to + (int)fmin(behind, (float)most) + 2);
}

#endif
