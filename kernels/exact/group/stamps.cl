// Labelling a patch where places are dense: each of them stamps its key on the pixels within a radius, and
// the least key of a pixel stays. Pixels that no place is near enough to, or where two keys are alike but for
// their numbers, are OPEN: each looks for the nearest place alone (pixel.cl).

#ifndef VOROCL_EXACT_GROUP_STAMPS
#define VOROCL_EXACT_GROUP_STAMPS

#include "exact/group/patch.cl"

// A patch is tried where a place has fewer pixels than this on average. Within the radius of a pixel lie so
// many places then: at random one pixel in 37 has none. (Where so short a period that it has a seed twice
// around a patch leaves open which of two numbers comes first, none is tried.)
#define PIXELS_OF_DENSE (IS_VOLUME ? 200 : 36)
#define PLACES_WITHIN 3.6f
#define REACH (IS_VOLUME ? 8 : 6)  // of a radius at most, in whole pixels
// Pixels of a patch without a place near, which would look alone; with more it is left to others.
#define MOST_FAR (PIXELS_OF_PATCH * 3 / 16)
#define MOST_STAMPING 600  // places of a band of a patch at a time
#define OFTEN_STAMPING (MOST_STAMPING * 4 / 5)

// With weights lags come on top of squared distances, and the radius is so much longer that as many places are left on
// average.
//
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
#define TO_STAMPING(place) convert_short2((place).xy)
#else
#define NUMBER_BITS 10
#define STAMP_SHIFT (IS_MANHATTAN ? NUMBER_BITS : 0)
#define FIRST_NUMBER 1u
#if IS_VOLUME
typedef ulong stamping_t;  // with so many bits for each axis
#define AXIS_BITS 21
#define AXIS_MIDDLE (1 << (AXIS_BITS - 1))
#define AXIS_MASK ((1u << AXIS_BITS) - 1)
#define TO_STAMPING(place) packed_place((place) + AXIS_MIDDLE)
static inline ulong packed_place(int4 from_least) {
  return (ulong)from_least.x | (ulong)from_least.y << AXIS_BITS | (ulong)from_least.z << 2 * AXIS_BITS;
}
static inline int4 unpacked_place(ulong p) {
  return (int4)((int)((uint)p & AXIS_MASK), (int)((uint)(p >> AXIS_BITS) & AXIS_MASK), (int)(p >> 2 * AXIS_BITS), 0) -
         AXIS_MIDDLE;
}
#else
typedef int2 stamping_t;
#define TO_STAMPING(place) (place).xy
#endif
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
  uint key[PIXELS_OF_PATCH];
  stamping_t place[MOST_STAMPING];
  uint at[MOST_STAMPING];
  uint count, open_count, far_count, first_open, lags;
  ushort open[MOST_OPEN];
#if FRACTION_BITS == 1
  ushort number[AROUND * AROUND];  // by pixel, of the place there
#endif
} stamps_t;

// The places in the bins of a patch, and the pixels of these. Adds up the lags of the places; of each so much counts
// that a radius can have.
#define PIXELS_OF_LAG (1.f / (1 << LAG_BITS))
#define MOST_LAG ((REACH + 1) * (REACH + 1) << LAG_BITS)
#define LAG_SHIFT 4  // so that the lags of many places fit in 32 bits
static inline float2 places_and_pixels(const scene_t* scene, box_t patch, local uint* lags) {
  const bins_t* const bins = &scene->bins;
  const int first = patch.x >> bins->bits.x, top = patch.y >> bins->bits.y, front = patch.z >> bins->bits.z;
  const int last = min((patch.x + patch.sx - 1) >> bins->bits.x, bins->columns - 1);
  const int bottom = min((patch.y + patch.sy - 1) >> bins->bits.y, bins->rows - 1);
  const int back = IS_VOLUME ? min((patch.z + patch.sz - 1) >> bins->bits.z, bins->slices - 1) : 0;
  uint count = 0, sum = 0;
#pragma unroll 1  // for registers
  for (int slice = front; slice <= back; ++slice) {
#pragma unroll 1
    for (int row = top; row <= bottom; ++row) {
      global const uint* const starts = scene->starts + (slice * bins->rows + row) * (bins->columns + 1);
      const uint from = starts[first], to = starts[last + 1];
      count += to - from;
#pragma unroll 1
      for (uint at = from + (uint)ITEM(); IS_WEIGHTED && at < to; at += (uint)ITEMS())
        sum += (uint)min(scene->lags[at], MOST_LAG) >> LAG_SHIFT;
    }
  }
  if (IS_WEIGHTED) atomic_add(lags, sum);
  const int bits = bins->bits.x + bins->bits.y + (IS_VOLUME ? bins->bits.z : 0);
  return (float2)((float)count, ldexp((float)((last + 1 - first) * (bottom + 1 - top) * (back + 1 - front)), bits));
}

