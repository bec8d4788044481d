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
// four less than 2^209. So determinants and c take 128 bits, and sums that doubles do not decide 192. In a tilted box,
// whose sides have 2^39 steps at most, a cell begins as a cube with half of the box's diagonal each way. Its corners
// are at most 1.5 sides away, and sites that may cut 3 sides: less than the diagonal of a box of 2^40.

#ifndef VOROCL_EXACT_CELLS_SIDES
#define VOROCL_EXACT_CELLS_SIDES

#include "exact_cells/volumes/cell.cl"

static inline wide_t times_unsigned(ulong a, long b) {
  const wide_t wide = {a * (ulong)b, (long)(upper_half(a, (ulong)b) - (b < 0 ? a : 0))};
  return wide;
}

static inline wide_t times(wide_t a, long b) {
  const wide_t upper = {0, (long)((ulong)a.high * (ulong)b)};
  return sum(times_unsigned(a.low, b), upper);
}

static inline wide_t minor_of(long a, long b, long c, long d) { return sum(product(a, d), negative(product(b, c))); }

// Whole numbers of 192 bits.
typedef struct {
  ulong low;
  wide_t high;
} wider_t;

static inline void add_product(wider_t* to, wide_t a, wide_t b) {
  const ulong low = a.low * b.low;
  to->low += low;
  const wide_t carried = {upper_half(a.low, b.low) + (to->low < low ? 1u : 0u), 0};
  to->high = sum(sum(to->high, carried), sum(times_unsigned(a.low, b.high), times(b, a.high)));
}

// The sign of a sum of four products. Doubles are wrong by at most 2^-50 of the products' sizes: a sum that they do not
// decide is less than 2^162.
static inline int sign_of_sum(const wide_t* a, const wide_t* b) {
  double total = 0, size = 0;
  for (int k = 0; k < 4; ++k) {
    const double part = to_double(a[k]) * to_double(b[k]);
    total += part;
    size += fabs(part);
  }
  if (fabs(total) > 0x1p-49 * size) return total > 0 ? 1 : -1;
  wider_t exact = {0, {0, 0}};
  for (int k = 0; k < 4; ++k) add_product(&exact, a[k], b[k]);
  return exact.low != 0 && exact.high.high >= 0 ? 1 : sign_of(exact.high);
}

