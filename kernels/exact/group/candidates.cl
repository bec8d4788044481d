// The candidates of a patch: which seeds can be nearest somewhere in it, and labelling its pixels by them. A work-group
// does it together, with lists in local memory.

#ifndef VOROCL_EXACT_GROUP_CANDIDATES
#define VOROCL_EXACT_GROUP_CANDIDATES

#include "exact/group/patch.cl"

#define SYNC() barrier(CLK_LOCAL_MEM_FENCE)

// DOMINANCE. Seed a dominates seed b in a box if a wins, by distance and tie rule, at the box's four corners. Then a
// wins at every pixel of the box, and b is no candidate there: for the Euclidean metric the difference of the two
// squared distances is affine in the pixel, for the Manhattan metric it is the sum of a monotone function of x and one
// of y, and both are greatest at a corner. A bin is dominated if already its point nearest to each corner is.
//
// DOMINATORS: the nearest seeds known to the centre of a patch and to its four corners, and their distances from the
// four corners.
#define CORNERS 4
#define DOMINATORS (1 + CORNERS)
typedef struct {
  uint place[DOMINATORS];              // the centre and the corners, packed
  uint seed[DOMINATORS];
  uint least[DOMINATORS];              // from each seed to its place
  uint distance[DOMINATORS][CORNERS];  // from each seed to each corner
} PatchDominators;

static inline uint distance_to(uint place, uint seed) {
  return distance_of_offset(packed_x(seed) - packed_x(place), packed_y(seed) - packed_y(place));
}

static inline uint centre_of(Box box) { return pack((box.left + box.right) / 2, (box.top + box.bottom) / 2); }
static inline uint place_of(Box box, int number) {
  if (number == 0) return centre_of(box);
  return pack(number % 2 == 1 ? box.left : box.right, number <= 2 ? box.top : box.bottom);
}

// Begins with the only seed known.
static inline void begin_dominators(local PatchDominators* dominators, Box box, uint seed) {
  const int item = (int)get_local_id(0);
  if (item < DOMINATORS) {
    const uint place = place_of(box, item), distance = distance_to(place, seed);
    dominators->place[item] = place;
    dominators->seed[item] = seed;
    dominators->least[item] = distance;
    if (item > 0) {
#pragma unroll
      for (int i = 0; i < DOMINATORS; ++i) dominators->distance[i][item - 1] = distance;
    }
  }
  SYNC();
}

// Takes the seeds of a list that win at a place. The items share out the pairs of a seed and a place, as there may be a
// few seeds only.
static inline void improve_dominators(local PatchDominators* dominators, local const uint* seeds, int count) {
  const int item = (int)get_local_id(0);
  for (int i = item; i < count * DOMINATORS; i += (int)get_local_size(0)) {
    const int place = i % DOMINATORS;
    atomic_min(dominators->least + place, distance_to(dominators->place[place], seeds[i / DOMINATORS]));
  }
  SYNC();
  if (item < DOMINATORS && dominators->least[item] < distance_to(dominators->place[item], dominators->seed[item])) {
    dominators->seed[item] = EMPTY;
  }
  SYNC();
  for (int i = (int)get_local_id(0); i < count * DOMINATORS; i += (int)get_local_size(0)) {
    const int place = i % DOMINATORS;
    const uint seed = seeds[i / DOMINATORS];
    if (distance_to(dominators->place[place], seed) == dominators->least[place])
      atomic_min(dominators->seed + place, seed);
  }
  SYNC();
  for (int i = (int)get_local_id(0); i < DOMINATORS * CORNERS; i += (int)get_local_size(0)) {
    dominators->distance[i / CORNERS][i % CORNERS] =
        distance_to(dominators->place[1 + i % CORNERS], dominators->seed[i / CORNERS]);
  }
  SYNC();
}

// The part of the distance from a pixel to an interval of pixels that lies along one axis.
static inline int along_to(int from, int first, int last) { return ALONG(max(max(first - from, from - last), 0)); }

