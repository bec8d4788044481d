// Along y and z on GPUs: of each place of a line the nearest SITE, a row or slice that has marks. 16 neighbouring lines
// are taken together, a STRIP, and BAND places of each by a work-group.
//
// All nearest sites of a place lie between any nearest one of an earlier place and any of a later one (lines.cl). So
// the last place of each band looks at all sites, then the middle one of a band at those between the sites of the two
// ends, and so on: each level has the middles of the gaps that the last one left.
//
// Along a periodic line sites have IMAGES for half a period beyond both ends. Of sites as near the one with the lesser
// number in the period counts. Of the lines of a slice, or of the volume, all have a site or none has.
//
// What is known is the WAY to a mark: along x, of a row, in `columns`; along y and x, of a slice, in `between`, as
// y << 16 | x; along z in `slices`. NO_WAY says that there is none.

#ifndef VOROCL_MASKS_GROUP_LINES
#define VOROCL_MASKS_GROUP_LINES

#define VOROCL_ONE_LANE
#include "masks/lanes.cl"

#define NO_WAY (-0x8000)  // along x or z
#define NO_SITE (1 << 20)
#ifdef VOROCL_FAR
#define MOST_SQUARED LONG_MAX
#else
#define MOST_SQUARED UINT_MAX
#endif

typedef struct {
  int size, reach;     // places; how far from a place its nearest site may be
  int least, most;     // sites, with images
  uint first, stride;  // of the places, in images
  squares square;      // of a way of 1
  squares square_x, square_y;
} line_t;

INLINE void set_line(line_t* l, const images_t* e, const bool along_z, int x, int other) {
  const int period = along_z ? e->period_z : e->period_y;
  l->size = along_z ? e->depth : e->height;
  l->reach = period != 0 ? period / 2 : l->size - 1;
  l->least = period != 0 ? -l->reach : 0;
  l->most = l->size - 1 - l->least;
  const uint of_slice = (uint)e->width * (uint)e->height;
  l->first = (uint)x + (uint)other * (along_z ? (uint)e->width : of_slice);
  l->stride = along_z ? of_slice : (uint)e->width;
  l->square = (squares)(along_z ? e->square_z : e->square_y);
  l->square_x = (squares)e->square_x;
  l->square_y = (squares)e->square_y;
}

INLINE squares squared(int way, squares square) { return (squares)way * (squares)way * square; }

// Where a site stands in images, or the one that it is an image of.
INLINE uint place_of_site(const line_t* l, int site) {
  const int number = site < 0 ? site + l->size : site >= l->size ? site - l->size : site;
  return l->first + (uint)number * l->stride;
}

// The squared distance of the mark of a site that lies so far along the line; MOST_SQUARED if it has none.
INLINE squares distance_to(const line_t* l, const bool along_z, global const short* columns,
                           global const int* between, uint at, squares along) {
  const int known = along_z ? between[at] : columns[at], way_x = (short)known;
  squares distance = along + squared(way_x, l->square_x);
  if (along_z) distance += squared(known >> 16, l->square_y);
  return way_x == NO_WAY ? MOST_SQUARED : distance;
}

// The nearest site of a place; NO_SITE if none has marks. It looks outward, until all that is left is strictly farther
// away than what it found.
INLINE int nearest_of_all(const line_t* l, const bool along_z, global const short* columns,
                          global const int* between, int place) {
  squares best = MOST_SQUARED;
  int found = NO_SITE;
  uint at_found = 0;
  for (int k = 0; k <= l->reach; ++k) {
    const squares along = squared(k, l->square);
    if (along > best) break;
#pragma unroll
    for (int side = -1; side <= 1; side += 2) {
      const int site = clamp(place + side * k, l->least, l->most);  // that of an end is none the nearer for it
      const uint at = place_of_site(l, site);
      const squares distance = distance_to(l, along_z, columns, between, at, along);
      const bool wins = (distance < best) | ((distance == best) & (at < at_found));
      best = wins ? distance : best;
      found = wins ? site : found;
      at_found = wins ? at : at_found;
    }
  }
  return found;
}

