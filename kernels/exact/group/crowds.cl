// Labelling boxes of pixels or voxels by lists that follow each other in parts. Each pixel keeps the place
// that won so far. So a volume is labelled, and patches of a plane that have too many candidates for a list.

#ifndef VOROCL_EXACT_GROUP_CROWDS
#define VOROCL_EXACT_GROUP_CROWDS

#include "exact/group/patch.cl"

#define CROWD_PIXELS (CROWD_SIDE * CROWD_SIDE)
#define CROWD_RUN 2  // pixels below each other that an item compares at a time
#define CROWD_RUNS (CROWD_PIXELS / CROWD_RUN)
#define MOST_SHARES (IS_VOLUME ? 1 : 2)  // of a part's places: where there are more items than runs
#ifndef MOST_OF_PART
#define MOST_OF_PART 192  // a part is full from so many places on, and then there is a batch more at most
#endif
#define BATCH 256  // places that are looked at between two looks at how full the part is
#define PART_ROOM (MOST_OF_PART + BATCH)

typedef struct {
  int4 place[PART_ROOM];  // from the centre of the box, and its lag
  uint at[PART_ROOM];
  uint count;
  ulong least[MOST_SHARES * CROWD_PIXELS];  // by runs; NO_WINNER before there is one
  uint winner[MOST_SHARES * CROWD_PIXELS];
} crowd_t;
#define NO_WINNER (ULONG_MAX / 2)

// Run i of a box begins at this pixel: runs along x, then along y and z. All sides along y are even.
static inline int4 start_of_run(int i, box_t b) {
  const int row = i / b.sx * CROWD_RUN;
  return (int4)(i % b.sx, row % b.sy, row / b.sy, 0);
}

// Lets the places of a part stand against those that won so far.
static inline void compare_part(local crowd_t* crowd, const scene_t* scene, box_t box, int count) {
  const int shares = clamp(ITEMS() / CROWD_RUNS, 1, MOST_SHARES);
  for (int at_run = ITEM(); at_run < shares * CROWD_RUNS; at_run += ITEMS()) {
    const int4 start = start_of_run(at_run % CROWD_RUNS, box);
    const int4 from = centre_of(box_at(start.x, start.y, start.z, 1, 1, 1)) -
                      centre_of(box_at(0, 0, 0, box.sx, box.sy, box.sz));
    ulong2 least = vload2((size_t)at_run, crowd->least);
    uint2 winner = vload2((size_t)at_run, crowd->winner);
    for (int i = at_run / CROWD_RUNS; i < count; i += shares) {
      const int4 place = crowd->place[i];
      ulong across = length_along(place.x - from.x);
      if (IS_VOLUME) across += length_along(place.z - from.z);
      if (IS_WEIGHTED) across += (ulong)place.w * LAG_UNIT;
#pragma unroll
      for (int k = 0; k < CROWD_RUN; ++k, least = least.s10, winner = winner.s10) {
        const ulong distance = across + length_along(place.y - from.y - k * ONE * SPACING_Y);
        if (distance <= least.s0) {
          const uint at = crowd->at[i];
          if (distance < least.s0 || is_first(scene, at, winner.s0)) winner.s0 = at;
          least.s0 = distance;
        }
      }
    }
    vstore2(least, (size_t)at_run, crowd->least);
    vstore2(winner, (size_t)at_run, crowd->winner);
  }
}

// The label of a pixel by what won of each share.
static inline uint winner_of(local const crowd_t* crowd, const scene_t* scene, int pixel) {
  int best = pixel;
  for (int other = pixel + CROWD_PIXELS; other < MOST_SHARES * CROWD_PIXELS; other += CROWD_PIXELS) {
    const ulong least = crowd->least[best], distance = crowd->least[other];
    if (distance == NO_WINNER || distance > least) continue;
    if (distance < least || is_first(scene, crowd->winner[other], crowd->winner[best])) best = other;
  }
  return crowd->least[best] == NO_WINNER ? NO_LABEL : scene->ids[crowd->winner[best]];
}

