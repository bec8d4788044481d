// Sizes and limits of the exact engine, for its kernels and for the host that makes their buffers.

#ifndef VOROCL_EXACT_SIZES
#define VOROCL_EXACT_SIZES

// A bin is a square of pixels in the index of the seeds. The sides of a bin of level 0 in pixels, and of a bin of a
// higher level in bins of the level below, as powers of two.
#define BIN_BITS 4
#define FAN_BITS 2

// Bins of level 0 that are labelled together, one above the other: so many bits say which of them are labelled.
#define PAIR 2

// Lists of candidates are made for tiles, the bins of level 1, from those of regions, the bins of level 2.
#define TILE 1
#define REGION 2
#if (1 << FAN_BITS) % PAIR != 0
#error "A pair of bins does not lie in one tile"
#endif

// The top of the pyramid has at most so many bins.
#define TOP_BINS 64

// Bins are labelled by seeds in bins up to so many away.
#define MOST_AWAY 2

// Along a periodic axis the index has so many pixels more, at both ends: all that is looked at without a thought of
// periods. The vector shape searches images of bins for what is farther away; the group shape has no other images than
// those of the index, and so a margin of more than half a period.
#define MARGIN_OF_VECTORS (MOST_AWAY << BIN_BITS)
#define MARGIN_OF_GROUPS(period) ((((period) / 2 >> BIN_BITS) + 1) << BIN_BITS)

// While the index is made, counters stand behind its bits and are cleared with them.
#define COUNTERS 2
#define DUPLICATE_COUNT 0  // of seeds on a pixel that has one
#define LIST_END 1         // of those parts of the list that are given away

// How many bins are refined at a time, and how many seeds fill a list: only speed and memory depend on them. (As all
// lengths of lists, they can be build options; the buffers of lists have room for these.)
#ifndef MOST_PARENTS
#define MOST_PARENTS 64
#endif
#ifndef MOST_CANDIDATES
#define MOST_CANDIDATES 1024
#endif

// WHO LABELS A BIN. By the number of seeds near its pair, in its two bins and the ten around them: a pair with less
// than SPARSE is left to label_far, because its candidates are seldom near; one with less than MEDIUM is labelled as a
// whole, of another each bin by itself. Measured: at these numbers the two ways take the same time.
#define SPARSE 5
#define MEDIUM 24

// Where the group shape looks along rows for seeds: up to so many pixels away along each axis.
#define REACH ((1 << BIN_BITS) - 1)

// Of a bin with CROWDED seeds or more only some seeds can be candidates elsewhere, and in the bin itself only some can
// be candidates for pixels without a seed: see collect.cl. The others label their own pixels.
#define CROWDED 160

// A region of more seeds gets no list: its tiles search for themselves.
#define MOST_OF_REGION 64

// SEEDS OUTSIDE THE PIXELS (see outer.cl). The side of the boxes that have a list of them, as a power of two; the
// entries of a list; how many seeds or boxes a node of their tree holds, as a power of two.
#define OUTER_BOX_BITS 4
#define OUTER_BOX (1 << OUTER_BOX_BITS)
#define OUTER_FAN_BITS 3
#define OUTER_FAN (1 << OUTER_FAN_BITS)
#ifndef OUTER_LIST
#define OUTER_LIST 32
#endif
#if OUTER_LIST < OUTER_FAN
#error "A list has no room for one leaf, from which a walk could go on"
#endif

#endif
