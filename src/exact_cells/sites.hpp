// The points of seeds as kernels cut cells of them: rounded, in Hilbert's order, in a tree of boxes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "vorocl/grid.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// As many periods along each axis, or steps.
using PeriodCounts = std::array<std::int64_t, 3>;

/// Different points, in steps: in planes 32-bit numbers, in volumes whole numbers in doubles. The tree_t of
/// kernels/exact_cells says what the lists hold.
template <typename NumberOfKind, typename Four, std::size_t dimensions_of_kind>
struct Sites {
  using Number = NumberOfKind;
  static constexpr std::size_t dimensions = dimensions_of_kind;

  std::vector<cl_uint> ids;     // by site: the lowest id of the seeds that lie there
  std::vector<Number> places;   // of each eight sites eight x, eight y and in a volume eight z
  std::vector<Number> boxes;    // of each eight boxes eight lower and eight upper x, and so on
  std::vector<cl_uint> levels;  // by level the first of its groups of boxes; level 0 has none
  std::vector<cl_double> lags,
      box_lags;                      // of sites and of boxes, as lanes.cl has them; empty without weights
  std::vector<Number> shifts;        // of images, itself first
  std::vector<PeriodCounts> images;  // the same in edges of the box, so many along each
  std::vector<PeriodCounts> beyond;  // by id: how many periods beyond its place a point lies; or none does
  Four lower = {}, upper = {};       // sides of the box
  Four reach = {};                   // see tree_t
  Point origin;                      // in the units of the data: step 0 of all axes
  double step = 0;

  cl_uint count() const { return static_cast<cl_uint>(ids.size()); }
  cl_int top_level() const { return static_cast<cl_int>(levels.size()) - 1; }

  double size() const {
    double product = 1;
    for (std::size_t axis = 0; axis < dimensions; ++axis) product *= (upper.s[axis] - lower.s[axis]) * step;
    return product;
  }
};

using PlaneSites = Sites<cl_int, cl_int4, 2>;
using VolumeSites = Sites<cl_double, cl_double4, 3>;
using DirectionSites = Sites<cl_int, cl_int4, 3>;  // of the globe

/// Throws Error if the grid has less than a step along an axis, or is tilted and too flat. `weights`: by id,
/// or none.
template <typename SitesOfKind>
SitesOfKind sites_of(const Grid& grid, const std::vector<std::optional<Point>>& points,
                     const std::vector<double>& weights);

/// Of whole numbers x, y and z, by id; three zeros where there is none.
DirectionSites sites_of_directions(const std::vector<cl_int4>& directions);

}  // namespace vorocl
