// Gathering what may win in a box, and searching what wins at one pixel.

#ifndef VOROCL_EXACT_GATHER
#define VOROCL_EXACT_GATHER

#include "exact/walk.cl"

#if IS_TILTED
static inline int turns_to_near(int way, int period, int periodic) {
  return periodic ? -(int)rint((float)way / (float)period) : 0;
}
#endif
// From a centre to the nearest image of a place; in a tilted grid as near as floats tell, which take fewer of a GPU's
// registers than shortest_way_round().
static inline int4 to_nearest_image(const scene_t* scene, uint at, int4 centre) {
  const int4 period = scene->size * (ONE * SPACINGS);
  const int x = scene->x[at] - centre.x, y = scene->y[at] - centre.y, z = IS_VOLUME ? scene->z[at] - centre.z : 0;
#if IS_TILTED
  // Slices of images, and rows of each, from the nearest on, until they are too far.
  const int own_z = turns_to_near(z, period.z, IS_PERIODIC(scene, z)), near_z = z + own_z * period.z;
  int4 nearest = 0;
  float least = INFINITY;
  for (int i = 0; i == 0 || IS_PERIODIC(scene, z); ++i) {
    const int turns_z = own_z + turns_outward(near_z, i), along_z = z + turns_z * period.z;
    if (distance_of((float4)(0, 0, (float)along_z, 0)) >= least) break;
    const int in_slice = y + tilt_of_slice(scene, turns_z) * SPACING_Y;
    const int own_y = turns_to_near(in_slice, period.y, IS_PERIODIC(scene, y)), near_y = in_slice + own_y * period.y;
    for (int j = 0; j == 0 || IS_PERIODIC(scene, y); ++j) {
      const int turns_y = own_y + turns_outward(near_y, j), along_y = in_slice + turns_y * period.y;
      if (distance_of((float4)(0, (float)along_y, (float)along_z, 0)) >= least) break;
      const int in_row = x + tilt_of_row(scene, turns_y, turns_z) * SPACING_X;
      const int along_x = in_row + turns_to_near(in_row, period.x, IS_PERIODIC(scene, x)) * period.x;
      const float distance = distance_of((float4)((float)along_x, (float)along_y, (float)along_z, 0));
      if (distance < least) least = distance, nearest = (int4)(along_x, along_y, along_z, 0);
    }
  }
  return nearest;
#else
  return (int4)(shorter_way(x, period.x, IS_PERIODIC(scene, x)), shorter_way(y, period.y, IS_PERIODIC(scene, y)),
                IS_VOLUME ? shorter_way(z, period.z, IS_PERIODIC(scene, z)) : 0, 0);
#endif
}
// w: its lag, in units squared.
static inline float4 way_to(const scene_t* scene, uint at, int4 centre) {
  const float4 way = convert_float4(to_nearest_image(scene, at, centre));
  return (float4)(way.xyz, IS_WEIGHTED ? (float)scene->lags[at] * LAG_UNIT : 0);
}

// Lists the blocks of a source that may win in a box, behind the source; the source itself if there is no room.
NOINLINE static source_t list_blocks(const scene_t* scene, box_t box, uint near, source_t source, blocks_t* b) {
  const cuboid_t limits = limits_around(scene, box);
  const balls_t balls = balls_around(box, way_to(scene, near, centre_of(box)));
  walk_t walk = walk_over_balls(scene, &limits, balls, source);
  const int begin = (source.end + BLOCKS_AT_ONCE - 1) / BLOCKS_AT_ONCE * BLOCKS_AT_ONCE;
  source_t list = {b, begin, begin};
  global const int* const along[3] = {scene->x, scene->y, scene->z};
  uint from, to;
  int4 origin;
  while (next_range(scene, &walk, 0, &from, &to, &origin)) {
    const float4 shift = convert_float4(origin) * UNITS_OF_BOUNDS, margin = fabs(shift) * 0x1p-22f;
    for (uint next; from < to; from = next) {
      const uint block = from / PLACES_OF_BLOCK;
      next = min(to, (block + 1) * PLACES_OF_BLOCK);
      if (list.end == MOST_BLOCKS) return source;
      const int i = list.end++;
      b->from[i] = from, b->to[i] = next, b->x[i] = origin.x, b->y[i] = origin.y, b->z[i] = origin.z;
      global const float* own = scene->bounds + FIRST_BOUND(block);
      const bool is_bound = own[0] > -INFINITY;  // or its bins have few places, and it is done here
      float* out = b->bounds + FIRST_BOUND(i);
#pragma unroll
      for (int axis = 0; axis < AXES_OF_PLACES; ++axis, own += 2 * BLOCKS_AT_ONCE, out += 2 * BLOCKS_AT_ONCE) {
        float2 ends = (float2)(own[0], own[BLOCKS_AT_ONCE]);
        if (!is_bound) ends = bounds_of(along[axis] + from, (int)(next - from));
        out[0] = ends.x - shift[axis] - margin[axis];
        out[BLOCKS_AT_ONCE] = ends.y - shift[axis] + margin[axis];
      }
      if (IS_WEIGHTED) out[0] = own[0];
    }
  }
  return list;
}

