// How long distances are, and in which units positions and ways are.

#ifndef VOROCL_UNITS
#define VOROCL_UNITS

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

// UNITS. Positions and ways are whole numbers of pixels: between the centres of pixels. With VOROCL_FRACTIONS, which
// comes with VOROCL_FAR, they are whole numbers of 1/4096 pixel, and a pixel's centre is CENTRE behind its start.
#ifdef VOROCL_FRACTIONS
#define UNIT_BITS 12
#define CENTRE (UNIT / 2)
#else
#define UNIT_BITS 0
#define CENTRE 0
#endif
#define UNIT (1 << UNIT_BITS)

#endif
