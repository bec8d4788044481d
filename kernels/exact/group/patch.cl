// Patches: squares of pixels that a work-group labels together; and reading the places around boxes of pixels
// or voxels, shared out among its items.

#ifndef VOROCL_EXACT_GROUP_PATCH
#define VOROCL_EXACT_GROUP_PATCH

#include "exact/gather.cl"

#define SYNC() barrier(CLK_LOCAL_MEM_FENCE)
#define ITEM() ((int)get_local_id(0))
#define ITEMS() ((int)get_local_size(0))

#define SCENE_PARAMETERS                                                                               \
  global const uint *restrict starts, global const int *restrict xs, global const int *restrict ys,    \
      global const int *restrict zs, global const uint *restrict ids, global const int *restrict lags, \
      global const int2 *restrict order, int has_images, int4 bits, int4 size, int4 tilts, int4 first, \
      int4 last, global uint *restrict labels
#define PERIODIC_AXES (int4)(PERIODIC_X, PERIODIC_Y, PERIODIC_Z, 0)
#define SCENE_OF_PARAMETERS                                                                         \
  {                                                                                                 \
    bins_of(bits, size), size, PERIODIC_AXES, tilts, starts, xs, ys, zs, ids, lags, 0, 0,           \
        has_images ? order : 0, first, last, labels                                                 \
  }

// Of volumes those of points are stamped, whose voxels are cubes: dense seeds at centres are marks of a mask.
#define IS_STAMPED (!IS_VOLUME || (FRACTION_BITS > 1 && !IS_SPACED))

#if IS_VOLUME
#define PATCH_WIDTH (BOX_WIDTH * BOXES_ALONG)
#define PATCH_HEIGHT (BOX_HEIGHT * BOXES_ALONG)
#define PATCH_DEPTH (BOX_DEPTH * BOXES_ALONG)
#else
#define PATCH_WIDTH PATCH
#define PATCH_HEIGHT PATCH
#define PATCH_DEPTH 1
#endif
#define PIXELS_OF_PATCH (PATCH_WIDTH * PATCH_HEIGHT * PATCH_DEPTH)
static inline box_t pixel_of(box_t patch, int i) {
  const int row = i / PATCH_WIDTH;
  return box_at(patch.x + i % PATCH_WIDTH, patch.y + row % PATCH_HEIGHT, patch.z + row / PATCH_HEIGHT, 1, 1, 1);
}
static inline box_t box_of_patch(const scene_t* scene, int patch) {
  const int columns = (scene->size.x - 1) / PATCH_WIDTH + 1, rows = (scene->size.y - 1) / PATCH_HEIGHT + 1;
  return box_at(patch % columns * PATCH_WIDTH, patch / columns % rows * PATCH_HEIGHT,
                patch / columns / rows * PATCH_DEPTH, PATCH_WIDTH, PATCH_HEIGHT, PATCH_DEPTH);
}

// Where all pixels of a box get labels nothing is asked of each.
static inline bool is_whole(const scene_t* s, box_t b) {
  if (IS_VOLUME && b.z + b.sz > s->size.z) return false;
  return b.x >= s->first.x && b.y >= s->first.y && b.x + b.sx <= min(s->last.x + 1, s->size.x) &&
         b.y + b.sy <= min(s->last.y + 1, s->size.y);
}
static inline void show_label(const scene_t* scene, bool whole, int x, int y, int z, uint label) {
  if (!whole && (x >= scene->size.x || y >= scene->size.y || z >= scene->size.z)) return;
  const int row = IS_VOLUME ? z * scene->size.y + y : y;
  scene->labels[(size_t)row * (size_t)scene->size.x + (size_t)x] =
      whole || has_label(scene, x, y, z) ? label : NO_LABEL;
}

// How long a way is; by the Euclidean metric its square.
static inline ulong length_along(int way) {
  return IS_MANHATTAN ? (ulong)abs(way) : (ulong)((long)way * way);
}

