// The numbers that the kernels which label volumes by places (kernels/points/) and their host agree on. Read by both.

#ifndef VOROCL_POINTS_SIZES_3
#define VOROCL_POINTS_SIZES_3

#define REGION 32            // voxels along the sides of what a work-item labels
#define BUCKETS 256          // of rows of bins, into which places are sorted first
#define PLACES_OF_BIN 4      // about
#define BEHIND_PLACES 16     // values behind each list of the index, which is read in whole vectors

#endif
