// Labels by great circles, of grids of longitude and latitude.
//
// A seed is a direction v, three whole numbers of RADIUS units (3 mm of the Earth), and so is a pixel's centre p, which
// is made of a column and a row. The nearest seed is that of the least |p - v|^2, so of the greatest p.v - |v|^2 / 2,
// which 64 bits hold. (The greatest p.v would not do: rounded directions have unequal lengths.) All decisions are made
// by these numbers. Floats only say which seeds need not be looked at, with a margin.
//
// CANDIDATES. The pixels p of a block lie around its middle c, and reach so far to the east, to the north and up of it.
// A seed v is nearer than v0 to none of them if it is farther from c by enough: half of |v - c|^2 - |v0 - c|^2 is more
// than (p - c).(v - v0), for all p. With w = v - v0 and a = v0 - c the former is w.a + |w|^2 / 2, which is exact to a
// float's digits however near the seeds lie to each other, and the latter is at most the sum over the three axes of how
// far the block reaches times how long w is. So one walk through the tree of boxes finds the seeds that matter. Where
// they are more than a list holds, the block is halved along the axes that let so many in.
//
// BOXES have axes of their own, for seeds lie on the sphere, and often on a curve: along the seeds, across, and down
// into the sphere. Other boxes would be thick where the seeds are thin, so that from afar, where all seeds are almost
// equally far, a corner would be nearer than they are.

#include "core/abi.cl"
#include "exact_cells/lanes.cl"
#include "globe/sizes.cl"

#define NO_LABEL 0xffffffffu
#define MOST_CANDIDATES 96
#define ROUNDING 2.0f  // along an axis two places that would be one are at most so far from each other
#define DIAMETER 0x1p32f
#define MOST_PARTS 13  // that wait: of 16 x 16 pixels each axis is halved 4 times, which leaves 3 more each time

// Of the seeds: the tree of their directions (src/globe/boxes.cpp), and by id the directions, (0, 0, 0) of one that is
// absent, and how far east they are.
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

static inline long score_of(int4 p, int4 v) { return dot_of(p, v) - half_square(v); }

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
  float east_x, east_y;  // at c; east has no z
  float north_x, north_y, north_z;
  float reach_east, reach_north, reach_up;
} search_t;

static inline void set_best(search_t* search, int4 best) {
  search->best = best;
  search->ax = way_to(best.s0, search->middle.s0);
  search->ay = way_to(best.s1, search->middle.s1);
  search->az = way_to(best.s2, search->middle.s2);
  search->length = sqrt(search->ax * search->ax + search->ay * search->ay + search->az * search->az);
}

static inline float8 to_east(const search_t* search, float8 x, float8 y) {
  return fabs(x * search->east_x + y * search->east_y);
}

static inline float8 to_north(const search_t* search, float8 x, float8 y, float8 z) {
  return fabs(x * search->north_x + y * search->north_y + z * search->north_z);
}

// How much farther a seed may be than v0 and be nearer to a pixel, as half of a difference of squares, if w is at most
// so long, in all and to the east and north. Up, w is as long as the seed is farther, but for rounding: so a share of
// that does not count.
static inline float8 limits_of(const search_t* search, float8 way, float8 east, float8 north) {
  return search->reach_east * east + search->reach_north * north +
         1e-5f * (search->reach_east + search->reach_north) * way + 2 * ROUNDING * search->reach_up;
}

static inline float share_of(const search_t* search) { return fmax(1 - 0x1p-31f * search->reach_up, 0.0f); }

// Which of eight may hold the nearest seed of a pixel, that are at least so much farther. Floats err by less.
static inline int8 may_be_nearest(const search_t* search, float8 lead, float8 way, float8 east, float8 north) {
  return share_of(search) * lead <= limits_of(search, way, east, north) + 2e-6f * way * (search->length + way);
}

// The least of a w + w^2 / 2, for w of that range.
static inline float8 least_lead(float8 low, float8 high, float8 a) {
  const float8 nearest = fmin(fmax(-a, low), high);
  return nearest * (a + 0.5f * nearest);
}