// A sum of three products, less than 2^170, right but for 2^-51 of itself.
static inline double sum_of_products(const wide_t* a, const wide_t* b) {
  wider_t exact = {0, {0, 0}};
  for (int k = 0; k < 3; ++k) add_product(&exact, a[k], b[k]);
  const bool is_negative = exact.high.high < 0;
  if (is_negative) {
    const wide_t borrowed = {exact.low != 0 ? 1u : 0u, 0};
    exact.low = 0 - exact.low;
    exact.high = negative(sum(exact.high, borrowed));
  }
  const double total = convert_double(exact.low) + to_double(exact.high) * 0x1p64;
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

// The n and c of a plane in whole numbers, of which those of walls are short.
#define WALL 0x1p39
static inline void find_whole(const cell_t* cell, double4 plane, uint site, long3* n, wide_t* c) {
  const double4 whole = site == NO_CELL ? plane / WALL : plane;
  *n = convert_long3(whole.xyz);
  if (site == NO_CELL) {
    *c = product((long)whole.w, 1);
  } else {
    *c = sum(sum(product(n->x, n->x), product(n->y, n->y)), product(n->z, n->z));
    if (cell->lags != 0) *c = sum(*c, lag_beyond(cell, site));
  }
}

// The same of a vertex's planes, and the sites behind these.
static inline void find_planes(const cell_t* cell, int v, long3* n, wide_t* c, uint* sites) {
  const indices_t t = cell->triples[v];
  const index_t of[3] = {t.s0, t.s1, t.s2};
  for (int k = 0; k < 3; ++k) {
    sites[k] = cell->sites[of[k]];
    find_whole(cell, cell->planes[of[k]], sites[k], &n[k], &c[k]);
  }
}

// Of four planes, for each the determinant of the three others, with a sign.
static inline void find_determinants(const long3* n, wide_t* determinants) {
  wide_t minors[3], with_last[3];  // of x and y: of two of the first three planes, and of one and the last
  for (int k = 0; k < 3; ++k) {
    const long3 q = n[k == 2 ? 0 : k + 1], r = n[k == 0 ? 2 : k - 1];
    minors[k] = minor_of(q.x, q.y, r.x, r.y);
    with_last[k] = minor_of(n[k].x, n[k].y, n[3].x, n[3].y);
  }
  for (int k = 0; k < 3; ++k) {
    const int q = k == 2 ? 0 : k + 1, r = k == 0 ? 2 : k - 1;
    determinants[k] =
        sum(times(minors[k], n[3].z), sum(times(with_last[r], n[q].z), times(with_last[q], -n[r].z)));
  }
  determinants[3] = negative(sum(sum(times(minors[0], n[0].z), times(minors[1], n[1].z)), times(minors[2], n[2].z)));
}

// On which side of a plane a vertex is: 1 is beyond it. 0 only if `is_plain`, or if no weights make a
// difference.
static inline int side_of(const cell_t* cell, int v, double4 plane, uint site, bool is_plain) {
  uint sites[4] = {0, 0, 0, site};
  long3 n[4];
  wide_t factors[4], determinants[4];
  find_planes(cell, v, n, factors, sites);
  find_whole(cell, plane, site, &n[3], &factors[3]);
  find_determinants(n, determinants);
  const int side = sign_of_sum(factors, determinants);
  if (side != 0 || is_plain) return side;
  for (int of_lags = 0; of_lags < 2 && cell->lags != 0; ++of_lags) {
    for (int k = 0; k < 4; ++k) {
      const bool is_site = sites[k] != NO_CELL;
      factors[k] = product(of_lags == 0 && !is_site ? -1 : 0, 1);
      if (of_lags != 0 && is_site) factors[k] = lag_beyond(cell, sites[k]);
    }
    const int sign = sign_of_sum(factors, determinants);
    if (sign != 0) return sign;
  }
  // The weights of sites, the first one first. Where the own one is greater, all bisectors are farther away.
  for (uint next = 0, from = 0; next != NO_CELL; from = next + 1) {
    next = cell->site >= from ? cell->site : NO_CELL;
    for (int k = 0; k < 4; ++k) next = sites[k] >= from ? min(next, sites[k]) : next;
    wide_t share = {0, 0};
    for (int k = 0; k < 4; ++k) {
      if (sites[k] == NO_CELL || sites[k] == cell->site) continue;
      if (next == cell->site || next == sites[k]) share = sum(share, determinants[k]);
    }
    const int sign = sign_of(share);
    if (sign != 0) return next == cell->site ? sign : -sign;
  }
  // Only images of the same sites: lengths are measured no longer the same along all directions.
  for (int form = 0; form < 6; ++form) {
    for (int k = 0; k < 4; ++k) {
      const long of_way[3] = {n[k].x, n[k].y, n[k].z};
      const int first = form % 3, second = form < 3 ? (form + 1) % 3 : first;
      factors[k] = product(sites[k] == NO_CELL ? 0 : of_way[first], of_way[second]);
    }
    const int sign = sign_of_sum(factors, determinants);
    if (sign != 0) return sign;
  }
  return 0;
}

// A vertex from whole numbers, where doubles are too rough: where its planes are almost the same.
static inline void place_exactly(cell_t* cell, int v) {
  uint sites[3];
  long3 n[3];
  wide_t c[3], x[3], y[3], z[3];
  find_planes(cell, v, n, c, sites);
  for (int k = 0; k < 3; ++k) {
    const long3 p = n[k == 2 ? 0 : k + 1], q = n[k == 0 ? 2 : k - 1];
    x[k] = minor_of(p.y, p.z, q.y, q.z);
    y[k] = minor_of(p.z, p.x, q.z, q.x);
    z[k] = minor_of(p.x, p.y, q.x, q.y);
  }
  const double d = to_double(sum(sum(times(x[0], n[0].x), times(y[0], n[0].y)), times(z[0], n[0].z)));
  cell->x[v] = sum_of_products(c, x) / d;
  cell->y[v] = sum_of_products(c, y) / d;
  cell->z[v] = sum_of_products(c, z) / d;
  cell->error[v] = 0x1p-49 * norm_of((double3)(cell->x[v], cell->y[v], cell->z[v]));
}

#endif
