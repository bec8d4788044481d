// Labels by great circles, of grids of longitude and latitude.
//
// A seed is a direction v, three whole numbers of RADIUS units (3 mm of the Earth), and so is a pixel's centre p, which
// is made of a column and a row. The nearest seed is that of the least |p - v|^2, so of the greatest p.v - |v|^2 / 2,
// which 64 bits hold. (The greatest p.v would not do: rounded directions have unequal lengths.) All decisions are made
// by these numbers. Floats only say which seeds need not be looked at, with a margin.
//
// CANDIDATES. The pixels of a block lie in a ball around its middle c. A seed v is nearer than v0 to none of them if it
// is farther from c by enough: |v - c|^2 - |v0 - c|^2 > 2 r |v - v0|, for the left side changes by no more on the way
// from c to a pixel. With w = v - v0 and a = v0 - c half of the left side is w.a + |w|^2 / 2, which is exact to a
// float's digits however near the seeds lie to each other, and whose least over a box is a sum over the axes. So one
// walk through the tree of boxes finds the seeds that matter. Where they are more than a list holds, the block is
// halved.

#include "core/abi.cl"
#include "exact_cells/lanes.cl"
#include "globe/sizes.cl"

#define NO_LABEL 0xffffffffu
#define MOST_CANDIDATES 96
#define MOST_PARTS 12  // blocks that are halved and wait; of 16 x 16 pixels there are 8 halvings

// Of the seeds: the tree of their directions (src/exact_cells/sites.hpp), and by id the directions, (0, 0, 0) of one
// that is absent, and how far east they are.
#define GLOBE_PARAMETERS                                                                                     \
  uint count, global const int *restrict sites, global const int *restrict boxes, global const uint *restrict levels, \
      int top, global const uint *restrict ids, global const int4 *restrict directions
#define GLOBE_ARGUMENTS \
  { count, sites, boxes, levels, top, ids, directions }

typedef struct {
  uint count;
  global const int* sites;
  global const int* boxes;
  global const uint* levels;
  int top;
  global const uint* ids;
  global const int4* directions;
} globe_t;

// --- whole numbers ---

// Products of cosines of latitude, and cosines and sines of longitude.
static inline int scaled(int of_row, int of_column) {
  return (int)(((long)of_row * (long)of_column + (1L << 30)) >> 31);
}
static inline long8 scaled_8(int of_row, int8 of_columns) {
  return (convert_long8(of_columns) * (long)of_row + (1L << 30)) >> 31;
}

// Of pixels: the cosines of the columns and then the sines, with FAN more each, and of each row the cosine and z.
typedef struct {
  global const int* columns;
  global const int2* rows;
  int behind;  // the sines are so far behind the cosines
} pixels_t;

static inline int4 direction_of(const pixels_t* pixels, int x, int y) {
  const int2 row = pixels->rows[y];
  return (int4)(scaled(row.s0, pixels->columns[x]), scaled(row.s0, pixels->columns[x + pixels->behind]), row.s1, 0);
}

static inline int4 direction_at(const globe_t* globe, uint site) {
  const size_t at = (size_t)(site >> FAN_BITS) * (3 * FAN) + (site & (FAN - 1));
  return (int4)(globe->sites[at], globe->sites[at + FAN], globe->sites[at + 2 * FAN], 0);
}

static inline long dot_of(int4 p, int4 v) {
  return (long)p.s0 * (long)v.s0 + (long)p.s1 * (long)v.s1 + (long)p.s2 * (long)v.s2;
}

static inline long half_square(int4 v) { return dot_of(v, v) >> 1; }

// Which of two seeds at one distance has a pixel: the northern one, then the western one, then the lowest id.
static inline bool comes_first(const globe_t* globe, uint a, uint b) {
  const uint id_a = globe->ids[a], id_b = globe->ids[b];
  const int4 at_a = globe->directions[id_a], at_b = globe->directions[id_b];
  if (at_a.s2 != at_b.s2) return at_a.s2 > at_b.s2;
  return at_a.s3 != at_b.s3 ? at_a.s3 < at_b.s3 : id_a < id_b;
}

// --- floats ---

