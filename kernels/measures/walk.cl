// How work-items share out the pixels of two diagrams that are compared, and join what they have found.

#ifndef VOROCL_WALK
#define VOROCL_WALK

#include "core/vector.cl"
#include "measures/comparison_sizes.cl"

// THE WALK of a work-item goes through vectors: the first one is at its number times walk.s0, each one walk.s1 pixels
// behind the last one, and all are within walk.s2 pixels. On a CPU an item has neighbouring vectors, on a GPU
// neighbouring items have. The vector at the end of the diagram may be a part of one.
#define FOR_EACH_VECTOR(first, end, walk, pixels)                                                                  \
  const uint begin = (uint)get_global_id(0) * walk.s0, walk_end = min(begin + walk.s2, pixels);                    \
  for (uint first = begin, end; end = min(first + VOROCL_WIDTH, walk_end), first < walk_end; first += walk.s1)

// Adds what the items of a group have found, at `found`, in the first place. In each round the lower half takes what
// the upper half has.
#define JOIN_IN_GROUP(take)                                                                     \
  barrier(CLK_LOCAL_MEM_FENCE);                                                                 \
  for (int left = (int)get_local_size(0); left > 1; left = (left + 1) / 2) {                    \
    const int to = (int)get_local_id(0), from = to + (left + 1) / 2;                            \
    if (from < left) { take; }                                                                  \
    barrier(CLK_LOCAL_MEM_FENCE);                                                               \
  }

// How many labels are wrong, and how many of those have no seed; the sum of the others' excess distances, in parts of a
// pixel, and the greatest one.
typedef struct {
  uint2 wrong;
  long sum;
  float greatest;
} errors_t;

#define NO_ERRORS {(uint2)0, 0, 0}

static inline void add_excess(errors_t* errors, float excess) {
  errors->wrong.s0 += 1;
  errors->sum += (long)(excess * PARTS_OF_EXCESS + 0.5f);
  errors->greatest = fmax(errors->greatest, excess);
}

// Writes the errors that the items of a group have found, joined, at the group's number. The local memory has
// MOST_COMPARING values each.
static inline void join_errors(errors_t own, local uint2* wrong_of, local long* sum_of, local float* greatest_of,
                               global uint2* wrong, global long* sums, global float* greatest) {
  const int item = (int)get_local_id(0);
  wrong_of[item] = own.wrong;
  sum_of[item] = own.sum;
  greatest_of[item] = own.greatest;
  JOIN_IN_GROUP(wrong_of[to] += wrong_of[from]; sum_of[to] += sum_of[from];
                greatest_of[to] = fmax(greatest_of[to], greatest_of[from]))
  if (item == 0) {
    wrong[get_group_id(0)] = wrong_of[0];
    sums[get_group_id(0)] = sum_of[0];
    greatest[get_group_id(0)] = greatest_of[0];
  }
}

#endif
