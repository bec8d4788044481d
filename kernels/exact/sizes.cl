// The numbers that the kernels of exact diagrams by places, of planes and of volumes, and their host agree
// on. Read by both.

#ifndef VOROCL_EXACT_SIZES
#define VOROCL_EXACT_SIZES

// Positions of points are whole numbers of 2^-MOST_FRACTION_BITS pixels, and int32, as are their differences
// from all pixels of a window, whose sides have at most 2^SIDE_BITS. No place is more than 2^AWAY_BITS pixels
// from the window's first one.
#define MOST_FRACTION_BITS 12
#define SIDE_BITS 15
#define AWAY_BITS 18
#define LAG_BITS 11  // lags of weighted seeds are whole numbers of 2^-LAG_BITS squared pixels, and int32
#if ((1 << AWAY_BITS) + (1 << SIDE_BITS)) << MOST_FRACTION_BITS > 0x7fffffff
#error "The way from a pixel to a place does not fit in an int"
#endif

// A work-item labels so many pixels along the sides of a plane, or of a volume.
#define SIDE_OF_PLANE 64
#define SIDE_OF_VOLUME 32

// In the group shape a work-group of 32, 64, 128 or 256 items labels a patch, a square of pixels or a cuboid of voxels,
// or a box of one: where a patch of a plane has a crowd, and in a volume where places are not dense.
#define PATCH 32
#define CROWD_SIDE 16  // and that of a box in a volume of one slice
#define BOX_WIDTH 8
#define BOX_HEIGHT 8
#define BOX_DEPTH 4
#if BOX_WIDTH * BOX_HEIGHT * BOX_DEPTH != CROWD_SIDE * CROWD_SIDE
#error "All boxes have as many pixels"
#endif
#define BOXES_ALONG 2  // a patch of a volume, along each axis
#define MOST_OPEN 512  // pixels of a patch that look alone, each for the nearest place
#define BEFORE_QUEUE 2  // the number of patches in the queue, which have crowds, and that of all open pixels

#define BUCKETS 256            // of rows of bins, into which places are sorted first
#define PLACES_OF_BIN 4        // about
#define MOST_ITEMS_OF_ROW 256  // of a group that gives a row of bins its part of the list (group/index.cl)
#define BEHIND_PLACES 16       // values behind each list of the index, which is read in whole vectors
#define PLACES_OF_BLOCK 16     // of which the bounds are known, on CPUs
#define BLOCKS_AT_ONCE 8       // whose bounds stand together
#define MOST_BOUNDS 7          // of a block: both ends along each axis, and the least lag

#endif
