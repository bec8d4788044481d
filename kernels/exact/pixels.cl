// The program of exact diagrams of points in the group shape, for devices whose work-items have little memory each: a
// work-item labels a pixel, by all places of the bins around it, in integers.

#include "exact/gather.cl"

typedef struct {
  ulong distance;
  uint place;
} winner_t;

static inline winner_t nearest_in(const scene_t* scene, span_t x, span_t y, int2 centre) {
  winner_t best = {ULONG_MAX, 0};
  walk_t walk = walk_over(scene, x, y);
  uint2 range;
  while (next_range(scene, &walk, &range)) {
    const int2 origin = origin_of(scene, &walk, centre);
    for (uint at = range.s0; at < range.s1; ++at) {
      const ulong distance = length_of(scene->list[at] - origin);
      if (distance > best.distance) continue;
      if (distance == best.distance && !comes_first(scene, at, best.place)) continue;
      best.distance = distance;
      best.place = at;
    }
  }
  return best;
}

// How many pixels away a place may be that is no farther than so many units.
static inline float pixels_of(ulong distance) {
#ifdef VOROCL_EUCLIDEAN
  return sqrt((float)distance) * ((1 + 0x1p-20f) / ONE_PIXEL);
#else
  return (float)distance * ((1 + 0x1p-20f) / ONE_PIXEL);
#endif
}

static inline span_t widened(span_t span, span_t limits) {
  const int length = span.to - span.from + 1;
  return clamped(span_of(span.from - length, span.to + length), limits);
}

static inline uint label_of(const scene_t* scene, int column, int row) {
  const span_t own_x = span_of(column, column), own_y = span_of(row, row);
  const span_t limits_x = limits_of(own_x, scene->width, PERIODIC_X);
  const span_t limits_y = limits_of(own_y, scene->height, PERIODIC_Y);
  const int2 centre = (int2)(column, row) * ONE_PIXEL + HALF_PIXEL;
  span_t x = clamped(with_bins_around(own_x, 1, scene->bins.bits), limits_x);
  span_t y = clamped(with_bins_around(own_y, 1, scene->bins.bits), limits_y);
  while (true) {
    const winner_t best = nearest_in(scene, x, y, centre);
    const bool has_none = best.distance == ULONG_MAX;
    const float reach = pixels_of(best.distance);
    const span_t needed_x = has_none ? widened(x, limits_x) : clamped(span_of_reach(own_x, reach, reach), limits_x);
    const span_t needed_y = has_none ? widened(y, limits_y) : clamped(span_of_reach(own_y, reach, reach), limits_y);
    if (holds(x, needed_x) && holds(y, needed_y)) return has_none ? NO_LABEL : scene->ids[best.place];
    x = joined(x, needed_x);
    y = joined(y, needed_y);
  }
}

// Labels all pixels; those outside the region (left, top, right, bottom, both ends included) get no label.
kernel void label_pixels(global const uint* restrict starts, global const int2* restrict list,
                         global const uint* restrict ids, global const int2* restrict order, int has_images, int bits,
                         int width, int height, int4 region, global uint* restrict out) {
  const int item = (int)get_global_id(0), column = item % width, row = item / width;
  if (row >= height) return;
  const scene_t scene = {bins_of(bits, width, height), width, height, starts, list, ids, has_images ? order : 0,
                         out, region};
  const bool has_label = column >= region.s0 && column <= region.s2 && row >= region.s1 && row <= region.s3;
  out[item] = has_label ? label_of(&scene, column, row) : NO_LABEL;
}