// The place of a walk that is nearest to a centre, of at most so many of each range; NO_PLACE if there is none. A
// walk over a ball goes on in smaller ones.
static inline uint nearest_of_walk(const scene_t* scene, walk_t* walk, int4 centre, uint most) {
  uint from, to;
  int4 origin;
  float8 least = INFINITY;
  uint8 nearest = 0;
  while (next_range(scene, walk, centre, &from, &to, &origin)) {
    to = min(to, from + most);
    for (uint at = from; at < to; at += 8) {
      const float8 n = floats_of(load_from_index(scene, at, origin)).n;
      const int8 wins = (n < least) & (EIGHT < (int)(to - at));
      least = select(least, n, wins), nearest = select(nearest, at + as_uint8(EIGHT), as_uint8(wins));
    }
    if (walk->has_balls) walk->balls.n = fmin(walk->balls.n, radius_of_ball(least_float(least)));
  }
  const float found = least_float(least);
  if (found == INFINITY) return NO_PLACE;
  uint lane[8];
  store_uints(nearest, lane);
  return lane[31 - clz(mask_of(least == found))];
}

// Whether the place near a box is farther than a side of what a work-item labels: by its lag, or as a heavy
// seed.
static inline bool is_far_by_weights(float4 place) {
  const float side = (float)((IS_VOLUME ? SIDE_OF_VOLUME : SIDE_OF_PLANE) * ONE);
  return IS_WEIGHTED && distance_of(place) > side * side;
}

// A place near the centre of a box; NO_PLACE if there is no place at all. Where the bins of the box are empty, a
// known place or a few places of each range around say how far the nearest one is at most. Places of the box with
// long lags say so, too: a heavier one farther away may be nearer. Of a list of blocks the nearest is looked up there.
#define FEW_OF_RANGE 8
#define ALL_OF_RANGE (UINT_MAX / 2)
NOINLINE static uint find_near(const scene_t* scene, box_t box, const cuboid_t* limits, uint known, source_t source) {
  const int4 centre = centre_of(box), bits = scene->bins.bits;
  uint near = source.blocks ? known : NO_PLACE;
  for (int rings = 0; near == NO_PLACE; rings = 2 * rings + 1) {
    const span_t x = clamped(with_bins_around(span_of(box.x, box.x + box.sx - 1), rings, bits.x), limits->x);
    const span_t y = clamped(with_bins_around(span_of(box.y, box.y + box.sy - 1), rings, bits.y), limits->y);
    const span_t z = clamped(with_bins_around(span_of(box.z, box.z + box.sz - 1), rings, bits.z), limits->z);
    walk_t walk = walk_over(scene, x, y, z);
    near = nearest_of_walk(scene, &walk, centre, rings > 0 ? FEW_OF_RANGE : ALL_OF_RANGE);
    if (near != NO_PLACE && rings == 0 && !is_far_by_weights(way_to(scene, near, centre))) return near;
    if (near == NO_PLACE) near = known;
    if (holds(x, limits->x) && holds(y, limits->y) && holds(z, limits->z)) break;
  }
  if (near == NO_PLACE) return near;
  walk_t walk = walk_over_balls(scene, limits, ball_around(centre, way_to(scene, near, centre)), source);
  // Where the centre is beyond the grid, rows may be cut to nothing at its end.
  const uint nearer = nearest_of_walk(scene, &walk, centre, ALL_OF_RANGE);
  return nearer == NO_PLACE ? near : nearer;
}

// A walk over all that may win in a box, which goes on where a list was full.
typedef struct {
  walk_t walk;
  uint from, to;  // what is left of the present range
  int4 origin;
} gathering_t;

static inline gathering_t gathering_in(const scene_t* scene, box_t box, const cuboid_t* limits,
                                       float4 place, source_t source) {
  const gathering_t start = {walk_over_balls(scene, limits, balls_around(box, place), source), 0, 0, 0};
  return start;
}

// Gathers what a place does not drop; true if that is all of it. Full lists are cut by the corners, and
// gathering goes on, unless three quarters stay.
NOINLINE static bool gather(const scene_t* scene, box_t box, float4 place, gathering_t* gathering,
                            list_t* list, int* count) {
  const int4 centre = centre_of(box);
  const spans_t spans = spans_of(box);
  const rival_t rival = rival_at(place, &spans);
  gathering_t g = *gathering;
  int some = 0;
  do {
    for (; g.from < g.to; g.from += 8) {
      if (some > MOST_IN_LIST - 8) {
        some = drop_beaten(scene, list, some, box);
        if (some > MOST_IN_LIST / 4 * 3) {
          *gathering = g;
          *count = some;
          return false;
        }
      }
      const places8_t p = load_from_index(scene, g.from, g.origin);
      const floats8_t f = floats_of(p);
      const int8 stays = may_win(&f, &rival, &spans) & (EIGHT < (int)(g.to - g.from));
      some = keep(list, some, stays, &p, g.from + as_uint8(EIGHT));
    }
  } while (next_range(scene, &g.walk, centre, &g.from, &g.to, &g.origin));
  *count = drop_beaten(scene, list, some, box);
  return true;
}

