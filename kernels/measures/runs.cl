// Runs: neighbouring pixels of one row with one label, as in run-length coding. What is summed over the pixels of a
// cell is added run by run, in closed form, so that the cost follows the borders of the cells and few additions meet
// at one cell's sums.
//
// The grid is cut into blocks; a work-item walks through the rows of one block. The host chooses the blocks' shape:
// large ones for a CPU, small ones for a GPU, which needs many work-items.

#include "core/vector.cl"

// A block's pixels: x in [left, right), y in [top, bottom).
typedef struct {
  uint index;
  int left, top, right, bottom;
} block_t;

// Blocks have 2^wide columns and 2^high rows.
static inline uint blocks_across(int width, int wide) { return ((uint)(width - 1) >> wide) + 1; }

// The index of the block that holds a pixel.
static inline uint block_of(int x, int y, int width, int wide, int high) {
  return ((uint)y >> high) * blocks_across(width, wide) + ((uint)x >> wide);
}

// The block of this work-item; the launch is rounded up to whole work-groups, so there may be none.
static inline bool take_block(int width, int height, int wide, int high, block_t* block) {
  const uint across = blocks_across(width, wide);
  block->index = (uint)get_global_id(0);
  block->left = (int)(block->index % across) << wide;
  block->top = (int)(block->index / across) << high;
  block->right = min(block->left + (1 << wide), width);
  block->bottom = min(block->top + (1 << high), height);
  return block->top < height;
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
  walk->to = walk->base + (int)popcount(~walk->changes & (walk->changes - 1));  // the index of the lowest bit
  walk->changes &= walk->changes - 1;
  return true;
}

// The label of the present run.
static inline uint run_label(const walk_t* walk) { return walk->row[walk->to - 1]; }
