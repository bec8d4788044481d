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

// The place of a pixel in an image of labels, less than a period outside the grid; -1 if there is none. In a tilted
// grid what lies a period of y further is shifted along x, and what lies one of z further along x and y, by whole
// pixels: of the two pixels beside one that share an edge with it, the one that has more of it counts.
static inline long index_of_image(int x, int y, int z, int4 size, int4 shifts) {
  const int image_z = !PERIODIC_Z ? 0 : z < 0 ? -1 : z >= DEPTH(size);
  x -= image_z * shifts.y, y -= image_z * shifts.z, z -= image_z * DEPTH(size);
  const int image_y = !PERIODIC_Y ? 0 : y < 0 ? -1 : y >= size.y;
  x -= image_y * shifts.x, y -= image_y * size.y;
  if (PERIODIC_X) x = (x % size.x + size.x) % size.x;
  const bool inside = x >= 0 && x < size.x && y >= 0 && y < size.y && z >= 0 && z < DEPTH(size);
  return inside ? ((long)z * size.y + y) * size.x + x : -1;
}

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

// Bit i: two rows have other labels at pixel i, of at most 32. A CPU would mispredict a branch on each.
static inline uint differences(global const uint* row, global const uint* other, int pixels) {
  uint found = 0;
  for (int i = 0; pixels < VOROCL_WIDTH && i < pixels; ++i) found |= (uint)(row[i] != other[i]) << i;
#pragma unroll 1  // for registers
  for (int i = 0; pixels >= VOROCL_WIDTH && i < pixels; i += VOROCL_WIDTH) {
    const int at = min(i, pixels - VOROCL_WIDTH);  // the last vector passes over what was compared before
    const uint_v differ = select((uint_v)0, (uint_v)1 << LANES, LOAD_VECTOR(row + at) != LOAD_VECTOR(other + at));
    found |= lane_sum(differ) << at;
  }
  return found;
}

// A walk along the runs of a block's row: [from, to) is the present one.
#define COMPARED (VOROCL_WIDTH > 1 ? 32 : 1)  // pixels at once; on GPUs one, for registers
typedef struct {
  global const uint* row;
  int right;  // of the block
  int from, to;
  int base;      // of COMPARED pixels
  uint changes;  // bit i: pixel base + i begins another run
} walk_t;

static inline walk_t begin_walk(global const uint* row, block_t block) {
  const walk_t walk = {row, block.right, block.left, block.left, block.left + 1 - COMPARED, 0u};
  return walk;
}

// Goes to the next run; false at the end of the row.
__attribute__((always_inline)) static inline bool next_run(walk_t* walk) {
  walk->from = walk->to;
  if (walk->from >= walk->right) return false;
  while (walk->changes == 0) {
    walk->base += COMPARED;
    if (walk->base >= walk->right) {
      walk->to = walk->right;
      return true;
    }
    global const uint* const first = walk->row + walk->base;
    walk->changes = differences(first, first - 1, min(COMPARED, walk->right - walk->base));
  }
  walk->to = walk->base + (int)lowest_bit(walk->changes);
  walk->changes &= walk->changes - 1;
  return true;
}

// The label of the present run.
static inline uint run_label(const walk_t* walk) { return walk->row[walk->to - 1]; }

// A loop over the runs of all rows. (`break` would leave a row alone.)
#define FOR_EACH_RUN(walk, y, z, block, labels, size) \
  FOR_EACH_ROW(y, z, block)                           \
    for (walk_t walk = begin_walk(row_of(labels, y, z, size), block); next_run(&walk);)

#endif