// Of eight boxes, and by how much they are farther.
static inline int8 which_boxes(const search_t* search, const globe_t* globe, int level, uint group, float8* lead) {
  const size_t at = BOX_NUMBERS * (size_t)(globe->levels[level] + group);
  const int8 x = vload8(at, globe->boxes), y = vload8(at + 1, globe->boxes), z = vload8(at + 2, globe->boxes);
  const float8 along_x = as_float8(vload8(at + 3, globe->boxes)), along_y = as_float8(vload8(at + 4, globe->boxes)),
               along_z = as_float8(vload8(at + 5, globe->boxes)), length = as_float8(vload8(at + 6, globe->boxes)),
               width = as_float8(vload8(at + 7, globe->boxes)), depth = as_float8(vload8(at + 8, globe->boxes));
  const float8 up_x = convert_float8(x) * 0x1p-31f, up_y = convert_float8(y) * 0x1p-31f,
               up_z = convert_float8(z) * 0x1p-31f;
  const float8 across_x = up_y * along_z - up_z * along_y, across_y = up_z * along_x - up_x * along_z,
               across_z = up_x * along_y - up_y * along_x;
  const float8 wx = ways_to(x, search->best.s0), wy = ways_to(y, search->best.s1), wz = ways_to(z, search->best.s2);
  const float8 along = wx * along_x + wy * along_y + wz * along_z,
               across = wx * across_x + wy * across_y + wz * across_z, up = wx * up_x + wy * up_y + wz * up_z;
  *lead = least_lead(along - length, along + length,
                     along_x * search->ax + along_y * search->ay + along_z * search->az) +
          least_lead(across - width, across + width,
                     across_x * search->ax + across_y * search->ay + across_z * search->az) +
          least_lead(up - depth, up + ROUNDING, up_x * search->ax + up_y * search->ay + up_z * search->az);
  const float8 way = sqrt(wx * wx + wy * wy + wz * wz) + (length + width + depth);
  const float8 east = to_east(search, wx, wy) + to_east(search, along_x, along_y) * length +
                      to_east(search, across_x, across_y) * width + depth,
               north = to_north(search, wx, wy, wz) + to_north(search, along_x, along_y, along_z) * length +
                       to_north(search, across_x, across_y, across_z) * width + depth;
  return may_be_nearest(search, *lead, way, east, north);
}

// The same of eight seeds.
static inline int8 which_seeds(const search_t* search, int8 x, int8 y, int8 z, float8* lead) {
  const float8 wx = ways_to(x, search->best.s0), wy = ways_to(y, search->best.s1), wz = ways_to(z, search->best.s2);
  *lead = wx * (search->ax + 0.5f * wx) + wy * (search->ay + 0.5f * wy) + wz * (search->az + 0.5f * wz);
  return may_be_nearest(search, *lead, sqrt(wx * wx + wy * wy + wz * wz), to_east(search, wx, wy),
                        to_north(search, wx, wy, wz));
}

// --- candidates ---

typedef struct {
  uint size;
  uint sites[MOST_CANDIDATES];
} list_t;

// Leaves the nearest one to a pixel.
static inline void leave_first(list_t* list, const search_t* search, const globe_t* globe) {
  uint first = list->sites[0];
  long most = LONG_MIN;
  for (uint i = 0; i < list->size; ++i) {
    const long score = score_of(search->middle, direction_at(globe, list->sites[i]));
    if (score > most || (score == most && comes_first(globe, list->sites[i], first))) {
      first = list->sites[i];
      most = score;
    }
  }
  list->sites[0] = first;
  list->size = 1;
}

// Leaves those that may still be the nearest of a pixel, by how much farther they are in whole numbers.
static inline void shorten(list_t* list, const search_t* search, const globe_t* globe) {
  const long most = score_of(search->middle, search->best);
  uint kept = 0;
  for (uint i = 0; i < list->size; ++i) {
    const int4 at = direction_at(globe, list->sites[i]);
    const float lead = convert_float(most - score_of(search->middle, at)), wx = way_to(at.s0, search->best.s0),
                wy = way_to(at.s1, search->best.s1), wz = way_to(at.s2, search->best.s2);
    const float limit = limits_of(search, sqrt(wx * wx + wy * wy + wz * wz), to_east(search, wx, wy),
                                  to_north(search, wx, wy, wz)).s0;
    if (share_of(search) * (lead - ROUNDING) <= limit) list->sites[kept++] = list->sites[i];
  }
  list->size = kept;
}

// Adds those of a leaf. Returns false if the list is too short.
static inline bool add_leaf(list_t* list, search_t* search, const globe_t* globe, uint leaf, bool is_pixel) {
  const int8 x = vload8(3 * (size_t)leaf, globe->sites), y = vload8(3 * (size_t)leaf + 1, globe->sites),
             z = vload8(3 * (size_t)leaf + 2, globe->sites);
  const int8 there = first_of(globe->count - leaf * FAN);
  float8 lead;
  int8 may = which_seeds(search, x, y, z, &lead);
  const float8 lead_there = select((float8)INFINITY, lead, there);
  const float least = least_of_floats(lead_there);
  if (least < 0) {
    const int nearest_bits = bits_of_ints(lead_there == least);
    const uint nearest = leaf * FAN + (uint)LOWEST_BIT(nearest_bits);
    set_best(search, direction_at(globe, nearest));
    may = which_seeds(search, x, y, z, &lead);
  }
  for (int some = bits_of_ints(may & there); some != 0; some &= some - 1) {
    if (list->size == MOST_CANDIDATES) {
      is_pixel ? leave_first(list, search, globe) : shorten(list, search, globe);
      if (list->size == MOST_CANDIDATES) return false;
    }
    list->sites[list->size++] = leaf * FAN + (uint)LOWEST_BIT(some);
  }
  return true;
}

