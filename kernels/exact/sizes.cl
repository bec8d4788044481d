// Sizes of the exact engine, for its kernels and for the host that makes their buffers.

// The sides of a cell of level 0 in pixels, and of a cell in cells of the level below it, as powers of two. (A row of a
// cell of level 0 is a vector of 16 lanes in many places.)
#define CELL_BITS 4
#define FAN_BITS 2

// Cells that are labelled together, one above the other: so many bits say which of them are.
#define PAIR 2

// Lists of candidates are made for tiles, the cells of level 1, from those of regions, the cells of level 2.
#define TILE 1
#define REGION 2

// The top of the pyramid has at most so many cells.
#define TOP_CELLS 64

// How many cells are refined at a time, and how many seeds fill a list: only speed and memory depend on them.
#ifndef MOST_PARENTS
#define MOST_PARENTS 64
#define MOST_CANDIDATES 1024
#endif
