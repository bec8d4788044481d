// What is found of cells, in planes and volumes: of a volume's cell the area is its volume, the perimeter its
// surface, and its edges are its faces.

#ifndef VOROCL_EXACT_CELLS_FOUND
#define VOROCL_EXACT_CELLS_FOUND

#define TOUCHES_BORDER 1u
#define CERTIFIED 2u

// What sites are called in the caller's list; where step 0 is, and how long one, in the units of the data;
// and what is found, by the caller's ids. `begins` is by site: where its edges lie among the found ones, of
// which each is a site and an image, and in a volume the cell, the image and the area. They come in the order
// in which cells are done. The first of the `counters` says how many were found.
#define MEASURE_PARAMETERS                                                                               \
  global const uint *ids, double4 origin, double step, global double *areas, global double *centroids,   \
      global double *perimeters, global uint *edge_counts, global uint *neighbours, global uchar *flags, \
      global uint *begins, global FOUND_EDGE *found, uint room_for_edges

#define MEASURE_ARGUMENTS                                                                                         \
  ids, origin, step, areas, centroids, perimeters, edge_counts, neighbours, flags, begins, found, room_for_edges, \
      counters

#endif