INLINE void label_crowd(local crowd_t* crowd, local ranges_t* ranges, local rivals_t* rivals,
                        const scene_t* scene, box_t box) {
  const spans_t spans = spans_of(box);
  const int4 centre = centre_of(box);
  const bool whole = is_whole(scene, box);
  for (int i = ITEM(); i < MOST_SHARES * CROWD_PIXELS; i += ITEMS()) crowd->least[i] = NO_WINNER;
  if (ITEM() == 0) crowd->count = 0;
  find_rivals(rivals, ranges, scene, box);
  for (int begin = 0; begin < count_ranges(ranges); begin += ranges_of_chunk()) {
    const uint places = make_ranges(ranges, scene, begin);
    int range = 0;
    for (uint batch = 0; batch < places; batch += BATCH) {
      const uint end = min(batch + BATCH, places);
      for (uint i = batch + (uint)ITEM(); i < end; i += (uint)ITEMS()) {
        uint at;
        const int4 place = place_from(ranges, scene, i, centre, &range, &at);
        if (stays(place, rivals, &spans)) {
          const uint kept = atomic_inc(&crowd->count);
          crowd->place[kept] = place, crowd->at[kept] = at;
        }
      }
      SYNC();
      // A part that is not full, nor the last one of the chunk, is left for more.
      const int part = crowd->count > MOST_OF_PART || end == places ? (int)crowd->count : 0;
      compare_part(crowd, scene, box, part);
      SYNC();
      if (ITEM() == 0 && part > 0) crowd->count = 0;
      SYNC();
    }
  }
  for (int pixel = ITEM(); pixel < CROWD_PIXELS; pixel += ITEMS()) {
    const int column = pixel % box.sx, row = pixel / box.sx;
    const int at = (row / CROWD_RUN * box.sx + column) * CROWD_RUN + row % CROWD_RUN;
    show_label(scene, whole, box.x + column, box.y + row % box.sy, box.z + row / box.sy,
               winner_of(crowd, scene, at));
  }
}

#if IS_VOLUME

// Labels a box of a patch that is pending.
kernel void label_boxes(SCENE_PARAMETERS, global const uint* restrict pending) {
  local crowd_t crowd;
  local ranges_t ranges;
  local rivals_t rivals;
  const int group = (int)get_group_id(0), patch = group / (BOXES_ALONG * BOXES_ALONG * BOXES_ALONG);
  if (!pending[patch]) return;
  const scene_t scene = SCENE_OF_PARAMETERS;
  box_t box = box_of_patch(&scene, patch);
  box.x += group % BOXES_ALONG * BOX_WIDTH;
  box.y += group / BOXES_ALONG % BOXES_ALONG * BOX_HEIGHT;
  box.z += group / (BOXES_ALONG * BOXES_ALONG) % BOXES_ALONG * BOX_DEPTH;
  if (!is_in_grid(&scene, box)) return;
  label_crowd(&crowd, &ranges, &rivals, &scene, box_at(box.x, box.y, box.z, BOX_WIDTH, BOX_HEIGHT, BOX_DEPTH));
}

// The same of a volume of one slice, all of it.
kernel void label_squares(SCENE_PARAMETERS) {
  local crowd_t crowd;
  local ranges_t ranges;
  local rivals_t rivals;
  const scene_t scene = SCENE_OF_PARAMETERS;
  const int group = (int)get_group_id(0), columns = (size.x - 1) / CROWD_SIDE + 1;
  label_crowd(&crowd, &ranges, &rivals, &scene,
              box_at(group % columns * CROWD_SIDE, group / columns * CROWD_SIDE, 0, CROWD_SIDE, CROWD_SIDE, 1));
}

#else

#define BOXES_OF_PATCH (PATCH / CROWD_SIDE)

// Labels the boxes of the patches in the queue, of which there are none most often.
kernel void label_crowds(SCENE_PARAMETERS, global const uint* restrict queue) {
  local crowd_t crowd;
  local ranges_t ranges;
  local rivals_t rivals;
  const scene_t scene = SCENE_OF_PARAMETERS;
  const int boxes = (int)queue[0] * BOXES_OF_PATCH * BOXES_OF_PATCH;
#pragma unroll 1
  for (int number = (int)get_group_id(0); number < boxes; number += (int)get_num_groups(0)) {
    const int patch = (int)queue[BEFORE_QUEUE + number / (BOXES_OF_PATCH * BOXES_OF_PATCH)];
    box_t box = box_of_patch(&scene, patch);
    box.x += number % BOXES_OF_PATCH * CROWD_SIDE;
    box.y += number / BOXES_OF_PATCH % BOXES_OF_PATCH * CROWD_SIDE;
    if (is_in_grid(&scene, box))
      label_crowd(&crowd, &ranges, &rivals, &scene, box_at(box.x, box.y, 0, CROWD_SIDE, CROWD_SIDE, 1));
    SYNC();
  }
}

#endif

#endif