// Where a period begins again among the lines around a patch, along an axis; 0 if it does not.
static inline int border_around(int from, int size, int periodic) {
  const int start = REACH - from, end = start + size;
  if (!periodic) return 0;
  return start > 0 ? start : end < AROUND ? end : 0;
}

// What is the same for a patch: how many rows of a plane, or slices, are labelled at a time, a BAND; how far places
// stamp; the lines at which periods begin.
#define LAYER (IS_VOLUME ? PATCH_WIDTH * PATCH_HEIGHT : PATCH_WIDTH)  // pixels of a row or slice
#define LAYERS (PIXELS_OF_PATCH / LAYER)
typedef struct {
  int layers;
  int reach;     // in units
  float radius;  // in pixels, and a bit more; by the Euclidean metric its square
  uint limit;    // what a key is at least, if places farther than the radius may be nearer
  int border_x, border_y;
} band_t;

// Seeds at the centres of pixels are at whole distances, whatever they are squared.
static inline void set_radius(local band_t* band, float density, float lag) {
  const float most = REACH + 0.5f;
#if IS_VOLUME
  const float radius = cbrt(PLACES_WITHIN * 3 / (4 * M_PI_F) / density);
  const float square = fmin(radius * radius + lag, most * most);
#else
  const float square = fmin(PLACES_WITHIN / (IS_MANHATTAN ? 2 : M_PI_F) / density + lag, most * most);
#endif
#if FRACTION_BITS == 1
  const int whole = (int)(IS_MANHATTAN ? sqrt(square) : square);
  band->radius = (float)whole + 0.5f;
  band->reach = (int)((IS_MANHATTAN ? band->radius : sqrt(band->radius)) * ONE);
  band->limit = (uint)(whole + 1) << NUMBER_BITS;
#else
  band->reach = (int)(sqrt(square) * ONE);
  const float outer = ((float)band->reach + 1) * (1.f / ONE);
  band->radius = IS_MANHATTAN ? outer : outer * outer;
  band->limit =
      IS_MANHATTAN ? (uint)band->reach << STAMP_SHIFT : (uint)(band->reach * band->reach) & ~NUMBER_MASK;
#endif
}

// How much of a patch is labelled at a time, so that most often its places are not too many.
static inline int layers_of_band(float density, int reach) {
  const int around = 2 * (reach >> FRACTION_BITS);
  const int across = (PATCH_WIDTH + around) * (IS_VOLUME ? PATCH_HEIGHT + around : 1);
  int layers = LAYERS;
  while (layers > (IS_VOLUME ? 1 : 4) && density * (float)(across * (layers + around)) > OFTEN_STAMPING) layers /= 2;
  return layers;
}

static inline uint number_of_pixel(local const band_t* band, int x, int y) {
  return (uint)((y + REACH - band->border_y) & (LINES - 1)) << LINE_BITS |
         (uint)((x + REACH - band->border_x) & (LINES - 1));
}

