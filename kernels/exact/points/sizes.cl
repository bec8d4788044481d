// The numbers that the kernels of exact diagrams of points and their host agree on. Read by both.

#ifndef VOROCL_POINTS_SIZES
#define VOROCL_POINTS_SIZES

// Positions are whole numbers of 2^-FRACTION_BITS pixels, and int32, as are their differences from all pixels of a
// window, whose sides have at most 2^SIDE_BITS. No place is more than 2^AWAY_BITS pixels from the window's first one.
#define FRACTION_BITS 12
#define SIDE_BITS 15
#define AWAY_BITS 18
#if ((1 << AWAY_BITS) + (1 << SIDE_BITS)) << FRACTION_BITS > 0x7fffffff
#error "The way from a pixel to a place does not fit in an int"
#endif

// A work-item labels a tile of TILE x TILE pixels.
#define POINTS_TILE_BITS 6
#define POINTS_TILE (1 << POINTS_TILE_BITS)

// Lists are read in whole vectors of LANES_OF_POINTS values: int8, uint8, float8.
#define LANES_OF_POINTS 8
#if LANES_OF_POINTS != 8
#error "The vectors of lists have eight lanes"
#endif

#endif