// From one coordinate to eight others. Those that are far off may be more than 32 bits away.
static inline float8 ways_to(int8 to, int from) {
  const float8 roughly = convert_float8(to) - convert_float(from);
  const float8 exactly = convert_float8(as_int8(as_uint8(to) - (uint)from));
  return select(roughly, exactly, fabs(roughly) < (float8)0x1p30f);
}

static inline float way_to(int to, int from) { return ways_to((int8)to, from).s0; }

typedef struct {
  int4 middle, best;  // c and v0
  float ax, ay, az;   // a, and its length
  float length;
  float radius;
} search_t;

static inline void set_best(search_t* search, int4 best) {
  search->best = best;
  search->ax = way_to(best.s0, search->middle.s0);
  search->ay = way_to(best.s1, search->middle.s1);
  search->az = way_to(best.s2, search->middle.s2);
  search->length = sqrt(search->ax * search->ax + search->ay * search->ay + search->az * search->az);
}

// By how much eight boxes are at least farther than the best one, as half of a difference of squares; and how long the
// ways to them are at most, squared, which margins grow with.
typedef struct {
  float8 lead, longest;
} leads_t;

static inline void add_axis(leads_t* leads, int8 lower, int8 upper, int best, float a) {
  const float8 low = ways_to(lower, best), high = ways_to(upper, best);
  const float8 nearest = fmin(fmax((float8)-a, low), high), farthest = fmax(fabs(low), fabs(high));
  leads->lead += nearest * (a + 0.5f * nearest);
  leads->longest += farthest * farthest;
}

static inline leads_t leads_of_boxes(const search_t* search, const globe_t* globe, int level, uint group) {
  const size_t at = 6 * (size_t)(globe->levels[level] + group);
  leads_t leads = {0.0f, 0.0f};
  add_axis(&leads, vload8(at, globe->boxes), vload8(at + 1, globe->boxes), search->best.s0, search->ax);
  add_axis(&leads, vload8(at + 2, globe->boxes), vload8(at + 3, globe->boxes), search->best.s1, search->ay);
  add_axis(&leads, vload8(at + 4, globe->boxes), vload8(at + 5, globe->boxes), search->best.s2, search->az);
  return leads;
}

static inline void add_way(leads_t* leads, float8 way, float a) {
  leads->lead += way * (a + 0.5f * way);
  leads->longest += way * way;
}

static inline leads_t leads_of_places(const search_t* search, int8 x, int8 y, int8 z) {
  leads_t leads = {0.0f, 0.0f};
  add_way(&leads, ways_to(x, search->best.s0), search->ax);
  add_way(&leads, ways_to(y, search->best.s1), search->ay);
  add_way(&leads, ways_to(z, search->best.s2), search->az);
  return leads;
}

// Which of eight may hold the nearest seed of a pixel.
static inline int8 may_be_nearest(const search_t* search, leads_t leads) {
  const float8 way = sqrt(leads.longest);
  return leads.lead <= way * (search->radius + 2e-6f * (search->length + way));
}

// --- candidates ---

typedef struct {
  uint size;
  uint sites[MOST_CANDIDATES];
} list_t;

// Leaves those that may still be the nearest of a pixel; of one pixel the nearest one alone, if these are still many.
static inline void shorten(list_t* list, const search_t* search, const globe_t* globe, bool is_pixel) {
  uint kept = 0;
  for (uint i = 0; i < list->size; ++i) {
    const int4 at = direction_at(globe, list->sites[i]);
    if (may_be_nearest(search, leads_of_places(search, (int8)at.s0, (int8)at.s1, (int8)at.s2)).s0 != 0)
      list->sites[kept++] = list->sites[i];
  }
  list->size = kept;
  if (kept < MOST_CANDIDATES || !is_pixel) return;
  uint first = list->sites[0];
  long most = LONG_MIN;
  for (uint i = 0; i < kept; ++i) {
    const int4 at = direction_at(globe, list->sites[i]);
    const long score = dot_of(search->middle, at) - half_square(at);
    if (score > most || (score == most && comes_first(globe, list->sites[i], first))) {
      first = list->sites[i];
      most = score;
    }
  }
  list->sites[0] = first;
  list->size = 1;
}

