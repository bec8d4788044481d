// DISTANCES. A distance is the sum of ALONG(offset) over all axes: the squared distance for VOROCL_EUCLIDEAN, the
// Manhattan distance for VOROCL_MANHATTAN, both integers. The exact engine needs this sum. ALONG(offset) is
// offset * FACTOR(offset). Both macros take numbers and vectors, FACTOR those of 16 bits.

#ifndef VOROCL_METRIC
#define VOROCL_METRIC

#define NO_LABEL 0xffffffffu
#define NO_DISTANCE 0x7fffffffu  // what results say where there is no seed: more than any distance
#define FIRST_ID 1  // an image of ids starts with NO_LABEL, which is looked up for an empty position
#define EMPTY_BIT 0x80000000u  // of a position: there is no seed

#if defined(VOROCL_EUCLIDEAN)
#define ALONG(offset) ((offset) * (offset))
#define FACTOR(offset) (offset)
#elif defined(VOROCL_MANHATTAN)
#define ALONG(offset) max(offset, -(offset))
#define FACTOR(offset) (((offset) >> (short)15) | (short)1)  // the sign: -1 or 1
#else
#error "Kernels are built for no metric"
#endif

// SPACING. How long a pixel is along each axis, in units of distances; where it is no square, by build options.
#ifdef VOROCL_SPACING_X
#define SPACING_X VOROCL_SPACING_X
#define SPACING_Y VOROCL_SPACING_Y
#define SPACING_Z VOROCL_SPACING_Z
#else
#define SPACING_X 1
#define SPACING_Y 1
#define SPACING_Z 1
#endif

#define ALONG_X(offset) ALONG((offset) * SPACING_X)
#define ALONG_Y(offset) ALONG((offset) * SPACING_Y)
#define ALONG_Z(offset) ALONG((offset) * SPACING_Z)

#endif