// Of places as near: the index has no two seeds that are at one place and could both win.
static inline bool is_first(const scene_t* scene, uint a, uint b) {
  if (IS_VOLUME && scene->z[a] != scene->z[b]) return scene->z[a] < scene->z[b];
  const int ya = own_y(scene, a), yb = own_y(scene, b);
  return ya != yb ? ya < yb : own_x(scene, a) < own_x(scene, b);
}

// --- reading the index together ---
//
// An AREA is a cuboid of pixels, or what of it is in the balls through a place around the corners of a box
// (walk.cl). Its places stand in ranges of the list, one for each row of bins and image of the grid. The
// items make a chunk of ranges at a time, and then share out the places of all of them, however full bins
// are.

// It is in local memory, for registers are few: the first item sets it.
typedef struct {
  span_t x, y, z;
  float4 ball[CORNERS];  // x, y, z and n of balls_t
  int has_balls;
  int first_row, rows, first_slice, slices;  // of bins, numbered through all images of the grid
  int first_image, images;                   // along x
} area_t;
// In a tilted grid the first row is one of each slice, and the first image one of each row; what follows them may be
// more than there is.

#define MOST_RANGES 64
typedef struct {
  area_t area;
  int is_new;  // whether there may be places in the area that were not looked at
  uint places[MOST_RANGES];
  uint end[MOST_RANGES];    // the places of the ranges up to this one
  uint first[MOST_RANGES];  // the number i of the chunk is the place first + i of the list
#ifdef VOROCL_PERIODIC
  int2 image[MOST_RANGES];  // how far the image lies from the grid
#if IS_VOLUME
  int image_z[MOST_RANGES];
#endif
#endif
} ranges_t;

// A row of bins along y, or a slice of them along z.
static inline int number_of_line(int at, int size, int bits, int lines, int periodic) {
  const int image = image_at(at, size, periodic);
  return image * lines + ((at - image * size) >> bits);
}
static inline int number_of_row(const scene_t* s, int y) {
  return number_of_line(y, s->size.y, s->bins.bits.y, s->bins.rows, PERIODIC_Y);
}
static inline int number_of_slice(const scene_t* s, int z) {
  return IS_VOLUME ? number_of_line(z, s->size.z, s->bins.bits.z, s->bins.slices, PERIODIC_Z) : 0;
}

// How many rows a span of pixels has at most where it is moved by a tilt: each image of the grid that it begins or ends
// in may add one that is no whole one.
static inline int most_rows(const scene_t* scene, int length) {
  return (length >> scene->bins.bits.y) + 2 + (PERIODIC_Y ? length / scene->size.y + 3 : 1);
}

static inline void set_area(local area_t* area, const scene_t* scene, cuboid_t c) {
  area->x = c.x, area->y = c.y, area->z = c.z;
  area->first_slice = number_of_slice(scene, c.z.from);
  area->slices = number_of_slice(scene, c.z.to) + 1 - area->first_slice;
#if IS_TILTED
  area->rows = most_rows(scene, c.y.to - c.y.from);
  area->images = PERIODIC_X ? (c.x.to - c.x.from) / scene->size.x + 3 : 1;
#else
  area->first_row = number_of_row(scene, c.y.from);
  area->rows = number_of_row(scene, c.y.to) + 1 - area->first_row;
  area->first_image = image_at(c.x.from, scene->size.x, PERIODIC_X);
  area->images = image_at(c.x.to, scene->size.x, PERIODIC_X) + 1 - area->first_image;
#endif
}
static inline float way_outside(float at, float from, float to) {
  return fmax(fmax(from - at, at - to), 0.f);
}
// The pixels along x of a row of bins, in a box along y and z, that the balls meet: one ball after the other,
// which takes few registers.
static inline span_t span_in_balls(local const area_t* area, float north, float south, float above,
                                   float below) {
  float west = 0x1p24f, east = -0x1p24f;
#pragma unroll 1
  for (int i = 0; i < CORNERS; ++i) {
    const float4 ball = area->ball[i];
    const float y = way_outside(ball.y, north, south), z = IS_VOLUME ? way_outside(ball.z, above, below) : 0;
    const float rest = ball.w - (IS_MANHATTAN ? y : y * y + z * z);
    const float reach = IS_MANHATTAN ? rest : sqrt(fmax(rest, 0.f));
    west = rest < 0 ? west : fmin(west, ball.x - reach);
    east = rest < 0 ? east : fmax(east, ball.x + reach);
  }
  west = fmax(west * (1.f / SPACING_X) - 1, -0x1p20f), east = fmin(east * (1.f / SPACING_X) + 1, 0x1p20f);
  return span_of(max((int)west, area->x.from), min((int)east, area->x.to));
}

