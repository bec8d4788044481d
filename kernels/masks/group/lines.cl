// Along y and z on GPUs: of each place of a line the nearest SITE, a row or slice that has marks. 16 neighbouring lines
// are taken together, a STRIP, and BAND places of each by a work-group, some items for each line.
//
// All nearest sites of a place lie between any nearest one of an earlier place and any of a later one (lines.cl). So
// the last places of a band and of the one before look outward; then three places between them, the MIDDLES, are
// compared with the sites between those of the two ends, and so on: each level has the middles of the GAPS that the
// last one left.
//
// Gaps may have sites by the hundred, or one. At each level the items of a line share all that is to be compared
// evenly: the sites of the first gap, then those of the next, which begin with the last one of the first. An item may
// take a part of a gap, or several gaps. A gap belongs to the item that takes its last site; what others found of it
// stands in local memory.
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
#define NO_SITE (-(1 << 20))
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

// The number of a site, or of the one that it is an image of.
INLINE int number_of(const line_t* l, int site) {
  return site < 0 ? site + l->size : site >= l->size ? site - l->size : site;
}

INLINE uint place_in_images(const line_t* l, int number) { return l->first + (uint)number * l->stride; }

// The part of the squared distance of a site's mark that is not along the line; MOST_SQUARED if it has none.
INLINE squares across_to(const line_t* l, const bool along_z, global const short* columns, global const int* between,
                         int number) {
  const uint at = place_in_images(l, number);
  const int known = along_z ? between[at] : columns[at], way_x = (short)known;
  const squares square = squared(way_x, l->square_x) + (along_z ? squared(known >> 16, l->square_y) : 0);
  return way_x == NO_WAY ? MOST_SQUARED : square;
}
INLINE squares distance_of(squares across, squares along) {
  return across == MOST_SQUARED ? MOST_SQUARED : across + along;
}

// The nearest one of the sites that were compared.
typedef struct {
  squares square;
  int site;
} nearest_site_t;

INLINE void compare(const line_t* l, nearest_site_t* n, squares square, int site) {
  const bool comes_first = number_of(l, site) < number_of(l, n->site);
  const bool wins = square < n->square || (square == n->square && comes_first);
  n->square = wins ? square : n->square;
  n->site = wins ? site : n->site;
}

// The nearest site of a place, of those whose way is `first`, or `step` more, and so on. It looks outward, until all
// that is left is strictly farther away than what it found, some ways at a time, whose loads wait together.
INLINE void find_nearest_of_all(const line_t* l, const bool along_z, global const short* columns,
                                global const int* between, int place, int first, int step, nearest_site_t* n) {
  n->square = MOST_SQUARED, n->site = NO_SITE;
#pragma unroll 1
  for (int k = first; k <= l->reach && squared(k, l->square) <= n->square; k += LOADS * step) {
    int sites[2 * LOADS];
    squares distances[2 * LOADS], least = MOST_SQUARED;
#pragma unroll
    for (int i = 0; i < 2 * LOADS; ++i) {
      const int way = min(k + i / 2 * step, l->reach);
      // That of an end is none the nearer for it.
      sites[i] = clamp(i % 2 == 0 ? place - way : place + way, l->least, l->most);
      const squares across = across_to(l, along_z, columns, between, number_of(l, sites[i]));
      distances[i] = distance_of(across, squared(way, l->square));
      least = min(least, distances[i]);
    }
    if (least == MOST_SQUARED || least > n->square) continue;  // as most are
#pragma unroll
    for (int i = 0; i < 2 * LOADS; ++i) compare(l, n, distances[i], sites[i]);
  }
}

// The same for the middles of a gap, in the order of sites: of those as near the first one counts.
INLINE void compare_middles(const line_t* l, nearest_site_t* n, squares across, int site, int way, int step) {
#pragma unroll
  for (int j = 0; j < MIDDLES; ++j) {
    const squares distance = distance_of(across, squared(way - j * step, l->square));
    n[j].site = distance < n[j].square ? site : n[j].site;
    n[j].square = min(distance, n[j].square);
  }
}

// Writes the site of a place.
INLINE void store_site(const line_t* l, const bool along_z, global const short* columns, global int* between,
                       global short* slices, int place, int site) {
  const uint at = place_in_images(l, place);
  const bool is_there = site != NO_SITE;
  if (along_z) {
    slices[at] = (short)(is_there ? site - place : NO_WAY);
  } else {
    const uint at_site = place_in_images(l, is_there ? number_of(l, site) : place);
    between[at] = is_there ? (site - place) << 16 | (ushort)columns[at_site] : (ushort)NO_WAY;
  }
}

// What a work-group shares.
typedef struct {
  int sites[(BAND + 1) * STRIP];                   // see slot_of()
  int gap[MOST_OF_BAND];                          // of each item the last gap that it had a part of, and ...
  nearest_site_t nearest[MIDDLES][MOST_OF_BAND];  // ... what it found for the places in its middle
} band_t;

// Where the site of a place of the band stands: that of the last one behind all others, for places behind it are
// compared, too. (What is found for these is not read, and its squares may not fit.) Place 0 is the last one of the
// band before.
INLINE int slot_of(int place, int count) { return (place < count ? place : BAND) * STRIP; }

