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

// Each pixel's distance to its label's seed; NO_SEED without one.
static inline length_v find_distances(global const uint* labels, global const seed_t* seeds, uint count, int x, int y,
                                      window_t window) {
  labels += y * window.width + x;
#ifdef VOROCL_OUTER_SEEDS
  LENGTH lane[VOROCL_WIDTH];
  for (int i = 0; i < VOROCL_WIDTH; ++i) lane[i] = distance_to(seeds[min(labels[i], count)], x + i, y, window);
  return LOAD_VECTOR(lane);
#else
  const uint_v position = look_up_positions(labels, seeds, count);
  const uint_v distance = distance_in_grid(position, vector_positions(x, y), periods(window.width, window.height));
  return AS_INT_V(select(distance, (uint_v)NO_SEED, (position & EMPTY_BIT) != 0));
#endif
}

// Notes where a distance is too long for 31 bits.
VECTOR_KERNEL void integer_distances(global const uint* restrict labels, SEED_PARAMETERS, global int* restrict out,
                                     global uint* restrict too_long) {
  if (!has_vector(width, height)) return;
  const window_t window = window_of(width, height, periods);
  const int x = vector_x(width), y = vector_y();
  const length_v distance = find_distances(labels, seeds, count, x, y, window);
#ifdef VOROCL_FAR
  const length_v longest = (length_v)NO_DISTANCE;
  if (ANY(distance >= longest && distance != (length_v)NO_SEED)) atomic_or(too_long, 1u);
  STORE_VECTOR(CONVERT_INT_V(min(distance, longest)), out + y * width + x);
#else
  (void)too_long;
  STORE_VECTOR(distance, out + y * width + x);
#endif
}

VECTOR_KERNEL void float_distances(global const uint* restrict labels, SEED_PARAMETERS, global float* restrict out) {
  if (!has_vector(width, height)) return;
  const window_t window = window_of(width, height, periods);
  const int x = vector_x(width), y = vector_y();
  const length_v distance = find_distances(labels, seeds, count, x, y, window);
#ifdef VOROCL_EUCLIDEAN
  const float_v in_pixels = sqrt(CONVERT_FLOAT_V(distance)) / UNIT;
#else
  const float_v in_pixels = CONVERT_FLOAT_V(distance) / UNIT;
#endif
  const int_v none = CONVERT_INT_V(distance == (length_v)NO_SEED);
  STORE_VECTOR(select(in_pixels, (float_v)INFINITY, none), out + y * width + x);
}

// The labels of the pixels that are no farther than `most` from their seeds; NO_LABEL for the others.
VECTOR_KERNEL void expand_labels(global const uint* restrict labels, SEED_PARAMETERS, long most,
                                 global uint* restrict out) {
  if (!has_vector(width, height)) return;
  const window_t window = window_of(width, height, periods);
  const int x = vector_x(width), y = vector_y();
  const length_v limit = (length_v)(LENGTH)min(most, (long)NO_SEED - 1);
  const int_v beyond = CONVERT_INT_V(find_distances(labels, seeds, count, x, y, window) > limit);
  STORE_VECTOR(select(LOAD_VECTOR(labels + y * width + x), (uint_v)NO_LABEL, beyond), out + y * width + x);
}

// A table's entries for the seeds that are there; NO_LABEL for those that are absent, as that behind the last one is.
kernel void copy_table(global const seed_t* restrict seeds, uint count, global const uint* restrict table,
                       global uint* restrict copy) {
  const uint id = (uint)get_global_id(0);
  if (id <= count) copy[id] = is_there(seeds[id]) ? table[id] : NO_LABEL;
}

// Whether a pixel has another label than the pixel at (x, y), less than half a period outside the grid. Beyond the rows
// of a periodic y pixels are shifted by whole ones.
static inline bool differs(uint own, global const uint* labels, int x, int y, int width, int height, int shift) {
  if (PERIODIC_Y) x += y < 0 ? shift : y >= height ? -shift : 0;
  x = wrapped_x(x, width);
  y = wrapped_y(y, height);
  return x >= 0 && x < width && y >= 0 && y < height && labels[y * width + x] != own;
}

// Whether a pixel has another label than one of its four neighbours.
static inline bool is_border(global const uint* labels, int x, int y, int width, int height, int shift) {
  const uint own = labels[y * width + x];
  return differs(own, labels, x - 1, y, width, height, shift) || differs(own, labels, x + 1, y, width, height, shift) ||
         differs(own, labels, x, y - 1, width, height, shift) || differs(own, labels, x, y + 1, width, height, shift);
}

VECTOR_KERNEL void mark_borders(global const uint* restrict labels, global uchar* restrict mask, int width, int height,
                                int shift) {
  if (!has_vector(width, height)) return;
  const int x = vector_x(width), y = vector_y();
  global const uint* const pixels = labels + y * width + x;
  if (x > 0 && x + VOROCL_WIDTH < width && y > 0 && y + 1 < height) {
    const uint_v own = LOAD_VECTOR(pixels);
    const uint_v differs = select((uint_v)0, (uint_v)1,
                                  own != LOAD_VECTOR(pixels - 1) || own != LOAD_VECTOR(pixels + 1) ||
                                  own != LOAD_VECTOR(pixels - width) || own != LOAD_VECTOR(pixels + width));
    STORE_VECTOR(TO_BYTES(differs), mask + y * width + x);
  } else {
    for (int i = 0; i < VOROCL_WIDTH; ++i) {
      mask[y * width + x + i] = (uchar)is_border(labels, x + i, y, width, height, shift);
    }
  }
}
