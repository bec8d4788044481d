// The numbers that the kernels of exact diagrams of points and their host agree on. Read by both.

#ifndef VOROCL_POINTS_SIZES
#define VOROCL_POINTS_SIZES

// Positions are whole numbers of 2^-FRACTION_BITS pixels.
#define FRACTION_BITS 12

// A work-item labels a tile of TILE x TILE pixels.
#define POINTS_TILE_BITS 6
#define POINTS_TILE (1 << POINTS_TILE_BITS)

// Lists are read in whole vectors of LANES_OF_POINTS values.
#define LANES_OF_POINTS 8

#endif
