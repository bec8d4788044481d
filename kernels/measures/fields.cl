// Images that follow from the labels: distances to the seeds, borders of the cells, labels near their seeds.

#include "measures/seed_place.cl"

#if VOROCL_WIDTH == 1
typedef float float_v;
typedef LENGTH length_v;
#define TO_BYTES convert_uchar
#else
typedef JOIN(float, VOROCL_WIDTH) float_v;
typedef JOIN(LENGTH, VOROCL_WIDTH) length_v;
#define TO_BYTES JOIN(convert_uchar, VOROCL_WIDTH)
#endif

// The slice and the row of this work-item's vector.
static inline int slice_of(int4 size) { return DEPTH(size) == 1 ? 0 : vector_y() / size.y; }
static inline int row_in_slice(int4 size) { return vector_y() - slice_of(size) * size.y; }
static inline bool has_vector_of(int4 size) { return has_vector(size.x, size.y * DEPTH(size)); }

// Where it begins in an image of the grid.
static inline int vector_begin(int4 size) { return vector_y() * size.x + vector_x(size.x); }

// Each pixel's distance to its label's seed; NO_SEED without one.
static inline length_v find_distances(global const uint* labels, global const seed_t* seeds, uint count, int8 lattice,
                                      int4 size) {
  const int x = vector_x(size.x), y = row_in_slice(size);
  labels += vector_begin(size);
#ifdef VOROCL_FAR
  const window_t window = window_of(size, lattice);
  const int z = slice_of(size);
  LENGTH lane[VOROCL_WIDTH];
  for (int i = 0; i < VOROCL_WIDTH; ++i) lane[i] = distance_to(seeds[min(labels[i], count)], x + i, y, z, window);
  return LOAD_VECTOR(lane);
#else
  (void)lattice;
  const uint_v position = looked_up(seeds, min(LOAD_VECTOR(labels), (uint_v)count));
#if VOROCL_DIMENSIONS == 3
  const int z = slice_of(size);
  const int_v inside_x = AS_INT_V(position & MASK_X) - AS_INT_V((uint)x + LANES);
  const int_v inside_y = AS_INT_V(position >> VOROCL_BITS_X & MASK_Y) - y;
  const int_v inside_z = AS_INT_V(position >> SHIFT_Z & MASK_Z) - z;
  const int_v way_x = SHORTER(inside_x, size.x, PERIODIC_X), way_y = SHORTER(inside_y, size.y, PERIODIC_Y);
  const int_v way_z = SHORTER(inside_z, size.z, PERIODIC_Z);
  const int_v distance = ALONG_X(way_x) + ALONG_Y(way_y) + ALONG_Z(way_z);
#else
  const uint_v pixels = vector_positions(x, y);
  const int_v distance = AS_INT_V(distance_in_grid(position, pixels, periods(size.x, size.y)));
#endif
  return select(distance, (int_v)NO_SEED, AS_INT_V(position) < 0);
#endif
}

// Notes where a distance is too long for 31 bits.
VECTOR_KERNEL void integer_distances(global const uint* restrict labels, SEED_PARAMETERS, global int* restrict out,
                                     global uint* restrict too_long) {
  if (!has_vector_of(size)) return;
  const length_v distance = find_distances(labels, seeds, count, lattice, size);
#ifdef VOROCL_FAR  // of whole pixels
#ifdef VOROCL_EUCLIDEAN
  const length_v in_pixels = distance >> (length_v)(2 * UNIT_BITS);
#else
  const length_v in_pixels = distance >> (length_v)UNIT_BITS;
#endif
  const length_v longest = (length_v)NO_DISTANCE;
  if (ANY(in_pixels >= longest && distance != (length_v)NO_SEED)) atomic_or(too_long, 1u);
  STORE_VECTOR(CONVERT_INT_V(min(in_pixels, longest)), out + vector_begin(size));
#else
  (void)too_long;
  STORE_VECTOR(distance, out + vector_begin(size));
#endif
}

