// Labels that are looked up in a list: of a tile, from places in the list of its seeds to the seeds' ids; of a diagram,
// in a table of the caller's.

#include "core/vector.cl"

// The list has NO_LABEL behind its last entry, for pixels that have no label.
VECTOR_KERNEL void name_labels(global const uint* restrict labels, global const uint* restrict ids, uint count,
                               int width, int height, global uint* restrict named) {
  if (!has_vector(width, height)) return;
  const int first = vector_y() * width + vector_x(width);
  store_looked_up(ids, min(LOAD_VECTOR(labels + first), (uint_v)count), named, first);
}
