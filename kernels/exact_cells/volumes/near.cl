// The leaves around a leaf, with their sites, which a cell is cut by in the order of their distances.

#ifndef VOROCL_EXACT_CELLS_VOLUME_NEAR
#define VOROCL_EXACT_CELLS_VOLUME_NEAR

#include "exact_cells/volumes/polyhedron.cl"
#include "exact_cells/boxes.cl"

#define SPACINGS 2.5f  // how far they reach
#define BUCKETS 64     // of distances

static inline void add_leaf(near_t* near, const tree_t* tree, uint leaf, double3 from) {
  const size_t at = 3 * (size_t)leaf, k = (size_t)near->count;
  const double8 x = vload8(at, tree->sites) - from.x, y = vload8(at + 1, tree->sites) - from.y,
                z = vload8(at + 2, tree->sites) - from.z;
  vstore8(x, k, near->exact_x);
  vstore8(y, k, near->exact_y);
  vstore8(z, k, near->exact_z);
  vstore8(convert_float8(x), k, near->x);
  vstore8(convert_float8(y), k, near->y);
  vstore8(convert_float8(z), k, near->z);
}

// Finds the leaf's box. The list reaches some spacings of the sites far: the 64 around say how dense they are.
static inline float find_extent(near_t* near, const tree_t* tree, uint leaf) {
  find_box(tree, leaf, near->base, &near->low, &near->high);
  const uint first = leaf & ~(uint)(FAN - 1), leaves = min((tree->count + FAN - 1) / FAN - first, (uint)FAN);
  float3 low = INFINITY, high = -INFINITY;
  for (uint k = first; k < first + leaves; ++k) {
    float3 of_low, of_high;
    find_box(tree, k, near->base, &of_low, &of_high);
    low = fmin(low, of_low);
    high = fmax(high, of_high);
  }
  const float3 extent = high - low, size = near->high - near->low;
  const float spacing = cbrt(extent.x) * cbrt(extent.y) * cbrt(extent.z) / cbrt(convert_float(leaves * FAN));
  return SPACINGS * fmax(spacing, 0.15f * (size.x + size.y + size.z));
}

// Cuts a cell by one of the sites of the list.
static inline bool cut_by_listed(cell_t* cell, const near_t* near, int k, double3 from, uint site) {
  const uint other = near->leaves[k >> FAN_BITS] * FAN + (uint)(k & (FAN - 1));
  const int image = near->images[k >> FAN_BITS];
  if (other == site && image == 0) return false;
  return cut(cell, (double3)(near->exact_x[k], near->exact_y[k], near->exact_z[k]) - from, other, image);
}

// The squared distances of the bisectors with eight sites of the list, from site k on.
static inline float8 bisectors_of_listed(const tree_t* tree, const near_t* near, double lag, int k, float3 from) {
  const float8 x = vload8(0, near->x + k) - from.x, y = vload8(0, near->y + k) - from.y,
               z = vload8(0, near->z + k) - from.z;
  const float8 distances = x * x + y * y + z * z;
  if (tree->lags == 0) return distances;
  return bisectors_at(distances, leads_of(tree->lags, near->leaves[k >> FAN_BITS], lag));
}

// Cuts a cell by the sites of the list: by those nearer than is covered about in the order of their
// distances, then, if it reaches farther, by the others. Returns behind which squared distance nothing can
// cut.
static inline float cut_by_near(cell_t* cell, const tree_t* tree, const near_t* near, double3 at, uint site) {
  const float covered = covered_by(near, at);
  const double3 exact_from = at - near->base;
  const float3 from = convert_float3(exact_from);
  const float scale = BUCKETS / (covered * covered);
  int buckets[MOST_NEAR * FAN];  // the last one, BUCKETS, has what is not covered
  ushort list[MOST_NEAR * FAN], order[MOST_NEAR * FAN], ends[BUCKETS];
  for (int b = 0; b < BUCKETS; ++b) ends[b] = 0;
  const int sites = near->count * FAN;
  for (int k = 0; k < sites; k += 8) {
    const float8 d = bisectors_of_listed(tree, near, cell->lag, k, from) * scale;
    vstore8(convert_int8(fmin(d, (float8)(BUCKETS))), 0, buckets + k);
  }
  int found = 0;
  for (int k = 0; k < sites; ++k) {
    list[found] = (ushort)k;
    found += buckets[k] < BUCKETS;
  }
  for (int i = 0; i < found; ++i) ++ends[buckets[list[i]]];
  ushort sum = 0;
  for (int b = 0; b < BUCKETS; ++b) {
    const ushort many = ends[b];
    ends[b] = sum;
    sum = (ushort)(sum + many);
  }
  for (int i = 0; i < found; ++i) order[ends[buckets[list[i]]]++] = list[i];
  float end = INFINITY;
  for (int i = 0, since = 0; i < found && convert_float(buckets[order[i]]) <= end * scale; ++i) {
    since += cut_by_listed(cell, near, order[i], exact_from, site);
    if (since < 3 && (i & 15) != 15) continue;
    end = end_of(cell);
    since = 0;
  }
  end = end_of(cell);
  if (end < covered * covered) return end;
  for (int k = 0; k < sites; k += 8) {
    const int8 is_near = bisectors_of_listed(tree, near, cell->lag, k, from) < end;
    const int8 may_cut = is_near & (vload8(0, buckets + k) == BUCKETS);
    for (int left = bits_of_ints(may_cut); left != 0; left &= left - 1) {
      if (cut_by_listed(cell, near, k + LOWEST_BIT(left), exact_from, site)) end = end_of(cell);
    }
  }
  return end;
}

#endif
