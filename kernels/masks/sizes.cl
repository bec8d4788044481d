// Sizes of the mask engine, for its kernels and for the host that makes their buffers.

#ifndef VOROCL_MASKS_SIZES
#define VOROCL_MASKS_SIZES

// Lines are taken so many at a time: neighbours along x.
#define STRIP 16

// How many places around it a place looks at before divide and conquer takes it; the absent sites behind both ends of a
// line that this needs.
#define NEAR 4
#define PAD 8

// After a place that is far, so many are left out: those around it are mostly far, too.
#define SKIPPED 3

// Comparisons of a run of places, for each place and site of it, after which lanes are taken one by one (lines.cl).
#ifndef MOST_COMPARISONS
#define MOST_COMPARISONS 64
#endif

// The nearest columns of the rows of a strip stand together. (Not a power of two, for the sake of the caches.)
#define SHORTS_OF_STRIP(rows) ((rows) * STRIP + 32)
#define STRIPS_OF(width) (((width) + STRIP - 1) / STRIP)

// The marks of a row begin with a word of 64 pixels, whose rank is known.
#define SHORTS_OF_ROW(width) (((width) + 63) / 64 * 4)

// Costs are tabulated from -REACH_OF_COSTS(size) to REACH_OF_COSTS(size) places away.
#define REACH_OF_COSTS(size) (2 * (size) + PAD)
#define COSTS(size) (2 * REACH_OF_COSTS(size) + 1)

// Along z a row of so many strips is read and written together: slices lie far apart, and memory gives lines of the
// cache that lie beside each other in half the time. Images that are higher or deeper are taken strip by strip: working
// memory would leave the caches.
#define MOST_AT_ONCE 4
#define LONGEST_AT_ONCE 1024

// What a work-item remembers of lines of so many places, in vectors of keys or of whole numbers (lines.cl): the
// sites' keys, with images along a periodic line; of each strip of a row the least key of each place, what the sites
// carry, and what the places find; and for each place the ends of the sites that are tried, the number of a site in the
// list of sites, the list, and where these are.
#define KEYS_OF_LINE(longest) (2 * ((longest) + PAD))
#define CARRIED_BY_LINE(longest) ((longest) + PAD + PAD)
#define INTS_OF_LINE(longest) (8 * (longest) + 64)
#define VECTORS_OF_KEYS(longest, strips) (KEYS_OF_LINE(longest) + (strips) * (longest))
#define VECTORS_OF_INTS(longest, strips) \
  ((strips) * (CARRIED_BY_LINE(longest) + (longest)) + INTS_OF_LINE(longest) / STRIP + 1)

// In the group shape: places of a line that a work-group takes, a BAND; how many of them divide a gap; the most items
// of the group; of how many sites an item loads at a time what is known. The most items that sum counts.
#define LOG_BAND 6
#define BAND (1 << LOG_BAND)
#define MIDDLES 3
#define MOST_OF_BAND 64
#define LOADS 2
#define BANDS_OF(size) (((size) + BAND - 1) / BAND)
#define MOST_SUMMING 256

// What a transform writes, a bit each.
#define WANTS_SQUARES 1
#define WANTS_FLOATS 2
#define WANTS_DOUBLES 4
#define WANTS_INDICES 8
#define WANTS_PLACES 16
#define WANTS_RANKS 32
#define WANTS_VALUES 64

// What passes carry from mark to pixel besides the distance: nothing, where the mark is, or its label.
#define CARRIES_NOTHING 0
#define CARRIES_PLACES 1
#define CARRIES_LABELS 2

// What kernels know of images. Squared lengths are whole numbers. `most_...`: ways of so many pixels have the greatest
// part of a distance that keys hold.
#ifdef __OPENCL_C_VERSION__
typedef int cl_int;
typedef uint cl_uint;
typedef long cl_long;
typedef float cl_float;
#endif
typedef struct {
  cl_long square_x, square_y, square_z;
  cl_long limit_y, limit_z;            // of distances in keys
  cl_long length_x, length_y, length_z;  // of a pixel: the bits of doubles
  cl_long farthest;                    // squared; a mark that is farther is none
  cl_long longest_length;              // the bits of a double; so is one that is farther than this, if ...
  cl_float float_x, float_y, float_z;  // the lengths
  cl_int width, height, depth, longest;
  cl_int strips_at_once;               // along z
  cl_int period_x, period_y, period_z;  // as many pixels, or 0
  cl_int bits_y, bits_z, saturates_y, saturates_z;
  cl_int most_x_of_y, most_x_of_z, most_y_of_z;
  cl_int limits_lengths;               // ... this is set
  cl_int is_unit;                      // the lengths are 1
  cl_int is_volume, wanted, carried, bytes_of_value;
  cl_uint factor_of_width, factor_of_height;  // see DIVIDE
  cl_int shift_of_width, shift_of_height;
} images_t;

// A number below 2^31 / a side, by a product: 2^s is the side or the next power of two, and the factor is
// 2^(31 + s) / side, rounded up. (Work-items of GPUs divide in some 20 instructions.)
#define DIVIDE(number, factor, shift) (mul_hi(2 * (number), factor) >> (shift))

#endif