INLINE void find_along_lines(constant images_t* images, const bool along_z, global const short* columns,
                             global const int* known, global int* between, global short* slices, local band_t* b) {
  const images_t e = *images;
  const int size = along_z ? e.depth : e.height;
  const int strips = STRIPS_OF(e.width), bands = BANDS_OF(size);
  const int group = (int)get_group_id(0), bundle = group / strips, band = bundle % bands;
  const int id = (int)get_local_id(0), item = id / STRIP, items = (int)get_local_size(0) / STRIP;
  const int x = group % strips * STRIP + id % STRIP;
  const int before = band * BAND - 1, count = min(BAND, size - band * BAND);
  line_t l;
  set_line(&l, &e, along_z, min(x, e.width - 1), bundle / bands);
  local int* const sites = b->sites + id % STRIP;

  // Half of the items look for the site of each end.
  const int looking = items / 2, is_last = item / looking, place = before + is_last * count;
  if (place >= 0) {
    nearest_site_t n;
    find_nearest_of_all(&l, along_z, columns, known, place, item % looking, looking, &n);
    b->nearest[0][id] = n;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (item % looking == 0) {
    nearest_site_t n = {MOST_SQUARED, NO_SITE};
    for (int i = id; i < id + looking * STRIP; i += STRIP) {
      compare(&l, &n, b->nearest[0][i].square, b->nearest[0][i].site);
    }
    sites[is_last * BAND * STRIP] = place < 0 ? l.least : n.site;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  const int low = sites[0];
  const bool none = sites[BAND * STRIP] == NO_SITE;

#pragma unroll 1
  for (int shift = LOG_BAND; shift > 0; shift -= 2) {
    const int wide = 1 << shift, step = wide / (MIDDLES + 1), gaps = (count - 1 + MIDDLES * step) >> shift;
    const int all = none ? 0 : sites[slot_of(gaps * wide, count)] - low + gaps, part = (all + items - 1) / items;
    const int begin = part * item, end = min(begin + part, all);
    int gap = 0;
    for (int far = BAND / 2; far >= wide; far /= 2) {
      const int next = gap + far;
      if (next < gaps * wide && sites[next * STRIP] - low + (next >> shift) <= begin) gap = next;
    }
    int site = low + begin - (gap >> shift), last = sites[slot_of(gap + wide, count)], own = -1;
    int image = site < 0 ? -size : site < size ? 0 : size;  // the first site in it
    nearest_site_t n[MIDDLES];
    squares square[MIDDLES];  // of its first gap
#pragma unroll
    for (int j = 0; j < MIDDLES; ++j) n[j].square = MOST_SQUARED, n[j].site = NO_SITE;
#pragma unroll 1
    for (int i = begin; i < end; ++i) {
      const int first = before + gap + step;
      // Loads take long, and those of several sites wait together.
      if (site + LOADS <= min(last, image + size - 1) && i + LOADS < end) {
        squares across[LOADS];
#pragma unroll
        for (int k = 0; k < LOADS; ++k) across[k] = across_to(&l, along_z, columns, known, site + k - image);
#pragma unroll
        for (int k = 0; k < LOADS; ++k) compare_middles(&l, n, across[k], site + k, site + k - first, step);
        site += LOADS, i += LOADS;
      }
      const squares across = across_to(&l, along_z, columns, known, site - image);
      compare_middles(&l, n, across, site, site - first, step);
      if (site == last) {
#pragma unroll
        for (int j = 0; j < MIDDLES; ++j) {
          if (own < 0) square[j] = n[j].square - (n[j].site < image);
          sites[(gap + (j + 1) * step) * STRIP] = n[j].site;
          n[j].square = MOST_SQUARED, n[j].site = NO_SITE;
        }
        if (own < 0) own = gap;
        gap += wide;
        last = sites[slot_of(gap + wide, count)];
      } else if (++site == image + size) {
        // What is as near in the next image has a lesser number.
#pragma unroll
        for (int j = 0; j < MIDDLES; ++j) n[j].square += n[j].site >= image;
        image += size;
      }
    }
#pragma unroll
    for (int j = 0; j < MIDDLES; ++j) {
      b->nearest[j][id].square = n[j].square - (n[j].site < image);
      b->nearest[j][id].site = n[j].site;
    }
    b->gap[id] = gap;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (own >= 0) {
      for (int i = id - STRIP; i >= 0 && b->gap[i] == own; i -= STRIP) {
#pragma unroll
        for (int j = 0; j < MIDDLES; ++j) {
          local int* const middle = sites + (own + (j + 1) * step) * STRIP;
          nearest_site_t found = {square[j], *middle};
          compare(&l, &found, b->nearest[j][i].square, b->nearest[j][i].site);
          square[j] = found.square;
          *middle = found.site;
        }
      }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  for (int i = item + 1; i <= count && x < e.width; i += items) {
    store_site(&l, along_z, columns, between, slices, before + i, none ? NO_SITE : sites[slot_of(i, count)]);
  }
}

#endif
