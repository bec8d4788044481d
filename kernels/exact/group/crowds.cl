// Labelling patches that have too many candidates for a list: boxes of 16 x 16 pixels one after the other, by
// lists that follow each other in parts. Each pixel keeps the place that won so far.

#ifndef VOROCL_EXACT_GROUP_CROWDS
#define VOROCL_EXACT_GROUP_CROWDS

#include "exact/group/patch.cl"

#define CROWD_PIXELS (CROWD_SIDE * CROWD_SIDE)
#define CROWD_BOXES (PATCH / CROWD_SIDE)
#define CROWD_RUN 2  // pixels below each other that an item compares at a time
#ifndef MOST_OF_PART
#define MOST_OF_PART \
  192  // a part is full from so many places on, and then there are BATCH more from each item at most
#endif
#define BATCH 4  // places that an item looks at between two looks at how full the part is
#define PART_ROOM (MOST_OF_PART + BATCH * MOST_OF_CROWD_ITEMS)

typedef struct {
  int4 place[PART_ROOM];  // from the centre of the box, and its lag
  uint at[PART_ROOM];
  uint count;
  ulong least[CROWD_PIXELS];  // by runs; NO_WINNER before there is one
  uint winner[CROWD_PIXELS];
} crowd_t;
#define NO_WINNER (ULONG_MAX / 2)

static inline ulong length_along(int way) {
  return IS_MANHATTAN ? (ulong)abs(way) : (ulong)((long)way * way);
}

// Lets the places of a part stand against those that won so far.
static inline void compare_part(local crowd_t* crowd, const scene_t* scene, int count) {
  for (int run = ITEM(); run < CROWD_PIXELS / CROWD_RUN; run += ITEMS()) {
    const int x = (run % CROWD_SIDE - CROWD_SIDE / 2) * ONE + HALF;
    const int y = (run / CROWD_SIDE * CROWD_RUN - CROWD_SIDE / 2) * ONE + HALF;
    ulong2 least = vload2((size_t)run, crowd->least);
    uint2 winner = vload2((size_t)run, crowd->winner);
    for (int i = 0; i < count; ++i) {
      const int4 place = crowd->place[i];
      const ulong along_x = length_along(place.x - x) + (IS_WEIGHTED ? (ulong)place.w * LAG_UNIT : 0);
#pragma unroll
      for (int k = 0; k < CROWD_RUN; ++k, least = least.s10, winner = winner.s10) {
        const ulong distance = along_x + length_along(place.y - y - k * ONE);
        if (distance <= least.s0) {
          const uint at = crowd->at[i];
          if (distance < least.s0 || is_first(scene, at, winner.s0)) winner.s0 = at;
          least.s0 = distance;
        }
      }
    }
    vstore2(least, (size_t)run, crowd->least);
    vstore2(winner, (size_t)run, crowd->winner);
  }
}

// Labels a box of a patch of the queue. Most work-groups have none.
kernel void label_crowds(SCENE_PARAMETERS, global const uint* restrict queue) {
  local crowd_t crowd;
  local ranges_t ranges;
  local rivals_t rivals;
  const int number = (int)get_group_id(0) / (CROWD_BOXES * CROWD_BOXES);
  if (number >= (int)queue[0]) return;
  const scene_t scene = SCENE_OF_PARAMETERS;
  const box_t patch = box_of_patch(&scene, (int)queue[1 + number]);
  const int left = (int)get_group_id(0) % CROWD_BOXES, top = (int)get_group_id(0) / CROWD_BOXES % CROWD_BOXES;
  const box_t box =
      box_at(patch.x + left * CROWD_SIDE, patch.y + top * CROWD_SIDE, 0, CROWD_SIDE, CROWD_SIDE, 1);
  if (box.x >= size.x || box.y >= size.y) return;
  const spans_t spans = spans_of(box);
  const int4 centre = centre_of(box);
  const bool whole = is_whole(&scene, box);
  for (int pixel = ITEM(); pixel < CROWD_PIXELS; pixel += ITEMS()) crowd.least[pixel] = NO_WINNER;
  if (ITEM() == 0) crowd.count = 0;
  find_rivals(&rivals, &ranges, &scene, box);
  for (int begin = 0; begin < count_ranges(&ranges); begin += ranges_of_chunk()) {
    const uint places = make_ranges(&ranges, &scene, begin);
    int range = 0;
    for (uint batch = 0; batch < places; batch += (uint)ITEMS() * BATCH) {
      const uint end = min(batch + (uint)ITEMS() * BATCH, places);
      for (uint i = batch + (uint)ITEM(); i < end; i += (uint)ITEMS()) {
        uint at;
        const int4 place = place_from(&ranges, &scene, i, centre, &range, &at);
        if (stays(place, &rivals, &spans)) {
          const uint kept = atomic_inc(&crowd.count);
          crowd.place[kept] = place, crowd.at[kept] = at;
        }
      }
      SYNC();
      // A part that is not full, nor the last one of the chunk, is left for more.
      const int part = crowd.count > MOST_OF_PART || end == places ? (int)crowd.count : 0;
      compare_part(&crowd, &scene, part);
      SYNC();
      if (ITEM() == 0 && part > 0) crowd.count = 0;
      SYNC();
    }
  }
  for (int pixel = ITEM(); pixel < CROWD_PIXELS; pixel += ITEMS()) {
    const int column = pixel % CROWD_SIDE, row = pixel / CROWD_SIDE;
    const int at = (row / CROWD_RUN * CROWD_SIDE + column) * CROWD_RUN + row % CROWD_RUN;
    show_label(&scene, whole, box.x + column, box.y + row,
               crowd.least[at] == NO_WINNER ? NO_LABEL : ids[crowd.winner[at]]);
  }
}

#endif
