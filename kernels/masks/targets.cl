// What is stored of the nearest marks of 16 neighbouring pixels.

#ifndef VOROCL_MASKS_TARGETS
#define VOROCL_MASKS_TARGETS

#include "masks/lines.cl"
#include "masks/marks.cl"

#ifdef cl_khr_fp64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif

#define NO_MARK 0xffffffffu

// Buffers that are not wanted are any.
#define TARGET_PARAMETERS                                                                                         \
  global uchar *distances, global uint *indices, global uint *places, global uint *ranks, global const uint *starts, \
      global uchar *values, global const uchar *image, global uint *labels
#define TARGETS_OF_PARAMETERS {distances, indices, places, ranks, starts, values, image, labels, marks}
typedef struct {
  global uchar* distances;
  global uint *indices, *places, *ranks;
  global const uint* starts;
  global uchar* values;
  global const uchar* image;
  global uint* labels;
  global const ushort* marks;
} targets_t;

// Pixels beside each other, and the columns, rows and slices of their nearest marks. `none`: lanes that have no mark
// that is near enough.
typedef struct {
  size_t at;  // the first one
  int x, y, z, lanes;
  int16 column, row, slice, none;
  keys square;
} nearest_t;

#ifdef cl_khr_fp64
// From the offsets and the lengths as they were given.
INLINE double16 lengths_of(const nearest_t* n, const images_t* e) {
  const double16 x = convert_double16(way_of(n->column - (LANE + n->x), e->period_x)) * as_double(e->length_x);
  const double16 y = convert_double16(way_of(n->row - n->y, e->period_y)) * as_double(e->length_y);
  double16 squared = x * x + y * y;
  if (e->is_volume) {
    const double16 z = convert_double16(way_of(n->slice - n->z, e->period_z)) * as_double(e->length_z);
    squared += z * z;
  }
  return sqrt(squared);
}
#endif

INLINE void store_distances(const nearest_t* n, const images_t* e, const targets_t* t) {
  const int16 none = n->none;
  if (e->wanted & WANTS_SQUARES) {
    const uint16 squares = select(convert_uint16(n->square), (uint16)NO_MARK, none);
    STORE_LANES(uint, squares, (global uint*)t->distances + n->at, n->lanes);
    return;
  }
#ifdef cl_khr_fp64
  if ((e->wanted & WANTS_DOUBLES) || !e->is_unit) {
    double16 length = e->is_unit ? sqrt(convert_double16(n->square)) : lengths_of(n, e);
    length = select(length, (double16)INFINITY, convert_long16(none));
    if (e->wanted & WANTS_DOUBLES) {
      STORE_LANES(double, length, (global double*)t->distances + n->at, n->lanes);
    } else {
      STORE_LANES(float, convert_float16(length), (global float*)t->distances + n->at, n->lanes);
    }
    return;
  }
#endif
  float16 length;
  if (e->is_unit) {
    length = sqrt(convert_float16(n->square));
  } else {
    const int16 x = way_of(n->column - (LANE + n->x), e->period_x), y = way_of(n->row - n->y, e->period_y);
    const int16 z = way_of(n->slice - n->z, e->period_z);
    const float16 along_x = convert_float16(x) * e->float_x, along_y = convert_float16(y) * e->float_y;
    const float16 along_z = convert_float16(z) * e->float_z;
    length = sqrt(along_x * along_x + along_y * along_y + along_z * along_z);
  }
  STORE_LANES(float, select(length, (float16)INFINITY, none), (global float*)t->distances + n->at, n->lanes);
}

// Unrolled, for loads that a compiler gathers into vectors take many times as long.
#define COPY_VALUES(type, mask)                                                                            \
  do {                                                                                                     \
    type value[STRIP];                                                                                     \
    _Pragma("unroll") for (int i = 0; i < STRIP; ++i) value[i] = ((global const type*)t->image)[place[i]]; \
    const type##16 values = select(vload16(0, value), (type##16)(type)0, convert_##mask(n->none));         \
    STORE_LANES(type, values, (global type*)t->values + n->at, n->lanes);                                  \
  } while (0)

