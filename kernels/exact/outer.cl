// The pass after the exact engine where seeds lie outside its pixels: corrects the labels that it made of the seeds
// inside. docs/exact.md says how, and why the result is exact.
//
// OUTER SEEDS are the seeds outside the pixels and, where the plane is periodic, images of all seeds. They stand in a
// tree: `places` in an order in which neighbours are near each other, and boxes around OUTER_FAN of them, around
// OUTER_FAN such boxes, and so on up to one box: the levels of `nodes`, the finest one first. Only pixels in the region
// get labels: it is no longer than a period. Its part in the grid's own period is home: no outer seed is there.

#include "exact/sizes.cl"
#include "core/plane.cl"

typedef JOIN(LENGTH, 4) length4;

// Boxes of pixels, regions and nodes are (left, top, right, bottom), both ends included.
#define LEFT s0
#define TOP s1
#define RIGHT s2
#define BOTTOM s3

// --- the tree ---

typedef struct {
  global const int2* places;
  global const int4* nodes;
  uint count;  // of outer seeds
  int top;     // the level of the one box around all
  uint top_start;
} Tree;

#define TREE_PARAMETERS \
  global const int2 *restrict places, global const int4 *restrict nodes, uint outer_count, int top, uint top_start
#define TREE_OF_PARAMETERS {places, nodes, outer_count, top, top_start}

// A walk through the tree without a stack: the node that it comes to. Nodes of one parent are neighbours, so the next
// node after a whole family is found from its number. `start` is where the level begins in the list of nodes.
typedef struct {
  int level;
  uint index, start;
} Walk;

static inline uint nodes_of_level(const Tree* tree, int level) {
  return ((tree->count - 1) >> OUTER_FAN_BITS * (level + 1)) + 1;
}

static inline Walk walk_from_top(const Tree* tree) {
  const Walk walk = {tree->top, 0, tree->top_start};
  return walk;
}

static inline bool goes_on(const Tree* tree, const Walk* walk) { return walk->level < tree->top || walk->index == 0; }

static inline int4 node_of(const Tree* tree, const Walk* walk) { return tree->nodes[walk->start + walk->index]; }

static inline void enter(const Tree* tree, Walk* walk) {
  --walk->level;
  walk->start -= nodes_of_level(tree, walk->level);
  walk->index <<= OUTER_FAN_BITS;
}

static inline void pass(const Tree* tree, Walk* walk) {
  ++walk->index;
  while (walk->level < tree->top &&
         (walk->index % OUTER_FAN == 0 || walk->index == nodes_of_level(tree, walk->level))) {
    walk->start += nodes_of_level(tree, walk->level);
    walk->index = ((walk->index - 1) >> OUTER_FAN_BITS) + 1;
    ++walk->level;
  }
}

// The seeds of a leaf, a node of level 0.
static inline uint first_of_leaf(uint leaf) { return leaf << OUTER_FAN_BITS; }
static inline uint end_of_leaf(const Tree* tree, uint leaf) { return min((leaf + 1) << OUTER_FAN_BITS, tree->count); }

// --- distances ---

static inline LENGTH along(LENGTH offset) { return ALONG(offset); }

// The parts along the axes of the distances from the four lines on which a box's sides lie.
typedef struct {
  LENGTH left, top, right, bottom;
} Sides;

static inline Sides sides_to_place(int4 box, int2 place) {
  const Sides sides = {along((LENGTH)place.x - box.LEFT), along((LENGTH)place.y - box.TOP),
                       along((LENGTH)place.x - box.RIGHT), along((LENGTH)place.y - box.BOTTOM)};
  return sides;
}

// From a coordinate to the nearest one of a range.
static inline LENGTH along_to_range(int from, int low, int high) {
  return along((LENGTH)max(max(low, from) - min(high, from), 0));
}

// To the point of a node that is nearest to each line.
static inline Sides sides_to_node(int4 box, int4 node) {
  const Sides sides = {along((LENGTH)clamp(box.LEFT, node.LEFT, node.RIGHT) - box.LEFT),
                       along((LENGTH)clamp(box.TOP, node.TOP, node.BOTTOM) - box.TOP),
                       along((LENGTH)clamp(box.RIGHT, node.LEFT, node.RIGHT) - box.RIGHT),
                       along((LENGTH)clamp(box.BOTTOM, node.TOP, node.BOTTOM) - box.BOTTOM)};
  return sides;
}

