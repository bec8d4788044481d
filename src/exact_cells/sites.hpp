// The points of seeds as kernels cut cells of them: rounded, in Hilbert's order, in a tree of boxes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "vorocl/grid.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// Different points, in steps: in planes 32-bit numbers, in volumes whole numbers in doubles. The tree_t of
/// kernels/exact_cells says what the lists hold.
template <typename Number>
struct SiteTree {
  std::vector<cl_uint> ids;     // by site: the lowest id of the seeds that lie there
  std::vector<Number> places;   // of each eight sites eight x, eight y and in a volume eight z
  std::vector<Number> boxes;    // of each eight boxes eight lower and eight upper x, and so on
  std::vector<cl_uint> levels;  // by level the first of its groups of boxes; level 0 has none
  std::vector<cl_double> lags,
      box_lags;  // of sites and of boxes, as lanes.cl has them; empty without weights
  Point origin;  // in the units of the data: step 0 of all axes
  double step = 0;

  cl_uint count() const { return static_cast<cl_uint>(ids.size()); }
  cl_int top_level() const { return static_cast<cl_int>(levels.size()) - 1; }
};

struct PlaneSites : SiteTree<cl_int> {
  cl_int4 rectangle = {};  // left, lower, right and upper sides
  cl_int4 periods = {};    // along x and y, 0: not periodic; how far images above are shifted in x
  cl_int4 lattice = {};    // two short vectors of what repeats, counter-clockwise; or zeros

  std::array<cl_int4, 3> box() const { return {rectangle, periods, lattice}; }
  double size() const {
    return (rectangle.s[2] - rectangle.s[0]) * step * ((rectangle.s[3] - rectangle.s[1]) * step);
  }
};

/// As many periods along each axis.
using PeriodCounts = std::array<std::int64_t, 3>;

struct VolumeSites : SiteTree<cl_double> {
  cl_double4 lower = {}, upper = {};  // of the box
  cl_double4 periods = {};            // 0: not periodic
  std::vector<PeriodCounts> beyond;   // by id: how many periods beyond its place a point lies

  std::array<cl_double4, 3> box() const { return {lower, upper, periods}; }
  double size() const {
    double product = 1;
    for (int axis = 0; axis < 3; ++axis) product *= (upper.s[axis] - lower.s[axis]) * step;
    return product;
  }
};

/// Throws Error if the grid has less than a step along an axis. `weights`: by id, or none.
PlaneSites sites_of_plane(const Grid& grid, const std::vector<std::optional<Point>>& points,
                          const std::vector<double>& weights);
VolumeSites sites_of_volume(const Grid& grid, const std::vector<std::optional<Point>>& points,
                            const std::vector<double>& weights);

}  // namespace vorocl
