// Blocks of a volume, one for each work-item that sums over cells. A size is (width, height, depth, 0), and a block has
// 2^bits voxels along each axis. The host chooses them: large ones for a CPU, small ones for a GPU.

#ifndef VOROCL_VOLUMES_BLOCKS
#define VOROCL_VOLUMES_BLOCKS

// The voxels from `first` on that are before `end`.
typedef struct {
  uint index;
  int4 first, end;
} cuboid_t;

static inline uint4 blocks_of(int4 size, int4 bits) { return as_uint4(((size - 1) >> bits) + 1); }

// The index of the block that holds a voxel.
static inline uint block_with(int x, int y, int z, int4 size, int4 bits) {
  const uint4 blocks = blocks_of(size, bits);
  return ((uint)(z >> bits.z) * blocks.y + (uint)(y >> bits.y)) * blocks.x + (uint)(x >> bits.x);
}

static inline int4 first_of_block(uint index, int4 size, int4 bits) {
  const uint4 blocks = blocks_of(size, bits);
  const uint4 block = (uint4)(index % blocks.x, index / blocks.x % blocks.y, index / blocks.x / blocks.y, 0);
  return as_int4(block) << bits;
}

// The block of this work-item; the launch is rounded up to whole work-groups, so there may be none.
static inline bool take_cuboid(int4 size, int4 bits, cuboid_t* block) {
  block->index = (uint)get_global_id(0);
  block->first = first_of_block(block->index, size, bits);
  block->end = min(block->first + ((int4)1 << bits), size);
  return block->first.z < size.z;
}

static inline global const uint* row_of(global const uint* labels, int y, int z, int4 size) {
  return labels + ((size_t)z * (size_t)size.y + (size_t)y) * (size_t)size.x;
}

#endif
