// The pass over outer seeds with lists that one leaf fills: nearly every list overflows, so that tests see what comes
// then.

#define OUTER_LIST 8
#include "exact/outer.cl"
