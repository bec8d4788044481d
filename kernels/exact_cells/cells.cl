// Exact cells: cut out of the box in private memory.

#include "exact_cells/measure.cl"

static inline line_t found_line(const tree_t* tree, uint2 edge, int2 at, uint site) {
  const int image = as_int(edge.s1);
  if (edge.s0 == NO_CELL) return first_line(first_sides(tree, convert_long2(at)), image);
  const int2 way = site_at(tree, edge.s0) - (at - shift_of(tree, image));
  return line_towards(tree->lags, lag_of(tree->lags, site), way, edge.s0, image);
}

// Puts the edges of each cell where they belong, by the caller's ids: the cells behind them, and where they
// begin, in half steps from the site. And says which site that is.
kernel void place_edges(SITE_PARAMETERS, global const uint* restrict ids, global const uint* restrict begins,
                        global const uint2* restrict found, global const uint* restrict offsets,
                        global uint* restrict cells, global double2* restrict vertices,
                        global uint* restrict sites_of_cells) {
  const uint site = (uint)get_global_id(0);
  if (site >= count) return;
  const tree_t tree = SITE_ARGUMENTS;
  const int2 at = site_at(&tree, site);
  const uint id = ids[site], begin = begins[site], offset = offsets[id], size = offsets[id + 1] - offset;
  if (size == 0) return;
  sites_of_cells[id] = site;
  line_t before = found_line(&tree, found[begin + size - 1], at, site);
  for (uint i = 0; i < size; ++i) {
    const line_t line = found_line(&tree, found[begin + i], at, site);
    cells[offset + i] = line.site == NO_CELL ? NO_CELL : ids[line.site];
    vertices[offset + i] = crossing(before, line);
    before = line;
  }
}

// Measures the edges, and puts their vertices into the units of the data. The lengths lie where found edges
// did. In the order of cells, so that memory is read and written as it lies.
kernel void measure_edges(SITE_PARAMETERS, uint cells, global const uint* restrict sites_of_cells, double4 origin,
                          double step, global const uint* restrict offsets, global double2* restrict vertices,
                          global double* restrict lengths) {
  const uint id = (uint)get_global_id(0);
  if (id >= cells) return;
  const uint offset = offsets[id], end = offsets[id + 1];
  if (offset == end) return;
  const tree_t tree = SITE_ARGUMENTS;
  const double2 at = convert_double2(site_at(&tree, sites_of_cells[id]));
  const double2 first = vertices[offset];
  double2 from = first;
  for (uint i = offset; i < end; ++i) {
    const double2 to = i + 1 < end ? vertices[i + 1] : first, way = to - from;
    lengths[i] = fmax(sqrt(way.s0 * way.s0 + way.s1 * way.s1) / 2 * step, DBL_MIN);  // none is 0
    vertices[i] = origin.xy + (at + from / 2) * step;
    from = to;
  }
}
