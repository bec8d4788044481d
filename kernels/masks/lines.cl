// Along y and z: of each place of a line the nearest SITE, a row or slice that has marks. Lines are taken 16 at a time.
//
// A KEY is the squared distance << bits | the number of the site along the line: the least key is that of the nearest
// site, and of several of the first one. Distances that do not fit count as `limit`: sums of a site's part and the cost
// along the line are right if they are below it, and at least it otherwise. A strip that has such a sum is left to
// kernels with keys of 64 bits (VOROCL_FAR), which hold all.
//
// Let f_a(y) be the distance of site a from place y. Costs are strictly convex, so for sites a < b the difference
// f_b(y) - f_a(y) falls strictly with y. If m is nearest at y and m' at a later place, then m' >= m, whatever others
// are as near. So all nearest sites of a place lie between any nearest one of an earlier place and any of a later one.

#ifndef VOROCL_MASKS_LINES
#define VOROCL_MASKS_LINES

#include "masks/rows.cl"

#ifdef VOROCL_FAR
typedef long one_key;
typedef long16 keys;
#define TO_KEYS convert_long16
#define IS_LESS(a, b) convert_int16((a) < (b))
#else
typedef uint one_key;
typedef uint16 keys;
#define TO_KEYS as_uint16
#define IS_LESS(a, b) ((a) < (b))
#endif

typedef struct {
  int size, period;              // places; as many along a periodic line, else 0
  int bits;                      // of a site's number
  bool saturates;                // whether a distance may be beyond `limit`
  one_key limit;
  global const one_key* cost;    // of a site at the place itself
  global keys* key;              // of the sites, see below
  global keys* best;             // of each place: the least key
  // By place, what sites carry; and what the nearest site of each place does, if that is taken on the way. (It is where
  // it is all that is wanted. Else it is looked up.)
  bool takes;
  global int16 *carried, *found;
  global int *from, *to;         // the ends of the sites that are tried, while places are divided
  // All places are sites, if need be absent ones, and the key of place p is key[p], with images of half a period at
  // both ends. Or the sites are listed: their places are at[0], at[1], ..., along a periodic line with a period of
  // images at both ends, and index[p] is that of the site at p.
  bool is_listed;
  int count, first, last;        // sites in the period, and the first and last one to try
  global int *at, *index;
} line_t;

INLINE bool some_from(keys values, one_key limit) { return SOME(values >= (keys)limit); }

INLINE int least_of(int16 v) {
  const int8 a = min(v.lo, v.hi);
  const int4 b = min(a.lo, a.hi);
  return min(min(b.x, b.y), min(b.z, b.w));
}
INLINE int most_of(int16 v) {
  const int8 a = max(v.lo, v.hi);
  const int4 b = max(a.lo, a.hi);
  return max(max(b.x, b.y), max(b.z, b.w));
}

INLINE int16 sites_of(keys best, int bits) {
  const one_key numbers = ((one_key)1 << bits) - 1;
#ifdef VOROCL_FAR
  return convert_int16(best & numbers);
#else
  return as_int16(best & numbers);
#endif
}

INLINE keys square_of(keys best, int bits) { return best >> (keys)(one_key)bits; }

// The number of a place in the list of sites that has one, or an image of one.
static inline int index_of(const line_t* l, int place) {
  if (!l->is_listed) return place;
  if (place < 0) return l->index[place + l->period] - l->count;
  if (place >= l->size) return l->index[place - l->period] + l->count;
  return l->index[place];
}