// --- in integers, pixel by pixel ---

typedef struct {
  ulong distance;  // squared if Euclidean, and the lag
  uint at;
} winner_t;

// Lets up to eight places stand against the best one.
static inline void compare_eight(const scene_t* scene, const places8_t* p, uint8 at, int count,
                                 winner_t* best) {
#if IS_MANHATTAN
  const long8 distance = convert_long8(absolute(p->x)) + convert_long8(absolute(p->y));
#else
  const long8 x = convert_long8(p->x), y = convert_long8(p->y), z = convert_long8(p->z);
  long8 distance = IS_VOLUME ? x * x + y * y + z * z : x * x + y * y;
#if IS_WEIGHTED
  distance += convert_long8(p->lag) * LAG_UNIT;
#endif
#endif
  if (!SOME(distance <= (long8)(long)best->distance)) return;
  long lane[8];
  uint place[8];
  vstore8(distance, 0, lane);
  store_uints(at, place);
  for (int i = 0; i < min(count, 8); ++i) {
    const ulong d = (ulong)lane[i];
    if (d > best->distance) continue;
    if (d == best->distance && best->at != NO_PLACE && !comes_first(scene, place[i], best->at)) continue;
    best->distance = d, best->at = place[i];
  }
}

// `known`: a place that is near, or NO_PLACE.
NOINLINE static uint search_pixel(const scene_t* scene, int x, int y, int z, uint known) {
  if (!has_label(scene, x, y, z)) return NO_LABEL;
  const box_t box = box_at(x, y, z, 1, 1, 1);
  const cuboid_t limits = limits_around(scene, box);
  const int4 centre = centre_of(box);
  const uint near = known != NO_PLACE ? known : find_near(scene, box, &limits, NO_PLACE, THE_INDEX);
  if (near == NO_PLACE) return NO_LABEL;
  walk_t walk = walk_over_balls(scene, &limits, balls_around(box, way_to(scene, near, centre)), THE_INDEX);
  winner_t best = {LONG_MAX, NO_PLACE};
  uint from, to;
  int4 origin;
  while (next_range(scene, &walk, centre, &from, &to, &origin)) {
    for (uint at = from; at < to; at += 8) {
      const places8_t p = load_from_index(scene, at, origin);
      compare_eight(scene, &p, at + as_uint8(EIGHT), (int)(to - at), &best);
    }
  }
  return scene->ids[best.at];
}

// The nearest of a list at a pixel of its box.
NOINLINE static uint nearest_at(const scene_t* scene, box_t b, const list_t* list, int count, int x, int y,
                                int z) {
  const int4 way = centre_of(box_at(x, y, z, 1, 1, 1)) - centre_of(b);
  winner_t best = {LONG_MAX, NO_PLACE};
  for (int k = 0; k < count; k += 8) {
    const places8_t p = moved(load_from_list(list, k), way);
    compare_eight(scene, &p, vload8(0, list->at + k), count - k, &best);
  }
  return best.at;
}

// Whether a place is nearer to a pixel than another one.
static inline long distance_to(const scene_t* scene, int4 centre, uint at) {
#if IS_TILTED
  const int4 sides = scene->size * (int4)(IS_PERIODIC(scene, x), IS_PERIODIC(scene, y), IS_PERIODIC(scene, z), 0);
  const lattice_t lattice = lattice_of(sides.x, sides.y, sides.z, scene->tilts, ONE);
  const int4 way = shortest_way_round(&lattice, scene->x[at] - centre.x, scene->y[at] - centre.y,
                                      IS_VOLUME ? scene->z[at] - centre.z : 0);
#else
  const int4 way = to_nearest_image(scene, at, centre);
#endif
  const long distance = ALONG((long)way.x) + ALONG((long)way.y) + ALONG((long)way.z);
  return distance + (IS_WEIGHTED ? (long)scene->lags[at] * LAG_UNIT : 0);
}
static inline bool is_nearer(const scene_t* scene, int x, int y, int z, uint at, uint than) {
  const int4 centre = centre_of(box_at(x, y, z, 1, 1, 1));
  const long distance = distance_to(scene, centre, at), least = distance_to(scene, centre, than);
  return distance < least || (distance == least && at != than && comes_first(scene, at, than));
}

#endif
