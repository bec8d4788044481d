// Sizes of the comparison of two diagrams, for its kernels and for the host that launches them.

#ifndef VOROCL_COMPARISON_SIZES
#define VOROCL_COMPARISON_SIZES

// The most work-items of a group.
#define MOST_COMPARING 256

// Excess distances are added in so many parts of a pixel. The sum of a group that compares MOST_OF_GROUP pixels fits in
// 63 bits, as no distance is longer than 2^32 pixels.
#define PARTS_OF_EXCESS 32768
#define MOST_OF_GROUP 65536

#endif
