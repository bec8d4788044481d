// The group shape with lists of two entries, for tests: every patch with three seeds near overflows.

#define MOST_GATHERED 2
#define MOST_RANKED 2

#include "exact/group/diagram.cl"
