// The program of exact diagrams by places, of planes and of volumes, on CPUs.

#include "exact/regions.cl"
