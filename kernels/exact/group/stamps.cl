// Labelling a patch where places are dense: each of them stamps its key on the pixels within a radius, and
// the least key of a pixel stays. Pixels that no place is near enough to, or where two keys are alike but for
// their numbers, look for the nearest place alone.

#ifndef VOROCL_EXACT_GROUP_STAMPS
#define VOROCL_EXACT_GROUP_STAMPS

#include "exact/group/patch.cl"
#include "exact/group/pixel.cl"

// A patch is tried where a place has fewer pixels than this on average. Within the radius of a pixel lie so
// many places then: at random one pixel in 37 has none. (Where so short a period that it has a seed twice
// around a patch leaves open which of two numbers comes first, none is tried.)
#define PIXELS_OF_DENSE 36
#define PLACES_WITHIN 3.6f
#define REACH 6  // of a radius at most, in whole pixels
#define MOST_FAR \
  192  // pixels of a patch without a place near, which would look alone; with more it is left to others
#define MOST_STAMPING 600  // places of a band of a patch at a time
#define OFTEN_STAMPING 480

// KEYS. The squared distance, and in the low bits, in which all distances of a column or row of pixels agree,
// the place's number. Of two keys that are alike but for their numbers, from 1 on, the pixel gets one with
// the number 0, unless there is a lesser key: then it is open. Of seeds at the centres of pixels, which have
// whole distances, the number is the pixel's, in the order of the tie rule, so that a key decides. Rows and
// columns are numbered from those behind the end of a period on. (By the Manhattan metric numbers stand below
// the distance.)
#if FRACTION_BITS == 1
#define NUMBER_BITS 12
#define STAMP_SHIFT (NUMBER_BITS - (IS_MANHATTAN ? 1 : 2))
#define FIRST_NUMBER 0u
typedef short2 stamping_t;
#define TO_STAMPING convert_short2
#else
#define NUMBER_BITS 10
#define STAMP_SHIFT (IS_MANHATTAN ? NUMBER_BITS : 0)
#define FIRST_NUMBER 1u
typedef int2 stamping_t;
#define TO_STAMPING
#if MOST_STAMPING >= 1 << NUMBER_BITS || NUMBER_BITS > LOW_BITS
#error "The number of a place does not fit in a key"
#endif
#endif
#define NUMBER_MASK ((1u << NUMBER_BITS) - 1)
#if (REACH + 1) * (REACH + 1) > 1 << (31 - 2 * MOST_FRACTION_BITS)
#error "A squared distance does not fit in a key"
#endif

#define AROUND (PATCH + 2 * REACH)
#define LINE_BITS (NUMBER_BITS / 2)
#define LINES (1 << LINE_BITS)  // rows or columns of pixels

typedef struct {
  uint key[PATCH * PATCH];
  stamping_t place[MOST_STAMPING];
  uint at[MOST_STAMPING];
  uint count, open_count, far_count;
  ushort open[PATCH * PATCH];
#if FRACTION_BITS == 1
  ushort number[AROUND * AROUND];  // by pixel, of the place there
#endif
} stamps_t;

// The places in the bins of a patch, for each pixel of these.
static inline float density_of(const scene_t* scene, box_t patch) {
  const bins_t* const bins = &scene->bins;
  const int first = patch.x >> bins->bits.x, top = patch.y >> bins->bits.y;
  const int last = min((patch.x + PATCH - 1) >> bins->bits.x, bins->columns - 1);
  const int bottom = min((patch.y + PATCH - 1) >> bins->bits.y, bins->rows - 1);
  uint count = 0;
  for (int row = top; row <= bottom; ++row) {
    global const uint* const starts = scene->starts + row * (bins->columns + 1);
    count += starts[last + 1] - starts[first];
  }
  return (float)count / (float)((last + 1 - first) * (bottom + 1 - top) << (bins->bits.x + bins->bits.y));
}

// Where a period begins again among the lines around a patch, along an axis; 0 if it does not.
static inline int border_around(int from, int size, int periodic) {
  const int start = REACH - from, end = start + size;
  if (!periodic) return 0;
  return start > 0 ? start : end < AROUND ? end : 0;
}

// What is the same for a patch: how many rows are labelled at a time, a BAND; how far places stamp; the lines
// at which periods begin.
typedef struct {
  int rows;
  int reach;     // in units
  float radius;  // in pixels, and a bit more; by the Euclidean metric its square
  uint limit;    // what a key is at least, if places farther than the radius may be nearer
  int border_x, border_y;
} band_t;