static inline uint8 order_of_group(const search_t* search, const globe_t* globe, int level, uint group) {
  float8 lead;
  const int8 some = which_boxes(search, globe, level, group, &lead) & are_there(globe->count, level, group);
  lead = select((float8)INFINITY, lead, some);
  return order_of(lead - least_of_floats(lead), some);
}

// Finds the candidates of a part, the nearest boxes first. Returns false if they are too many.
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
  is_pixel ? leave_first(list, search, globe) : shorten(list, search, globe);
  return true;
}

// Along which axes a part with too many candidates is halved: those that let in about as many as the other one.
static inline void choose_halves(const list_t* list, const search_t* search, const globe_t* globe, int4 part, bool* x,
                                 bool* y) {
  float east = 0, north = 0;
  for (uint i = 0; i < list->size; ++i) {
    const int4 at = direction_at(globe, list->sites[i]);
    const float wx = way_to(at.s0, search->best.s0), wy = way_to(at.s1, search->best.s1),
                wz = way_to(at.s2, search->best.s2);
    east += to_east(search, wx, wy).s0;
    north += to_north(search, wx, wy, wz).s0;
  }
  east *= search->reach_east;
  north *= search->reach_north;
  *x = part.s2 > 1 && (4 * east > north || part.s3 == 1);
  *y = part.s3 > 1 && (4 * north > east || part.s2 == 1);
}

// --- pixels ---

// Begins to look for seeds that are near the pixels [x, x + width) x [y, y + height), given as a part. The pixels of a
// row that are farthest along an axis are the first one and the one in the middle, if they do not go round the globe.
static inline void begin_search(search_t* search, int4 part, const pixels_t* pixels) {
  const int column = part.s0 + part.s2 / 2;
  const int2 row = pixels->rows[part.s1 + part.s3 / 2];
  const float cosine = 0x1p-31f * convert_float(pixels->columns[column]),
              sine = 0x1p-31f * convert_float(pixels->columns[column + pixels->behind]),
              row_cosine = 0x1p-31f * convert_float(row.s0), row_sine = 0x1p-31f * convert_float(row.s1);
  search->middle = direction_of(pixels, column, part.s1 + part.s3 / 2);
  search->east_x = -sine;
  search->east_y = cosine;
  search->north_x = -row_sine * cosine;
  search->north_y = -row_sine * sine;
  search->north_z = row_cosine;
  float east = 0, north = 0, up = 0;
  for (int y = part.s1; y < part.s1 + part.s3; ++y) {
    for (int x = part.s0; x <= column; x += max(column - part.s0, 1)) {
      const int4 at = direction_of(pixels, x, y);
      const float dx = way_to(at.s0, search->middle.s0), dy = way_to(at.s1, search->middle.s1),
                  dz = way_to(at.s2, search->middle.s2), outwards = dx * cosine + dy * sine;
      east = fmax(east, fabs(dy * cosine - dx * sine));
      north = fmax(north, fabs(dz * row_cosine - outwards * row_sine));
      up = fmax(up, fabs(outwards * row_cosine + dz * row_sine));
    }
  }
  const bool goes_round = cosine * convert_float(pixels->columns[part.s0]) +
                              sine * convert_float(pixels->columns[part.s0 + pixels->behind]) < 0;
  search->reach_east = goes_round ? DIAMETER : east + ROUNDING;
  search->reach_north = goes_round ? DIAMETER : north + ROUNDING;
  search->reach_up = goes_round ? DIAMETER : up + ROUNDING;
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
        if (SOME(is_tie)) wins |= which_come_first(list, globe, i, best, is_tie);
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
    begin_search(&search, part, &pixels);
    set_best(&search, search.best);
    const bool is_pixel = part.s2 == 1 && part.s3 == 1;
    if (find_candidates(&list, &search, &globe, is_pixel)) {
      label_part(&list, &globe, part, &pixels, width, labels);
      continue;
    }
    bool halves_x, halves_y;
    choose_halves(&list, &search, &globe, part, &halves_x, &halves_y);
    const int right = halves_x ? part.s2 / 2 : 0, down_by = halves_y ? part.s3 / 2 : 0;
    for (int i = 0; i < 4; ++i) {
      const bool is_right = (i & 1) != 0, is_lower = (i & 2) != 0;
      const int4 piece = (int4)(part.s0 + (is_right ? right : 0), part.s1 + (is_lower ? down_by : 0),
                                is_right ? part.s2 - right : right, is_lower ? part.s3 - down_by : down_by);
      if (piece.s2 > 0 && piece.s3 > 0) parts[waiting++] = piece;
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
