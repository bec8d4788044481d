// Patches: squares of pixels that a work-group labels together; and reading the places around them, shared
// out among its items.

#ifndef VOROCL_EXACT_GROUP_PATCH
#define VOROCL_EXACT_GROUP_PATCH

#include "exact/gather.cl"

#define SYNC() barrier(CLK_LOCAL_MEM_FENCE)
#define ITEM() ((int)get_local_id(0))
#define ITEMS() ((int)get_local_size(0))

#define SCENE_PARAMETERS                                                                                   \
  global const uint *restrict starts, global const int *restrict xs, global const int *restrict ys,        \
      global const uint *restrict ids, global const int *restrict lags, global const int2 *restrict order, \
      int has_images, int4 bits, int4 size, int4 first, int4 last, global uint *restrict labels
#define SCENE_OF_PARAMETERS \
  { bins_of(bits, size), size, starts, xs, ys, 0, ids, lags, 0, has_images ? order : 0, first, last, labels }

static inline box_t box_of_patch(const scene_t* scene, int patch) {
  const int across = ((scene->size.x - 1) >> PATCH_BITS) + 1;
  return box_at(patch % across * PATCH, patch / across * PATCH, 0, PATCH, PATCH, 1);
}

// Where all pixels of a patch get labels nothing is asked of each.
static inline bool is_whole(const scene_t* s, box_t b) {
  return b.x >= s->first.x && b.y >= s->first.y && b.x + b.sx <= min(s->last.x + 1, s->size.x) &&
         b.y + b.sy <= min(s->last.y + 1, s->size.y);
}
static inline void show_label(const scene_t* scene, bool whole, int x, int y, uint label) {
  if (whole || (x < scene->size.x && y < scene->size.y))
    scene->labels[y * scene->size.x + x] = whole || has_label(scene, x, y, 0) ? label : NO_LABEL;
}

// Of places as near: the index has no two seeds that are at one place and could both win.
static inline bool is_first(const scene_t* scene, uint a, uint b) {
  const int ya = own_y(scene, a), yb = own_y(scene, b);
  return ya != yb ? ya < yb : own_x(scene, a) < own_x(scene, b);
}

// --- reading the index together ---
//
// An AREA is a rectangle of pixels, or what of it is in the balls through a place around the corners of a box
// (walk.cl). Its places stand in ranges of the list, one for each row of bins and image of the grid. The
// items make a chunk of ranges at a time, and then share out the places of all of them, however full bins
// are.

// It is in local memory, for registers are few: the first item sets it.
typedef struct {
  span_t x, y;
  float4 ball[4];  // x, y, and n of balls_t
  int has_balls;
  int first_row, rows;      // of bins, numbered through all images of the grid
  int first_image, images;  // along x
} area_t;

#define MOST_RANGES 64
typedef struct {
  area_t area;
  int is_new;  // whether there may be places in the area that were not looked at
  uint places[MOST_RANGES];
  uint end[MOST_RANGES];    // the places of the ranges up to this one
  uint first[MOST_RANGES];  // the number i of the chunk is the place first + i of the list
#ifdef VOROCL_PERIODIC
  int2 image[MOST_RANGES];  // how far the image lies from the grid
#endif
} ranges_t;

static inline int number_of_row(const scene_t* scene, int y) {
  const int image = image_at(y, scene->size.y, PERIODIC_Y);
  return image * scene->bins.rows + ((y - image * scene->size.y) >> scene->bins.bits.y);
}

static inline void set_area(local area_t* area, const scene_t* scene, span_t x, span_t y) {
  area->x = x, area->y = y;
  area->first_row = number_of_row(scene, y.from);
  area->rows = number_of_row(scene, y.to) + 1 - area->first_row;
  area->first_image = image_at(x.from, scene->size.x, PERIODIC_X);
  area->images = image_at(x.to, scene->size.x, PERIODIC_X) + 1 - area->first_image;
}
// The pixels along x of a row of bins that the balls meet, one ball after the other, which takes few
// registers.
static inline span_t span_in_balls(local const area_t* area, float north, float south) {
  float west = 1 << 20, east = -(1 << 20);
#pragma unroll 1
  for (int i = 0; i < 4; ++i) {
    const float4 ball = area->ball[i];
    const float way = fmax(fmax(north - ball.y, ball.y - south), 0.f);
    const float rest = ball.z - (IS_MANHATTAN ? way : way * way);
    const float reach = IS_MANHATTAN ? rest : sqrt(fmax(rest, 0.f));
    west = rest < 0 ? west : fmin(west, ball.x - reach);
    east = rest < 0 ? east : fmax(east, ball.x + reach);
  }
  return span_of(max((int)fmax(west - 1, -0x1p20f), area->x.from),
                 min((int)fmin(east + 1, 0x1p20f), area->x.to));
}

