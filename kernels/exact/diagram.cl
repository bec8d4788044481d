// The exact diagram: all kernels, in the order of their launches. docs/exact.md says how they work together.

#include "exact/make_index.cl"
#include "exact/near.cl"
#include "exact/far.cl"
