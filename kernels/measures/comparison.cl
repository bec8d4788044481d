// The labels of two diagrams, pixel by pixel: where they differ, where their seeds are not equally far away within a
// tolerance, and how much farther one diagram's seeds are than those of the exact one. All counts and sums are of
// integers, so they are the same whatever work-item compares a pixel.

#include "measures/seed_place.cl"
#include "measures/walk.cl"

static inline void add_in_group(uint own, local uint* found, global uint* sum) {
  found[get_local_id(0)] = own;
  JOIN_IN_GROUP(found[to] += found[from])
  if (get_local_id(0) == 0 && found[0] > 0) atomic_add(sum, found[0]);
}

// Whether some labels from `first` to `end` differ. (The last pixels of all count as if they did.)
static inline bool may_differ(global const uint* a, global const uint* b, uint first, uint end) {
  return end - first < VOROCL_WIDTH || ANY(LOAD_VECTOR(a + first) != LOAD_VECTOR(b + first));
}

// Counts the pixels whose labels differ.
VECTOR_KERNEL void count_differences(global const uint* restrict a, global const uint* restrict b, uint4 walk,
                                     uint pixels, global uint* restrict differences) {
  local uint found[MOST_COMPARING];
  uint_v per_lane = (uint_v)0;
  uint of_part = 0;
  FOR_EACH_VECTOR(first, end, walk, pixels) {
    if (end - first == VOROCL_WIDTH) {
      per_lane += select((uint_v)0, (uint_v)1, LOAD_VECTOR(a + first) != LOAD_VECTOR(b + first));
    } else {
      for (uint i = first; i < end; ++i) of_part += a[i] != b[i];
    }
  }
  add_in_group(lane_sum(per_lane) + of_part, found, differences);
}

// The distance from a pixel, given where it is in an image of the window.
static inline LENGTH distance_at(seed_t seed, uint pixel, window_t window) {
  const uint row = pixel / (uint)window.width;
  const uint z = window.depth == 1 ? 0 : row / (uint)window.height;
  return distance_to(seed, (int)(pixel % (uint)window.width), (int)(row - z * (uint)window.height), (int)z, window);
}

// By how many pixels one distance is longer than another. The difference of two roots would lose its digits.
static inline float excess(LENGTH distance, LENGTH least) {
#ifdef VOROCL_EUCLIDEAN
  return (float)(distance - least) / (sqrt((float)distance) + sqrt((float)least)) / UNIT;
#else
  return (float)(distance - least) / UNIT;
#endif
}

// Judges labels by the exact ones: how many are wrong, and how many of those have no seed; the sum of the others'
// excess distances, in parts of a pixel, and the greatest one, of each group. Where labels are equal, nothing is looked
// up.
VECTOR_KERNEL void judge_labels(global const uint* restrict labels, global const uint* restrict exact, uint4 walk,
                                SEED_PARAMETERS, global uint2* restrict wrong, global long* restrict sums,
                                global float* restrict greatest) {
  local uint2 wrong_of[MOST_COMPARING];
  local long sum_of[MOST_COMPARING];
  local float greatest_of[MOST_COMPARING];
  const window_t window = window_of(size, lattice);
  errors_t errors = NO_ERRORS;
  FOR_EACH_VECTOR(first, end, walk, (uint)(size.x * size.y * DEPTH(size))) {
    if (!may_differ(labels, exact, first, end)) continue;
    for (uint i = first; i < end; ++i) {
      const LENGTH distance = distance_at(seeds[min(labels[i], count)], i, window);
      const LENGTH least = distance_at(seeds[min(exact[i], count)], i, window);
      if (distance <= least) continue;
      if (distance == NO_SEED) {
        errors.wrong += (uint2)(1, 1);
      } else {
        add_excess(&errors, excess(distance, least));
      }
    }
  }
  join_errors(errors, wrong_of, sum_of, greatest_of, wrong, sums, greatest);
}

// Adds the pixels whose two labels name seeds that are not equally far away, within a tolerance in pixels.
VECTOR_KERNEL void count_distant(global const uint* restrict a, global const uint* restrict b, uint4 walk,
                                 SEED_PARAMETERS, float tolerance, global uint* restrict differences) {
  local uint of_items[MOST_COMPARING];
  const window_t window = window_of(size, lattice);
  uint found = 0;
  FOR_EACH_VECTOR(first, end, walk, (uint)(size.x * size.y * DEPTH(size))) {
    if (!may_differ(a, b, first, end)) continue;
    for (uint i = first; i < end; ++i) {
      if (a[i] == b[i]) continue;
      const LENGTH of_a = distance_at(seeds[min(a[i], count)], i, window);
      const LENGTH of_b = distance_at(seeds[min(b[i], count)], i, window);
      if (of_a == of_b) continue;
      const LENGTH longer = max(of_a, of_b);
      found += longer == NO_SEED || excess(longer, min(of_a, of_b)) > tolerance;
    }
  }
  add_in_group(found, of_items, differences);
}