// The range with a number: where it starts, and how many places it has.
static inline uint2 range_of(const scene_t* scene, local const area_t* area, int number, int4* image) {
  const bins_t* const bins = &scene->bins;
  const int line = number / area->images, slice = IS_VOLUME ? line / area->rows : 0;
  const int image_z = image_at(slice + area->first_slice, bins->slices, PERIODIC_Z);
  const int bin_z = slice + area->first_slice - image_z * bins->slices;
  int row = line - slice * area->rows;
#if IS_TILTED
  const span_t own = moved_back(area->y, tilt_of_slice(scene, image_z));
  row += number_of_row(scene, own.from);
  if (row > number_of_row(scene, own.to)) return (uint2)(0, 0);
#else
  row += area->first_row;
#endif
  const int image_y = image_at(row, bins->rows, PERIODIC_Y), bin_y = row - image_y * bins->rows;
  span_t along = area->x;
  if (area->has_balls) {
    // Places outside a window stand in the bins at its border.
    const int first_y = (bin_y << bins->bits.y) + image_y * scene->size.y;
    const span_t y = moved_on(span_of(first_y, first_y + (1 << bins->bits.y)), tilt_of_slice(scene, image_z));
    const int z = (bin_z << bins->bits.z) + image_z * scene->size.z;
    const float north = !PERIODIC_Y && bin_y == 0 ? -INFINITY : (float)(y.from * SPACING_Y);
    const float south = !PERIODIC_Y && bin_y == bins->rows - 1 ? INFINITY : (float)(y.to * SPACING_Y);
    along = span_in_balls(area, north, south, (float)(z * SPACING_Z),
                          (float)((z + (1 << bins->bits.z)) * SPACING_Z));
    if (along.from > along.to) return (uint2)(0, 0);
  }
  int image_x = number % area->images;
#if IS_TILTED
  along = moved_back(along, tilt_of_row(scene, image_y, image_z));
  image_x += image_at(along.from, scene->size.x, PERIODIC_X);
#else
  image_x += area->first_image;
#endif
  const span_t x = of_image(along, image_x, scene->size.x, PERIODIC_X);
  if (x.from > x.to) return (uint2)(0, 0);
  *image = way_to_image(scene, image_x, image_y, image_z);
  global const uint* const starts =
      scene->starts + (uint)(bin_z * bins->rows + bin_y) * (uint)(bins->columns + 1);
  const uint start = starts[x.from >> bins->bits.x];
  return (uint2)(start, starts[(x.to >> bins->bits.x) + 1] - start);
}

static inline int count_ranges(local const ranges_t* ranges) {
  return ranges->area.rows * ranges->area.images * (IS_VOLUME ? ranges->area.slices : 1);
}
static inline int ranges_of_chunk(void) { return min(ITEMS(), MOST_RANGES); }