// The places from first to last, whose nearest sites are known to be from low to high: the middle one is compared with
// all of these; its sites bound those of the places before and behind it, and so on. With a lane's number the sites of
// this lane alone count, and it alone is stored.
#define DONE 0
#define NOT_HELD 1   // a sum is beyond the limit
#define TOO_MANY 2   // comparisons
#define ALL_LANES -1
static int divide_places(const line_t* l, int first, int last, int low, int high, int lane) {
  global int *const from = l->from, *const to = l->to;
  const int count = last - first + 1, reach = l->period / 2;
  const one_key end_of_limit = l->limit << l->bits;
  long left = lane == ALL_LANES ? (long)MOST_COMPARISONS * (count + high - low + 1) : (long)1 << 62;
  int step = 1;
  while (step * 2 <= count) step *= 2;
  for (; step >= 1; step /= 2) {
    for (int i = step; i <= count; i += 2 * step) {
      const int place = first + i - 1;
      const int begin = i > step ? from[i - step] : low, end = i + step <= count ? to[i + step] : high;
      left -= end - begin + 1;
      if (left < 0) return TOO_MANY;
      keys best = l->key[begin] + l->cost[place - (l->is_listed ? l->at[begin] : begin)];
      if (l->is_listed) {
        for (int j = begin + 1; j <= end; ++j) best = min(best, l->key[j] + l->cost[place - l->at[j]]);
      } else {
        for (int j = begin + 1; j <= end; ++j) best = min(best, l->key[j] + l->cost[place - j]);
      }
      if (lane != ALL_LANES) {
        const one_key of_lane = ((const one_key*)&best)[lane];
        if (l->saturates && of_lane >= end_of_limit) return NOT_HELD;
        ((global one_key*)(l->best + place))[lane] = of_lane;
      } else {
        if (l->saturates && some_from(best, end_of_limit)) return NOT_HELD;
        l->best[place] = best;
      }
      if (step == 1) continue;
      int16 image = sites_of(best, l->bits);
      if (reach != 0) {  // the nearest one
        const int16 away = image - place;
        image += select((int16)0, (int16)l->period, away < -reach) - select((int16)0, (int16)l->period, away > reach);
      }
      const bool all = lane == ALL_LANES;
      from[i] = index_of(l, all ? least_of(image) : ((const int*)&image)[lane]);
      to[i] = index_of(l, all ? most_of(image) : ((const int*)&image)[lane]);
    }
  }
  return DONE;
}

// As above; returns whether all sums held. Where the nearest sites of 16 neighbouring lines lie so far apart that
// comparing all lines with all of these takes many times as long as it takes where they do not, lanes are taken one by
// one: then no more than each site and each place is compared at each level.
static bool divide(const line_t* l, int first, int last, int low, int high) {
  int result = divide_places(l, first, last, low, high, ALL_LANES);
  if (result != TOO_MANY) return result == DONE;
  for (int lane = 0; lane < STRIP; ++lane) {
    if (divide_places(l, first, last, low, high, lane) != DONE) return false;
  }
  return true;
}

// What the nearest sites of a place carry.
INLINE int16 carried_by(int16 site, int place, global const int16* carried) {
  if (!SOME(site != (int16)place)) return carried[place];
  int from[STRIP], found[STRIP];
  vstore16(site, 0, from);
#pragma unroll
  for (int i = 0; i < STRIP; ++i) found[i] = ((global const int*)carried)[from[i] * STRIP + i];
  return vload16(0, found);
}
static void look_up(const line_t* l, int first, int last) {
  if (!l->takes) return;
  for (int p = first; p <= last; ++p) l->found[p] = carried_by(sites_of(l->best[p], l->bits), p, l->carried);
}

// The images of the sites of a periodic line that is not listed, and absent ones behind both ends.
static void add_ends(const line_t* l) {
  const int reach = l->period / 2, size = l->size;
  for (int i = 1; i <= reach; ++i) {
    l->key[-i] = l->key[size - i];
    l->key[size - 1 + i] = l->key[i - 1];
  }
  const keys absent = (keys)(l->limit << l->bits);
  for (int i = reach + 1; i <= reach + PAD; ++i) l->key[-i] = l->key[size - 1 + i] = absent;
  for (int i = 1; i <= min(reach, NEAR); ++i) {
    l->carried[-i] = l->carried[size - i];
    l->carried[size - 1 + i] = l->carried[i - 1];
  }
}