// The same of the sites from `low` to `high`, in the order of their numbers. No nearest one is beyond `reach`, nor
// does a square of such a way fit.
INLINE int nearest_of_some(const line_t* l, const bool along_z, global const short* columns,
                           global const int* between, int place, int low, int high) {
  if (low == high) return low;
  low = max(low, place - l->reach), high = min(high, place + l->reach);
  squares best = MOST_SQUARED;
  int found = low;
  for (int image = high >= l->size; image >= -(low < 0); --image) {
    int site = max(low, image * l->size);
    const int last = min(high, image * l->size + l->size - 1), way = site - place;
    uint at = l->first + (uint)(site - image * l->size) * l->stride;
    squares along = squared(way, l->square), more = (squares)(2 * way + 1) * l->square;
#pragma unroll 1
    for (; site <= last; ++site, at += l->stride) {
      const squares distance = distance_to(l, along_z, columns, between, at, along);
      found = distance < best ? site : found;
      best = min(best, distance);
      along += more;
      more += 2 * l->square;
    }
  }
  return found;
}

// Writes the site of a place.
INLINE void store_site(const line_t* l, const bool along_z, global const short* columns, global int* between,
                       global short* slices, int place, int site) {
  const uint at = l->first + (uint)place * l->stride;
  const bool is_there = site != NO_SITE;
  if (along_z) {
    slices[at] = (short)(is_there ? site - place : NO_WAY);
  } else {
    between[at] = is_there ? (site - place) << 16 | (ushort)columns[place_of_site(l, site)] : (ushort)NO_WAY;
  }
}

// The site that was written.
INLINE int site_at(const line_t* l, const bool along_z, global const int* between, global const short* slices,
                   int place) {
  const uint at = l->first + (uint)place * l->stride;
  const int known = along_z ? slices[at] : between[at];
  if ((short)known == NO_WAY) return NO_SITE;
  return place + (along_z ? known : known >> 16);
}

INLINE int places_of_band(int band, int size) { return min(BAND, size - band * BAND); }

// Of the last places of bands, an item each.
INLINE void find_ends(global const images_t* images, const bool along_z, global const short* columns,
                      global const int* known, global int* between, global short* slices) {
  const images_t e = *images;
  const uint item = (uint)get_global_id(0), bundle = item / (uint)e.width;
  const int size = along_z ? e.depth : e.height;
  const uint bands = (uint)BANDS_OF(size), others = (uint)(along_z ? e.height : e.depth);
  if (bundle >= bands * others) return;
  line_t l;
  set_line(&l, &e, along_z, (int)(item % (uint)e.width), (int)(bundle / bands));
  const int band = (int)(bundle % bands), place = band * BAND + places_of_band(band, size) - 1;
  store_site(&l, along_z, columns, between, slices, place, nearest_of_all(&l, along_z, columns, known, place));
}

// Of all others. `sites`: those of the places of a work-group, from the last one of the band before on.
INLINE void find_between_ends(global const images_t* images, const bool along_z, global const short* columns,
                              global const int* known, global int* between, global short* slices, local int* sites) {
  const images_t e = *images;
  const int size = along_z ? e.depth : e.height;
  const int strips = STRIPS_OF(e.width), bands = BANDS_OF(size);
  const int group = (int)get_group_id(0), bundle = group / strips, band = bundle % bands;
  const int lane = (int)get_local_id(0) % STRIP, item = (int)get_local_id(0) / STRIP;
  const int items = (int)get_local_size(0) / STRIP, x = group % strips * STRIP + lane;
  const int before = band * BAND - 1, count = places_of_band(band, size);
  line_t l;
  set_line(&l, &e, along_z, min(x, e.width - 1), bundle / bands);
  local int* const own = sites + lane;
  if (item == 0) {
    const int end = site_at(&l, along_z, between, slices, before + count);
    own[count * STRIP] = end;
    own[0] = band > 0 ? site_at(&l, along_z, between, slices, before) : end == NO_SITE ? NO_SITE : l.least;
  }
#pragma unroll 1
  for (int step = BAND / 2; step > 0; step /= 2) {
    barrier(CLK_LOCAL_MEM_FENCE);
#pragma unroll 1
    for (int i = step * (2 * item + 1); i < count; i += 2 * step * items) {
      const int site = nearest_of_some(&l, along_z, columns, known, before + i, own[(i - step) * STRIP],
                                       own[min(i + step, count) * STRIP]);
      own[i * STRIP] = site;
      if (x < e.width) store_site(&l, along_z, columns, between, slices, before + i, site);
    }
  }
}

#endif
