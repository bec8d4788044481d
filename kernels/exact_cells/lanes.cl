// Eight boxes, sites or vertices at once: bits for those that hold, and the order of those that may cut. The
// tree of sites that planes and volumes share: theirs are of a NUMBER, int or double.

#ifndef VOROCL_EXACT_CELLS_LANES
#define VOROCL_EXACT_CELLS_LANES

#include "exact_cells/sizes.cl"

#if DIMENSIONS == 3
#define NUMBER double
#define NUMBER_4 double4
typedef double3 place_t;
typedef float3 rough_t;
#define rough_of convert_float3
#define place_from(at, stride) ((double3)((at)[0], (at)[stride], (at)[2 * (stride)]))
#else
#define NUMBER int
#define NUMBER_4 int4
typedef int2 place_t;
typedef float2 rough_t;
#define rough_of convert_float2
#define place_from(at, stride) ((int2)((at)[0], (at)[stride]))
#endif

#define FAN_BITS 3
#define MOST_LEVELS 10       // of boxes, for 2^30 sites
#define NO_CELL 0xffffffffu  // behind a side of the box

// Where cells lie: private for the many, global for those that have no room there. Functions that say ROOM have a
// `cell`.
#ifdef LARGE_CELLS
#define CELL_SPACE global
#define DECLARED_LIST(type, name, length) global type* name;
#define ROOM cell->room
#else
#define CELL_SPACE private
#define DECLARED_LIST(type, name, length) type name[length];
#define ROOM PRIVATE_ROOM
#endif

// Which sites there are: in the kernels' arguments, and as what functions take.
#define SITE_PARAMETERS                                                                                  \
  uint count, global const NUMBER *sites, global const NUMBER *boxes, global const uint *levels,         \
      global const double *lags, global const double *box_lags, int top, NUMBER_4 lower, NUMBER_4 upper, \
      NUMBER_4 reach, global const NUMBER *shifts, int images
#define SITE_ARGUMENTS \
  { count, sites, boxes, levels, lags, box_lags, top, lower, upper, reach, shifts, images }

typedef struct {
  uint count;                     // of sites
  global const NUMBER* sites;     // per leaf eight x, eight y and in a volume eight z, in steps
  global const NUMBER* boxes;     // per group eight lower and eight upper x, and so on
  global const uint* levels;      // by level: its first group. Those of level 1 are boxes around leaves.
  global const double* lags;      // per site, and null without weights
  global const double* box_lags;  // per group eight
  int top;                        // the last level
  NUMBER_4 lower, upper;          // sides of the box
  NUMBER_4 reach;                 // along a periodic axis all cells end nearer to their sites, in half steps; else 0
  global const NUMBER* shifts;    // of each image of all sites that may cut: itself, the others, the nearest first
  int images;
} tree_t;

// A cell begins as the box, but along periodic axes farther than its own images let it reach: how far its lower
// and upper sides are from the site, in half steps, along an axis.
#define FIRST_SIDES(tree, at, axis)                                                         \
  (tree)->reach.axis > 0 ? -(tree)->reach.axis : 2 * ((tree)->lower.axis - (at).axis),      \
      (tree)->reach.axis > 0 ? (tree)->reach.axis : 2 * ((tree)->upper.axis - (at).axis)

// What eight numbers are together.
#define OF_EIGHT(type, name, join)                       \
  static inline type name(type##8 all) {                 \
    const type##4 of_four = join(all.lo, all.hi);        \
    const type##2 of_two = join(of_four.lo, of_four.hi); \
    return join(of_two.s0, of_two.s1);                   \
  }
#define BITS_OR(a, b) ((a) | (b))
OF_EIGHT(uint, least_of, min)
OF_EIGHT(float, least_of_floats, fmin)
OF_EIGHT(float, greatest_of_floats, max)
OF_EIGHT(double, greatest_of, fmax)
OF_EIGHT(int, or_of_ints, BITS_OR)
OF_EIGHT(ulong, or_of, BITS_OR)

