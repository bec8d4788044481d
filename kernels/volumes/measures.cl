// What is measured of a volume's labels: distances to their seeds, labels near their seeds, and wrong labels. Positions
// have one more than there are seeds, EMPTY: a label that is no seed's id is clamped to it.

#include "measures/walk.cl"
#include "volumes/position.cl"

#define NO_SEED 0x7fffffffu  // farther than any distance

static inline uint distance_to(uint position, uint x, uint y, uint z, int4 size) {
  if (position & EMPTY) return NO_SEED;
  const int inside_x = x_of(position) - (int)x, inside_y = y_of(position) - (int)y, inside_z = z_of(position) - (int)z;
  const int way_x = SHORTER(inside_x, size.x, PERIODIC_X), way_y = SHORTER(inside_y, size.y, PERIODIC_Y);
  const int way_z = SHORTER(inside_z, size.z, PERIODIC_Z);
  return (uint)(ALONG_X(way_x) + ALONG_Y(way_y) + ALONG_Z(way_z));
}

// The distance of a row's voxel to the seed of its label.
static inline uint label_distance(global const uint* labels, global const uint* positions, uint count, uint x, uint row,
                                  int4 size) {
  const uint label = labels[(size_t)row * (size_t)size.x + x], height = (uint)size.y;
  return distance_to(positions[min(label, count)], x, row % height, row / height, size);
}

static inline int4 size_of(int width, int height, uint rows) {
  return (int4)(width, height, (int)(rows / (uint)height), 0);
}

// A work-item per row.
kernel void integer_distances(global const uint* restrict labels, global const uint* restrict positions, uint count,
                              int width, int height, uint rows, global int* restrict out) {
  const uint row = (uint)get_global_id(0);
  if (row >= rows) return;
  const int4 size = size_of(width, height, rows);
  for (uint x = 0; x < (uint)width; ++x) {
    out[(size_t)row * (size_t)width + x] = (int)label_distance(labels, positions, count, x, row, size);
  }
}

kernel void float_distances(global const uint* restrict labels, global const uint* restrict positions, uint count,
                            int width, int height, uint rows, global float* restrict out) {
  const uint row = (uint)get_global_id(0);
  if (row >= rows) return;
  const int4 size = size_of(width, height, rows);
  for (uint x = 0; x < (uint)width; ++x) {
    const uint distance = label_distance(labels, positions, count, x, row, size);
#ifdef VOROCL_MANHATTAN
    const float in_voxels = (float)distance;
#else
    const float in_voxels = sqrt((float)distance);
#endif
    out[(size_t)row * (size_t)width + x] = distance == NO_SEED ? INFINITY : in_voxels;
  }
}

// The labels of the voxels that are no farther than `most` from their seeds; NO_LABEL for the others.
kernel void expand_labels(global const uint* restrict labels, global const uint* restrict positions, uint count,
                          int width, int height, uint rows, uint most, global uint* restrict out) {
  const uint row = (uint)get_global_id(0);
  if (row >= rows) return;
  const int4 size = size_of(width, height, rows);
  for (uint x = 0; x < (uint)width; ++x) {
    const size_t at = (size_t)row * (size_t)width + x;
    out[at] = label_distance(labels, positions, count, x, row, size) <= most ? labels[at] : NO_LABEL;
  }
}

// As judge_labels() of measures/comparison.cl.
VECTOR_KERNEL void judge_labels(global const uint* restrict labels, global const uint* restrict exact, uint4 walk,
                                global const uint* restrict positions, uint count, int width, int height, uint voxels,
                                global uint2* restrict wrong, global long* restrict sums,
                                global float* restrict greatest) {
  local uint2 wrong_of[MOST_COMPARING];
  local long sum_of[MOST_COMPARING];
  local float greatest_of[MOST_COMPARING];
  const int4 size = size_of(width, height, voxels / (uint)width);
  errors_t errors = NO_ERRORS;
  FOR_EACH_VECTOR(first, end, walk, voxels) {
    for (uint i = first; i < end; ++i) {
      if (labels[i] == exact[i]) continue;
      const uint x = i % (uint)width, row = i / (uint)width;
      const uint distance = label_distance(labels, positions, count, x, row, size);
      const uint least = label_distance(exact, positions, count, x, row, size);
      if (distance <= least) continue;
      if (distance == NO_SEED) {
        errors.wrong += (uint2)(1, 1);
        continue;
      }
#ifdef VOROCL_MANHATTAN
      add_excess(&errors, (float)(distance - least));
#else
      add_excess(&errors, (float)(distance - least) / (sqrt((float)distance) + sqrt((float)least)));
#endif
    }
  }
  join_errors(errors, wrong_of, sum_of, greatest_of, wrong, sums, greatest);
}