// Seeds at the centres of pixels are at whole distances, whatever they are squared.
static inline void set_radius(local band_t* band, float density) {
  const float most = REACH + 0.5f;
  const float square = fmin(PLACES_WITHIN / (IS_MANHATTAN ? 2 : M_PI_F) / density, most * most);
#if FRACTION_BITS == 1
  const int whole = (int)(IS_MANHATTAN ? sqrt(square) : square);
  band->radius = (float)whole + 0.5f;
  band->reach = (int)((IS_MANHATTAN ? band->radius : sqrt(band->radius)) * ONE);
  band->limit = (uint)(whole + 1) << NUMBER_BITS;
#else
  band->reach = (int)(sqrt(square) * ONE);
  const float radius = ((float)band->reach + 1) * (1.f / ONE);
  band->radius = IS_MANHATTAN ? radius : radius * radius;
  band->limit =
      IS_MANHATTAN ? (uint)band->reach << STAMP_SHIFT : (uint)(band->reach * band->reach) & ~NUMBER_MASK;
#endif
}

// The rows of a patch that are labelled at a time, so that most often their places are not too many.
static inline int rows_of_band(float density, int reach) {
  const int around = 2 * (reach >> FRACTION_BITS);
  int rows = PATCH;
  while (rows > 4 && density * (float)((PATCH + around) * (rows + around)) > OFTEN_STAMPING) rows /= 2;
  return rows;
}

static inline uint number_of_pixel(local const band_t* band, int x, int y) {
  return (uint)((y + REACH - band->border_y) & (LINES - 1)) << LINE_BITS |
         (uint)((x + REACH - band->border_x) & (LINES - 1));
}

// Lists the places that stamp pixels of a band, from the patch's corner; counts more than there is room for.
INLINE void list_stamping(local stamps_t* stamps, local ranges_t* ranges, const scene_t* scene, box_t patch,
                          local const band_t* band, int top) {
  const int least = HALF - band->reach, more = (band->reach >> FRACTION_BITS) + 1, first = patch.y + top;
  if (ITEM() == 0) {
    ranges->area.has_balls = 0;
    const cuboid_t limits = limits_around(scene, patch);
    cuboid_t around = limits;
    around.x = clamped(span_of(patch.x - more, patch.x + PATCH - 1 + more), limits.x);
    around.y = clamped(span_of(first - more, first + band->rows - 1 + more), limits.y);
    set_area(&ranges->area, scene, around);
  }
  SYNC();
  const int4 corner = (int4)(patch.x, patch.y, 0, 0) * ONE;
  for (int begin = 0; begin < count_ranges(ranges); begin += ranges_of_chunk()) {
    const uint count = make_ranges(ranges, scene, begin);
    int range = 0;
    for (uint i = (uint)ITEM(); i < count; i += (uint)ITEMS()) {
      uint at;
      const int4 place = place_from(ranges, scene, i, corner, &range, &at);
      const int y = place.y - top * ONE;
      if (place.x >= least && place.x <= PATCH * ONE - least && y >= least && y <= band->rows * ONE - least) {
        const uint number = atomic_inc(&stamps->count);
        if (number < MOST_STAMPING) {
          stamps->place[number] = TO_STAMPING(place.xy);
          stamps->at[number] = at;
#if FRACTION_BITS == 1
          stamps->number[((place.y >> 1) + REACH) * AROUND + (place.x >> 1) + REACH] = (ushort)number;
#endif
        }
      }
    }
  }
  SYNC();
}

// The place of a key.
static inline uint place_of_key(local const stamps_t* stamps, local const band_t* band, uint key) {
#if FRACTION_BITS == 1
  const int y = (int)((key >> LINE_BITS & (LINES - 1)) + (uint)band->border_y) & (LINES - 1);
  const int x = (int)((key & (LINES - 1)) + (uint)band->border_x) & (LINES - 1);
  return stamps->at[stamps->number[y * AROUND + x]];
#else
  (void)band;
  return stamps->at[(key & NUMBER_MASK) - FIRST_NUMBER];
#endif
}

static inline void stamp_one(local uint* at, uint key) {
#if FRACTION_BITS == 1
  atomic_min(at, key);
#else
  const uint other = atomic_min(at, key);
  if ((other ^ key) <= NUMBER_MASK) atomic_min(at, key & ~NUMBER_MASK);
#endif
}

// The pixels of a line that are no farther than a half chord from a place, in pixels from the first pixel's
// centre.
static inline span_t stamped(float place, float half_chord, int from, int to) {
  return span_of(max((int)ceil(place - half_chord), from), min((int)floor(place + half_chord), to));
}

