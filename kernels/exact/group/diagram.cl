// The program of exact diagrams by places in the group shape, for GPUs, of planes: work-groups label squares
// of pixels.

#include "exact/group/crowds.cl"
#include "exact/group/index.cl"
#include "exact/group/lists.cl"
#include "exact/group/stamps.cl"