// A bit for each lane that holds, and back.
#define LANE_BITS ((int8)(1, 2, 4, 8, 16, 32, 64, 128))
static inline int8 lanes_of(int bits) { return (bits & LANE_BITS) != 0; }
static inline int bits_of_ints(int8 lanes) { return or_of_ints(lanes & LANE_BITS); }

#define LOWEST_BIT(bits) ((int)popcount(~(bits) & ((bits)-1)))

#define FAR 0xffffffffu  // of those that cut nothing

// The nearest of eight come first: numbers that grow with a squared distance, and end with which one it is.
static inline uint8 order_of(float8 distances, int8 may_cut) {
  const uint8 order = (as_uint8(distances) & ~(uint)(FAN - 1)) | (uint8)(0, 1, 2, 3, 4, 5, 6, 7);
  return order | ~as_uint8(may_cut);
}

static inline uint8 without(uint8 numbers, uint one) { return numbers | as_uint8(numbers == one); }

// --- walks through the tree ---

// By level: the boxes that are still to be looked into. `node` is the one that the walk has come to, at `level`.
typedef struct {
  uint8 orders[MOST_LEVELS + 1];
  uint firsts[MOST_LEVELS + 1];
  int level;
  uint node;
} walk_t;

// Begins with a group at a level, of whose boxes this is the order.
static inline void begin_walk(walk_t* walk, int level, uint group, uint8 order) {
  walk->level = level;
  walk->firsts[level] = group * FAN;
  walk->orders[level] = order;
}

// Goes on with the boxes in the one that it has come to.
static inline void enter(walk_t* walk, uint8 order) { begin_walk(walk, walk->level - 1, walk->node, order); }

// Comes to the next box that is nearer than `end`, the nearest first. False after the last one up to level `top`.
static inline bool goes_on(walk_t* walk, int top, uint end) {
  for (; walk->level <= top; ++walk->level) {
    const uint next = least_of(walk->orders[walk->level]);
    if (next >= end) continue;
    walk->orders[walk->level] = without(walk->orders[walk->level], next);
    walk->node = walk->firsts[walk->level] + (next & (FAN - 1));
    return true;
  }
  return false;
}

// --- weights ---
//
// A place belongs to the site of the least |place - site|^2 - weight. Sites have lags: the greatest weight
// less their own, in steps squared; boxes have the least of theirs. Without weights there are no lags.

static inline double lag_of(global const double* lags, uint site) { return lags != 0 ? lags[site] : 0; }

// By how much the weights of eight sites or boxes are greater than that of a site with this lag.
static inline float8 leads_of(global const double* lags, size_t group, double lag) {
  return lags != 0 ? convert_float8(lag - vload8(group, lags)) : 0.0f;
}

// The squared distances of bisectors, in half steps, from a site that others are at these squared distances
// from, in steps: (distance - lead / distance)^2, or 0 where the site is beyond. Of others that are at least
// so far it is the least.
static inline float8 bisectors_at(float8 distances, float8 leads) {
  const float8 at = fmax(fmax(distances, fabs(leads)), 1e-30f);
  const float8 ahead = fmax(at - leads - 4e-6f * at, 0.0f);  // floats err by less
  return ahead * (ahead / at);
}

// With what floats may err by, where they are added to a squared distance.
static inline float8 with_margin(float8 leads) { return leads + 1e-5f * fabs(leads); }

// The greatest lag of the sites of a leaf.
static inline double most_lag(global const double* lags, uint leaf, uint count) {
  double most = 0;
  for (uint site = leaf * FAN; site < min(leaf * FAN + FAN, count); ++site) most = fmax(most, lag_of(lags, site));
  return most;
}

// Those of eight of which there are so many.
static inline int8 first_of(uint many) { return (int8)(0, 1, 2, 3, 4, 5, 6, 7) < (int)min(many, (uint)FAN); }

// Those of a group that are there: its last ones may not be.
static inline int8 are_there(uint count, int level, uint group) {
  const uint nodes = (count + (1u << (FAN_BITS * level)) - 1) >> (FAN_BITS * level);
  return first_of(nodes - group * FAN);
}

#endif