// Whether one of the first `count` dominators dominates all seeds in a box: a bin, a row of it or a single seed. In the
// tie rule the box's first pixel stands for them. Where there are images, whose seeds' order is another one, it is
// left open who wins a tie. A distance of seeds is at most 0x7fffffff, so differences fit in an int.
static inline bool is_dominated(local const PatchDominators* dominators, int count, Box patch, Box seeds) {
  const int to_left = along_to(patch.left, seeds.left, seeds.right);
  const int to_right = along_to(patch.right, seeds.left, seeds.right);
  const int to_top = along_to(patch.top, seeds.top, seeds.bottom);
  const int to_bottom = along_to(patch.bottom, seeds.top, seeds.bottom);
#ifndef VOROCL_PERIODIC
  const uint first_pixel = pack(seeds.left, seeds.top);
#endif
  bool dominated = false;
#pragma unroll 1  // unrolled, it takes too many registers
  for (int i = 0; i < count; ++i) {
    local const uint* const distance = dominators->distance[i];
    const int lag = min(min(to_left + to_top - (int)distance[0], to_right + to_top - (int)distance[1]),
                        min(to_left + to_bottom - (int)distance[2], to_right + to_bottom - (int)distance[3]));
#ifdef VOROCL_PERIODIC
    dominated |= lag >= 1;
#else
    dominated |= lag >= (COMES_FIRST(dominators->seed[i], first_pixel) ? 0 : 1);
#endif
  }
  return dominated;
}

static inline Box box_of_pixel(uint pixel) {
  const Box box = {packed_x(pixel), packed_y(pixel), packed_x(pixel), packed_y(pixel)};
  return box;
}

// Copies those seeds of a list that nothing dominates; counts all of them, and copies as many as there is room for.
static inline void keep_candidates(local uint* kept, local uint* kept_count, int room,
                                   local const PatchDominators* dominators, Box patch, local const uint* seeds,
                                   int count) {
  for (int i = (int)get_local_id(0); i < count; i += (int)get_local_size(0)) {
    if (!is_dominated(dominators, DOMINATORS, patch, box_of_pixel(seeds[i]))) {
      const uint at = atomic_inc(kept_count);
      if (at < (uint)room) kept[at] = seeds[i];
    }
  }
  SYNC();
}

// RANKED: candidates in the order of the tie rule, with what their keys are made of. A KEY at a pixel holds, above, by
// how much farther a candidate is than the base, and, in the lowest bits, its rank by the tie rule. The base is the
// seed nearest to the patch's centre.
typedef struct {
  int4 term[MOST_RANKED];
  uint value[MOST_RANKED];
#ifdef VOROCL_PERIODIC
  uint seed[MOST_RANKED];  // whose image a candidate is, in the list's order
#endif
} Ranked;

// A difference of distances fits in so many bits and a sign, however large the distances are. At the centre the
// difference is not negative, as the base is the nearest seed; at one corner it is not positive, as the base
// dominates no candidate. So it is nowhere farther from 0 than it varies in the patch, and along an axis it varies by
// at most 2 * LAST_COORDINATE per pixel (Euclidean) or 2 per pixel (Manhattan).
#define RANK_BITS 8
#define DIFFERENCE_BITS 22
#if 1 + DIFFERENCE_BITS + RANK_BITS > 32
#error "A key does not fit in an int"
#endif
#if 2 * LAST_COORDINATE * (2 * ((1 << PATCH_BITS) - 1)) >= 1 << DIFFERENCE_BITS
#error "A difference of distances in a patch does not fit in its bits"
#endif
#if MOST_RANKED > 1 << RANK_BITS
#error "A rank does not fit in the bits of a key"
#endif

static inline uint bits_of_rank(int count) { return 32 - clz((uint)max(count, 1) - 1); }

#ifdef VOROCL_EUCLIDEAN
// The difference of two squared distances is affine in the pixel. So a key is the sum of three parts: of the patch's
// first pixel, times the column, and times the row.
static inline int4 term_of(int x, int y, int base_x, int base_y, uint rank, uint rank_bits) {
  const uint difference = (uint)(x * x + y * y) - (uint)(base_x * base_x + base_y * base_y);
  return (int4)((int)((difference << rank_bits) + rank), (int)((uint)(2 * (base_x - x)) << rank_bits),
                (int)((uint)(2 * (base_y - y)) << rank_bits), 0);
}
static inline int8 keys_of(int4 term, int column, int row, uint rank_bits) {
  (void)rank_bits;
  const int a = term.s0 + term.s1 * column + term.s2 * row, b = a + term.s2, c = b + term.s2, d = c + term.s2;
  const int e = d + term.s2, f = e + term.s2, g = f + term.s2, h = g + term.s2;
  return (int8)(a, b, c, d, e, f, g, h);
}
#else
// Distances themselves fit in a key, and need no base: the candidate's place in the patch, and its rank.
static inline int4 term_of(int x, int y, int base_x, int base_y, uint rank, uint rank_bits) {
  (void)base_x, (void)base_y, (void)rank_bits;
  return (int4)(x, y, (int)rank, 0);
}
static inline int8 keys_of(int4 term, int column, int row, uint rank_bits) {
  const int along_x = ALONG(column - term.s0);
  const int8 y = row - term.s1 + (int8)(0, 1, 2, 3, 4, 5, 6, 7);
  return (along_x + ALONG(y) << (int8)(int)rank_bits) + term.s2;
}
#endif

