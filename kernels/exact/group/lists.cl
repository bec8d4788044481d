// Labelling a patch by a list of the places that may win in it, of which boxes of 16 x 16 pixels take what
// may win in them.

#ifndef VOROCL_EXACT_GROUP_LISTS
#define VOROCL_EXACT_GROUP_LISTS

#include "exact/group/patch.cl"

#ifndef MOST_RANKED
#define MOST_RANKED 128
#endif
#define MOST_IN_BOX 64

#define BOXES 4
#define BOX (PATCH / 2)
#define RUN 8  // pixels below each other that an item labels at a time
#define RUNS (BOX * BOX / RUN)
#define FAR_BITS (32 - LOW_BITS)

typedef struct {
  int4 place[MOST_RANKED];  // from the patch's centre, and its lag
  uint at[MOST_RANKED];
  int order[MOST_RANKED + 4];
  int4 term[MOST_RANKED];  // by rank (keys.cl): |c|^2 >> LOW_BITS, and the place, from a pixel's centre
  uint label[MOST_RANKED];
  int rank[MOST_RANKED];
  uint count, rank_sum;
} listed_t;

// Of each box the parts of its candidates' keys: of the patch's centre, of a column and of a row.
typedef struct {
  int4 term[BOXES][MOST_IN_BOX];
  uint least[BOXES], count[BOXES];
  rival_t rival[BOXES];
  uint failed;
} boxes_t;

// The lowest bit of what is less than no key, where there are no candidates.
#define NO_RANK 1
static inline uint bits_of_rank(uint count) { return 32 - clz(max(count, 2u) - 1); }

// --- ranks ---

// |c|^2, and the lag, without 64 bits: c is whole * 2^F + rest along each axis (keys.cl).
static inline uint rests_of(int4 c) {
  const uint x = (uint)c.x & (ONE - 1u), y = (uint)c.y & (ONE - 1u);
  return x * x + y * y;
}
static inline uint high_of(int4 c) {
  const uint whole_x = (uint)(c.x >> FRACTION_BITS), whole_y = (uint)(c.y >> FRACTION_BITS);
  const uint mixed = whole_x * ((uint)c.x & (ONE - 1u)) + whole_y * ((uint)c.y & (ONE - 1u));
  return ((whole_x * whole_x + whole_y * whole_y) << (FRACTION_BITS - 1)) + mixed +
         (rests_of(c) >> LOW_BITS) + (uint)c.w;
}
static inline int low_of(int4 c) {
  return IS_MANHATTAN ? 0 : (int)(rests_of(c) & ((1u << LOW_BITS) - 1)) - ONE;
}
static inline int4 from_pixel(int4 place) { return place - (int4)(HALF, HALF, 0, 0); }

// What orders candidates by their low bits and the tie rule, as far as it is enough.
static inline int order_of(local const listed_t* listed, const scene_t* scene, int i) {
  const uint at = listed->at[i];
#if FRACTION_BITS == 1
  return (own_y(scene, at) >> 1 << SIDE_BITS) + (own_x(scene, at) >> 1);
#else
  const int most = 1 << (FAR_BITS - 1);
  const int way = sub_sat(own_y(scene, at), own_y(scene, listed->at[0]));
  return (low_of(from_pixel(listed->place[i])) << FAR_BITS) + clamp(way, -most, most - 1) + most;
#endif
}
// Whether the candidate a comes before b; images of one seed stand in the list's order.
static inline bool ranks_before(local const listed_t* listed, const scene_t* scene, int a, int b) {
  const int low_a = low_of(from_pixel(listed->place[a])), low_b = low_of(from_pixel(listed->place[b]));
  if (low_a != low_b) return low_a < low_b;
  if (is_first(scene, listed->at[a], listed->at[b])) return true;
  return !is_first(scene, listed->at[b], listed->at[a]) && a < b;
}

static inline void take_rank(local listed_t* listed, const scene_t* scene, int i, int rank) {
  const int4 place = from_pixel(listed->place[i]);
  listed->term[rank] = (int4)((int)high_of(place), place.x, place.y, place.w);
  listed->label[rank] = scene->ids[listed->at[i]];
}

