// The exact diagram in the group shape: all kernels, in the order of their launches. docs/exact.md says how they work
// together.

#include "exact/group/index.cl"
#include "exact/group/dense.cl"
#include "exact/group/near.cl"
#include "exact/group/search.cl"