INLINE void store_places(const nearest_t* n, const images_t* e, const targets_t* t) {
  const uint16 places = as_uint16((n->slice * e->height + n->row) * e->width + n->column);
  if (e->wanted & WANTS_PLACES) {
    STORE_LANES(uint, select(places, (uint16)NO_MARK, n->none), t->places + n->at, n->lanes);
  }
  if (e->wanted & WANTS_RANKS) {
    const int16 words = (n->slice * e->height + n->row) * (SHORTS_OF_ROW(e->width) / 4) + (n->column >> 6);
    uint word[STRIP], bit[STRIP], rank[STRIP];
    vstore16(as_uint16(words), 0, word);
    vstore16(as_uint16(n->column & 63), 0, bit);
#pragma unroll
    for (int i = 0; i < STRIP; ++i) rank[i] = rank_of((global const ulong*)t->marks, t->starts, word[i], bit[i]);
    STORE_LANES(uint, select(vload16(0, rank), (uint16)NO_MARK, n->none), t->ranks + n->at, n->lanes);
  }
  if (e->wanted & WANTS_VALUES) {
    uint place[STRIP];
    vstore16(places, 0, place);
    switch (e->bytes_of_value) {
      case 1: COPY_VALUES(uchar, char16); break;
      case 2: COPY_VALUES(ushort, short16); break;
      case 4: COPY_VALUES(uint, int16); break;
      default: COPY_VALUES(ulong, long16);
    }
  }
}

INLINE void store_indices(const nearest_t* n, const images_t* e, const targets_t* t) {
  const size_t pixels = (size_t)e->width * (size_t)e->height * (size_t)e->depth;
  global uint* out = t->indices + n->at;
  if (e->is_volume) {
    STORE_LANES(uint, select(as_uint16(n->slice), (uint16)NO_MARK, n->none), out, n->lanes);
    out += pixels;
  }
  STORE_LANES(uint, select(as_uint16(n->row), (uint16)NO_MARK, n->none), out, n->lanes);
  out += pixels;
  STORE_LANES(uint, select(as_uint16(n->column), (uint16)NO_MARK, n->none), out, n->lanes);
}

INLINE size_t index_of_pixel(int x, int y, int z, const images_t* e) {
  return ((size_t)z * (size_t)e->height + (size_t)y) * (size_t)e->width + (size_t)x;
}

INLINE void store_labels(int16 labels, int x, int y, int z, int lanes, const images_t* e, const targets_t* t) {
  STORE_LANES(uint, as_uint16(labels), t->labels + index_of_pixel(x, y, z, e), lanes);
}

INLINE void store_nearest(nearest_t* n, const images_t* e, const targets_t* t) {
#ifdef cl_khr_fp64
  // Whole numbers may be rounded, or their unit.
  if (e->limits_lengths) n->none |= convert_int16(lengths_of(n, e) > (double16)as_double(e->longest_length));
#endif
  n->at = index_of_pixel(n->x, n->y, n->z, e);
  if (e->wanted & (WANTS_SQUARES | WANTS_FLOATS | WANTS_DOUBLES)) store_distances(n, e, t);
  if (e->wanted & WANTS_INDICES) store_indices(n, e, t);
  if (e->wanted & (WANTS_PLACES | WANTS_RANKS | WANTS_VALUES)) store_places(n, e, t);
}

// The lanes whose squared distance is beyond the farthest.
INLINE int16 too_far(keys square, const images_t* e) {
#ifdef VOROCL_FAR
  return convert_int16(square > (keys)e->farthest);
#else
  return e->farthest >= 0xffffffffl ? (int16)0 : square > (keys)(uint)e->farthest;
#endif
}

// Of pixels from (x, y, z) on where there are no marks at all.
static inline void store_none(int x, int y, int z, int lanes, const images_t* e, const targets_t* t) {
  nearest_t n = {0, x, y, z, lanes, (int16)0, (int16)0, (int16)0, (int16)-1, (keys)0};
  if (e->carried == CARRIES_LABELS) store_labels((int16)-1, x, y, z, lanes, e, t);
  store_nearest(&n, e, t);
}

#endif