// The range with a number: where it starts, and how many places it has.
static inline uint2 range_of(const scene_t* scene, local const area_t* area, int number, int2* image) {
  const bins_t* const bins = &scene->bins;
  const int line = area->first_row + number / area->images, image_y = image_at(line, bins->rows, PERIODIC_Y);
  const int bin_y = line - image_y * bins->rows;
  span_t row = area->x;
  if (area->has_balls) {
    // Places outside a window stand in the bins at its border.
    const int y = (bin_y << bins->bits.y) + image_y * scene->size.y;
    row = span_in_balls(area, !PERIODIC_Y && bin_y == 0 ? -INFINITY : (float)y,
                        !PERIODIC_Y && bin_y == bins->rows - 1 ? INFINITY : (float)(y + (1 << bins->bits.y)));
    if (row.from > row.to) return (uint2)(0, 0);
  }
  const int image_x = area->first_image + number % area->images;
  const span_t x = of_image(row, image_x, scene->size.x, PERIODIC_X);
  if (x.from > x.to) return (uint2)(0, 0);
  *image = (int2)(image_x, image_y) * scene->size.xy * ONE;
  global const uint* const starts = scene->starts + bin_y * (bins->columns + 1);
  const uint start = starts[x.from >> bins->bits.x];
  return (uint2)(start, starts[(x.to >> bins->bits.x) + 1] - start);
}

static inline int count_ranges(local const ranges_t* ranges) {
  return ranges->area.rows * ranges->area.images;
}
static inline int ranges_of_chunk(void) { return min(ITEMS(), MOST_RANGES); }

// Makes the ranges of a chunk from the number `begin` on; returns how many places they have.
INLINE uint make_ranges(local ranges_t* ranges, const scene_t* scene, int begin) {
  uint2 own = (uint2)(0, 0);
  int2 image = (int2)(0, 0);
  const int some = min(count_ranges(ranges) - begin, ranges_of_chunk());
  if (ITEM() < some) own = range_of(scene, &ranges->area, begin + ITEM(), &image);
  SYNC();  // for what was read of the last chunk
  if (ITEM() < MOST_RANGES) ranges->places[ITEM()] = own.y;
  SYNC();
  if (ITEM() < some) {  // few: a scan in steps would take as many instructions, and barriers
    uint before = 0;
    for (int i = 0; i < ITEM(); ++i) before += ranges->places[i];
    ranges->end[ITEM()] = before + own.y;
    ranges->first[ITEM()] = own.x - before;
#ifdef VOROCL_PERIODIC
    ranges->image[ITEM()] = image;
#endif
  }
  SYNC();
  return ranges->end[some - 1];
}

// Place i of a chunk: where it stands in the list, and how far it lies from an origin; w: its lag. `range`
// goes on from a lower i.
static inline int4 place_from(local const ranges_t* ranges, const scene_t* scene, uint i, int4 origin,
                              int* range, uint* at) {
  while (i >= ranges->end[*range]) ++*range;
  *at = ranges->first[*range] + i;
  int4 place =
      (int4)(scene->x[*at] - origin.x, scene->y[*at] - origin.y, 0, IS_WEIGHTED ? scene->lags[*at] : 0);
#ifdef VOROCL_PERIODIC
  place.xy += ranges->image[*range];
#endif
  return place;
}

// --- rivals: the places near the centre of a box and its corners (lists.cl) ---

#define RIVALS 5
typedef struct {
  rival_t rival[RIVALS];
  uint least[RIVALS], at[RIVALS];
} rivals_t;

static inline float farness_of(int4 place) {
  const float x = (float)place.x, y = (float)place.y;
  return IS_MANHATTAN ? fabs(x) + fabs(y) : fma(x, x, y * y) + (IS_WEIGHTED ? (float)place.w * LAG_UNIT : 0);
}
// Floats that are not below 0 are in the order of their bits.
static inline uint4 farness_from_corners(int4 place, const spans_t* spans) {
  const float x = (float)place.x, y = (float)place.y;
#if IS_MANHATTAN
  const float west = fabs(x + spans->x), east = fabs(x - spans->x);
  const float north = fabs(y + spans->y), south = fabs(y - spans->y);
  return as_uint4((float4)(west + north, east + north, west + south, east + south));
#else
  const float along_x = spans->x * x, along_y = spans->y * y;
  const float n = farness_of(place) + (spans->x * spans->x + spans->y * spans->y) / 4;
  return as_uint4(fmax(
      (float4)(n + along_x + along_y, n - along_x + along_y, n + along_x - along_y, n - along_x - along_y),
      0.f));
#endif
}

static inline bool stays_by(int4 place, local const rival_t* rival, const spans_t* s) {
  const float x = (float)place.x, y = (float)place.y;
#if IS_MANHATTAN
  const float west = fabs(x + s->x) - fabs(rival->x + s->x), east = fabs(x - s->x) - fabs(rival->x - s->x);
  const float north = fabs(y + s->y) - fabs(rival->y + s->y), south = fabs(y - s->y) - fabs(rival->y - s->y);
  return fmin(west, east) + fmin(north, south) <= fma(farness_of(place), 0x1p-19f, rival->limit);
#else
  return fma(fabs(y - rival->y), -s->y, fma(fabs(x - rival->x), -s->x, farness_of(place))) <= rival->limit;
#endif
}
static inline bool stays(int4 place, local const rivals_t* rivals, const spans_t* spans) {
  bool wins = true;
#pragma unroll 1
  for (int i = 0; i < RIVALS && wins; ++i) wins = stays_by(place, rivals->rival + i, spans);
  return wins;
}

