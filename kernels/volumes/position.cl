// Positions in a volume, distances and the tie rule: what both methods that label volumes must agree on, to the bit.
//
// A voxel's position is x | y << VOROCL_BITS_X | z << (VOROCL_BITS_X + VOROCL_BITS_Y), in at most 31 bits. Its unsigned
// order is the tie rule: z, then y, then x. The shifts are build options, so that long volumes fit as well as deep
// ones. The sign bit says that there is no seed (EMPTY). Along a periodic axis there is room for half a period more at
// both ends: see images.cl.

#ifndef VOROCL_VOLUMES_POSITION
#define VOROCL_VOLUMES_POSITION

#include "core/periods.cl"
#include "core/vector.cl"

#define NO_LABEL 0xffffffffu
#define EMPTY 0x80000000u
#define FIRST_ID 1  // an image of ids starts with NO_LABEL, which is looked up for an empty position

#define MASK_X ((1u << VOROCL_BITS_X) - 1)
#define MASK_Y ((1u << VOROCL_BITS_Y) - 1)
#define MASK_Z ((1u << VOROCL_BITS_Z) - 1)
#define SHIFT_Z (VOROCL_BITS_X + VOROCL_BITS_Y)

static inline uint pack(int x, int y, int z) { return (uint)z << SHIFT_Z | (uint)y << VOROCL_BITS_X | (uint)x; }
static inline int x_of(uint position) { return (int)(position & MASK_X); }
static inline int y_of(uint position) { return (int)(position >> VOROCL_BITS_X & MASK_Y); }
static inline int z_of(uint position) { return (int)(position >> SHIFT_Z & MASK_Z); }

// Where a voxel is in an image of the volume: slices of rows.
static inline uint voxel_index(uint position, int width, int height) {
  return ((uint)z_of(position) * (uint)height + (uint)y_of(position)) * (uint)width + (uint)x_of(position);
}

// How long the way between two coordinates of an axis is, given that inside the volume. The macro takes numbers and
// vectors.
#define SHORTER(inside, size, periodic) \
  ((periodic) ? min(max(inside, -(inside)), (size) - max(inside, -(inside))) : (inside))

// SPACING. How long a voxel is along each axis, in units of distances; where it is no cube, by build options.
#ifdef VOROCL_SPACING_X
#define SPACING_X VOROCL_SPACING_X
#define SPACING_Y VOROCL_SPACING_Y
#define SPACING_Z VOROCL_SPACING_Z
#else
#define SPACING_X 1
#define SPACING_Y 1
#define SPACING_Z 1
#endif

// The part of an axis in a distance, of an offset in voxels: an integer. The macros take numbers and vectors.
#ifdef VOROCL_MANHATTAN
#define ALONG(offset) max(offset, -(offset))
#else
#define ALONG(offset) ((offset) * (offset))
#endif
#define ALONG_X(offset) ALONG((offset) * SPACING_X)
#define ALONG_Y(offset) ALONG((offset) * SPACING_Y)
#define ALONG_Z(offset) ALONG((offset) * SPACING_Z)

#endif
