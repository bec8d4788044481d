// Images of seeds across the ends of periodic axes, and the places where they lie.
//
// Along a periodic axis a seed has images, a period before and behind it, and the candidates of a box are images: it
// may have two of one seed. They are seeds like others to all proofs, for the nearest image is as far as the shorter
// way round. Their places are coordinates that start half a period before the volume (MARGIN_X and so on, 0 along other
// axes), packed as positions are; an image that is farther from all voxels is none. Boxes are in places.

#ifndef VOROCL_VOLUMES_IMAGES
#define VOROCL_VOLUMES_IMAGES

#include "volumes/index.cl"

#define MARGIN_X(e) (PERIODIC_X ? (e).width / 2 : 0)
#define MARGIN_Y(e) (PERIODIC_Y ? (e).height / 2 : 0)
#define MARGIN_Z(e) (PERIODIC_Z ? (e).depth / 2 : 0)

typedef struct {
  int x, y, z;     // the first corner
  int hx, hy, hz;  // from it to the last corner
} box_t;

// What is added to positions for the places of an image. Images have numbers: a digit of base 3 for each axis, of which
// 1 is the seed itself.
typedef struct {
  int x, y, z;
} image_t;
#ifdef VOROCL_PERIODIC
#define FIRST_IMAGE 0u
#define LAST_IMAGE 26u
#else
#define FIRST_IMAGE 13u
#define LAST_IMAGE 13u
#endif

// The same of 8 images.
typedef struct {
  iv x, y, z;
} images_t;

static inline images_t images_of(extent_t e, uv numbers) {
  const images_t images = {as_int8(numbers % 3 - 1) * e.width + MARGIN_X(e),
                           as_int8(numbers / 3 % 3 - 1) * e.height + MARGIN_Y(e),
                           as_int8(numbers / 9 - 1) * e.depth + MARGIN_Z(e)};
  return images;
}
static inline image_t image_of(extent_t e, uint number) {
  const image_t image = {((int)(number % 3) - 1) * e.width + MARGIN_X(e),
                         ((int)(number / 3 % 3) - 1) * e.height + MARGIN_Y(e),
                         ((int)(number / 9) - 1) * e.depth + MARGIN_Z(e)};
  return image;
}

// Whether the image before (digit 0) or behind (2) is the nearest one of some seed to some voxel of a box, along an
// axis.
static inline bool has_near_image(uint digit, int first, int h, int size, int periodic) {
  const int at = first - size / 2;  // the box's first voxel in the volume
  return digit == 1 || (periodic && (digit == 0 ? 2 * at < size : 2 * (at + h) >= size));
}
static inline bool is_near_image(extent_t e, box_t b, uint number) {
  return has_near_image(number % 3, b.x, b.hx, e.width, PERIODIC_X) &&
         has_near_image(number / 3 % 3, b.y, b.hy, e.height, PERIODIC_Y) &&
         has_near_image(number / 9, b.z, b.hz, e.depth, PERIODIC_Z);
}

static inline iv is_empty(uv seeds) { return as_int8(seeds) < 0; }

// The places of images of seeds; EMPTY where there is none.
static inline uv places_of(extent_t e, images_t images, uv seeds) {
#ifdef VOROCL_PERIODIC
  const iv x = xs_of(seeds) + images.x, y = ys_of(seeds) + images.y, z = zs_of(seeds) + images.z;
  const iv none = is_empty(seeds) | (x < 0) | (y < 0) | (z < 0) | (x >= e.width + 2 * MARGIN_X(e)) |
                  (y >= e.height + 2 * MARGIN_Y(e)) | (z >= e.depth + 2 * MARGIN_Z(e));
  return select(as_uint8(z) << SHIFT_Z | as_uint8(y) << VOROCL_BITS_X | as_uint8(x), (uv)EMPTY, none);
#else
  (void)e, (void)images;
  return seeds;
#endif
}

// The same of the boxes of nodes, cut at the ends of the places.
static inline void place_boxes(extent_t e, images_t images, uv* low, uv* high) {
#ifdef VOROCL_PERIODIC
  const iv lx = max(xs_of(*low) + images.x, (iv)0);
  const iv hx = min(xs_of(*high) + images.x, (iv)(e.width + 2 * MARGIN_X(e) - 1));
  const iv ly = max(ys_of(*low) + images.y, (iv)0);
  const iv hy = min(ys_of(*high) + images.y, (iv)(e.height + 2 * MARGIN_Y(e) - 1));
  const iv lz = max(zs_of(*low) + images.z, (iv)0);
  const iv hz = min(zs_of(*high) + images.z, (iv)(e.depth + 2 * MARGIN_Z(e) - 1));
  const iv none = is_empty(*low) | (lx > hx) | (ly > hy) | (lz > hz);
  *low = select(as_uint8(lz) << SHIFT_Z | as_uint8(ly) << VOROCL_BITS_X | as_uint8(lx), (uv)EMPTY, none);
  *high = select(as_uint8(hz) << SHIFT_Z | as_uint8(hy) << VOROCL_BITS_X | as_uint8(hx), (uv)EMPTY, none);
#else
  (void)e, (void)images, (void)low, (void)high;
#endif
}

// The positions of the seeds whose images are at these places.
static inline uv positions_of(extent_t e, uv places) {
#ifdef VOROCL_PERIODIC
  iv x = xs_of(places) - MARGIN_X(e), y = ys_of(places) - MARGIN_Y(e), z = zs_of(places) - MARGIN_Z(e);
  x += select((iv)0, (iv)e.width, x < 0) - select((iv)0, (iv)e.width, x >= e.width);
  y += select((iv)0, (iv)e.height, y < 0) - select((iv)0, (iv)e.height, y >= e.height);
  z += select((iv)0, (iv)e.depth, z < 0) - select((iv)0, (iv)e.depth, z >= e.depth);
  return as_uint8(z) << SHIFT_Z | as_uint8(y) << VOROCL_BITS_X | as_uint8(x);
#else
  (void)e;
  return places;
#endif
}

// The entries of a search's lists: the number of an image, above a node's. Without periodic axes the node alone.
#ifdef VOROCL_PERIODIC
#define NODE_BITS 26  // there are at most 2^24 bins
#else
#define NODE_BITS 0
#endif
static inline uint entry_of(uint image, uint node) { return NODE_BITS == 0 ? node : image << NODE_BITS | node; }
static inline uint node_of(uint entry) { return NODE_BITS == 0 ? entry : entry & ((1u << NODE_BITS) - 1); }
static inline uint image_in(uint entry) { return NODE_BITS == 0 ? FIRST_IMAGE : entry >> NODE_BITS; }

#endif
