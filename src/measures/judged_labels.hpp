// Kernels of distance_errors.cl: what two diagrams' labels say by the distances of their seeds.
#pragma once

#include "core/outer_seeds.hpp"
#include "measures/measurement.hpp"
#include "runtime/kernel.hpp"

namespace vorocl {

/// The pixels that a work-item judges, and the work-items of a grid.
constexpr std::size_t judged_per_item = 1024;
inline std::size_t judging_items(const Grid& grid) {
  return (grid.pixels() + judged_per_item - 1) / judged_per_item;
}

/// Enqueues one of them. `arguments` are those behind the chunk.
template <typename... Arguments>
void enqueue_judging(const char* kernel, const Seeds& seeds, const SeedsFrame& frame, const Diagram& a,
                     const Diagram& b, Metric metric, const Arguments&... arguments) {
  const OuterSeeds* const outer = frame.outer.get();
  const Grid& grid = a.grid();
  Kernel(a.device(), "measures/distance_errors.cl", kernel, grid,
         {metric, Neighbourhood::moore, outer != nullptr ? outer->extent : Extent::grid})
      .over_items(judging_items(grid), a.labels(), b.labels(),
                  outer != nullptr ? outer->seeds : seeds.positions(), static_cast<cl_uint>(seeds.size()),
                  outer != nullptr ? outer->periods : cl_uint2{}, grid.width(), grid.height(),
                  static_cast<cl_uint>(judged_per_item), arguments...);
}

}  // namespace vorocl