VECTOR_KERNEL void float_distances(global const uint* restrict labels, SEED_PARAMETERS, global float* restrict out) {
  if (!has_vector_of(size)) return;
  const length_v distance = find_distances(labels, seeds, count, lattice, size);
#ifdef VOROCL_EUCLIDEAN
  const float_v in_pixels = sqrt(CONVERT_FLOAT_V(distance)) / UNIT;
#else
  const float_v in_pixels = CONVERT_FLOAT_V(distance) / UNIT;
#endif
  const int_v none = CONVERT_INT_V(distance == (length_v)NO_SEED);
  STORE_VECTOR(select(in_pixels, (float_v)INFINITY, none), out + vector_begin(size));
}

// The labels of the pixels that are no farther than `most` from their seeds; NO_LABEL for the others.
VECTOR_KERNEL void expand_labels(global const uint* restrict labels, SEED_PARAMETERS, long most,
                                 global uint* restrict out) {
  if (!has_vector_of(size)) return;
  const length_v limit = (length_v)(LENGTH)min(most, (long)NO_SEED - 1);
  const int_v beyond = CONVERT_INT_V(find_distances(labels, seeds, count, lattice, size) > limit);
  STORE_VECTOR(select(LOAD_VECTOR(labels + vector_begin(size)), (uint_v)NO_LABEL, beyond), out + vector_begin(size));
}

// A table's entries for the seeds that are there; NO_LABEL for those that are absent, as that behind the last one is.
kernel void copy_table(global const seed_t* restrict seeds, uint count, global const uint* restrict table,
                       global uint* restrict copy) {
  const uint id = (uint)get_global_id(0);
  if (id <= count) copy[id] = is_there(seeds[id]) ? table[id] : NO_LABEL;
}

// Whether a pixel has another label than the one at (x, y, z), if there is one.
static inline bool differs(uint own, global const uint* labels, int x, int y, int z, int4 size, int4 shifts) {
  const long at = index_of_image(x, y, z, size, shifts);
  return at >= 0 && labels[at] != own;
}

// Whether a pixel has another label than one of its four neighbours, in a volume six.
static inline bool is_border(global const uint* labels, int x, int y, int z, int4 size, int4 shifts) {
  const uint own = row_of(labels, y, z, size)[x];
  bool found = false;
  for (int step = -1; step <= 1; step += 2) {
    found |= differs(own, labels, x + step, y, z, size, shifts) || differs(own, labels, x, y + step, z, size, shifts);
    if (DEPTH(size) > 1) found |= differs(own, labels, x, y, z + step, size, shifts);
  }
  return found;
}

VECTOR_KERNEL void mark_borders(global const uint* restrict labels, global uchar* restrict mask, int4 size,
                                int4 shifts) {
  if (!has_vector_of(size)) return;
  const int x = vector_x(size.x), y = row_in_slice(size), z = slice_of(size), slice = size.x * size.y;
  global const uint* const pixels = labels + vector_begin(size);
  mask += vector_begin(size);
  const bool inside = DEPTH(size) == 1 || (z > 0 && z + 1 < DEPTH(size));
  if (inside && x > 0 && x + VOROCL_WIDTH < size.x && y > 0 && y + 1 < size.y) {
    const uint_v own = LOAD_VECTOR(pixels), zero = (uint_v)0, one = (uint_v)1;
    uint_v differs = select(zero, one, own != LOAD_VECTOR(pixels - 1) || own != LOAD_VECTOR(pixels + 1) ||
                                         own != LOAD_VECTOR(pixels - size.x) || own != LOAD_VECTOR(pixels + size.x));
    if (DEPTH(size) > 1) {
      differs |= select(zero, one, own != LOAD_VECTOR(pixels - slice) || own != LOAD_VECTOR(pixels + slice));
    }
    STORE_VECTOR(TO_BYTES(differs), mask);
  } else {
    for (int i = 0; i < VOROCL_WIDTH; ++i) mask[i] = (uchar)is_border(labels, x + i, y, z, size, shifts);
  }
}
