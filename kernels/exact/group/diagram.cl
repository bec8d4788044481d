// The program of exact diagrams by places in the group shape, for GPUs: work-groups label squares of pixels
// of a plane, in three tiers, or cuboids of voxels of a volume, in two.

#include "exact/group/crowds.cl"
#include "exact/group/index.cl"
#if !IS_VOLUME
#include "exact/group/lists.cl"
#endif
#if IS_STAMPED
#include "exact/group/pixel.cl"
#include "exact/group/stamps.cl"
#endif