// The distances to the corners: top left, top right, bottom left, bottom right.
static inline length4 to_corners(const Sides* sides) {
  return (length4)(sides->left, sides->right, sides->left, sides->right) +
         (length4)(sides->top, sides->top, sides->bottom, sides->bottom);
}

// --- dominance (see dominance.cl), with a seed that wins at each corner of a box ---

typedef struct {
  int4 x, y;
  length4 distance;  // from each to its corner
} CornerDominators;

// Whether a dominator is nearer at all four corners. The greatest lag along one axis and that along the other meet at
// one corner.
static inline bool is_nearer(int x, int y, int4 box, const Sides* sides) {
  const LENGTH lag_x = max(along((LENGTH)x - box.LEFT) - sides->left, along((LENGTH)x - box.RIGHT) - sides->right);
  const LENGTH lag_y = max(along((LENGTH)y - box.TOP) - sides->top, along((LENGTH)y - box.BOTTOM) - sides->bottom);
  return lag_x + lag_y < 0;
}

// Turns the dominators until the first one is nearer, if one is: what ruled out the last seed often rules out the next.
// (Unrolled, this takes more registers than a GPU has.)
static inline bool is_dominated(CornerDominators* dominators, int4 box, const Sides* sides) {
#pragma unroll 1
  for (int turns = 0; turns < 4; ++turns) {
    if (is_nearer(dominators->x.s0, dominators->y.s0, box, sides)) return true;
    dominators->x = dominators->x.s1230;
    dominators->y = dominators->y.s1230;
  }
  return false;
}

static inline void take_dominators(CornerDominators* dominators, int4 box, int2 place) {
  const Sides sides = sides_to_place(box, place);
  const length4 distance = to_corners(&sides);
  dominators->x = select((int4)place.x, dominators->x, convert_int4(distance >= dominators->distance));
  dominators->y = select((int4)place.y, dominators->y, convert_int4(distance >= dominators->distance));
  dominators->distance = min(dominators->distance, distance);
}

// --- the kernels ---

static inline int boxes_along(int pixels) { return ((pixels - 1) >> OUTER_BOX_BITS) + 1; }

static inline int4 box_in_region(int item, int width, int4 region) {
  const int left = item % boxes_along(width) << OUTER_BOX_BITS, top = item / boxes_along(width) << OUTER_BOX_BITS;
  return (int4)(max(left, region.LEFT), max(top, region.TOP), min(left + OUTER_BOX - 1, region.RIGHT),
                min(top + OUTER_BOX - 1, region.BOTTOM));
}

