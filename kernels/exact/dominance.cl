// Dominance: which seeds cannot be the nearest one of any pixel of a box.
//
// Seed a dominates seed b in a box if a wins, by distance and tie rule, at the box's four corners. Then a wins at
// every pixel of the box, and b is no candidate there: for the Euclidean metric the difference of the two squared
// distances is affine in the pixel, for the Manhattan metric it is the sum of a monotone function of x and one of y,
// and both are greatest at a corner. A bin is dominated if already its point nearest to each corner is.

#ifndef VOROCL_EXACT_DOMINANCE
#define VOROCL_EXACT_DOMINANCE

#include "exact/box.cl"

DEFINE_DISTANCE_BETWEEN(distance_to_corners, uint4, short8, as_uint4, as_short8, convert_int4)

// The seeds that dominate: the nearest one known to the centre, and to each of the four corners.
#define CORNERS 4
#define DOMINATORS (1 + CORNERS)
typedef struct {
  uint place[DOMINATORS];              // the centre and the corners, packed
  uint seed[DOMINATORS];               // packed
  uint distance[DOMINATORS][CORNERS];  // from each seed to each corner
} Dominators;

static inline void no_dominators(Dominators* dominators, Box box) {
  dominators->place[0] = pack((box.left + box.right) / 2, (box.top + box.bottom) / 2);
  dominators->place[1] = pack(box.left, box.top);
  dominators->place[2] = pack(box.right, box.top);
  dominators->place[3] = pack(box.left, box.bottom);
  dominators->place[4] = pack(box.right, box.bottom);
  for (int i = 0; i < DOMINATORS; ++i) dominators->seed[i] = EMPTY;
}

// Lists are read in whole vectors: fills a list's last one with empty positions.
static inline void pad(uint* list, int count) { STORE_VECTOR((uint_v)EMPTY, list + count); }

// Takes the seed of a padded list that wins at a place, if it wins against the place's dominator.
static inline void improve_dominator(Dominators* dominators, int i, const uint* seeds, int count) {
  const uint_v place = dominators->place[i];
  uint_v nearest = dominators->seed[i];
  uint_v least = distance_to_label(nearest, place);
  for (int first = 0; first < count; first += VOROCL_WIDTH) {
    const uint_v seed = LOAD_VECTOR(seeds + first);
    const uint_v distance = distance_to_label(seed, place);
    nearest = select(nearest, seed, WINS(seed, distance, nearest, least));
    least = min(least, distance);
  }
  dominators->seed[i] = winning_lane(nearest, least);
  const uint4 corners = vload4(0, dominators->place + 1);
  vstore4(distance_to_corners((uint4)dominators->seed[i], corners), 0, dominators->distance[i]);
}

// Copies those entries of the vector at `first` for which the condition holds behind the `kept` ones at the front of
// the list. Every entry is copied, and the next one over it unless it is kept: no branch depends on the condition.
static inline int keep_entries(uint* list, int first, int_v condition, int kept) {
  int keep[VOROCL_WIDTH];
  STORE_VECTOR(condition, keep);
#pragma unroll
  for (int lane = 0; lane < VOROCL_WIDTH; ++lane) {
    list[kept] = list[first + lane];
    kept += keep[lane] & 1;
  }
  return kept;
}

// How much farther than a dominator seeds at these distances are from the corner where that is least: below 0 if they
// win at a corner. At an equal distance the dominator wins if it comes first; where there are images, whose seeds'
// order is another one, it is left open who wins.
static inline int_v least_lag(const Dominators* dominators, int i, uint_v seed, const uint_v* distance) {
  int_v lag = AS_INT_V(distance[0] - dominators->distance[i][0]);
#pragma unroll
  for (int corner = 1; corner < CORNERS; ++corner) {
    lag = min(lag, AS_INT_V(distance[corner] - dominators->distance[i][corner]));
  }
#ifdef VOROCL_PERIODIC
  (void)seed;
  return lag - 1;
#else
  return lag - AS_INT_V(select((uint_v)1, (uint_v)0, COMES_FIRST(dominators->seed[i], seed)));
#endif
}

// Drops the seeds of a padded list that are dominated by one of the dominators from `begin` to `end`.
static inline int drop_dominated_seeds(const Dominators* dominators, int begin, int end, uint* seeds, int count) {
  int kept = 0;
  for (int first = 0; first < count; first += VOROCL_WIDTH) {
    const uint_v seed = LOAD_VECTOR(seeds + first);
    uint_v distance[CORNERS];
#pragma unroll
    for (int corner = 0; corner < CORNERS; ++corner) {
      distance[corner] = distance_to_label(seed, (uint_v)dominators->place[1 + corner]);
    }
    int_v lag = (int_v)INT_MIN;
    for (int i = begin; i < end; ++i) lag = max(lag, least_lag(dominators, i, seed, distance));
    lag = select(lag, (int_v)0, AS_INT_V(seed) < 0);  // empty
    kept = keep_entries(seeds, first, lag < 0, kept);
  }
  pad(seeds, kept);
  return kept;
}

// Drops what is dominated from a padded list whose winner at the centre is known. That one dominates most of the
// list, so the winners at the corners are found among what is left: what is nearest to a corner is dominated by none.
// A list of FEW seeds is not searched for those, because trying all of it at every pixel takes less time.
#define FEW 8
static inline int drop_dominated(Dominators* dominators, uint* seeds, int count) {
  count = drop_dominated_seeds(dominators, 0, 1, seeds, count);
  if (count <= FEW) return count;
  for (int i = 1; i < DOMINATORS; ++i) improve_dominator(dominators, i, seeds, count);
  return drop_dominated_seeds(dominators, 1, DOMINATORS, seeds, count);
}

#endif
