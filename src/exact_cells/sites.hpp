// The points of seeds as kernels cut cells of them: rounded, in Hilbert's order, in a tree of boxes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vorocl/grid.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// Different points, in steps. kernels/exact_cells/search.cl says what the lists hold.
struct Sites {
  std::vector<cl_uint> ids;     // by site: the lowest id of the seeds that lie there
  std::vector<cl_int> places;   // of each eight sites eight x and eight y
  std::vector<cl_int> boxes;    // of each eight boxes eight left sides, and so on
  std::vector<cl_uint> levels;  // by level the first of its groups of boxes; level 0 has none
  cl_int4 rectangle = {};       // left, lower, right and upper sides
  cl_int4 periods = {};         // along x and y, 0: not periodic; how far images above are shifted in x
  cl_int4 lattice = {};         // two short vectors of what repeats, counter-clockwise; or zeros
  Point origin;                 // in the units of the data: step 0 of both axes
  double step = 0;

  cl_uint count() const { return static_cast<cl_uint>(ids.size()); }
  cl_int top_level() const { return static_cast<cl_int>(levels.size()) - 1; }
};

/// Throws Error if the grid has less than a step along an axis.
Sites sites_of(const Grid& grid, const std::vector<std::optional<Point>>& points);

}  // namespace vorocl
