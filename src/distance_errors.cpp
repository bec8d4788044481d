#include "vorocl/distance_errors.hpp"

#include <algorithm>

#include "buffer.hpp"
#include "measurement.hpp"

namespace vorocl {

namespace {
constexpr std::size_t pixels_per_item = 1024;
}  // namespace

DistanceErrors distance_errors(const Seeds& seeds, const Diagram& diagram, const Diagram& exact,
                               Metric metric) {
  frames_of(seeds, exact);
  const auto measured = frames_of(seeds, diagram);
  const Device& device = diagram.device();
  const Grid& grid = diagram.grid();
  const std::size_t items = (grid.pixels() + pixels_per_item - 1) / pixels_per_item;
  const cl::Buffer wrong = allocate(device, items * sizeof(cl_uint2), "the errors");
  const cl::Buffer excesses = allocate(device, items * sizeof(cl_float2), "the errors");
  const OuterSeeds* const outer = measured.seeds->outer.get();
  Kernel(device, "distance_errors.cl", "judge_labels", grid,
         {metric, Neighbourhood::moore, outer != nullptr ? outer->extent : Extent::grid})
      .over_items(items, diagram.labels(), exact.labels(),
                  outer != nullptr ? outer->seeds : seeds.positions(), static_cast<cl_uint>(seeds.size()),
                  outer != nullptr ? outer->periods : cl_uint2{}, grid.width(), grid.height(),
                  static_cast<cl_uint>(pixels_per_item), wrong, excesses);
  diagram.wait();
  exact.wait();
  measured.check();

  DistanceErrors errors;
  errors.pixels = grid.pixels();
  for (const cl_uint2& some : download<cl_uint2>(device, wrong, items)) {
    errors.wrong_pixels += some.s[0];
    errors.unlabelled_pixels += some.s[1];
  }
  double sum = 0;
  for (const cl_float2& some : download<cl_float2>(device, excesses, items)) {
    sum += some.s[0];
    errors.largest_excess = std::max(errors.largest_excess, static_cast<double>(some.s[1]));
  }
  errors.mean_excess = sum / static_cast<double>(errors.pixels);
  return errors;
}

}  // namespace vorocl