// Lists the places that stamp pixels of a band, from the patch's corner; counts more than there is room for.
static inline bool is_near(int at, int from, int to, int reach) {
  return at >= from * ONE + HALF - reach && at <= to * ONE - HALF + reach;
}
INLINE void list_stamping(local stamps_t* stamps, local ranges_t* ranges, const scene_t* scene, box_t patch,
                          local const band_t* band, int first) {
  if (ITEM() == 0) {
    const int more = (band->reach >> FRACTION_BITS) + 1;
    const cuboid_t limits = limits_around(scene, patch);
    cuboid_t around = limits;
    box_t part = patch;
    if (IS_VOLUME) {
      part.z += first, part.sz = band->layers;
      around.z = clamped(span_of(part.z - more, part.z + part.sz - 1 + more), limits.z);
    } else {
      part.y += first, part.sy = band->layers;
    }
    around.x = clamped(span_of(part.x - more, part.x + part.sx - 1 + more), limits.x);
    around.y = clamped(span_of(part.y - more, part.y + part.sy - 1 + more), limits.y);
    ranges->area.has_balls = 0;
    set_area(&ranges->area, scene, around);
  }
  SYNC();
  const int4 corner = (int4)(patch.x, patch.y, IS_VOLUME ? patch.z : 0, 0) * ONE;
  for (int begin = 0; begin < count_ranges(ranges); begin += ranges_of_chunk()) {
    const uint count = make_ranges(ranges, scene, begin);
    int range = 0;
    for (uint i = (uint)ITEM(); i < count; i += (uint)ITEMS()) {
      uint at;
      const int4 place = place_from(ranges, scene, i, corner, &range, &at);
      const int reach = band->reach, along = IS_VOLUME ? place.z : place.y;
      if (is_near(place.x, 0, PATCH_WIDTH, reach) && (!IS_VOLUME || is_near(place.y, 0, PATCH_HEIGHT, reach)) &&
          is_near(along, first, first + band->layers, reach)) {
        const uint number = atomic_inc(&stamps->count);
        if (number < MOST_STAMPING) {
          stamps->place[number] = TO_STAMPING(place);
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

// The pixels along an axis that are no farther than so much from a place, in pixels from the first one's centre.
static inline span_t stamped(float place, float reach, int from, int to) {
  return span_of(max((int)ceil(place - reach), from), min((int)floor(place + reach), to - 1));
}
static inline float in_pixels(int way) { return (float)way * (1.f / ONE); }

// Stamps the pixels of a row within a radius that is left of it, the way `across` to the place along y and z, or its
// square.
static inline void stamp_row(local uint* row, int x, uint across, float radius, uint number) {
  const span_t columns = stamped(in_pixels(x - HALF), IS_MANHATTAN ? radius : sqrt(radius), 0, PATCH_WIDTH);
  const int way = columns.from * ONE + HALF - x;
#if IS_MANHATTAN
  for (int column = columns.from; column <= columns.to; ++column)
    stamp_one(row + column, (abs(way + (column - columns.from) * ONE) + across) << STAMP_SHIFT | number);
#else
  uint key = (((uint)(way * way) + across) << STAMP_SHIFT & ~NUMBER_MASK) | number;
  uint step = (uint)(2 * way + ONE) << (FRACTION_BITS + STAMP_SHIFT);
  for (int column = columns.from; column <= columns.to; ++column) {
    stamp_one(row + column, key);
    key += step;
    step += 2u << (2 * FRACTION_BITS + STAMP_SHIFT);
  }
#endif
}

static inline void stamp_slice(local uint* slice, int2 place, uint across, float radius, int top, int end,
                               uint number) {
  const span_t rows = stamped(in_pixels(place.y - HALF), IS_MANHATTAN ? radius : sqrt(radius), top, end);
  for (int row = rows.from; row <= rows.to; ++row) {
    const int way = row * ONE + HALF - place.y;
    const float away = in_pixels(way), rest = radius - (IS_MANHATTAN ? fabs(away) : away * away);
    stamp_row(slice + row * PATCH_WIDTH, place.x, across + (IS_MANHATTAN ? abs(way) : (uint)(way * way)),
              fmax(rest, 0.f), number);
  }
}

static inline void stamp(local stamps_t* stamps, const scene_t* scene, int i, local const band_t* band, int first) {
  const int end = first + band->layers;
  const uint lag = IS_WEIGHTED ? (uint)scene->lags[stamps->at[i]] : 0;
  const float radius = band->radius - (float)lag * PIXELS_OF_LAG;
  if (radius < 0) return;
#if IS_VOLUME
  const int4 place = unpacked_place(stamps->place[i]);
  const span_t slices = stamped(in_pixels(place.z - HALF), sqrt(radius), first, end);
  for (int slice = slices.from; slice <= slices.to; ++slice) {
    const int way = slice * ONE + HALF - place.z;
    const float away = in_pixels(way);
    stamp_slice(stamps->key + slice * LAYER, place.xy, lag * LAG_UNIT + (uint)(way * way),
                fmax(radius - away * away, 0.f), 0, PATCH_HEIGHT, (uint)i + FIRST_NUMBER);
  }
#else
  const int2 place = convert_int2(stamps->place[i]);
  const uint number =
      FRACTION_BITS == 1 ? number_of_pixel(band, place.x >> 1, place.y >> 1) : (uint)i + FIRST_NUMBER;
  stamp_slice(stamps->key, place, lag * LAG_UNIT, radius, first, end, number);
#endif
}

static inline bool is_short(int period, int periodic) {
  return FRACTION_BITS == 1 && periodic && period < 2 * PATCH;
}

// Labels dense patches, and says of each patch whether it is pending. Lists pixels that are open.
kernel void stamp_patches(SCENE_PARAMETERS, global uint* restrict pending, global uint* restrict queue,
                          global uint* restrict open) {
  local stamps_t stamps;
  local ranges_t ranges;
  local band_t band;
  const scene_t scene = SCENE_OF_PARAMETERS;
  const box_t patch = box_of_patch(&scene, (int)get_group_id(0));
  if (ITEM() == 0) stamps.lags = 0;
  SYNC();
  const float2 around = places_and_pixels(&scene, patch, &stamps.lags);
  const float density = around.x / around.y;
  SYNC();
  const bool has_short_period = is_short(size.x, PERIODIC_X) || is_short(size.y, PERIODIC_Y);
  const bool is_dense = density * (has_short_period ? 0 : PIXELS_OF_DENSE) >= 1;
  if (ITEM() == 0) {
    set_radius(&band, density, (float)stamps.lags * (PIXELS_OF_LAG * (1 << LAG_SHIFT)) / around.x);
    band.layers = layers_of_band(density, band.reach);
    band.border_x = border_around(patch.x, size.x, PERIODIC_X);
    band.border_y = border_around(patch.y, size.y, PERIODIC_Y);
    stamps.count = stamps.open_count = 0;
    stamps.far_count = is_dense ? 0 : MOST_FAR + 1;
  }
  for (int i = ITEM(); i < (is_dense ? PIXELS_OF_PATCH : 0); i += ITEMS()) stamps.key[i] = UINT_MAX;
  SYNC();
  const bool whole = is_whole(&scene, patch);
  for (int first_layer = is_dense ? 0 : LAYERS; first_layer < LAYERS; first_layer += band.layers) {
    list_stamping(&stamps, &ranges, &scene, patch, &band, first_layer);
    const int count = stamps.count <= MOST_STAMPING ? (int)stamps.count : 0;
    if (ITEM() == 0 && stamps.count > MOST_STAMPING) stamps.far_count = MOST_FAR + 1;
    for (int i = ITEM(); i < count; i += ITEMS()) stamp(&stamps, &scene, i, &band, first_layer);
    SYNC();
    if (ITEM() == 0) stamps.count = 0;
    for (int i = first_layer * LAYER + ITEM(); i < (first_layer + band.layers) * LAYER; i += ITEMS()) {
      const box_t pixel = pixel_of(patch, i);
      const uint key = stamps.key[i];
      const bool is_far = key >= band.limit;
      if (!is_far && (key & NUMBER_MASK) >= FIRST_NUMBER) {
        show_label(&scene, whole, pixel.x, pixel.y, pixel.z, ids[place_of_key(&stamps, &band, key)]);
      } else if (is_in_grid(&scene, pixel)) {
        const uint number = atomic_inc(&stamps.open_count);
        if (number < MOST_OPEN) stamps.open[number] = (ushort)i;
        if (is_far) atomic_inc(&stamps.far_count);
      }
    }
    SYNC();
  }
  const bool is_labelled = stamps.far_count <= MOST_FAR && stamps.open_count <= MOST_OPEN;
  const uint open_here = is_labelled ? stamps.open_count : 0;
  if (ITEM() == 0) {
    pending[get_group_id(0)] = is_labelled ? 0 : 1;
    stamps.first_open = atomic_add(queue + 1, open_here);
  }
  SYNC();
  for (uint i = (uint)ITEM(); i < open_here; i += (uint)ITEMS())
    open[stamps.first_open + i] = (uint)get_group_id(0) * PIXELS_OF_PATCH + stamps.open[i];
}

#endif
