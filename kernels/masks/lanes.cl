// The pixels of a row that are worked on together, LANES: 16 on CPUs, and one on GPUs (VOROCL_ONE_LANE).

#ifndef VOROCL_MASKS_LANES
#define VOROCL_MASKS_LANES

#include "core/abi.cl"
#include "masks/sizes.cl"

#define INLINE __attribute__((always_inline)) static inline
#define NO_MARK 0xffffffffu

// (Less than 2^31.)
INLINE uint pixels_of(const images_t* e) { return (uint)e->width * (uint)e->height * (uint)e->depth; }

#ifdef VOROCL_ONE_LANE
#define LANES 1
#define IN_LANES(name) name
#define LANE 0
#define LOAD_ALL(p) (*(p))
#define STORE_ALL(values, p) (*(p) = (values))
#define STORE_LANES(type, values, out, lanes) ((void)(lanes), *(out) = (values))
#define STREAM_LANES(images, type, values, out, lanes) STORE_LANES(type, values, out, lanes)
#else
#define LANES STRIP
#define JOIN_16(name) name##16
#define IN_LANES(name) JOIN_16(name)
#define LANE ((int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))
#define LOAD_ALL(p) vload16(0, p)
#define STORE_ALL(values, p) vstore16(values, 0, p)
// Stores the first ones of 16 values.
__attribute__((noinline)) static void store_some(const uchar* values, global uchar* out, int bytes) {
  for (int i = 0; i < bytes; ++i) out[i] = values[i];
}
#define STORE_LANES(type, vector, out, lanes)                                                    \
  do {                                                                                           \
    if ((lanes) == STRIP) {                                                                      \
      vstore16(vector, 0, out);                                                                  \
    } else {                                                                                     \
      type lane_values[STRIP];                                                                   \
      vstore16(vector, 0, lane_values);                                                          \
      store_some((const uchar*)lane_values, (global uchar*)(out), (lanes) * (int)sizeof(type)); \
    }                                                                                            \
  } while (0)
// The same in one of `images`. What is stored comes back into the caches from memory if a later kernel reads it.
#define STREAM_LANES(images, type, vector, out, lanes)                                                     \
  do {                                                                                                     \
    const bool has_lines = sizeof(type##16) % BYTES_OF_LINE == 0 && (size_t)(out) % sizeof(type##16) == 0; \
    if ((lanes) == STRIP && has_lines && IS_STREAMED(pixels_of(images))) {                                 \
      STREAM(vector, (global type##16*)(out));                                                             \
    } else {                                                                                               \
      STORE_LANES(type, vector, out, lanes);                                                               \
    }                                                                                                      \
  } while (0)
#endif

typedef IN_LANES(int) ints;
typedef IN_LANES(uint) uints;
typedef IN_LANES(float) floats;

// Squared distances.
#ifdef VOROCL_FAR
typedef IN_LANES(long) squares;
#else
typedef uints squares;
#endif

// How far the site of a row or column is.
INLINE ints way_of(ints far, int period) {
  const ints way = IN_LANES(as_int)(abs(far));
  return period == 0 ? way : min(way, period - way);
}

// The nearer of the marks at the left and at the right; of two as near the one that comes first in the row. Along a
// period of `period` columns they may lie beyond its ends.
INLINE ints nearer(ints x, ints last, ints next, int period) {
  if (period == 0) return select(next, last, x * 2 <= last + next);
  const ints a = last + select((ints)0, (ints)period, last < 0);
  const ints b = next - select((ints)0, (ints)period, next >= (ints)period);
  return select(b, a, (x * 2 < last + next) | ((x * 2 == last + next) & (a <= b)));
}

#endif
