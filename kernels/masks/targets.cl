// What is stored of the nearest marks of neighbouring pixels, or of one (lanes.cl).

#ifndef VOROCL_MASKS_TARGETS
#define VOROCL_MASKS_TARGETS

#include "masks/marks.cl"

#ifdef cl_khr_fp64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef IN_LANES(double) doubles;
#endif
#define TO_INTS IN_LANES(convert_int)
#define TO_UINTS IN_LANES(convert_uint)
#define AS_UINTS IN_LANES(as_uint)
#define TO_LONGS IN_LANES(convert_long)
#define TO_FLOATS IN_LANES(convert_float)
#define TO_DOUBLES IN_LANES(convert_double)

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
  ints column, row, slice, none;
  squares square;
} nearest_t;

#ifdef cl_khr_fp64
// From the offsets and the lengths as they were given.
INLINE doubles lengths_of(const nearest_t* n, const images_t* e) {
  const doubles x = TO_DOUBLES(way_of(n->column - (LANE + n->x), e->period_x)) * as_double(e->length_x);
  const doubles y = TO_DOUBLES(way_of(n->row - n->y, e->period_y)) * as_double(e->length_y);
  doubles squared = x * x + y * y;
  if (e->is_volume) {
    const doubles z = TO_DOUBLES(way_of(n->slice - n->z, e->period_z)) * as_double(e->length_z);
    squared += z * z;
  }
  return sqrt(squared);
}
#endif

INLINE void store_distances(const nearest_t* n, const images_t* e, const targets_t* t) {
  const ints none = n->none;
  if (e->wanted & WANTS_SQUARES) {
    const uints values = select(TO_UINTS(n->square), (uints)NO_MARK, none);
    STREAM_LANES(e, uint, values, (global uint*)t->distances + n->at, n->lanes);
    return;
  }
#ifdef cl_khr_fp64
  if ((e->wanted & WANTS_DOUBLES) || !e->is_unit) {
    doubles length = e->is_unit ? sqrt(TO_DOUBLES(n->square)) : lengths_of(n, e);
    length = select(length, (doubles)INFINITY, TO_LONGS(none));
    if (e->wanted & WANTS_DOUBLES) {
      STREAM_LANES(e, double, length, (global double*)t->distances + n->at, n->lanes);
    } else {
      STREAM_LANES(e, float, TO_FLOATS(length), (global float*)t->distances + n->at, n->lanes);
    }
    return;
  }
#endif
  floats length;
  if (e->is_unit) {
    length = sqrt(TO_FLOATS(n->square));
  } else {
    const ints x = way_of(n->column - (LANE + n->x), e->period_x), y = way_of(n->row - n->y, e->period_y);
    const ints z = way_of(n->slice - n->z, e->period_z);
    const floats along_x = TO_FLOATS(x) * e->float_x, along_y = TO_FLOATS(y) * e->float_y;
    const floats along_z = TO_FLOATS(z) * e->float_z;
    length = sqrt(along_x * along_x + along_y * along_y + along_z * along_z);
  }
  STREAM_LANES(e, float, select(length, (floats)INFINITY, none), (global float*)t->distances + n->at, n->lanes);
}

