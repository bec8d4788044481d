// The cells that had more edges than the first kernel has room for, in global memory.

#define LARGE_CELLS
#include "exact_cells/measure.cl"
