// The label of one pixel or voxel: the nearest of all places of the bins around it, in integers.

#ifndef VOROCL_EXACT_GROUP_PIXEL
#define VOROCL_EXACT_GROUP_PIXEL

#include "exact/group/patch.cl"

// Of each place its nearest image counts.
static inline winner_t nearest_in(const scene_t* scene, cuboid_t c, int4 centre) {
  winner_t best = {ULONG_MAX, 0};
  const bins_t* const bins = &scene->bins;
  const int4 period = scene->size * (ONE * SPACINGS);
  const int first_row = number_of_row(scene, c.y.from), rows = number_of_row(scene, c.y.to) + 1 - first_row;
  const int first_slice = number_of_slice(scene, c.z.from);
  const int lines = IS_VOLUME ? rows * (number_of_slice(scene, c.z.to) + 1 - first_slice) : rows;
  const int last_image = image_at(c.x.to, scene->size.x, PERIODIC_X);
#pragma unroll 1
  for (int line = 0; line < lines; ++line) {
    const int row = wrapped(first_row + (IS_VOLUME ? line % rows : line), bins->rows, PERIODIC_Y);
    const int slice = IS_VOLUME ? wrapped(first_slice + line / rows, bins->slices, PERIODIC_Z) : 0;
    const int first_bin = (slice * bins->rows + row) * (bins->columns + 1);
#pragma unroll 1
    for (int image = image_at(c.x.from, scene->size.x, PERIODIC_X); image <= last_image; ++image) {
      const span_t own = of_image(c.x, image, scene->size.x, PERIODIC_X);
      const uint end = scene->starts[first_bin + (own.to >> bins->bits.x) + 1];
#pragma unroll 1
      for (uint at = scene->starts[first_bin + (own.from >> bins->bits.x)]; at < end; ++at) {
        ulong distance = length_along(SHORTER(scene->x[at] - centre.x, period.x, PERIODIC_X)) +
                         length_along(SHORTER(scene->y[at] - centre.y, period.y, PERIODIC_Y));
        if (IS_VOLUME) distance += length_along(SHORTER(scene->z[at] - centre.z, period.z, PERIODIC_Z));
        if (IS_WEIGHTED) distance += (ulong)scene->lags[at] * LAG_UNIT;
        if (distance > best.distance) continue;
        if (distance == best.distance && !is_first(scene, at, best.at)) continue;
        best.distance = distance;
        best.at = at;
      }
    }
  }
  return best;
}

// How many pixels before and behind a pixel a place may be that is so far from its centre.
static inline int reach_of(ulong distance) {
  const float units = IS_MANHATTAN ? (float)distance : sqrt((float)distance);
  return (int)fmin(fma(units, (1 + 0x1p-20f) / ONE, 0.5f + 0x1p-10f), (float)(1 << 21));
}

static inline span_t span_around(int at, int reach, span_t limits) {
  return clamped(span_of(at - reach, at + reach), limits);
}
static inline uint label_of(const scene_t* scene, box_t pixel) {
  const cuboid_t limits = limits_around(scene, pixel);
  const int most = max(max(scene->size.x, scene->size.y), scene->size.z);
  int reach = 1 << min(scene->bins.bits.x, scene->bins.bits.y);
  while (true) {
    cuboid_t around = limits;
    around.x = span_around(pixel.x, reach, limits.x), around.y = span_around(pixel.y, reach, limits.y);
    if (IS_VOLUME) around.z = span_around(pixel.z, reach, limits.z);
    const winner_t best = nearest_in(scene, around, centre_of(pixel));
    const bool has_none = best.distance == ULONG_MAX;
    const int needed = has_none ? 2 * reach : reach_of(best.distance);
    if (needed <= reach || reach >= most) return has_none ? NO_LABEL : scene->ids[best.at];
    reach = needed;
  }
}

// Labels the pixels that are open.
kernel void label_open(SCENE_PARAMETERS, global const uint* restrict queue, global const uint* restrict open) {
  const scene_t scene = SCENE_OF_PARAMETERS;
  for (uint i = (uint)get_global_id(0); i < queue[1]; i += (uint)get_global_size(0)) {
    const uint patch = open[i] / PIXELS_OF_PATCH, number = open[i] % PIXELS_OF_PATCH;
    const box_t pixel = pixel_of(box_of_patch(&scene, (int)patch), (int)number);
    show_label(&scene, false, pixel.x, pixel.y, pixel.z, label_of(&scene, pixel));
  }
}

#endif
