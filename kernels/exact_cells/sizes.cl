// A size of the tree of sites, for kernels and for the host.

#ifndef VOROCL_EXACT_CELLS_SIZES
#define VOROCL_EXACT_CELLS_SIZES

#define FAN 8  // the sites of a leaf, and the boxes that one is around

#endif
