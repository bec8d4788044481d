// Positions in a volume and the tie rule: what both methods that label volumes must agree on, to the bit. Included by
// core/position.cl.
//
// A voxel's position is x | y << VOROCL_BITS_X | z << (VOROCL_BITS_X + VOROCL_BITS_Y), in at most 31 bits. Its unsigned
// order is the tie rule: z, then y, then x. The shifts are build options, so that long volumes fit as well as deep
// ones. The sign bit says that there is no seed (EMPTY).

#ifndef VOROCL_VOLUMES_POSITION
#define VOROCL_VOLUMES_POSITION

#include "core/metric.cl"
#include "core/periods.cl"
#include "core/vector.cl"

#define EMPTY EMPTY_BIT

#define MASK_X ((1u << VOROCL_BITS_X) - 1)
#define MASK_Y ((1u << VOROCL_BITS_Y) - 1)
#define MASK_Z ((1u << VOROCL_BITS_Z) - 1)
#define SHIFT_Y VOROCL_BITS_X
#define SHIFT_Z (VOROCL_BITS_X + VOROCL_BITS_Y)

static inline uint packed(int3 at) { return (uint)at.z << SHIFT_Z | (uint)at.y << SHIFT_Y | (uint)at.x; }
static inline int x_of(uint position) { return (int)(position & MASK_X); }
static inline int y_of(uint position) { return (int)(position >> SHIFT_Y & MASK_Y); }
static inline int z_of(uint position) { return (int)(position >> SHIFT_Z & MASK_Z); }

// Where a voxel is in an image of the volume: slices of rows.
static inline uint index_of_seed(uint position, int width, int height) {
  return ((uint)z_of(position) * (uint)height + (uint)y_of(position)) * (uint)width + (uint)x_of(position);
}

#endif
