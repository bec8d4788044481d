// Which pixel of an axis a coordinate falls in, and where in it: Axis of grid.hpp, to the bit, of a vector of
// coordinates. Each step is rounded as the host rounds it, so nothing here may be contracted.

#ifndef VOROCL_AXIS
#define VOROCL_AXIS

#include "core/place_sizes.cl"
#include "core/vector.cl"

#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#pragma OPENCL FP_CONTRACT OFF

// `flags` are what comparisons of doubles give.
#if VOROCL_WIDTH == 1
typedef double double_v;
typedef int flags;
#define ALL(condition) (condition)
#define IF(condition, then, otherwise) ((condition) ? (then) : (otherwise))
#else
typedef JOIN(double, VOROCL_WIDTH) double_v;
typedef JOIN(long, VOROCL_WIDTH) flags;
#define ALL(condition) all(condition)
#define IF(condition, then, otherwise) select(otherwise, then, condition)
#endif

typedef struct {
  double from, to;
  double count;  // of its pixels
  int kind;      // AXIS_...
} axis_t;

static inline axis_t axis_of(double2 ends, int pixels, int kind) {
  const axis_t axis = {ends.x, ends.y, (double)pixels, kind};
  return axis;
}

// rint() and floor(), which drivers of CPUs call a function for, lane by lane. Past 2^52 all numbers are whole.
static inline double_v nearest_whole(double_v number) {
  const double_v shift = IF(number < 0, (double_v)(-4503599627370496.0), (double_v)4503599627370496.0);
  return IF(fabs(number) >= 4503599627370496.0, number, (number + shift) - shift);
}
static inline double_v whole_below(double_v number) {
  const double_v whole = nearest_whole(number);
  return IF(whole > number, whole - 1, whole);
}

// The nearest whole number of one in [0, 2^52), in fewer steps; of a negative one, what is not above 0.
#define NEAREST_FROM_0(number) (((number) + 4503599627370496.0) - 4503599627370496.0)

// Pixels, which may lie outside the axis, and how many 1/4096 behind their starts coordinates are.
typedef struct {
  double_v pixel, part;
} spots_t;

static inline double_v offset_in_period(axis_t axis, double_v coordinate) {
  const double period = axis.to - axis.from;
  double_v offset = coordinate - axis.from;
  const flags is_inside = offset >= 0 && offset < period;
  if (!ALL(is_inside)) {
    const double_v brought_in = fmod(offset, (double_v)period);
    offset = IF(is_inside, offset, brought_in + IF(brought_in < 0, (double_v)period, (double_v)0));
  }
  return offset;
}

static inline double_v periods_beyond(axis_t axis, double_v coordinate) {
  if (!(axis.kind & AXIS_PERIODIC)) return 0;
  return nearest_whole((coordinate - axis.from - offset_in_period(axis, coordinate)) / (axis.to - axis.from));
}

// Finds the spots of coordinates, those that are finite.
__attribute__((always_inline)) static inline void find_spots(axis_t axis, double_v coordinate, spots_t* spots) {
  double_v position = coordinate, pixel;
  flags is_middle = 0;
  if (axis.kind & AXIS_PERIODIC) {
    position = offset_in_period(axis, coordinate);
    if (!(axis.kind & AXIS_IN_PIXELS)) position = position * axis.count / (axis.to - axis.from);
    const double_v whole = NEAREST_FROM_0(position);
    // What is just below the period can be rounded up to its end.
    pixel = min(IF(whole > position, whole - 1, whole), axis.count - 1);
  } else if (axis.from == axis.to) {
    is_middle = coordinate == axis.from;
    position = IF(is_middle, (double_v)(floor(axis.count / 2) + 0.5), position);
    pixel = IF(is_middle, whole_below(position),
               IF(coordinate < axis.from, (double_v)(-1), (double_v)axis.count));
  } else {
    if (!(axis.kind & AXIS_IN_PIXELS)) position = (coordinate - axis.from) * axis.count / (axis.to - axis.from);
    pixel = whole_below(position);
    const bool is_closed = axis.kind & AXIS_CLOSED;
    const flags is_below = is_closed ? coordinate <= axis.to : coordinate < axis.to;
    pixel = IF(is_below, fmin(pixel, axis.count - 1), pixel);  // what is just below the end can be rounded up to it
  }
  if (axis.kind & AXIS_REVERSED) {
    pixel = axis.count - 1 - pixel;
    position = axis.count - position;
  }
  spots->pixel = pixel;
  spots->part = clamp(NEAREST_FROM_0((position - pixel) * PARTS_OF_PIXEL), 0.0, PARTS_OF_PIXEL - 1.0);
}

#endif
