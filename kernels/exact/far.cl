// Labels of a window that all seeds are far from: each pixel is held against all places that may own one.
// They are few, unless many seeds are nearly as far.

#include "core/metric.cl"
#include "core/units.cl"

// Places and pixels are counted from the window's first pixel; `order` says by id which seed comes first.
kernel void label_far(global const int2* restrict places, global const uint* restrict ids,
                      global const int2* restrict order, uint count, int4 size, int4 first, int4 last,
                      global uint* restrict labels) {
  const int x = (int)(get_global_id(0) % (size_t)size.x), y = (int)(get_global_id(0) / (size_t)size.x);
  if (y >= size.y) return;
  uint label = NO_LABEL;
  LENGTH least = MOST_LENGTH;
  const bool has_label = x >= first.x && y >= first.y && x <= last.x && y <= last.y;
  for (uint i = 0; has_label && i < count; ++i) {
    const uint id = ids[i];
    const LENGTH way_x = places[i].x - (LENGTH)x, way_y = places[i].y - (LENGTH)y,
                 away = ALONG(way_x) + ALONG(way_y);
    const bool is_first =
        away == least && (order[id].y < order[label].y || (order[id].y == order[label].y && id < label));
    if (away < least || is_first) least = away, label = id;
  }
  labels[get_global_id(0)] = label;
}
