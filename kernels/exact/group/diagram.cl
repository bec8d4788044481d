// The program of exact diagrams by places in the group shape, for GPUs: work-groups label squares of pixels
// of a plane, in three tiers, or boxes of voxels of a volume.

#include "exact/group/crowds.cl"
#include "exact/group/index.cl"
#if !IS_VOLUME
#include "exact/group/lists.cl"
#include "exact/group/stamps.cl"
#endif
