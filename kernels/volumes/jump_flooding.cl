// Jump flooding in a volume: every voxel takes the best of its own position and its neighbours' at a step, 26 of them
// (VOROCL_NEIGHBOURS of 9) or 6 (of 5). A wave gathers: it reads one image of positions and writes another. There is
// a work-item for each vector of each row of all slices.

#include "volumes/position.cl"

// The voxels of this work-item.
typedef struct {
  int x, y, z, width, height, depth;
} place_t;
static inline place_t place_of(int width, int height, int depth) {
  const int row = vector_y();
  const place_t place = {vector_x(width), row % height, row / height, width, height, depth};
  return place;
}

// A row's values in the vector that starts at x, less than a period outside it. A periodic row goes on there with its
// other end; else lanes outside are EMPTY.
static inline uint_v load_positions(global const uint* row, int x, int width) {
  x = wrapped(x, width, PERIODIC_X);
  if (!PERIODIC_X && (x <= -VOROCL_WIDTH || x >= width)) return (uint_v)EMPTY;
  const uint_v values = LOAD_VECTOR(row + x);
  if ((PERIODIC_X || x >= 0) && x + VOROCL_WIDTH <= width) return values;
  const uint_v outside = PERIODIC_X ? LOAD_VECTOR(row + x - width) : (uint_v)EMPTY;
  return select(outside, values, (uint)x + LANES < (uint_v)(uint)width);
}

// A wave's step along an axis. Along a periodic one it may be longer than the period.
static inline int step_along(int step, int size, int periodic) { return periodic && step >= size ? step % size : step; }

// The best position of the vector's voxels after a wave. An empty position is farther than any seed.
static inline uint_v best_position(global const uint* image, place_t p, int step) {
  const int_v x = AS_INT_V((uint)p.x + LANES);
  const int step_x = step_along(step, p.width, PERIODIC_X), step_y = step_along(step, p.height, PERIODIC_Y);
  const int step_z = step_along(step, p.depth, PERIODIC_Z);
  uint_v best = (uint_v)EMPTY, least = (uint_v)0xffffffffu;
  for (int dz = -1; dz <= 1; ++dz) {
    const int from_z = wrapped(p.z + dz * step_z, p.depth, PERIODIC_Z);
    if (from_z < 0 || from_z >= p.depth) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      const int from_y = wrapped(p.y + dy * step_y, p.height, PERIODIC_Y);
      if (from_y < 0 || from_y >= p.height) continue;
      const size_t first = ((size_t)from_z * (size_t)p.height + (size_t)from_y) * (size_t)p.width;
#pragma unroll
      for (int dx = -1; dx <= 1; ++dx) {
        if (VOROCL_NEIGHBOURS == 5 && abs(dx) + abs(dy) + abs(dz) > 1) continue;
        const uint_v position = load_positions(image + VOROCL_GUARD + first, p.x + dx * step_x, p.width);
        const int_v inside_x = AS_INT_V(position & MASK_X) - x, way_x = SHORTER(inside_x, p.width, PERIODIC_X);
        const int_v inside_y = AS_INT_V(position >> VOROCL_BITS_X & MASK_Y) - p.y;
        const int_v inside_z = AS_INT_V(position >> SHIFT_Z & MASK_Z) - p.z;
        const int_v way_y = SHORTER(inside_y, p.height, PERIODIC_Y), way_z = SHORTER(inside_z, p.depth, PERIODIC_Z);
        const uint_v distance =
            AS_UINT_V(ALONG_X(way_x) + ALONG_Y(way_y) + ALONG_Z(way_z)) | (position & EMPTY);
        best = select(best, position, distance < least || (distance == least && position < best));
        least = min(least, distance);
      }
    }
  }
  return best;
}

VECTOR_KERNEL void wave(global const uint* restrict in, global uint* restrict out, int width, int height, int depth,
                        int step) {
  if (!has_vector(width, height * depth)) return;
  const place_t p = place_of(width, height, depth);
  const uint_v best = best_position(in, p, step);
  STORE_VECTOR(best, out + VOROCL_GUARD + (size_t)vector_y() * (size_t)width + p.x);
}

// Writes the ids of the positions, which it looks up in the ids at the seeds' voxels.
VECTOR_KERNEL void write_labels(global const uint* restrict image, global const uint* restrict ids,
                                global uint* restrict labels, int width, int height, int depth) {
  if (!has_vector(width, height * depth)) return;
  const size_t first = (size_t)vector_y() * (size_t)width + (size_t)vector_x(width);
  uint position[VOROCL_WIDTH];
  STORE_VECTOR(LOAD_VECTOR(image + VOROCL_GUARD + first), position);
  for (int i = 0; i < VOROCL_WIDTH; ++i) {
    labels[first + (size_t)i] =
        ids[position[i] & EMPTY ? 0 : FIRST_ID + index_of_seed(position[i], width, height)];
  }
}