INLINE void rank_listed(local listed_t* listed, const scene_t* scene, int count) {
  for (int i = ITEM(); i < count + 3; i += ITEMS())
    listed->order[i] = i < count ? order_of(listed, scene, i) : INT_MAX;
  SYNC();
  for (int i = ITEM(); i < count; i += ITEMS()) {
    const int own = listed->order[i];
    int4 before = (int4)(0);
    for (int other = 0; other < count; other += 4)
      before = select(before, before + 1, vload4(0, listed->order + other) < own);
    const int rank = before.s0 + before.s1 + before.s2 + before.s3;
    atomic_add(&listed->rank_sum, (uint)rank);
    listed->rank[i] = rank;
  }
  SYNC();
  const bool has_ties = listed->rank_sum != (uint)(count * (count - 1) / 2);
  for (int i = ITEM(); i < count; i += ITEMS()) {
    int rank = has_ties ? 0 : listed->rank[i];
    for (int other = 0; has_ties && other < count; ++other)
      rank += ranks_before(listed, scene, other, i) ? 1 : 0;
    take_rank(listed, scene, i, rank);
  }
  SYNC();
}

// --- boxes: a quarter of the items has each ---

static inline int box_of_item(void) { return ITEM() / (ITEMS() / BOXES); }
static inline int item_of_box(void) { return ITEM() % (ITEMS() / BOXES); }
static inline int items_of_box(void) { return ITEMS() / BOXES; }

// A candidate from the centre of a box, and its lag.
static inline int4 from_box(int4 term, int box) {
  return (int4)(term.y, term.z, 0, term.w) -
         (int4)((box % 2 * BOX - BOX / 2) * ONE - HALF, (box / 2 * BOX - BOX / 2) * ONE - HALF, 0, 0);
}

// A term of a box, less that of the place nearest to its centre; `hold` says whether keys hold it.
static inline int4 term_for(int4 term, int4 base, int box, uint rank, uint bits, bool* hold) {
  const float most = 0x1.fp30f / (float)(1u << bits);
  const int4 base_place = from_box(base, box);
#if IS_MANHATTAN
  *hold = 256.f * ONE < most;
  const uint distance = abs(base_place.x) + abs(base_place.y);
  return (int4)(term.y, term.z, (int)(rank - (distance << bits)), 0);
#else
  const int4 place = from_box(term, box);
  const float way_x = fabs((float)(place.x - base_place.x)), way_y = fabs((float)(place.y - base_place.y));
  const float sum_x = fabs((float)place.x + (float)base_place.x);
  const float sum_y = fabs((float)place.y + (float)base_place.y);
  float spread = fma(way_x, sum_x, way_y * sum_y) * (1.f / (1 << LOW_BITS)) + (way_x + way_y) * (BOX / 2 + 1);
  if (IS_WEIGHTED) spread += fabs((float)(term.w - base.w));
  *hold = spread < most;
  return (int4)((int)(((uint)(term.x - base.x) << bits) + rank), (int)((uint)(base.y - term.y) << bits),
                (int)((uint)(base.z - term.z) << bits), 0);
#endif
}

// The keys of a run: a place's distance, less what is the same for all places, above its rank.
static inline int8 keys_of(int4 term, int column, int row, uint bits) {
#if IS_MANHATTAN
  const uint along_x = abs(column * ONE - term.x);
  const uint8 along_y = abs((row + EIGHT) * ONE - term.y);
  return as_int8(((along_y + along_x) << bits) + (uint)term.z);
#else
  (void)bits;
  const int a = term.x + term.y * column + term.z * row, b = a + term.z, c = b + term.z, d = c + term.z;
  const int e = d + term.z, f = e + term.z, g = f + term.z, h = g + term.z;
  return (int8)(a, b, c, d, e, f, g, h);
#endif
}

