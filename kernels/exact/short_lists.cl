// The exact diagram with lists of two entries, for tests: what overflows may cost time, never a pixel.

#define MOST_PARENTS 2
#define MOST_CANDIDATES 2

#include "exact/diagram.cl"
