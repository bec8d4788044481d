// Sizes of the tree of sites, and of large cells, for kernels and for the host.

#ifndef VOROCL_EXACT_CELLS_SIZES
#define VOROCL_EXACT_CELLS_SIZES

#define FAN 8  // the sites of a leaf, and the boxes that one is around

// Of a polygon with room for so many edges, a multiple of 8: polygon.cl.
#define POLYGON_BYTES(room) (52 * ((room) + 8))

// Of a polyhedron in global memory, with room for so many vertices, a multiple of 64, and planes: CELL_LISTS
// of cell.cl.
#define POLYHEDRON_BYTES(room) (176 * (room) + 512)

#endif
