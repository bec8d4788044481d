// The label of one pixel: the nearest of all places of the bins around it, in integers.

#ifndef VOROCL_EXACT_GROUP_PIXEL
#define VOROCL_EXACT_GROUP_PIXEL

#include "exact/group/patch.cl"

static inline ulong length_of(int x, int y) {
#if IS_MANHATTAN
  return (ulong)abs(x) + (ulong)abs(y);
#else
  return (ulong)((long)x * x) + (ulong)((long)y * y);
#endif
}

static inline winner_t nearest_in(const scene_t* scene, span_t x, span_t y, int4 centre) {
  winner_t best = {ULONG_MAX, 0};
  const bins_t* const bins = &scene->bins;
  const int last = number_of_row(scene, y.to), last_image = image_at(x.to, scene->size.x, PERIODIC_X);
#pragma unroll 1
  for (int line = number_of_row(scene, y.from); line <= last; ++line) {
    const int image_y = image_at(line, bins->rows, PERIODIC_Y);
    global const uint* const starts = scene->starts + (line - image_y * bins->rows) * (bins->columns + 1);
    const int origin_y = centre.y - image_y * scene->size.y * ONE;
#pragma unroll 1
    for (int image = image_at(x.from, scene->size.x, PERIODIC_X); image <= last_image; ++image) {
      const span_t own = of_image(x, image, scene->size.x, PERIODIC_X);
      const int origin_x = centre.x - image * scene->size.x * ONE;
      const uint end = starts[(own.to >> bins->bits.x) + 1];
#pragma unroll 1
      for (uint at = starts[own.from >> bins->bits.x]; at < end; ++at) {
        const ulong lag = IS_WEIGHTED ? (ulong)scene->lags[at] * LAG_UNIT : 0;
        const ulong distance = length_of(scene->x[at] - origin_x, scene->y[at] - origin_y) + lag;
        if (distance > best.distance) continue;
        if (distance == best.distance && !is_first(scene, at, best.at)) continue;
        best.distance = distance;
        best.at = at;
      }
    }
  }
  return best;
}

// How many pixels away a place may be that is no farther than so many units.
static inline float pixels_of(ulong distance) {
  return (IS_MANHATTAN ? (float)distance : sqrt((float)distance)) * ((1 + 0x1p-20f) / ONE);
}

static inline uint label_of(const scene_t* scene, int column, int row) {
  const box_t own = box_at(column, row, 0, 1, 1, 1);
  const cuboid_t limits = limits_around(scene, own);
  int reach = 1 << max(scene->bins.bits.x, scene->bins.bits.y);
  while (true) {
    const winner_t best = nearest_in(scene, clamped(span_of(column - reach, column + reach), limits.x),
                                     clamped(span_of(row - reach, row + reach), limits.y), centre_of(own));
    const bool has_none = best.distance == ULONG_MAX;
    const int needed = has_none ? 2 * reach : (int)fmin(pixels_of(best.distance), (float)(1 << 21)) + 2;
    if (needed <= reach || reach >= max(scene->size.x, scene->size.y))
      return has_none ? NO_LABEL : scene->ids[best.at];
    reach = needed;
  }
}

#endif