// Unrolled, for loads that a compiler gathers into vectors take many times as long.
#define COPY_VALUES(type, mask)                                                                                        \
  do {                                                                                                                 \
    type value[LANES];                                                                                                 \
    _Pragma("unroll") for (int i = 0; i < LANES; ++i) value[i] = ((global const type*)t->image)[place[i]];             \
    const IN_LANES(type) values = select(LOAD_ALL(value), (IN_LANES(type))(type)0, IN_LANES(convert_##mask)(n->none)); \
    STREAM_LANES(e, type, values, (global type*)t->values + n->at, n->lanes);                                          \
  } while (0)

INLINE void store_places(const nearest_t* n, const images_t* e, const targets_t* t) {
  const uints places = AS_UINTS((n->slice * e->height + n->row) * e->width + n->column);
  if (e->wanted & WANTS_PLACES) {
    STREAM_LANES(e, uint, select(places, (uints)NO_MARK, n->none), t->places + n->at, n->lanes);
  }
  if (e->wanted & WANTS_RANKS) {
    const ints words = (n->slice * e->height + n->row) * (SHORTS_OF_ROW(e->width) / 4) + (n->column >> 6);
    uint word[LANES], bit[LANES], rank[LANES];
    STORE_ALL(AS_UINTS(words), word);
    STORE_ALL(AS_UINTS(n->column & 63), bit);
#pragma unroll
    for (int i = 0; i < LANES; ++i) rank[i] = rank_of((global const ulong*)t->marks, t->starts, word[i], bit[i]);
    STREAM_LANES(e, uint, select(LOAD_ALL(rank), (uints)NO_MARK, n->none), t->ranks + n->at, n->lanes);
  }
  if (e->wanted & WANTS_VALUES) {
    uint place[LANES];
    STORE_ALL(places, place);
    switch (e->bytes_of_value) {
      case 1: COPY_VALUES(uchar, char); break;
      case 2: COPY_VALUES(ushort, short); break;
      case 4: COPY_VALUES(uint, int); break;
      default: COPY_VALUES(ulong, long);
    }
  }
}

INLINE void store_indices(const nearest_t* n, const images_t* e, const targets_t* t) {
  const size_t pixels = pixels_of(e);
  global uint* out = t->indices + n->at;
  if (e->is_volume) {
    STREAM_LANES(e, uint, select(AS_UINTS(n->slice), (uints)NO_MARK, n->none), out, n->lanes);
    out += pixels;
  }
  STREAM_LANES(e, uint, select(AS_UINTS(n->row), (uints)NO_MARK, n->none), out, n->lanes);
  out += pixels;
  STREAM_LANES(e, uint, select(AS_UINTS(n->column), (uints)NO_MARK, n->none), out, n->lanes);
}

// (See pixels_of().)
INLINE size_t index_of_pixel(int x, int y, int z, const images_t* e) {
  return ((uint)z * (uint)e->height + (uint)y) * (uint)e->width + (uint)x;
}

INLINE void store_labels(ints labels, int x, int y, int z, int lanes, const images_t* e, const targets_t* t) {
  STREAM_LANES(e, uint, AS_UINTS(labels), t->labels + index_of_pixel(x, y, z, e), lanes);
}

INLINE void store_nearest(nearest_t* n, const images_t* e, const targets_t* t) {
#ifdef cl_khr_fp64
  // Whole numbers may be rounded, or their unit.
  if (e->limits_lengths) n->none |= TO_INTS(lengths_of(n, e) > (doubles)as_double(e->longest_length));
#endif
  n->at = index_of_pixel(n->x, n->y, n->z, e);
  if (e->wanted & (WANTS_SQUARES | WANTS_FLOATS | WANTS_DOUBLES)) store_distances(n, e, t);
  if (e->wanted & WANTS_INDICES) store_indices(n, e, t);
  if (e->wanted & (WANTS_PLACES | WANTS_RANKS | WANTS_VALUES)) store_places(n, e, t);
}

// The lanes whose squared distance is beyond the farthest.
INLINE ints too_far(squares square, const images_t* e) {
#ifdef VOROCL_FAR
  return TO_INTS(square > (squares)e->farthest);
#else
  return e->farthest >= 0xffffffffl ? (ints)0 : square > (squares)(uint)e->farthest;
#endif
}

// Of pixels from (x, y, z) on where there are no marks at all.
static inline void store_none(int x, int y, int z, int lanes, const images_t* e, const targets_t* t) {
  nearest_t n = {0, x, y, z, lanes, (ints)0, (ints)0, (ints)0, (ints)-1, (squares)0};
  if (e->carried == CARRIES_LABELS) store_labels((ints)-1, x, y, z, lanes, e, t);
  store_nearest(&n, e, t);
}

#endif
