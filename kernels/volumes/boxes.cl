// Exact labels by boxes, at any density: a work-item labels a region. It searches the index for the seeds that may win
// in the region, hands them down to tiles of 16 x 16 x 16, and these to boxes of 16 x 8 x 8, labelled by keys, or in
// parts of 8 x 4 x 4 where there are too many. Where a list overflows, the next smaller box searches for itself.

#ifndef VOROCL_VOLUMES_BOXES
#define VOROCL_VOLUMES_BOXES

#include "volumes/keys.cl"

#define TILE 16
#define FEW 5                 // candidates of a tile: so many are tried in all of its boxes
#define ALL_LEFT 0xffffffffu  // of the boxes of a region: a bit for each, those of a tile side by side
#define BOXES 4               // of a tile

// The candidates of a part of a box, from those of the box.
static inline int take(dominators_t* d, box_t part, const ulong* list, int count, ulong* own) {
  begin_dominators(d, part);
  if (count <= FEW) {
    d->seed[0] = (uint)list[0];  // any candidate can be the keys' base
    for (int i = 0; i < count; ++i) own[i] = list[i];
    pad(own, count);
    return count;
  }
  improve(d, list, count);
  return filter(d, list, count, own);
}

static inline int take_or_search(const index_t* index, dominators_t* d, box_t part, const ulong* list, int count,
                                 ulong* own) {
  return count == OVERFLOW ? search(index, part, d, own) : take(d, part, list, count, own);
}

// A box with too many candidates for keys: parts of half its sides have fewer.
__attribute__((noinline)) static void label_parts(const index_t* index, dominators_t* d, const ulong* list, int count,
                                                  global uint* labels) {
  const box_t b = d->box;
  const extent_t e = index->extent;
  ulong of_part[SEED_ROOM];
  for (int i = 0; i < 8; ++i) {
    const box_t part = {b.x + i % 2 * (BOX_X / 2), b.y + i / 2 % 2 * (BOX_Y / 2), b.z + i / 4 * (BOX_Z / 2),
                        BOX_X / 2 - 1, BOX_Y / 2 - 1, BOX_Z / 2 - 1};
    if (part.x >= END_X(e) || part.y >= END_Y(e) || part.z >= END_Z(e)) continue;
    const int in_part = take_or_search(index, d, part, list, count, of_part);
    if (in_part == OVERFLOW) {
      label_by_voxels(index, part, labels);
    } else {
      label_plainly(index, part, of_part, in_part, labels);
    }
  }
}

static inline void label_box(const index_t* index, dominators_t* d, const ulong* list, int count, global uint* labels) {
  if (count == 1) {
    fill(index, d->box, (uint)(list[0] >> 32), labels);
  } else if (count != OVERFLOW && count <= MOST_OF_KEYS) {
    label_by_keys(index, d, list, count, labels);
  } else {
    label_parts(index, d, list, count, labels);
  }
}

kernel void label_regions(global const uint* restrict starts, global const uint* restrict low,
                          global const uint* restrict high, global const uint* restrict seed,
                          global const ulong* restrict list, int width, int height, int depth,
                          global uint* restrict labels, global const uint* restrict boxes_left) {
  const index_t index = {extent_of(width, height, depth), starts, low, high, seed, list};
  const extent_t e = index.extent;
  const int region = (int)get_global_id(0), rx = e.rx, ry = e.ry;
  if (region >= regions_of(e)) return;
  const uint left = boxes_left[region];
  if (left == 0) return;
  const box_t box = {region % rx * REGION + MARGIN_X(e),
                     region / rx % ry * REGION + MARGIN_Y(e),
                     region / rx / ry * REGION + MARGIN_Z(e),
                     REGION - 1,
                     REGION - 1,
                     REGION - 1};
  ulong of_region[SEED_ROOM], of_tile[SEED_ROOM], of_box[SEED_ROOM];
  dominators_t d;
  // Where only some boxes are left, each of them searches for itself.
  const bool all = left == ALL_LEFT;
  const int in_region = all ? search(&index, box, &d, of_region) : OVERFLOW;
  if (in_region == 0 || in_region == 1) {
    fill(&index, box, in_region == 0 ? NO_LABEL : (uint)(of_region[0] >> 32), labels);
    return;
  }
  for (int tile = 0; tile < 8; ++tile) {
    const box_t t = {box.x + tile % 2 * TILE, box.y + tile / 2 % 2 * TILE, box.z + tile / 4 * TILE,
                     TILE - 1, TILE - 1, TILE - 1};
    if (t.x >= END_X(e) || t.y >= END_Y(e) || t.z >= END_Z(e) || (left >> tile * BOXES & 15) == 0) continue;
    const int in_tile = all ? take_or_search(&index, &d, t, of_region, in_region, of_tile) : OVERFLOW;
    if (in_tile == 1) {
      fill(&index, t, (uint)(of_tile[0] >> 32), labels);
      continue;
    }
    for (int part = 0; part < BOXES; ++part) {
      const box_t b = {t.x, t.y + part % 2 * BOX_Y, t.z + part / 2 * BOX_Z, BOX_X - 1, BOX_Y - 1, BOX_Z - 1};
      if (b.y >= END_Y(e) || b.z >= END_Z(e) || (left >> (tile * BOXES + part) & 1) == 0) continue;
      label_box(&index, &d, of_box, take_or_search(&index, &d, b, of_tile, in_tile, of_box), labels);
    }
  }
}

#endif
