// What doubles do not decide: the sign of a determinant in whole numbers, and where that is 0, of the same
// determinant of sites whose weights differ by infinitely little (the first site's is the greatest). So all
// vertices have three planes, all cells agree, and being a neighbour is mutual, in lattices too.
//
// Weights may make a cell that is flat. So that it is empty, the sides of the box come first, by infinitely
// little, to where the box is smaller, and then all weights are greater by the same infinitely small part of
// themselves. (With heights |p|^2 - w over the sites a cell is empty if its site's point is above, and flat if
// it is on, a plane through others around it. As if |p|^2 were divided by a little more than 1, it is above: the
// square at a mean of places is less than the mean of the squares.)
//
// How large the numbers are: with positions of b = 40 bits, n has b + 1 bits and a sign, a determinant of
// three is less than 2^(3 b + 3), |n|^2 less than 2^(2 b + 2), and a lag at most 2^(2 b + 3), beyond which a
// cell is empty: so c is less than 2^(2 b + 4), their product less than 2^(5 b + 7) = 2^207, and a sum of
// four less than 2^209. So determinants and c take 128 bits, and sums 256. In a tilted box,
// whose sides have 2^39 steps at most, a cell begins as a cube with half of the box's diagonal each way. Its corners
// are at most 1.5 sides away, and sites that may cut 3 sides: less than the diagonal of a box of 2^40.

#ifndef VOROCL_EXACT_CELLS_SIDES
#define VOROCL_EXACT_CELLS_SIDES

#include "exact_cells/volumes/cell.cl"

static inline wide_t negative(wide_t a) {
  const wide_t wide = {0 - a.low, (long)(~(ulong)a.high + (a.low == 0 ? 1u : 0u))};
  return wide;
}

static inline wide_t widened(long a) {
  const wide_t wide = {(ulong)a, a < 0 ? -1 : 0};
  return wide;
}

static inline wide_t times(wide_t a, long b) {
  const ulong low = (ulong)b, high = b < 0 ? ~0UL : 0;
  const wide_t wide = {a.low * low, (long)(upper_half(a.low, low) + a.low * high + (ulong)a.high * low)};
  return wide;
}

typedef struct {
  long x, y, z;
} way_t;

// A plane in whole numbers, of which those of walls are short.
#define WALL 0x1p39
static inline double4 whole_plane(double4 plane, uint site) { return site == NO_CELL ? plane / WALL : plane; }

static inline way_t way_of(double4 plane) {
  const way_t way = {(long)plane.x, (long)plane.y, (long)plane.z};
  return way;
}

static inline wide_t minor_of(long a, long b, long c, long d) { return sum(product(a, d), negative(product(b, c))); }

// Numbers of 256 bits that are not negative, the lowest 64 first.
typedef struct {
  ulong s[4];
} wider_t;

static inline void add_product(wider_t* to, wide_t p, wide_t q) {
  const ulong p_high = (ulong)p.high, q_high = (ulong)q.high;
  ulong r[4] = {p.low * q.low, upper_half(p.low, q.low), p_high * q_high, upper_half(p_high, q_high)};
  for (int side = 0; side < 2; ++side) {
    const ulong s = side != 0 ? p.low : p_high, t = side != 0 ? q_high : q.low, low = s * t;
    r[1] += low;
    const ulong with = upper_half(s, t) + (r[1] < low ? 1u : 0u);  // at most 2^64 - 1
    r[2] += with;
    r[3] += r[2] < with ? 1u : 0u;
  }
  ulong carry = 0;
  for (int i = 0; i < 4; ++i) {
    const ulong with = r[i] + carry;
    carry = with < carry ? 1u : 0u;
    to->s[i] += with;
    carry += to->s[i] < with ? 1u : 0u;
  }
}

// A sum of some products, as what is positive of it less what is negative.
static inline void sum_products(const wide_t* a, const wide_t* b, int count, wider_t* more, wider_t* less) {
  const wider_t zero = {{0, 0, 0, 0}};
  *more = *less = zero;
  for (int k = 0; k < count; ++k) {
    const bool is_below = a[k].high < 0, is_other_below = b[k].high < 0;
    add_product(is_below != is_other_below ? less : more, is_below ? negative(a[k]) : a[k],
                is_other_below ? negative(b[k]) : b[k]);
  }
}

static inline int sign_of_difference(const wider_t* more, const wider_t* less) {
  for (int i = 3; i >= 0; --i) {
    if (more->s[i] != less->s[i]) return more->s[i] > less->s[i] ? 1 : -1;
  }
  return 0;
}

static inline int sign_of_sum(const wide_t* a, const wide_t* b) {
  wider_t more, less;
  sum_products(a, b, 4, &more, &less);
  return sign_of_difference(&more, &less);
}

