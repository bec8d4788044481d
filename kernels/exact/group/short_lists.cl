// The group shape with lists of two entries and the shortest stack, for tests: every patch with three seeds near
// overflows.

#define MOST_GATHERED 2
#define MOST_RANKED 2
#define STACK SHORTEST_STACK

#include "exact/group/diagram.cl"
