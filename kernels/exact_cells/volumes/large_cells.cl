// The cells that had more faces than the first kernel has room for, in global memory.

#define LARGE_CELLS
#include "exact_cells/volumes/measure.cl"