// Makes the ranges of a chunk from the number `begin` on; returns how many places they have.
INLINE uint make_ranges(local ranges_t* ranges, const scene_t* scene, int begin) {
  uint2 own = (uint2)(0, 0);
  int4 image = (int4)(0);
  const int some = min(count_ranges(ranges) - begin, ranges_of_chunk());
  if (ITEM() < some) own = range_of(scene, &ranges->area, begin + ITEM(), &image);
  SYNC();  // for what was read of the last chunk
  if (ITEM() < MOST_RANGES) ranges->places[ITEM()] = own.y;
  SYNC();
  if (ITEM() < some) {  // few: a scan in steps would take as many instructions, and barriers
    uint before = 0;
#pragma unroll 1
    for (int i = 0; i < ITEM(); ++i) before += ranges->places[i];
    ranges->end[ITEM()] = before + own.y;
    ranges->first[ITEM()] = own.x - before;
#ifdef VOROCL_PERIODIC
    ranges->image[ITEM()] = image.xy;
#if IS_VOLUME
    ranges->image_z[ITEM()] = image.z;
#endif
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
  int4 place = (int4)(scene->x[*at], scene->y[*at], IS_VOLUME ? scene->z[*at] : 0, 0) - origin;
  if (IS_WEIGHTED) place.w = scene->lags[*at];
#ifdef VOROCL_PERIODIC
  place.xy += ranges->image[*range];
#if IS_VOLUME
  place.z += ranges->image_z[*range];
#endif
#endif
  return place;
}

// --- rivals: the places near the centre of a box and its corners (lists.cl) ---

#define RIVALS (1 + CORNERS)
typedef struct {
  rival_t rival[RIVALS];
  uint least[RIVALS], at[RIVALS];
  float4 nearest;  // the way to the first one
} rivals_t;

static inline float farness_of(int4 place) {
  const float x = (float)place.x, y = (float)place.y, z = (float)place.z;
  if (IS_MANHATTAN) return fabs(x) + fabs(y);
  const float n = IS_VOLUME ? fma(z, z, fma(x, x, y * y)) : fma(x, x, y * y);
  return IS_WEIGHTED ? n + (float)place.w * LAG_UNIT : n;
}
// From the centre and the corners. Floats that are not below 0 are in the order of their bits.
static inline void find_farness(int4 place, const spans_t* spans, uint* farness) {
  const float x = (float)place.x, y = (float)place.y, n = farness_of(place);
  farness[0] = as_uint(n);
#if IS_MANHATTAN
#pragma unroll
  for (int i = 0; i < CORNERS; ++i)
    farness[1 + i] =
        as_uint(fabs(i & 1 ? x - spans->x : x + spans->x) + fabs(i & 2 ? y - spans->y : y + spans->y));
#else
  const float along_x = spans->x * x, along_y = spans->y * y, along_z = spans->z * (float)place.z;
  const float more = n + (spans->x * spans->x + spans->y * spans->y + spans->z * spans->z) / 4;
#pragma unroll
  for (int i = 0; i < CORNERS; ++i) {
    const float to_row = i & 2 ? more - along_y : more + along_y;
    const float to_line = !IS_VOLUME ? to_row : i & 4 ? to_row - along_z : to_row + along_z;
    farness[1 + i] = as_uint(fmax(i & 1 ? to_line - along_x : to_line + along_x, 0.f));
  }
#endif
}

static inline bool stays_by(int4 place, local const rival_t* rival, const spans_t* s) {
  const float x = (float)place.x, y = (float)place.y;
#if IS_MANHATTAN
  const float west = fabs(x + s->x) - fabs(rival->x + s->x), east = fabs(x - s->x) - fabs(rival->x - s->x);
  const float north = fabs(y + s->y) - fabs(rival->y + s->y), south = fabs(y - s->y) - fabs(rival->y - s->y);
  return fmin(west, east) + fmin(north, south) <= fma(farness_of(place), 0x1p-19f, rival->limit);
#else
  float n = fma(fabs(x - rival->x), -s->x, farness_of(place));
  n = fma(fabs(y - rival->y), -s->y, n);
  if (IS_VOLUME) n = fma(fabs((float)place.z - rival->z), -s->z, n);
  return n <= rival->limit;
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

// Sets the balls of an area and finds the cuboid around them, one ball after the other, which takes few
// registers.
static inline cuboid_t set_balls(local area_t* area, box_t box, float4 place) {
  const float4 half_way = between_centres(box) / 2, centre = convert_float4(centre_of(box)) * (1.f / ONE);
  const float4 pixels = (float4)(1.f / SPACING_X, 1.f / SPACING_Y, 1.f / SPACING_Z, 1);  // of a unit
  float4 from = 0x1p24f, to = -0x1p24f;
#pragma unroll 1
  for (int i = 0; i < CORNERS; ++i) {
    const float4 corner = half_way * (float4)(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1, 0);
    const float4 way = (float4)((corner - place * (1.f / ONE)).xyz, place.w * SQUARED_UNIT);
    float4 ball = corner + centre;
    ball.w = distance_of(way) * (1 + 0x1p-16f) + 0x1p-4f;
    const float reach = IS_MANHATTAN ? ball.w : sqrt(ball.w);
    from = fmin(from, ball - reach), to = fmax(to, ball + reach);
    area->ball[i] = ball;
  }
  from = fmax(from * pixels, -0x1p20f), to = fmin(to * pixels, 0x1p20f);
  cuboid_t c;
  c.x = span_of((int)from.x - 1, (int)to.x + 1);
  c.y = span_of((int)from.y - 1, (int)to.y + 1);
  c.z = IS_VOLUME ? span_of((int)from.z - 1, (int)to.z + 1) : span_of(0, 0);
  return c;
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
  cuboid_t c;
  c.x = with_bins_around(span_of(box.x, box.x + box.sx - 1), rings, bits.x);
  c.y = with_bins_around(span_of(box.y, box.y + box.sy - 1), rings, bits.y);
  c.z = IS_VOLUME ? with_bins_around(span_of(box.z, box.z + box.sz - 1), rings, bits.z) : span_of(0, 0);
  if (rivals->at[0] != UINT_MAX) {
    c = set_balls(area, box, rivals->nearest);
    area->has_balls = 1;
  }
  c.x = clamped(c.x, limits.x), c.y = clamped(c.y, limits.y), c.z = clamped(c.z, limits.z);
  ranges->is_new = !(holds(area->x, c.x) && holds(area->y, c.y) && holds(area->z, c.z));
  set_area(area, scene, c);
}

// Finds rivals of a box, and the area of all that may win in it against them, which has no places if there
// are none.
INLINE void find_rivals(local rivals_t* rivals, local ranges_t* ranges, const scene_t* scene, box_t box) {
  const spans_t spans = spans_of(box);
  const int4 centre = centre_of(box);
  const int4 bits = scene->bins.bits;
  int rings = 2 << max(max(bits.x, bits.y), bits.z) > box.sx ? 1 : 0;
  if (ITEM() == 0) ranges->area.has_balls = 0, ranges->area.x = span_of(1, 0);
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
      uint least[RIVALS], nearest[RIVALS];
#pragma unroll
      for (int k = 0; k < RIVALS; ++k) least[k] = nearest[k] = UINT_MAX;
      int range = 0;
#pragma unroll 1
      for (uint i = (uint)ITEM(); i < count; i += step) {
        uint at, farness[RIVALS];
        find_farness(place_from(ranges, scene, i, centre, &range, &at), &spans, farness);
#pragma unroll
        for (int k = 0; k < RIVALS; ++k) {
          nearest[k] = farness[k] < least[k] ? at : nearest[k];
          least[k] = min(least[k], farness[k]);
        }
      }
#pragma unroll
      for (int k = 0; k < RIVALS; ++k) atomic_min(rivals->least + k, least[k]);
      SYNC();
      if (nearest[0] != UINT_MAX) {
#pragma unroll
        for (int k = 0; k < RIVALS; ++k) take_least(rivals, k, least[k], nearest[k]);
      }
    }
    SYNC();
    if (ITEM() < RIVALS && rivals->at[0] != UINT_MAX) {
      const float4 way = way_to(scene, rivals->at[ITEM()], centre);
      rivals->rival[ITEM()] = rival_at(way, &spans);
      if (ITEM() == 0) rivals->nearest = way;
    }
    rings = 2 * rings + 1;
  } while (is_new);
  SYNC();
}

#endif
