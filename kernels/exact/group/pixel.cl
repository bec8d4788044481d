// The label of one pixel or voxel: the nearest of all places of the bins around it, in integers.

#ifndef VOROCL_EXACT_GROUP_PIXEL
#define VOROCL_EXACT_GROUP_PIXEL

#include "exact/group/patch.cl"

// How many pixels before and behind a pixel a place may be that is so far from its centre.
static inline int reach_of(float pixels) { return (int)fmin(fma(pixels, 1 + 0x1p-20f, 0.5f + 0x1p-10f), 0x1p21f); }
static inline float pixels_of(ulong distance) {
  return (IS_MANHATTAN ? (float)distance : sqrt((float)distance)) * (1.f / ONE);
}

// A row of bins along y, or a slice of them along z: where it stands in the index, its image, and how far a pixel's
// centre is from it at least. (Places outside a window, which stand in its border, are farther.)
typedef struct {
  int number, image;
  float way;
} line_of_bins_t;
static inline line_of_bins_t line_of_bins(int line, int lines, int bits, int size, int pixel, int tilt, int periodic) {
  line_of_bins_t l;
  l.image = image_at(line, lines, periodic), l.number = line - l.image * lines;
  const int from = l.image * size + (l.number << bits) - pixel;
  const span_t own = moved_on(span_of(from, from + (1 << bits)), tilt);
  l.way = fmax(fmax((float)own.from - 0.5f, 0.5f - (float)own.to), 0.f);
  return l;
}
static inline span_t span_around(int at, int reach, span_t limits) {
  return clamped(span_of(at - reach, at + reach), limits);
}
// Lines k = 0, 1, ... lead away from one, on both sides in turn.
static inline int line_outward(int own, int k) { return k % 2 != 0 ? own + (k + 1) / 2 : own - k / 2; }
static inline int count_outward(int own, int first, int last) { return 2 * max(own - first, last - own) + 1; }

// Looks no farther along a row than what it found, a span of it in an image in which the pixel's centre is there.
static inline void take_nearest_of_row(const scene_t* scene, int4 of_row, span_t x, int first_bin, winner_t* best) {
  const bins_t* const bins = &scene->bins;
  const int last_image = image_at(x.to, scene->size.x, PERIODIC_X);
#pragma unroll 1
  for (int image = image_at(x.from, scene->size.x, PERIODIC_X); image <= last_image; ++image) {
    const span_t own = of_image(x, image, scene->size.x, PERIODIC_X);
    const int4 centre = of_row - way_to_image(scene, image, 0, 0);
    const uint end = scene->starts[first_bin + (own.to >> bins->bits.x) + 1];
#pragma unroll 1
    for (uint at = scene->starts[first_bin + (own.from >> bins->bits.x)]; at < end; ++at) {
      ulong distance = length_along(scene->x[at] - centre.x) + length_along(scene->y[at] - centre.y);
      if (IS_VOLUME) distance += length_along(scene->z[at] - centre.z);
      if (IS_WEIGHTED) distance += (ulong)scene->lags[at] * LAG_UNIT;
      if (distance > best->distance) continue;
      if (distance == best->distance && !is_first(scene, at, best->at)) continue;
      best->distance = distance;
      best->at = at;
    }
  }
}

static inline winner_t nearest_in(const scene_t* scene, cuboid_t c, box_t pixel) {
  winner_t best = {ULONG_MAX, 0};
  const bins_t* const bins = &scene->bins;
  const int first_slice = number_of_slice(scene, c.z.from), last_slice = number_of_slice(scene, c.z.to);
  const int own_slice = number_of_slice(scene, pixel.z);
#if IS_TILTED
  const int rows = 2 * most_rows(scene, max(pixel.y - c.y.from, c.y.to - pixel.y)) + 1;
#else
  const int rows = count_outward(number_of_row(scene, pixel.y), number_of_row(scene, c.y.from),
                                 number_of_row(scene, c.y.to));
#endif
  const int lines = IS_VOLUME ? rows * count_outward(own_slice, first_slice, last_slice) : rows;
#pragma unroll 1
  for (int i = 0; i < lines; ++i) {
    const int slice = IS_VOLUME ? line_outward(own_slice, i / rows) : 0;
    if (IS_VOLUME && (slice < first_slice || slice > last_slice)) continue;
    line_of_bins_t z = {0, 0, 0};
    if (IS_VOLUME) z = line_of_bins(slice, bins->slices, bins->bits.z, scene->size.z, pixel.z, 0, PERIODIC_Z);
    const int tilt = tilt_of_slice(scene, z.image);
    const span_t along_y = moved_back(c.y, tilt), own_y = moved_back(span_of(pixel.y, pixel.y), tilt);
    const int row = line_outward(number_of_row(scene, own_y.from), IS_VOLUME ? i % rows : i);
    if (row < number_of_row(scene, along_y.from) || row > number_of_row(scene, along_y.to)) continue;
    const line_of_bins_t y = line_of_bins(row, bins->rows, bins->bits.y, scene->size.y, pixel.y, tilt, PERIODIC_Y);
    const float radius = best.distance == ULONG_MAX ? 0x1p20f : pixels_of(best.distance) * (1 + 0x1p-20f);
    const float rest = IS_MANHATTAN ? radius - y.way : radius * radius - y.way * y.way - z.way * z.way;
    if (rest < 0) continue;
    const int reach = reach_of(IS_MANHATTAN ? rest : sqrt(rest));
    const span_t x = moved_back(span_around(pixel.x, reach, c.x), tilt_of_row(scene, y.image, z.image));
    take_nearest_of_row(scene, centre_of(pixel) - way_to_image(scene, 0, y.image, z.image), x,
                        (z.number * bins->rows + y.number) * (bins->columns + 1), &best);
  }
  return best;
}

static inline uint label_of(const scene_t* scene, box_t pixel) {
  const cuboid_t limits = limits_around(scene, pixel);
  int most = max(max(scene->size.x, scene->size.y), scene->size.z);
#if IS_TILTED
  most = max(most, REACH_OF_TILTS(scene) + 1);
#endif
  int reach = 1 << max(max(scene->bins.bits.x, scene->bins.bits.y), scene->bins.bits.z);
  while (true) {
    cuboid_t around = limits;
    around.x = span_around(pixel.x, reach, limits.x), around.y = span_around(pixel.y, reach, limits.y);
    if (IS_VOLUME) around.z = span_around(pixel.z, reach, limits.z);
    const winner_t best = nearest_in(scene, around, pixel);
    const bool has_none = best.distance == ULONG_MAX;
    const int needed = has_none ? 2 * reach : reach_of(pixels_of(best.distance));
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