// Lists, for each box of pixels, the outer seeds that may win at one of them. A list that is full names the leaf to go
// on from, others the end of the leaves.
kernel void list_outer_seeds(TREE_PARAMETERS, global const uint* restrict labels, global const int2* restrict seeds,
                             int4 region, int4 home, int width, int height, global uint* restrict lists,
                             global uint2* restrict counts) {
  const int item = (int)get_global_id(0);
  if (item >= boxes_along(width) * boxes_along(height)) return;
  const Tree tree = TREE_OF_PARAMETERS;
  const int4 box = box_in_region(item, width, region);
  uint2 count_and_rest = (uint2)(0, nodes_of_level(&tree, 0));
  counts[item] = count_and_rest;
  if (box.RIGHT < box.LEFT || box.BOTTOM < box.TOP) return;

  CornerDominators dominators;
  dominators.distance = (length4)MOST_LENGTH;
  const uint label = labels[(box.TOP + box.BOTTOM) / 2 * width + (box.LEFT + box.RIGHT) / 2];
  if (label != NO_LABEL) {
    const Sides sides = sides_to_place(box, seeds[label]);
    const int gap = 1 + min(min(box.LEFT - home.LEFT, home.RIGHT - box.RIGHT),
                            min(box.TOP - home.TOP, home.BOTTOM - box.BOTTOM));
    // All outer seeds are farther from the box than this seed is from any of its pixels.
    if (gap > 0 && along(gap) > max(sides.left, sides.right) + max(sides.top, sides.bottom)) return;
    take_dominators(&dominators, box, seeds[labels[box.TOP * width + box.LEFT]]);
    take_dominators(&dominators, box, seeds[labels[box.TOP * width + box.RIGHT]]);
    take_dominators(&dominators, box, seeds[labels[box.BOTTOM * width + box.LEFT]]);
    take_dominators(&dominators, box, seeds[labels[box.BOTTOM * width + box.RIGHT]]);
  } else {
    take_dominators(&dominators, box, places[0]);
  }

  Walk walk = walk_from_top(&tree);
  while (goes_on(&tree, &walk)) {
    const Sides sides = sides_to_node(box, node_of(&tree, &walk));
    if (!any(to_corners(&sides) < dominators.distance)) {
      pass(&tree, &walk);
    } else if (walk.level > 0) {
      enter(&tree, &walk);
    } else {
      const uint end = end_of_leaf(&tree, walk.index);
      for (uint i = first_of_leaf(walk.index); i < end; ++i) take_dominators(&dominators, box, places[i]);
      pass(&tree, &walk);
    }
  }

  walk = walk_from_top(&tree);
  global uint* const list = lists + (size_t)item * OUTER_LIST;
  while (goes_on(&tree, &walk)) {
    const Sides sides = sides_to_node(box, node_of(&tree, &walk));
    if (is_dominated(&dominators, box, &sides)) {
      pass(&tree, &walk);
    } else if (walk.level > 0) {
      enter(&tree, &walk);
    } else if (count_and_rest.s0 + OUTER_FAN > OUTER_LIST) {
      count_and_rest.s1 = walk.index;
      break;
    } else {
      const uint end = end_of_leaf(&tree, walk.index);
      for (uint i = first_of_leaf(walk.index); i < end; ++i) {
        const Sides of_seed = sides_to_place(box, places[i]);
        if (!is_dominated(&dominators, box, &of_seed)) list[count_and_rest.s0++] = i;
      }
      pass(&tree, &walk);
    }
  }
  counts[item] = count_and_rest;
}

// Vectors of distances and of what is chosen by them.
#ifdef VOROCL_FAR
#define KEY ulong
#else
#define KEY uint
#endif
#if VOROCL_WIDTH == 1
typedef LENGTH length_v;
typedef KEY key_v;
#define CONVERT_LENGTH_V JOIN(convert_, LENGTH)
#else
typedef JOIN(LENGTH, VOROCL_WIDTH) length_v;
typedef JOIN(KEY, VOROCL_WIDTH) key_v;
#define CONVERT_LENGTH_V JOIN(JOIN(convert_, LENGTH), VOROCL_WIDTH)
#endif

// The tie rule is the row-major order of the seeds' own positions, not of their images. A key is that order.
static inline KEY key_of(int2 seed) {
#ifdef VOROCL_FAR
  return upsample((uint)seed.y ^ 0x80000000u, (uint)seed.x ^ 0x80000000u);
#else
  return (uint)(seed.y + LAST_COORDINATE) << 16 | (uint)(seed.x + LAST_COORDINATE);
#endif
}

// A pixel's label, and what it is chosen by.
typedef struct {
  KEY label, key;  // of one size, as vectors of conditions want it
  LENGTH distance;
} Choice;

// Tries the rest of the tree, from a leaf on, at one pixel.
static inline void choose_from_rest(const Tree* tree, uint leaf, global const int2* seeds, global const uint* ids,
                                    int x, int y, Choice* choice) {
  Walk walk = {0, leaf, 0};
  while (goes_on(tree, &walk)) {
    const int4 node = node_of(tree, &walk);
    if (along_to_range(x, node.LEFT, node.RIGHT) + along_to_range(y, node.TOP, node.BOTTOM) > choice->distance) {
      pass(tree, &walk);
    } else if (walk.level > 0) {
      enter(tree, &walk);
    } else {
      const uint end = end_of_leaf(tree, walk.index);
      for (uint i = first_of_leaf(walk.index); i < end; ++i) {
        const Choice other = {ids[i], key_of(seeds[ids[i]]),
                              along((LENGTH)tree->places[i].x - x) + along((LENGTH)tree->places[i].y - y)};
        if (WINS(other.key, other.distance, choice->key, choice->distance)) *choice = other;
      }
      pass(tree, &walk);
    }
  }
}

