// Positions in a volume, distances and the tie rule: what both methods that label volumes must agree on, to the bit.
//
// A voxel's position is x | y << VOROCL_BITS_X | z << (VOROCL_BITS_X + VOROCL_BITS_Y), in at most 31 bits. Its unsigned
// order is the tie rule: z, then y, then x. The shifts are build options, so that long volumes fit as well as deep
// ones. The sign bit says that there is no seed (EMPTY). Along a periodic axis there is room for half a period more at
// both ends: see images.cl.

#ifndef VOROCL_VOLUMES_POSITION
#define VOROCL_VOLUMES_POSITION

#include "core/metric.cl"
#include "core/periods.cl"
#include "core/vector.cl"

#define EMPTY EMPTY_BIT

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

#endif
