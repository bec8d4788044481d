// Sizes of the index of a volume's seeds, for kernels and for the host.

#ifndef VOROCL_VOLUMES_SIZES
#define VOROCL_VOLUMES_SIZES

#define BIN 8          // voxels along a bin's sides
#define WORDS 16       // of a bin's bits
#define REGION 32      // voxels along a region's sides
#define BINS 64        // of a region
#define MIDDLE_BIN 42  // of a region: one next to its centre
#define BLOCK 4        // regions along a block's sides
#define BEHIND_LIST 8  // entries behind the list of seeds, which is read in whole vectors

#endif