// A sum of three products, right but for 2^-51 of itself.
static inline double sum_of_products(const wide_t* a, const wide_t* b) {
  wider_t more, less;
  sum_products(a, b, 3, &more, &less);
  const bool is_negative = sign_of_difference(&more, &less) < 0;
  const wider_t* const from = is_negative ? &less : &more;
  const wider_t* const take = is_negative ? &more : &less;
  double total = 0, unit = 1;
  ulong borrow = 0;
  for (int i = 0; i < 4; ++i, unit *= 0x1p64) {
    const ulong with = take->s[i] + borrow, here = from->s[i] - with;
    borrow = (with < borrow ? 1u : 0u) | (from->s[i] < with ? 1u : 0u);
    total += convert_double(here) * unit;
  }
  return is_negative ? -total : total;
}

// A whole number that is not negative.
static inline wide_t whole(double number) {
  const double high = trunc(number * 0x1p-64);
  const wide_t wide = {(ulong)(number - high * 0x1p64), (long)high};
  return wide;
}

// By how much a site's lag is greater than that of the cell.
static inline wide_t lag_beyond(const cell_t* cell, uint site) {
  return sum(whole(cell->lags[site]), negative(whole(cell->lag)));
}

// The c of a plane.
static inline wide_t constant_of(const cell_t* cell, way_t n, double c, uint site) {
  if (site == NO_CELL) return product((long)c, 1);
  const wide_t square = sum(sum(product(n.x, n.x), product(n.y, n.y)), product(n.z, n.z));
  if (cell->lags == 0) return square;
  return sum(square, lag_beyond(cell, site));
}

// Of four planes in whole numbers: for each the determinant of the three others, with a sign, and the sign of
// the sum of these times c. `sites` are behind them.
static inline int wide_side(const cell_t* cell, const double4* planes, const uint* sites, wide_t* determinants) {
  wide_t constants[4];
  way_t n[4];
  for (int k = 0; k < 4; ++k) {
    n[k] = way_of(planes[k]);
    constants[k] = constant_of(cell, n[k], planes[k].w, sites[k]);
  }
  for (int k = 0; k < 3; ++k) {
    const way_t q = n[k == 2 ? 0 : k + 1], r = n[k == 0 ? 2 : k - 1];
    const wide_t x = minor_of(q.y, q.z, r.y, r.z), y = minor_of(q.z, q.x, r.z, r.x), z = minor_of(q.x, q.y, r.x, r.y);
    determinants[k] = sum(sum(times(x, n[3].x), times(y, n[3].y)), times(z, n[3].z));
    if (k == 0) determinants[3] = negative(sum(sum(times(x, n[0].x), times(y, n[0].y)), times(z, n[0].z)));
  }
  return sign_of_sum(constants, determinants);
}

// As wide_side(), of numbers of 11 bits but for a common power of two, as those of lattices are: then determinants
// are doubles, and all takes 62 bits. False if they are longer. (All bisectors, and all c, may be divided by one power
// of two: no sign changes.)
static inline bool narrow_side(const cell_t* cell, const double4* p, const uint* sites, wide_t* determinants,
                               int* side) {
  double4 x = (double4)(p[0].x, p[1].x, p[2].x, p[3].x), y = (double4)(p[0].y, p[1].y, p[2].y, p[3].y),
          z = (double4)(p[0].z, p[1].z, p[2].z, p[3].z);
  const double4 c = (double4)(p[0].w, p[1].w, p[2].w, p[3].w);
  const long4 is_wall = convert_long4(vload4(0, sites) == NO_CELL);
  const double4 none = 0;
  const ulong4 of_all = convert_ulong4(fabs(select(x, c, is_wall))) | convert_ulong4(fabs(select(y, none, is_wall))) |
                        convert_ulong4(fabs(select(z, none, is_wall)));
  const ulong bits = of_all.s0 | of_all.s1 | of_all.s2 | of_all.s3;
  const int shift = lowest_of(bits);
  if (bits >> shift >= 1UL << 11) return false;
  const double unit = as_double((ulong)(1023 - shift) << 52);  // 2^-shift
  const double4 units = select((double4)(unit), (double4)(1), is_wall);
  x *= units;
  y *= units;
  z *= units;
  double4 constants = select(x * x + y * y + z * z, c * unit, is_wall);
  for (int k = 0; k < 4 && cell->lags != 0; ++k) {
    if (sites[k] == NO_CELL) continue;
    const double lag = cell->lags[sites[k]], more = lag - cell->lag, shifted = more * unit * unit;
    if (more + cell->lag != lag || lag - more != cell->lag || !(fabs(shifted) < 0x1p23) || shifted != trunc(shifted))
      return false;
    ((double*)&constants)[k] += shifted;
  }
  const double4 qx = x.s1201, qy = y.s1201, qz = z.s1201, rx = x.s2012, ry = y.s2012, rz = z.s2012;
  const double4 way_x = (double4)(x.s333, -x.s0), way_y = (double4)(y.s333, -y.s0), way_z = (double4)(z.s333, -z.s0);
  const double4 minors_x = qy * rz - qz * ry, minors_y = qz * rx - qx * rz, minors_z = qx * ry - qy * rx;
  const long4 found = convert_long4(minors_x * way_x + minors_y * way_y + minors_z * way_z);
  const long4 parts = found * convert_long4(constants);
  const long total = parts.s0 + parts.s1 + parts.s2 + parts.s3;
  determinants[0] = widened(found.s0);
  determinants[1] = widened(found.s1);
  determinants[2] = widened(found.s2);
  determinants[3] = widened(found.s3);
  *side = (total > 0) - (total < 0);
  return true;
}