// Adds those of a leaf. Returns false if the list is too short.
static inline bool add_leaf(list_t* list, search_t* search, const globe_t* globe, uint leaf, bool is_pixel) {
  const int8 x = vload8(3 * (size_t)leaf, globe->sites), y = vload8(3 * (size_t)leaf + 1, globe->sites),
             z = vload8(3 * (size_t)leaf + 2, globe->sites);
  const int8 there = first_of(globe->count - leaf * FAN);
  leads_t leads = leads_of_places(search, x, y, z);
  const float8 lead = select((float8)INFINITY, leads.lead, there);
  const float least = least_of_floats(lead);
  if (least < 0) {
    const int nearest_bits = bits_of_ints(lead == least);
    const uint nearest = leaf * FAN + (uint)LOWEST_BIT(nearest_bits);
    set_best(search, direction_at(globe, nearest));
    leads = leads_of_places(search, x, y, z);
  }
  for (int some = bits_of_ints(may_be_nearest(search, leads) & there); some != 0; some &= some - 1) {
    if (list->size == MOST_CANDIDATES) {
      shorten(list, search, globe, is_pixel);
      if (list->size == MOST_CANDIDATES) return false;
    }
    list->sites[list->size++] = leaf * FAN + (uint)LOWEST_BIT(some);
  }
  return true;
}

static inline uint8 order_of_group(const search_t* search, const globe_t* globe, int level, uint group) {
  const leads_t leads = leads_of_boxes(search, globe, level, group);
  const float own = 0.5f * search->length * search->length;
  const int8 some = may_be_nearest(search, leads) & are_there(globe->count, level, group);
  return order_of(fmax(leads.lead + own, (float8)0.0f), some);
}

// Finds the candidates of a ball, the nearest boxes first. Returns false if they are too many.
static inline bool find_candidates(list_t* list, search_t* search, const globe_t* globe, bool is_pixel) {
  walk_t walk;
  list->size = 0;
  begin_walk(&walk, globe->top, 0, order_of_group(search, globe, globe->top, 0));
  while (goes_on(&walk, globe->top, FAR)) {
    if (walk.level > 1) {
      enter(&walk, order_of_group(search, globe, walk.level - 1, walk.node));
    } else if (!add_leaf(list, search, globe, walk.node, is_pixel)) {
      return false;
    }
  }
  shorten(list, search, globe, is_pixel);
  return true;
}

// --- pixels ---

// The ball of the pixels [x, x + width) x [y, y + height), given as a part. The ones that are farthest from its middle
// column are at its ends.
static inline float radius_of(int4 middle, int4 part, const pixels_t* pixels) {
  float most = 0;
  for (int y = part.s1; y < part.s1 + part.s3; ++y) {
    for (int side = 0; side < 2; ++side) {
      const int4 at = direction_of(pixels, side == 0 ? part.s0 : part.s0 + part.s2 - 1, y);
      const float dx = way_to(at.s0, middle.s0), dy = way_to(at.s1, middle.s1), dz = way_to(at.s2, middle.s2);
      most = fmax(most, dx * dx + dy * dy + dz * dz);
    }
  }
  return sqrt(most) * 1.00001f;
}

// Whether a candidate has pixels whose best one so far is as near, lane by lane.
static inline long8 which_come_first(const list_t* list, const globe_t* globe, uint i, uint8 best, long8 is_tie) {
  uint others[FAN];
  long lanes[FAN];
  vstore8(best, 0, others);
  vstore8(is_tie, 0, lanes);
  for (int k = 0; k < FAN; ++k)
    if (lanes[k] != 0 && !comes_first(globe, list->sites[i], list->sites[others[k]])) lanes[k] = 0;
  return vload8(0, lanes);
}

