// TILTED GRIDS, whose seeds have fractions. What is one period of y further down lies `xy` units further along x, and
// what is one period of z further `xz` and `yz` units along x and y. The tilts come as (xy, xz, yz, reach): along no
// axis is the nearest image of a place farther than `reach` units of the spacing, of whole pixels. Kernels that label,
// and those that find the pairs of cells, have the build option VOROCL_TILTED. A LATTICE comes as the periods in
// pixels, 0 along an axis without one, then 0, and the tilts.

#ifndef VOROCL_LATTICE
#define VOROCL_LATTICE

#include "core/metric.cl"

#ifdef VOROCL_TILTED
#define IS_TILTED 1
#else
#define IS_TILTED 0
#endif
#define TILT_XY(of) ((of)->tilts.x)
#define TILT_XZ(of) ((of)->tilts.y)
#define TILT_YZ(of) ((of)->tilts.z)
#define REACH_OF_TILTS(of) ((of)->tilts.w)

// What repeats, in units of the spacing: the periods, 0 along an axis without one, and the tilts.
typedef struct {
  long x, y, z;
  int4 tilts;
} lattice_t;
static inline lattice_t lattice_of(int period_x, int period_y, int period_z, int4 tilts, int unit) {
  const lattice_t lattice = {(long)period_x * unit * SPACING_X, (long)period_y * unit * SPACING_Y,
                             (long)period_z * unit * SPACING_Z,
                             tilts * (int4)(SPACING_X, SPACING_X, SPACING_Y, 0)};
  return lattice;
}

static inline long shorter_way_of(long way, long period) {
  if (period == 0) return way;
  if (way >= period || way <= -period) way %= period;  // rare, and a division takes long
  return 2 * way > period ? way - period : 2 * way <= -period ? way + period : way;
}

// How many periods to add to the shorter way: 0, then 1 and -1, or -1 and 1, and so on, so that the ways never get
// shorter.
static inline int turns_outward(long shorter, int number) {
  const int turns = (number + 1) / 2;
  return (number % 2 != 0) == (shorter > 0) ? -turns : turns;
}

// The shortest of a way and those round by the periods. Of equally short ones it is that to the nearest slice of
// images, then to its nearest row; of two equally near that of the way which is not below 0.
static inline int4 shortest_way_round(const lattice_t* l, long x, long y, long z) {
  const long near_z = shorter_way_of(z, l->z), periods_z = l->z == 0 ? 0 : (z - near_z) / l->z;
  int4 shortest = 0;
  ulong least = ULONG_MAX;
  for (int i = 0; i == 0 || l->z != 0; ++i) {
    const long turns_z = turns_outward(near_z, i), along_z = near_z + turns_z * l->z;
    const ulong of_z = (ulong)ALONG(along_z);
    if (of_z >= least) break;
    const long x_there = x + (turns_z - periods_z) * TILT_XZ(l), y_there = y + (turns_z - periods_z) * TILT_YZ(l);
    const long near_y = shorter_way_of(y_there, l->y), periods_y = l->y == 0 ? 0 : (y_there - near_y) / l->y;
    for (int j = 0; j == 0 || l->y != 0; ++j) {
      const long turns_y = turns_outward(near_y, j), along_y = near_y + turns_y * l->y;
      const ulong of_row = of_z + (ulong)ALONG(along_y);
      if (of_row >= least) break;
      const long along_x = shorter_way_of(x_there + (turns_y - periods_y) * TILT_XY(l), l->x);
      const ulong distance = of_row + (ulong)ALONG(along_x);
      if (distance >= least) continue;
      least = distance, shortest = (int4)((int)along_x, (int)along_y, (int)along_z, 0);
    }
  }
  return shortest;
}

#endif
