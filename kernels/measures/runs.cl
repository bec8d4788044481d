// Runs: neighbouring pixels of one row with one label, as in run-length coding. What is summed over the pixels of a
// cell is added run by run, in closed form, so that the cost follows the borders of the cells and few additions meet
// at one cell's sums.
//
// The grid is cut into blocks; a work-item walks through the rows of one block. The host chooses the blocks' shape:
// large ones for a CPU, small ones for a GPU, which needs many work-items.

#ifndef VOROCL_RUNS
#define VOROCL_RUNS

#include "core/periods.cl"
#include "core/vector.cl"

// How many slices a grid has. Kernels take its size as (width, height, depth, 0), and a plane's one slice is known when
// they are built.
#if VOROCL_DIMENSIONS == 3
#define DEPTH(size) ((size).z)
#else
#define DEPTH(size) 1
#endif

// A block's pixels: x in [left, right), y in [top, bottom), z in [front, back).
typedef struct {
  uint index;
  int left, top, front, right, bottom, back;
} block_t;

// A block has 2^bits pixels along each axis.
static inline uint blocks_along(int size, int bits) { return ((uint)(size - 1) >> bits) + 1; }

// The index of the block that holds a pixel.
static inline uint block_of(int x, int y, int z, int4 size, int4 bits) {
  const uint slab = DEPTH(size) == 1 ? 0 : ((uint)z >> bits.z) * blocks_along(size.y, bits.y);
  return (slab + ((uint)y >> bits.y)) * blocks_along(size.x, bits.x) + ((uint)x >> bits.x);
}

// Its first pixel.
static inline int4 first_of_block(uint index, int4 size, int4 bits) {
  const uint across = blocks_along(size.x, bits.x), row = index / across;
  if (DEPTH(size) == 1) return as_int4((uint4)(index % across, row, 0, 0)) << bits;
  const uint down = blocks_along(size.y, bits.y);
  return as_int4((uint4)(index % across, row % down, row / down, 0)) << bits;
}

// The block of this work-item; the launch is rounded up to whole work-groups, so there may be none.
static inline bool take_block(int4 size, int4 bits, block_t* block) {
  const int4 first = first_of_block((uint)get_global_id(0), size, bits);
  block->index = (uint)get_global_id(0);
  block->left = first.x;
  block->top = first.y;
  block->front = DEPTH(size) == 1 ? 0 : first.z;
  block->right = min(first.x + (1 << bits.x), size.x);
  block->bottom = min(first.y + (1 << bits.y), size.y);
  block->back = DEPTH(size) == 1 ? 1 : min(first.z + (1 << bits.z), size.z);
  return DEPTH(size) == 1 ? first.y < size.y : first.z < size.z;
}

#define FOR_EACH_ROW(y, z, block)                     \
  for (int z = (block).front; z < (block).back; ++z)  \
    for (int y = (block).top; y < (block).bottom; ++y)

// Where a row of pixels begins.
static inline global const uint* row_of(global const uint* labels, int y, int z, int4 size) {
  return labels + (z * size.y + y) * size.x;
}

// A walk along the runs of a block's row: [from, to) is the present one. Where two rows are walked at once a
// run ends where either changes.
typedef struct {
  global const uint* row;
  global const uint* other;
  int left, right;  // the block's row
  int from, to;
  int base, next;  // the pixels that were compared last begin at base; next is the first one that was not yet
  uint changes;    // bit i: pixel base + i begins another run
} walk_t;

static inline walk_t begin_walk(global const uint* row, global const uint* other, int left, int right) {
  const walk_t walk = {row, other, left, right, left, left, left, left + 1, 0u};
  return walk;
}

// Bit i: pixel i of a vector has another label than the one before it.
static inline uint changes_of_vector(global const uint* pixels) {
  return lane_sum(select((uint_v)0, (uint_v)1 << LANES, LOAD_VECTOR(pixels) != LOAD_VECTOR(pixels - 1)));
}

// Goes to the next run; false at the end of the row. All changes of a vector are found at once: a CPU would
// mispredict a branch for every run.
__attribute__((always_inline)) static inline bool next_run(walk_t* walk) {
  walk->from = walk->to;
  if (walk->from >= walk->right) return false;
  while (walk->changes == 0) {
    if (walk->next >= walk->right) {
      walk->to = walk->right;
      return true;
    }
    if (walk->right - walk->left > VOROCL_WIDTH) {
      // The last vector of the row is moved left; it ends with the row and passes over what was compared before.
      walk->base = min(walk->next, walk->right - VOROCL_WIDTH);
      walk->changes = changes_of_vector(walk->row + walk->base);
      if (walk->other != walk->row) walk->changes |= changes_of_vector(walk->other + walk->base);
      walk->changes &= 0xffffffffu << (walk->next - walk->base);
      walk->next = walk->base + VOROCL_WIDTH;
    } else {
      walk->base = walk->next++;
      walk->changes = (uint)(walk->row[walk->base] != walk->row[walk->base - 1] ||
                             walk->other[walk->base] != walk->other[walk->base - 1]);
    }
  }
  walk->to = walk->base + (int)lowest_bit(walk->changes);
  walk->changes &= walk->changes - 1;
  return true;
}

// The label of the present run.
static inline uint run_label(const walk_t* walk) { return walk->row[walk->to - 1]; }

#endif