#define MOST_SAMPLED 4096  // places of a chunk: of more, some are looked at

// The nearest place of a chunk may be the nearest one of all.
static inline void take_least(local rivals_t* rivals, int i, uint least, uint at) {
  if (least == rivals->least[i]) atomic_xchg(rivals->at + i, at);
}

// Sets the area that is looked at next for rivals: bins in so many rings around a box while no place is
// known, and then the balls, in which all that may win in the box lies. Nothing is looked at twice.
static inline void set_next_area(local ranges_t* ranges, local const rivals_t* rivals, const scene_t* scene,
                                 box_t box, int rings) {
  local area_t* const area = &ranges->area;
  ranges->is_new = 0;
  if (area->has_balls) return;
  const cuboid_t limits = limits_around(scene, box);
  const int4 bits = scene->bins.bits;
  span_t x = with_bins_around(span_of(box.x, box.x + box.sx - 1), rings, bits.x);
  span_t y = with_bins_around(span_of(box.y, box.y + box.sy - 1), rings, bits.y);
  if (rivals->at[0] != UINT_MAX) {
    const balls_t balls = balls_around(box, way_to(scene, rivals->at[0], centre_of(box)));
    area->ball[0] = (float4)(balls.x.s0, balls.y.s0, balls.n.s0, 0);
    area->ball[1] = (float4)(balls.x.s1, balls.y.s1, balls.n.s1, 0);
    area->ball[2] = (float4)(balls.x.s2, balls.y.s2, balls.n.s2, 0);
    area->ball[3] = (float4)(balls.x.s3, balls.y.s3, balls.n.s3, 0);
    area->has_balls = 1;
    const corners_t reach = radius_of(balls.n);
    x = span_of_balls(balls.x, reach, SPACING_X, limits.x);
    y = span_of_balls(balls.y, reach, SPACING_Y, limits.y);
  }
  x = clamped(x, limits.x), y = clamped(y, limits.y);
  ranges->is_new = !(holds(area->x, x) && holds(area->y, y));
  set_area(area, scene, x, y);
}

// Finds rivals of a box, and the area of all that may win in it against them, which has no places if there
// are none.
INLINE void find_rivals(local rivals_t* rivals, local ranges_t* ranges, const scene_t* scene, box_t box) {
  const spans_t spans = spans_of(box);
  const int4 centre = centre_of(box);
  int rings = 2 << max(scene->bins.bits.x, scene->bins.bits.y) > box.sx ? 1 : 0;
  if (ITEM() == 0) ranges->area.has_balls = 0, ranges->area.x = ranges->area.y = span_of(1, 0);
  if (ITEM() < RIVALS) rivals->least[ITEM()] = rivals->at[ITEM()] = UINT_MAX;
  SYNC();
  bool is_new;
  do {
    if (ITEM() == 0) set_next_area(ranges, rivals, scene, box, rings);
    SYNC();
    is_new = ranges->is_new != 0;
    const int end = is_new ? count_ranges(ranges) : 0;
    for (int begin = 0; begin < end; begin += ranges_of_chunk()) {
      const uint count = make_ranges(ranges, scene, begin), step = (uint)ITEMS() * (count / MOST_SAMPLED + 1);
      uint least = UINT_MAX, at_centre = UINT_MAX;
      uint4 least_of_corners = (uint4)(UINT_MAX), at_corners = (uint4)(UINT_MAX);
      int range = 0;
      for (uint i = (uint)ITEM(); i < count; i += step) {
        uint at;
        const int4 place = place_from(ranges, scene, i, centre, &range, &at);
        const uint away = as_uint(farness_of(place));
        const uint4 from_corners = farness_from_corners(place, &spans);
        at_centre = away < least ? at : at_centre;
        least = min(least, away);
        at_corners = select(at_corners, (uint4)(at), from_corners < least_of_corners);
        least_of_corners = min(least_of_corners, from_corners);
      }
      atomic_min(rivals->least, least);
      atomic_min(rivals->least + 1, least_of_corners.s0);
      atomic_min(rivals->least + 2, least_of_corners.s1);
      atomic_min(rivals->least + 3, least_of_corners.s2);
      atomic_min(rivals->least + 4, least_of_corners.s3);
      SYNC();
      if (at_centre != UINT_MAX) {
        take_least(rivals, 0, least, at_centre);
        take_least(rivals, 1, least_of_corners.s0, at_corners.s0);
        take_least(rivals, 2, least_of_corners.s1, at_corners.s1);
        take_least(rivals, 3, least_of_corners.s2, at_corners.s2);
        take_least(rivals, 4, least_of_corners.s3, at_corners.s3);
      }
    }
    SYNC();
    if (ITEM() < RIVALS && rivals->at[0] != UINT_MAX)
      rivals->rival[ITEM()] = rival_at(way_to(scene, rivals->at[ITEM()], centre), &spans);
    rings = 2 * rings + 1;
  } while (is_new);
  SYNC();
}

#endif
