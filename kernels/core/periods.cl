// How many dimensions there are: the build option VOROCL_DIMENSIONS, 3 in volumes. And which axes are periodic: the
// build options VOROCL_PERIODIC_X, VOROCL_PERIODIC_Y and, in volumes, VOROCL_PERIODIC_Z. Their period is the grid's
// side, and distances go the shorter way round. Kernels that take the periodic axes as an argument have the build
// option VOROCL_PERIODIC alone.

#ifndef VOROCL_PERIODS
#define VOROCL_PERIODS

#ifndef VOROCL_DIMENSIONS
#define VOROCL_DIMENSIONS 2
#endif

#if defined(VOROCL_PERIODIC_X) || defined(VOROCL_PERIODIC_Y) || defined(VOROCL_PERIODIC_Z)
#define VOROCL_PERIODIC 1
#endif
#ifdef VOROCL_PERIODIC_X
#define PERIODIC_X 1
#else
#define PERIODIC_X 0
#endif
#ifdef VOROCL_PERIODIC_Y
#define PERIODIC_Y 1
#else
#define PERIODIC_Y 0
#endif
#ifdef VOROCL_PERIODIC_Z
#define PERIODIC_Z 1
#else
#define PERIODIC_Z 0
#endif

// A coordinate that is less than a period outside the grid, brought back into it if the axis is periodic.
static inline int wrapped(int at, int size, int periodic) {
  if (!periodic) return at;
  return at < 0 ? at + size : at >= size ? at - size : at;
}

// The way between two coordinates of an axis, given the way inside the grid: the shorter one if the axis is periodic,
// and of two halves of the period the positive one.
static inline int shorter_way(int inside, int size, int periodic) {
  if (!periodic) return inside;
  if (2 * inside > size) return inside - size;
  return 2 * inside <= -size ? inside + size : inside;
}

// How long it is. The macro takes numbers and vectors.
#define SHORTER(inside, size, periodic) \
  ((periodic) ? min(max(inside, -(inside)), (size) - max(inside, -(inside))) : (inside))

#endif
