// The index of the seeds: where seeds are, one bit per pixel, and a list of the seeds bin by bin. index.cl makes it.

#ifndef VOROCL_EXACT_GROUP_SEED_INDEX
#define VOROCL_EXACT_GROUP_SEED_INDEX

#include "exact/group/sizes.cl"
#include "core/position.cl"

// THE FRAME. Along a periodic axis the index covers a margin more at both ends, where the seeds of the other end stand
// once more: their images. (In a short period there are several of a seed.) The margin is longer than half a period:
// the image that is nearest to a pixel is in the frame. Positions and bins count from the frame's corner.
static inline int margin_x(int width) { return PERIODIC_X * MARGIN(width); }
static inline int margin_y(int height) { return PERIODIC_Y * MARGIN(height); }
static inline int frame_width(int width) { return width + 2 * margin_x(width); }
static inline int frame_height(int height) { return height + 2 * margin_y(height); }

// All images of a position in the frame, and the seed itself.
static inline int first_image(int at, int size, int margin) {
  return at + margin < size ? at + margin : (at + margin) % size;  // a division takes long, and few seeds need it
}
#define FOR_EACH_IMAGE(x, y, position, width, height)                                                               \
  for (int y = first_image(packed_y(position), height, margin_y(height)); y < frame_height(height); y += height)    \
    for (int x = first_image(packed_x(position), width, margin_x(width)); x < frame_width(width); x += width)

// THE BINS. Level 0 is the index itself; each bin of a higher level holds FAN x FAN bins of the level below.
#define BIN (1 << BIN_BITS)
#define FAN (1 << FAN_BITS)

static inline int bin_bits(int level) { return BIN_BITS + FAN_BITS * level; }
static inline int bins_along(int pixels, int level) { return ((pixels - 1) >> bin_bits(level)) + 1; }
static inline int columns_of(int width, int level) { return bins_along(frame_width(width), level); }
static inline int rows_of(int height, int level) { return bins_along(frame_height(height), level); }

// THE BITS. A bit per pixel says whether there is a seed; the bits of a bin stand together, row-major, one bin after
// the other. This is the index of a pixel's bit, for a number or a vector.
#define BIT_INDEX(pixel, columns)                                                                             \
  (((((pixel) >> (16 + BIN_BITS)) * (uint)(columns) + (((pixel) & 0xffffu) >> BIN_BITS)) << 2 * BIN_BITS) + \
   (((pixel) >> 16 & (BIN - 1)) << BIN_BITS) + ((pixel) & (BIN - 1)))

#define WORDS (BIN * BIN / 32)    // of a bin's bits
#define ROWS_OF_WORD (32 / BIN)
#if 32 % BIN != 0 || BIN * BIN % 32 != 0
#error "The bits of a bin are not whole rows in whole words"
#endif

// The seeds in a row of a bin, given the word that holds it: a bit each, the lowest bit at the left.
#define ALL_BITS ((1u << BIN) - 1)
static inline uint row_bits(uint word, int y) { return word >> y % ROWS_OF_WORD * BIN & ALL_BITS; }

// THE LIST. The seeds of each bin stand in it together, row-major, without those that share a pixel; the bins of a
// row of bins follow each other. `starts` says where a bin's seeds begin, `word_starts` where those of each word of
// its bits do. So a seed's index in the list follows from its position: a bit vector with rank.
static inline uint list_index(global const uint* bits, global const uint* word_starts, uint bit) {
  const uint word = bit / 32;
  return word_starts[word] + popcount(bits[word] & ((1u << bit % 32) - 1));
}

// A row of bins has one start more than bins: where its last bin ends.
static inline int start_of(int bin_x, int bin_y, int columns) { return bin_y * (columns + 1) + bin_x; }

typedef struct {
  int width, height;  // of the grid, in pixels
  int columns, rows;  // of the frame, in bins of level 0
  int x0, y0;         // where the grid's first pixel is, in the coordinates of seeds and boxes
  global const uint *bits, *starts, *word_starts;
  global const uint *list, *ids;  // the seeds' positions and ids
} SeedIndex;

// The first parameters of every kernel that reads the index, and the index that they make.
#define SEED_INDEX_PARAMETERS                                                                                       \
  global const uint *restrict bits, global const uint *restrict starts, global const uint *restrict word_starts, \
      global const uint *restrict list, global const uint *restrict ids, int width, int height
#define SEED_INDEX_OF_PARAMETERS \
  {width,       height, columns_of(width, 0), rows_of(height, 0), margin_x(width), margin_y(height), bits, starts, \
   word_starts, list,   ids}

// Where the first pixel of a period is among `count` pixels of the frame from `first` on; `none` if it is not.
static inline int first_of_period(int first, int count, int start, int period, int none) {
  const int near_start = start - first, near_end = start + period - first;
  if (near_start >= 0 && near_start < count) return near_start;
  return near_end >= 0 && near_end < count ? near_end : none;
}

// The id of a seed at a position in the frame.
static inline uint id_of(const SeedIndex* index, uint seed) {
  return index->ids[list_index(index->bits, index->word_starts, BIT_INDEX(seed, index->columns))];
}

// The seeds of the bins from (first_x, y) to (last_x, y), as far as these are in the grid.
static inline uint count_seeds(const SeedIndex* index, int first_x, int last_x, int y) {
  if (y < 0 || y >= index->rows) return 0;
  const int end = start_of(min(last_x + 1, index->columns), y, index->columns);
  return index->starts[end] - index->starts[start_of(max(first_x, 0), y, index->columns)];
}

// THE PYRAMID. For each bin of every level one of its seeds, its representative, or EMPTY. The representative's bit
// MORE says that it is not the bin's only seed. The levels are row-major, the finest one first.
#define MORE 0x8000u
#if MORE <= LAST_COORDINATE
#error "MORE is a bit of a coordinate"
#endif

// Where a level begins in the pyramid.
static inline int level_start(int width, int height, int level) {
  int start = 0;
  for (int i = 0; i < level; ++i) start += columns_of(width, i) * rows_of(height, i);
  return start;
}

#endif
