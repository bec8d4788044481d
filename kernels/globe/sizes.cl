// Sizes that kernels of the globe and the host agree on.

#ifndef VOROCL_GLOBE_SIZES
#define VOROCL_GLOBE_SIZES

#define GLOBE_BLOCK 16  // pixels of a block along each axis

// Of each eight boxes eight of each: x, y and z of the direction in the middle, as of seeds, and as floats those of the
// axis along the box, half of its length and of its width, and its depth below the middle.
#define BOX_NUMBERS 9

#endif