static inline void stamp(local stamps_t* stamps, int i, local const band_t* band, int top) {
  const int2 place = convert_int2(stamps->place[i]);
  const float2 at = convert_float2(place - HALF) * (1.f / ONE);
  const uint number =
      FRACTION_BITS == 1 ? number_of_pixel(band, place.x >> 1, place.y >> 1) : (uint)i + FIRST_NUMBER;
  const span_t columns = stamped(at.x, IS_MANHATTAN ? band->radius : sqrt(band->radius), 0, PATCH - 1);
  for (int column = columns.from; column <= columns.to; ++column) {
    const float away = (float)column - at.x;
    const float half_chord =
        IS_MANHATTAN ? band->radius - fabs(away) : sqrt(fmax(band->radius - away * away, 0.f));
    const span_t rows = stamped(at.y, half_chord, top, top + band->rows - 1);
    const int way_x = column * ONE + HALF - place.x, way_y = rows.from * ONE + HALF - place.y;
    local uint* pixel = stamps->key + rows.from * PATCH + column;
#if IS_MANHATTAN
    for (int row = rows.from; row <= rows.to; ++row, pixel += PATCH)
      stamp_one(pixel, (uint)(abs(way_x) + abs(way_y + (row - rows.from) * ONE)) << STAMP_SHIFT | number);
#else
    uint key = ((uint)(way_x * way_x + way_y * way_y) << STAMP_SHIFT & ~NUMBER_MASK) | number;
    uint step = (uint)(2 * way_y + ONE) << (FRACTION_BITS + STAMP_SHIFT);
    for (int row = rows.from; row <= rows.to; ++row, pixel += PATCH) {
      stamp_one(pixel, key);
      key += step;
      step += 2u << (2 * FRACTION_BITS + STAMP_SHIFT);
    }
#endif
  }
}

static inline bool is_short(int period, int periodic) {
  return FRACTION_BITS == 1 && periodic && period < 2 * PATCH;
}

// Labels dense patches, and says of each patch whether it is pending. With weights the nearest place may be
// farther than others by any radius: all pixels of a dense patch look alone.
kernel void stamp_patches(SCENE_PARAMETERS, global uint* restrict pending, global uint* restrict queue) {
  local stamps_t stamps;
  local ranges_t ranges;
  local band_t band;
  const scene_t scene = SCENE_OF_PARAMETERS;
  const box_t patch = box_of_patch(&scene, (int)get_group_id(0));
  const float density = density_of(&scene, patch);
  if (get_global_id(0) == 0) queue[0] = 0;
  const bool has_short_period = is_short(size.x, PERIODIC_X) || is_short(size.y, PERIODIC_Y);
  if (density * (has_short_period ? 0 : PIXELS_OF_DENSE) < 1) {
    if (ITEM() == 0) pending[get_group_id(0)] = 1;
    return;
  }
  if (ITEM() == 0) {
    set_radius(&band, density);
    band.rows = rows_of_band(density, band.reach);
    band.border_x = border_around(patch.x, size.x, PERIODIC_X);
    band.border_y = border_around(patch.y, size.y, PERIODIC_Y);
  }
  for (int i = ITEM(); i < PATCH * PATCH; i += ITEMS()) stamps.key[i] = UINT_MAX;
  if (ITEM() == 0) stamps.count = stamps.open_count = stamps.far_count = 0;
  SYNC();
  const bool whole = is_whole(&scene, patch);
  for (int top = 0; top < PATCH; top += band.rows) {
    if (!IS_WEIGHTED) {
      list_stamping(&stamps, &ranges, &scene, patch, &band, top);
      const int count = stamps.count <= MOST_STAMPING ? (int)stamps.count : 0;
      if (ITEM() == 0 && stamps.count > MOST_STAMPING) stamps.far_count = MOST_FAR + 1;
      for (int i = ITEM(); i < count; i += ITEMS()) stamp(&stamps, i, &band, top);
    }
    SYNC();
    if (ITEM() == 0) stamps.count = 0;
    for (int i = ITEM(); i < band.rows * PATCH; i += ITEMS()) {
      const int column = i % PATCH, row = top + i / PATCH, x = patch.x + column, y = patch.y + row;
      const uint key = stamps.key[row * PATCH + column];
      const bool is_far = key >= band.limit;
      if (!is_far && (key & NUMBER_MASK) >= FIRST_NUMBER) {
        show_label(&scene, whole, x, y, 0, ids[place_of_key(&stamps, &band, key)]);
      } else if (x < size.x && y < size.y) {
        stamps.open[atomic_inc(&stamps.open_count)] = (ushort)(row * PATCH + column);
        if (is_far && !IS_WEIGHTED) atomic_inc(&stamps.far_count);
      }
    }
    SYNC();
  }
  const int open = stamps.far_count <= MOST_FAR ? (int)stamps.open_count : 0;
#pragma unroll 1
  for (int i = ITEM(); i < open; i += ITEMS()) {
    const int x = patch.x + stamps.open[i] % PATCH, y = patch.y + stamps.open[i] / PATCH;
    labels[y * size.x + x] = has_label(&scene, x, y, 0) ? label_of(&scene, x, y) : NO_LABEL;
  }
  if (ITEM() == 0) pending[get_group_id(0)] = stamps.far_count > MOST_FAR ? 1 : 0;
}

#endif
