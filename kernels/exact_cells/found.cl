// What is found of cells, in planes and volumes: of a volume's cell the area is its volume, the perimeter its
// surface, and its edges are its faces.

#ifndef VOROCL_EXACT_CELLS_FOUND
#define VOROCL_EXACT_CELLS_FOUND

#define TOUCHES_BORDER 1u
#define CERTIFIED 2u

// What sites are called in the caller's list; where step 0 is, and how long one, in the units of the data;
// and what is found, by the caller's ids. `begins` is by site: where its edges lie among the found ones, of
// which each is a site and an image, and in a volume the cell, the image and the area. They come in the order
// in which cells are done. `counters`: the edges found; the cells in the queue of those with more edges than
// there is room for.
#define MEASURE_PARAMETERS                                                                               \
  global const uint *ids, double4 origin, double step, global double *areas, global double *centroids,   \
      global double *perimeters, global uint *edge_counts, global uint *neighbours, global uchar *flags, \
      global uint *begins, global FOUND_EDGE *found, uint room_for_edges, global uint *counters, global uint *queue

#define MEASURE_ARGUMENTS                                                                                         \
  ids, origin, step, areas, centroids, perimeters, edge_counts, neighbours, flags, begins, found, room_for_edges, \
      counters, queue

// Cells of coincident points but the first, and of points that are not there, are empty. `dimensions` of centroids.
kernel void clear_cells(uint cells, uint dimensions, global double* restrict areas, global double* restrict centroids,
                        global double* restrict perimeters, global uint* restrict edge_counts,
                        global uint* restrict neighbours, global uchar* restrict flags) {
  const uint id = (uint)get_global_id(0);
  if (id >= cells) return;
  areas[id] = perimeters[id] = 0;
  for (size_t i = (size_t)id * dimensions; i < ((size_t)id + 1) * dimensions; ++i) centroids[i] = NAN;
  edge_counts[id] = neighbours[id] = 0;
  flags[id] = CERTIFIED;
}

#endif