// On which side of a plane a vertex is: 1 is beyond it. 0 only if `is_plain`, or if no weights make a
// difference.
static inline int side_of(const cell_t* cell, int v, double4 plane, uint site, bool is_plain) {
  const indices_t t = cell->triples[v];
  const uint sites[4] = {cell->sites[t.s0], cell->sites[t.s1], cell->sites[t.s2], site};
  const double4 planes[4] = {whole_plane(cell->planes[t.s0], sites[0]), whole_plane(cell->planes[t.s1], sites[1]),
                             whole_plane(cell->planes[t.s2], sites[2]), whole_plane(plane, site)};
  wide_t determinants[4];
  int side;
  if (!narrow_side(cell, planes, sites, determinants, &side)) side = wide_side(cell, planes, sites, determinants);
  if (side != 0 || is_plain) return side;
  for (int of_lags = 0; of_lags < 2 && cell->lags != 0; ++of_lags) {
    wide_t more[4];
    for (int k = 0; k < 4; ++k) {
      const bool is_site = sites[k] != NO_CELL;
      more[k] = product(of_lags == 0 && !is_site ? -1 : 0, 1);
      if (of_lags != 0 && is_site) more[k] = lag_beyond(cell, sites[k]);
    }
    const int sign = sign_of_sum(more, determinants);
    if (sign != 0) return sign;
  }
  // The weights of sites, the first one first.
  for (uint from = 0;;) {
    uint next = NO_CELL;
    for (int k = 0; k < 4; ++k) {
      if (sites[k] == NO_CELL || sites[k] == cell->site) continue;
      if (sites[k] >= from) next = min(next, sites[k]);
      if (cell->site >= from) next = min(next, cell->site);
    }
    if (next == NO_CELL) break;
    wide_t share = {0, 0};
    for (int k = 0; k < 4; ++k) {
      if (sites[k] == NO_CELL || sites[k] == cell->site) continue;
      if (next == cell->site)
        share = sum(share, determinants[k]);
      else if (sites[k] == next)
        share = sum(share, negative(determinants[k]));
    }
    const int sign = sign_of(share);
    if (sign != 0) return sign;
    from = next + 1;
  }
  // Only images of the same sites: lengths are measured no longer the same along all directions.
  for (int form = 0; form < 6; ++form) {
    wide_t forms[4];
    for (int k = 0; k < 4; ++k) {
      const way_t n = way_of(planes[k]);
      const long of_way[3] = {n.x, n.y, n.z};
      const int first = form % 3, second = form < 3 ? (form + 1) % 3 : first;
      forms[k] = product(sites[k] == NO_CELL ? 0 : of_way[first], of_way[second]);
    }
    const int sign = sign_of_sum(forms, determinants);
    if (sign != 0) return sign;
  }
  return 0;
}

// A vertex from whole numbers, where doubles are too rough: where its planes are almost the same.
static inline void place_exactly(cell_t* cell, int v) {
  const indices_t t = cell->triples[v];
  const index_t of[3] = {t.s0, t.s1, t.s2};
  way_t n[3];
  wide_t c[3], x[3], y[3], z[3];
  for (int k = 0; k < 3; ++k) {
    const double4 plane = whole_plane(cell->planes[of[k]], cell->sites[of[k]]);
    n[k] = way_of(plane);
    c[k] = constant_of(cell, n[k], plane.w, cell->sites[of[k]]);
  }
  for (int k = 0; k < 3; ++k) {
    const way_t p = n[k == 2 ? 0 : k + 1], q = n[k == 0 ? 2 : k - 1];
    x[k] = minor_of(p.y, p.z, q.y, q.z);
    y[k] = minor_of(p.z, p.x, q.z, q.x);
    z[k] = minor_of(p.x, p.y, q.x, q.y);
  }
  const double d = to_double(sum(sum(times(x[0], n[0].x), times(y[0], n[0].y)), times(z[0], n[0].z)));
  cell->x[v] = sum_of_products(c, x) / d;
  cell->y[v] = sum_of_products(c, y) / d;
  cell->z[v] = sum_of_products(c, z) / d;
  cell->error[v] = 0x1p-49 * (fabs(cell->x[v]) + fabs(cell->y[v]) + fabs(cell->z[v]));
}

#endif