// Each box takes the candidates that the one nearest to its centre does not drop.
INLINE void fill_boxes(local boxes_t* boxes, local const listed_t* listed, int count) {
  const uint bits = bits_of_rank((uint)count);
  const spans_t spans = spans_of(box_at(0, 0, 0, BOX, BOX, 1));
  const int box = box_of_item();
  if (ITEM() < BOXES) boxes->least[ITEM()] = UINT_MAX, boxes->count[ITEM()] = 0;
  SYNC();
  uint least = UINT_MAX;
  for (int i = item_of_box(); i < count; i += items_of_box())
    least = min(least, (as_uint(farness_of(from_box(listed->term[i], box))) & ~(NUMBERS - 1u)) | (uint)i);
  if (least != UINT_MAX) atomic_min(boxes->least + box, least);
  SYNC();
  if (ITEM() < min(count, 1) * BOXES) {
    const int4 place = from_box(listed->term[boxes->least[ITEM()] & (NUMBERS - 1)], ITEM());
    boxes->rival[ITEM()] =
        rival_at((float4)((float)place.x, (float)place.y, 0, (float)place.w * LAG_UNIT), &spans);
  }
  SYNC();
  uint failed = 0;
  for (int i = item_of_box(); i < count; i += items_of_box()) {
    const int4 term = listed->term[i];
    if (stays_by(from_box(term, box), boxes->rival + box, &spans)) {
      bool hold;
      const uint number = atomic_inc(boxes->count + box);
      const int4 base = listed->term[boxes->least[box] & (NUMBERS - 1)];
      const int4 of_box = term_for(term, base, box, (uint)i, bits, &hold);
      if (number < MOST_IN_BOX) boxes->term[box][number] = of_box;
      failed |= number < MOST_IN_BOX && hold ? 0 : 1;
    }
  }
  if (failed) atomic_or(&boxes->failed, 1u);
  SYNC();
}

// Labels the patches that are pending, or queues them.
kernel void list_patches(SCENE_PARAMETERS, global const uint* restrict pending, global uint* restrict queue) {
  local ranges_t ranges;
  local rivals_t rivals;
  local listed_t listed;
  local boxes_t boxes;
  if (!pending[get_group_id(0)]) return;
  const scene_t scene = SCENE_OF_PARAMETERS;
  const box_t patch = box_of_patch(&scene, (int)get_group_id(0));
  const spans_t spans = spans_of(patch);
  const int4 centre = centre_of(patch);
  if (ITEM() == 0) listed.count = listed.rank_sum = 0;
  find_rivals(&rivals, &ranges, &scene, patch);
  for (int begin = 0; begin < count_ranges(&ranges); begin += ranges_of_chunk()) {
    const uint places = make_ranges(&ranges, &scene, begin);
    int range = 0;
    for (uint i = (uint)ITEM(); i < places; i += (uint)ITEMS()) {
      uint at;
      const int4 place = place_from(&ranges, &scene, i, centre, &range, &at);
      if (stays(place, &rivals, &spans)) {
        const uint number = atomic_inc(&listed.count);
        if (number < MOST_RANKED) listed.place[number] = place, listed.at[number] = at;
      }
    }
  }
  SYNC();
  // From here on a list that is too long counts as empty.
  const int count = listed.count > MOST_RANKED ? 0 : (int)listed.count;
  if (ITEM() == 0) {
    listed.label[NO_RANK] = NO_LABEL;
    boxes.failed = listed.count > MOST_RANKED ? 1 : 0;
  }
  rank_listed(&listed, &scene, count);
  fill_boxes(&boxes, &listed, count);
  const uint bits_below = bits_of_rank((uint)count), mask = (1u << bits_below) - 1;
  const int runs = boxes.failed ? 0 : RUNS;
  const int box = box_of_item(), left = box % 2 * BOX, top = box / 2 * BOX;
  if (ITEM() == 0 && runs == 0) queue[BEFORE_QUEUE + atomic_inc(queue)] = (uint)get_group_id(0);
  for (int run = item_of_box(); run < runs; run += items_of_box()) {
    const int column = left + run % BOX, row = top + run / BOX * RUN;
    int8 least = (int8)INT_MAX;
    const int some = (int)boxes.count[box];
#pragma unroll 1  // for registers
    for (int i = 0; i < some; ++i)
      least = min(least, keys_of(boxes.term[box][i], column - PATCH / 2, row - PATCH / 2, bits_below));
    // The rows in the grid, and those of them that get labels.
    const int x = patch.x + column, y = patch.y + row, rows = x < size.x ? size.y - y : 0;
    const int from = x >= first.x && x <= last.x ? first.y - y : RUN, to = last.y - y;
    global uint* const out = labels + y * size.x + x;
#pragma unroll
    for (int k = 0; k < RUN; ++k, least = least.s12345670) {
      if (k < rows) out[k * size.x] = k >= from && k <= to ? listed.label[(uint)least.s0 & mask] : NO_LABEL;
    }
  }
}

#endif