// Takes another site's key, if it is less, and what it carries.
#define TAKE(other, from)                                                                \
  do {                                                                                   \
    const keys other_key = other;                                                        \
    if (takes) found = select(found, l->carried[from], IS_LESS(other_key, best));      \
    best = min(best, other_key);                                                         \
  } while (0)

// A line that is not listed. A place looks around it as far as NEAR, and is done when all that was not looked at is
// strictly farther away than what it found. Runs of places that are not done are divided; the done ones around a run
// bound its sites.
INLINE bool scan(const line_t* l, const bool takes) {
  const int size = l->size, reach = l->period / 2;
  global const one_key* const cost = l->cost;
  global const keys* const key = l->key;
  int far_from = -1, skipped = 0;
  for (int p = 0; p <= size; ++p) {
    bool is_near = p == size;
    if (!is_near && skipped > 0) {
      --skipped;
      continue;
    }
    if (!is_near) {
      keys best = key[p];
      int16 found = (int16)0;
      if (takes) found = l->carried[p];
      is_near = !some_from(best, cost[1]);
      if (!is_near) {
#pragma unroll
        for (int k = 1; k <= NEAR; ++k) {
          TAKE(key[p - k] + cost[k], p - k);
          TAKE(key[p + k] + cost[k], p + k);
          if (k != NEAR - 1 && !some_from(best, cost[k + 1])) {
            is_near = true;
            break;
          }
        }
      }
      if (is_near) {
        l->best[p] = best;
        if (takes) l->found[p] = found;
      }
    }
    if (!is_near) {
      if (far_from < 0) far_from = p;
      skipped = SKIPPED;
      continue;
    }
    if (far_from >= 0) {
      const int low = far_from == 0 ? -reach : max(far_from - 1 - NEAR, -reach);
      const int high = p == size ? size - 1 + reach : min(p + NEAR, size - 1 + reach);
      if (!divide(l, far_from, p - 1, low, high)) return false;
      look_up(l, far_from, p - 1);
      far_from = -1;
    }
  }
  return true;
}

#ifdef VOROCL_MANHATTAN
// Costs are not strictly convex by the Manhattan metric; but a step further along the line adds 1 to each key. So the
// least key of all sites at one side of a place, the place itself included, follows from that of its neighbour. Round a
// period it does so from a turn earlier on.
static bool sweep(const line_t* l) {
  const int size = l->size, turns = l->period != 0 ? 2 : 1;
  const keys step = (keys)((one_key)1 << l->bits), most = (keys)(l->limit << l->bits);
  keys last = most;
  for (int i = 0; i < turns * size; ++i) {
    last = min(min(last, most) + step, l->key[i % size]);
    l->best[i % size] = last;
  }
  last = most;
  for (int i = turns * size - 1; i >= 0; --i) {
    last = min(min(last, most) + step, l->key[i % size]);
    l->best[i % size] = min(l->best[i % size], last);
  }
  return true;
}
#endif

// Finds `best` and what is carried there, of all places. Returns whether all sums held.
static bool find_along_line(const line_t* l) {
#ifdef VOROCL_MANHATTAN
  if (!sweep(l)) return false;
#else
  if (!l->is_listed) {
    add_ends(l);
    return l->takes ? scan(l, true) : scan(l, false);
  }
  if (!divide(l, 0, l->size - 1, l->first, l->last)) return false;
#endif
  look_up(l, 0, l->size - 1);
  return true;
}

// A site's part of a distance, of its way along an axis: no more than `limit`. Ways from `most` on have more.
INLINE keys part_of(int16 way, int most, one_key square) {
#ifdef VOROCL_MANHATTAN
  (void)most, (void)square;
  return TO_KEYS(way);
#elif defined(VOROCL_FAR)
  (void)most;
  return convert_long16(way) * convert_long16(way) * square;
#else
  const uint16 near = as_uint16(min(way, (int16)most));
  return near * near * square;
#endif
}

#endif