// The position of a seed in the frame, from that of the seed or of its image: seed_of_image() for one image.
static inline int in_grid(int at, int size, int periodic) {
#ifdef VOROCL_SHORT_PERIOD
  const int rest = at % size;
  return !periodic ? at : rest < 0 ? rest + size : rest;
#else
  return wrapped(at, size, periodic);  // the margin is shorter than a period
#endif
}
static inline uint seed_of_one_image(const SeedIndex* index, uint image) {
  return pack(in_grid(packed_x(image) - index->x0, index->width, PERIODIC_X) + index->x0,
              in_grid(packed_y(image) - index->y0, index->height, PERIODIC_Y) + index->y0);
}

// The order of the candidates of a list by the tie rule; images of one seed are ordered by where they are.
#ifdef VOROCL_PERIODIC
static inline void find_seeds_of_images(local Ranked* ranked, const SeedIndex* index, local const uint* images,
                                        int count) {
  for (int i = (int)get_local_id(0); i < count; i += (int)get_local_size(0)) {
    ranked->seed[i] = seed_of_one_image(index, images[i]);
  }
  SYNC();
}
static inline bool is_ranked_first(local const Ranked* ranked, local const uint* seeds, int a, int b) {
  const uint seed = ranked->seed[a], other = ranked->seed[b];
  return COMES_FIRST(seed, other) || (seed == other && seeds[a] < seeds[b]);
}
#else
static inline void find_seeds_of_images(local Ranked* ranked, const SeedIndex* index, local const uint* images,
                                        int count) {
  (void)ranked, (void)index, (void)images, (void)count;
}
static inline bool is_ranked_first(local const Ranked* ranked, local const uint* seeds, int a, int b) {
  (void)ranked;
  return COMES_FIRST(seeds[a], seeds[b]);
}
#endif

// Ranks the candidates of a list. The base is the dominator of the centre.
static inline void rank_candidates(local Ranked* ranked, const SeedIndex* index, Box patch, uint base,
                                   local const uint* seeds, int count) {
  find_seeds_of_images(ranked, index, seeds, count);
  const uint rank_bits = bits_of_rank(count);
  for (int i = (int)get_local_id(0); i < count; i += (int)get_local_size(0)) {
    const uint seed = seeds[i];
    uint rank = 0;
#pragma unroll 4
    for (int other = 0; other < count; ++other) rank += is_ranked_first(ranked, seeds, other, i) ? 1 : 0;
    ranked->term[rank] = term_of(packed_x(seed) - patch.left, packed_y(seed) - patch.top, packed_x(base) - patch.left,
                                 packed_y(base) - patch.top, rank, rank_bits);
    ranked->value[rank] = seed;
  }
  SYNC();
}

// The least keys of PIXELS pixels of an item, one below the other ...
#define PIXELS 8
static inline int8 find_least_keys_below(local const Ranked* ranked, int count, int column, int row) {
  const uint rank_bits = bits_of_rank(count);
  int8 least = (int8)INT_MAX;
  for (int i = 0; i < count; ++i) least = min(least, keys_of(ranked->term[i], column, row, rank_bits));
  return least;
}

// ... and of FEW_PIXELS.
#define FEW_PIXELS 4
static inline int4 find_few_least_keys_below(local const Ranked* ranked, int count, int column, int row) {
  const uint rank_bits = bits_of_rank(count);
  int4 least = (int4)INT_MAX;
  for (int i = 0; i < count; ++i) least = min(least, keys_of(ranked->term[i], column, row, rank_bits).lo);
  return least;
}

#endif
