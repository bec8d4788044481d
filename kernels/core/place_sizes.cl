// The numbers that the kernels which place points and their host agree on. Read by both.

#ifndef VOROCL_PLACE_SIZES
#define VOROCL_PLACE_SIZES

// What an axis is, in bits.
#define AXIS_IN_PIXELS 1  // its unit is the pixel
#define AXIS_PERIODIC 2
#define AXIS_REVERSED 4
#define AXIS_CLOSED 8

#define PARTS_OF_PIXEL 4096

// A work-item places at most so many points, as a vector: one on a GPU, whose registers hold no more.
#define MOST_POINTS_OF_ITEM 4

// What becomes of points outside the grid.
#define OUTSIDE_COUNTS 0
#define OUTSIDE_IS_ABSENT 1
#define OUTSIDE_IS_BAD 2

// How points say that their seeds are absent.
#define ALL_PRESENT 0
#define MARKED_BY_BYTES 1   // of 0
#define MARKED_BY_POINTS 2  // a NaN in x

// What is found of all points, in words: the least index of a bad one, and how many are absent and outside.
#define FOUND_BAD 0
#define FOUND_ABSENT 1
#define FOUND_OUTSIDE 2

#endif
