// Sizes of the exact engine's group shape, for its kernels and for the host that launches them. Only speed and memory
// depend on them. (Lengths of lists can be build options.)

#ifndef VOROCL_EXACT_GROUP_SIZES
#define VOROCL_EXACT_GROUP_SIZES

// A bin is a square of pixels in the index of the seeds. The sides of a bin of level 0 in pixels, and of a bin of a
// higher level in bins of the level below, as powers of two.
#define BIN_BITS 4
#define FAN_BITS 2

// The top of the pyramid has at most so many bins.
#define TOP_BINS 64

// Along a periodic axis the index has so many pixels more, at both ends: more than half a period.
#define MARGIN(period) ((((period) / 2 >> BIN_BITS) + 1) << BIN_BITS)

// While the index is made, counters stand behind its bits and are cleared with them.
#define COUNTERS 2
#define DUPLICATE_COUNT 0  // of seeds on a pixel that has one
#define LIST_END 1         // of those parts of the list that are given away

// How far rows are looked at for seeds: up to so many pixels away along each axis.
#define REACH ((1 << BIN_BITS) - 1)

// The longest period whose images the index holds: it has all of it twice, and its coordinates have 15 bits.
#define MOST_PERIOD_OF_GROUPS 16000

// A patch is a square of pixels that a work-group labels, 2 x 2 bins. Its side in pixels, as a power of two.
#define PATCH_BITS 5
#if PATCH_BITS != BIN_BITS + 1
#error "The row masks of a patch hold its two bins and the one on each side"
#endif

// A work-group has 32, 64, 128 or 256 items: whole rows of a patch.
#define MOST_ITEMS 256

// A patch with so many seeds in its bins and those at its left and right is first tried by rows. Measured in simulated
// warps: at about 100 pixels per seed rows and lists take the same number of instructions.
#define DENSE_AROUND 20

// In a period that is shorter than a patch's surroundings nothing is tried by rows: see DENSE.
#ifdef VOROCL_SHORT_PERIOD
#undef DENSE_AROUND
#define DENSE_AROUND 0x7fffffff
#endif

// Lists of one patch: seeds that the nearest known one does not dominate, and candidates that are ranked at a time.
#ifndef MOST_GATHERED
#define MOST_GATHERED 256
#endif
#ifndef MOST_RANKED
#define MOST_RANKED 128
#endif

// A patch whose window holds more seeds is left to the search.
#define MOST_SCANNED 4096

// The descent to a seed near the patch looks at no more bins of a level.
#define MOST_LOOKED_AT 256

// Bins and rows of bins that the search has yet to open.
#ifndef STACK
#define STACK 512
#endif

#endif
