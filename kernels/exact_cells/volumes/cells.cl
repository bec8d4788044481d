// Exact cells of volumes: cut out of the box in private memory.

#include "exact_cells/volumes/measure.cl"

// Puts the faces of each cell where they belong, by the caller's ids.
kernel void place_faces(uint count, global const uint* restrict ids, global const uint* restrict begins,
                        global const uint4* restrict found, global const uint* restrict offsets,
                        global uint* restrict cells, global double* restrict areas, global ushort* restrict images) {
  const uint site = (uint)get_global_id(0);
  if (site >= count) return;
  const uint begin = begins[site], offset = offsets[ids[site]], size = offsets[ids[site] + 1] - offset;
  for (uint i = 0; i < size; ++i) {
    const uint4 face = found[begin + i];
    cells[offset + i] = face.s0;
    images[offset + i] = (ushort)face.s1;
    areas[offset + i] = as_double(face.s23);
  }
}
