// Seeds that lie outside a window's pixels: positions in the plane, an int2 of pixels from the window's corner, and how
// long distances to them are. With the build option VOROCL_FAR some are so far away that distances take 64 bits.

#ifndef VOROCL_PLANE
#define VOROCL_PLANE

#include "core/position.cl"

// A seed that is absent.
#define ABSENT INT_MIN

// LENGTH holds offsets along an axis, distances, and differences of two distances. The host sees to it: no pixel is
// 2^31 pixels or more away from a seed along an axis, and without VOROCL_FAR not 2^15 or more.
#ifdef VOROCL_FAR
#define LENGTH long
#define MOST_LENGTH LONG_MAX
#else
#define LENGTH int
#define MOST_LENGTH INT_MAX
#endif

#endif
