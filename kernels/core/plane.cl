// Seeds that lie outside a window's pixels: positions in the plane, an int2 of pixels from the window's corner.

#ifndef VOROCL_PLANE
#define VOROCL_PLANE

#include "core/position.cl"
#include "core/units.cl"

#endif