// Gives the pixels of each box to the seeds of its list, where they win. Each work-item has a square of the box, as
// wide as a vector.
#define SQUARES_OF_ROW (OUTER_BOX / VOROCL_WIDTH)
VECTOR_KERNEL void compare_outer_seeds(TREE_PARAMETERS, global uint* restrict labels,
                                       global const int2* restrict seeds, global const uint* restrict ids,
                                       int4 region, int width, int height, global const uint* restrict lists,
                                       global const uint2* restrict counts) {
  const int box = (int)get_global_id(0) / (SQUARES_OF_ROW * SQUARES_OF_ROW);
  const int square = (int)get_global_id(0) % (SQUARES_OF_ROW * SQUARES_OF_ROW);
  if (box >= boxes_along(width) * boxes_along(height)) return;
  const uint count = counts[box].s0, rest = counts[box].s1;
  if (count == 0) return;
  const Tree tree = TREE_OF_PARAMETERS;
  const int first = (box % boxes_along(width) << OUTER_BOX_BITS) + square % SQUARES_OF_ROW * VOROCL_WIDTH;
  const int top_row = (box / boxes_along(width) << OUTER_BOX_BITS) + square / SQUARES_OF_ROW * VOROCL_WIDTH;
  const int left = max(first, region.LEFT), right = min(first + VOROCL_WIDTH - 1, region.RIGHT);
  const int end_row = min(top_row + VOROCL_WIDTH, region.BOTTOM + 1);
  if (right < left) return;
  // Lanes outside the region do what the nearest one inside does.
  const length_v columns = clamp(CONVERT_LENGTH_V(LANES) + (LENGTH)first, (length_v)left, (length_v)right);
  global const uint* const list = lists + (size_t)box * OUTER_LIST;

  for (int y = max(top_row, region.TOP); y < end_row; ++y) {
    KEY label[VOROCL_WIDTH], key[VOROCL_WIDTH];
    LENGTH distance[VOROCL_WIDTH];
    global uint* const row = labels + y * width;
#pragma unroll
    for (int lane = 0; lane < VOROCL_WIDTH; ++lane) {
      const int x = clamp(first + lane, left, right);
      label[lane] = row[x];
      const int2 seed = seeds[row[x] == NO_LABEL ? 0 : row[x]];
      key[lane] = key_of(seed);
      distance[lane] = row[x] == NO_LABEL ? MOST_LENGTH : along((LENGTH)seed.x - x) + along((LENGTH)seed.y - y);
    }
    key_v labels_of_row = LOAD_VECTOR(label), keys = LOAD_VECTOR(key);
    length_v least = LOAD_VECTOR(distance);
    for (uint i = 0; i < count; ++i) {
      const int2 place = places[list[i]];
      const uint id = ids[list[i]];
      const key_v of_seed = (key_v)key_of(seeds[id]);
      const length_v offset = columns - (LENGTH)place.x, away = ALONG(offset) + along((LENGTH)place.y - y);
      labels_of_row = WINS(of_seed, away, keys, least) ? (key_v)id : labels_of_row;
      keys = WINS(of_seed, away, keys, least) ? of_seed : keys;
      least = min(least, away);
    }
    STORE_VECTOR(labels_of_row, label);
    STORE_VECTOR(keys, key);
    STORE_VECTOR(least, distance);
#pragma unroll
    for (int lane = 0; lane < VOROCL_WIDTH; ++lane) {
      const int x = clamp(first + lane, left, right);
      Choice choice = {label[lane], key[lane], distance[lane]};
      if (rest < nodes_of_level(&tree, 0)) choose_from_rest(&tree, rest, seeds, ids, x, y, &choice);
      row[x] = (uint)choice.label;
    }
  }
}

// Pixels outside the region have no label.
VECTOR_KERNEL void clear_outside_region(global uint* restrict labels, int4 region, int width, int height) {
  if (!has_vector(width, height)) return;
  const int first = vector_x(width), y = vector_y();
  for (int x = first; x < first + VOROCL_WIDTH; ++x) {
    if (x < region.LEFT || x > region.RIGHT || y < region.TOP || y > region.BOTTOM) labels[y * width + x] = NO_LABEL;
  }
}