static inline void label_part(const list_t* list, const globe_t* globe, int4 part, const pixels_t* pixels, int width,
                              global uint* labels) {
  for (int y = part.s1; y < part.s1 + part.s3; ++y) {
    for (int x = part.s0; x < part.s0 + part.s2; x += FAN) {
      const int2 row = pixels->rows[y];
      const long8 px = scaled_8(row.s0, vload8(0, pixels->columns + x)),
                  py = scaled_8(row.s0, vload8(0, pixels->columns + x + pixels->behind));
      long8 most = LONG_MIN;
      uint8 best = 0;
      for (uint i = 0; i < list->size; ++i) {
        const int4 v = direction_at(globe, list->sites[i]);
        const long8 score = px * (long)v.s0 + py * (long)v.s1 + ((long)row.s1 * (long)v.s2 - half_square(v));
        long8 wins = score > most;
        const long8 is_tie = score == most;
        if (any(is_tie)) wins |= which_come_first(list, globe, i, best, is_tie);
        most = max(most, score);
        best = select(best, (uint8)i, as_uint8(convert_int8(wins)));
      }
      uint found[FAN];
      vstore8(best, 0, found);
      for (int k = 0; k < min(FAN, part.s0 + part.s2 - x); ++k)
        labels[(size_t)y * (size_t)width + (size_t)(x + k)] = globe->ids[list->sites[found[k]]];
    }
  }
}

// A work-item labels a block.
kernel __attribute__((vec_type_hint(float8))) void label_globe(GLOBE_PARAMETERS, global const int* restrict columns,
                                                               global const int2* restrict rows, int width, int height,
                                                               global uint* restrict labels) {
  const int across = (width + GLOBE_BLOCK - 1) / GLOBE_BLOCK, down = (height + GLOBE_BLOCK - 1) / GLOBE_BLOCK;
  const int block = (int)get_global_id(0);
  if (block >= across * down) return;
  const globe_t globe = GLOBE_ARGUMENTS;
  const pixels_t pixels = {columns, rows, width + FAN};
  const int left = block % across * GLOBE_BLOCK, upper = block / across * GLOBE_BLOCK;
  int4 parts[MOST_PARTS];
  parts[0] = (int4)(left, upper, min(GLOBE_BLOCK, width - left), min(GLOBE_BLOCK, height - upper));
  search_t search;
  search.best = direction_at(&globe, 0);
  list_t list;
  for (int waiting = 1; waiting > 0;) {
    const int4 part = parts[--waiting];
    search.middle = direction_of(&pixels, part.s0 + part.s2 / 2, part.s1 + part.s3 / 2);
    search.radius = radius_of(search.middle, part, &pixels);
    set_best(&search, search.best);
    const bool is_pixel = part.s2 == 1 && part.s3 == 1;
    if (find_candidates(&list, &search, &globe, is_pixel)) {
      label_part(&list, &globe, part, &pixels, width, labels);
    } else if (part.s2 >= part.s3) {
      const int half_width = part.s2 / 2;
      parts[waiting++] = (int4)(part.s0, part.s1, half_width, part.s3);
      parts[waiting++] = (int4)(part.s0 + half_width, part.s1, part.s2 - half_width, part.s3);
    } else {
      const int half_height = part.s3 / 2;
      parts[waiting++] = (int4)(part.s0, part.s1, part.s2, half_height);
      parts[waiting++] = (int4)(part.s0, part.s1 + half_height, part.s2, part.s3 - half_height);
    }
  }
}

// The great circles from pixels to the seeds of their labels, in kilometres; infinity without one. The straight ways to
// a seed and to its antipode are the legs of a right triangle.
kernel void globe_distances(global const uint* restrict labels, global const int4* restrict directions, uint count,
                            global const int* restrict columns, global const int2* restrict rows, int width,
                            int height, float diameter, global float* restrict distances) {
  const size_t pixel = get_global_id(0);
  if (pixel >= (size_t)width * (size_t)height) return;
  const pixels_t pixels = {columns, rows, width + FAN};
  const int4 p = direction_of(&pixels, (int)(pixel % (size_t)width), (int)(pixel / (size_t)width));
  const uint label = labels[pixel];
  const int4 v = label < count ? directions[label] : (int4)0;
  const ulong both = ((ulong)dot_of(p, p) + (ulong)dot_of(v, v)) >> 1, dot = (ulong)dot_of(p, v);
  const bool is_there = v.s0 != 0 || v.s1 != 0 || v.s2 != 0;
  const float way = sqrt(convert_float(both - dot)), to_antipode = sqrt(convert_float(both + dot));
  distances[pixel] = is_there ? diameter * atan2(way, to_antipode) : INFINITY;
}
