// Along x: the nearest mark of each pixel's row, from bits.

#ifndef VOROCL_MASKS_ROWS
#define VOROCL_MASKS_ROWS

#include "masks/lanes.cl"

#define ITEM_KERNEL kernel __attribute__((reqd_work_group_size(1, 1, 1)))
typedef struct __attribute__((packed)) {
  ushort16 v;
} any_ushort16;
#define LOAD_SHORTS(p) (((global const any_ushort16*)(p))->v)
#define STORE_SHORTS(values, p) (((global any_ushort16*)(p))->v = (values))

// The place of the highest bit of 16 that is set, by the exponent of a float.
INLINE int16 place_of_highest(int16 word) { return (as_int16(convert_float16(word)) >> 23) - 127; }
static inline int lowest_of(uint word) { return (int)popcount((word & -word) - 1); }
static inline int highest_of(uint word) { return 31 - (int)clz(word); }

// Where there are labels: writes those of the nearest marks of a strip, given their columns, the marks of the strip,
// and the next ones at both sides. A mark is its own nearest one.
INLINE void label_strip(int16 column, uint word, int x0, int left, int right, int width, global uint* labels) {
  uint16 label = (uint16)0;
  if (left >= -width) label = (uint16)labels[left < 0 ? left + width : left];
  for (uint rest = word; rest != 0; rest &= rest - 1) {
    const int mark = x0 + lowest_of(rest);
    label = select(label, (uint16)labels[mark], column == mark);
  }
  if (right < 2 * width) {
    const int mark = right >= width ? right - width : right;
    label = select(label, (uint16)labels[mark], column == mark);
  }
  STORE_LANES(uint, label, labels + x0, min(STRIP, width - x0));
}

// Writes the column of the nearest mark for each pixel of a row that has one: of 16 pixels together, then those of the
// next strip, so many values farther on; and its label in a row of labels, or null.
static inline void find_in_row(global const ushort* word, int width, bool is_periodic, global ushort* out,
                               size_t stride, global uint* labels) {
  const int strips = STRIPS_OF(width), period = is_periodic ? width : 0;
  // Marks that are not there are farther than any.
  int none = 1 << 20, left = -none, right = -1;
  if (is_periodic) {
    int first = 0, last = strips - 1;
    while (word[first] == 0) ++first;
    while (word[last] == 0) --last;
    none = width + first * STRIP + lowest_of(word[first]);
    left = last * STRIP + highest_of(word[last]) - width;
  }
  for (int i = 0; i < strips; ++i) {
    const uint w = word[i];
    const int x0 = i * STRIP;
    const int16 x = LANE + x0;
    global ushort* const columns = out + (size_t)i * stride;
    if (w == 0xffff) {
      STORE_SHORTS(convert_ushort16(x), columns);
      left = x0 + STRIP - 1;
      continue;
    }
    if (right < x0 + STRIP) {  // the first mark behind the strip
      int j = i + 1;
      while (j < strips && word[j] == 0) ++j;
      right = j < strips ? j * STRIP + lowest_of(word[j]) : none;
    }
    int16 last = (int16)left, next = (int16)right;
    if (w != 0) {
      const int16 up_to = ((int16)2 << LANE) - 1;
      const int16 below = (int16)((int)w) & up_to, above = (int16)((int)w) & ~up_to;
      last = select(place_of_highest(below) + x0, last, below == 0);
      next = select(place_of_highest(above & -above) + x0, next, above == 0);
    }
    const int16 column = nearer(x, last, next, period);
    STORE_SHORTS(convert_ushort16(column), columns);
    if (labels != 0) label_strip(column, w, x0, left, right, width, labels);
    if (w != 0) left = x0 + highest_of(w);
  }
}

#endif
