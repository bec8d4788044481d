// Sizes that kernels of the globe and the host agree on.

#ifndef VOROCL_GLOBE_SIZES
#define VOROCL_GLOBE_SIZES

#define GLOBE_BLOCK 16  // pixels of a block along each axis

#endif
