#include "vorocl/similarity.hpp"

#include <cmath>

#include "buffer.hpp"
#include "kernel.hpp"
#include "measurement.hpp"

namespace vorocl {

namespace {
constexpr std::size_t pixels_per_item = 1024;

double percentage(std::size_t differences, std::size_t pixels) {
  return 100.0 * static_cast<double>(pixels - differences) / static_cast<double>(pixels);
}

void check_pair(const Diagram& a, const Diagram& b) {
  if (!a.device().same_as(b.device())) throw Error("the diagrams belong to different devices");
  if (a.grid() != b.grid()) throw Error("diagrams of different grids cannot be compared");
}
}  // namespace

double similarity(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  if (a.size() != b.size() || a.empty()) {
    throw Error("label images of " + std::to_string(a.size()) + " and " + std::to_string(b.size()) +
                " pixels cannot be compared");
  }
  std::size_t differences = 0;
  for (std::size_t i = 0; i < a.size(); ++i) differences += a[i] != b[i] ? 1 : 0;
  return percentage(differences, a.size());
}

double similarity(const Diagram& a, const Diagram& b) {
  check_pair(a, b);
  const Device& device = a.device();
  const std::size_t pixels = a.grid().pixels();
  const cl::Buffer differences = allocate(device, sizeof(cl_uint), "the similarity");
  fill(device, differences, cl_uint{0}, 1);
  Kernel(device, "similarity.cl", "count_differences", a.grid())
      .over_items((pixels + pixels_per_item - 1) / pixels_per_item, a.labels(), b.labels(),
                  static_cast<cl_uint>(pixels), static_cast<cl_uint>(pixels_per_item), differences);
  a.wait();
  b.wait();
  return percentage(download<cl_uint>(device, differences, 1).front(), pixels);
}

double similarity(const Seeds& seeds, const Diagram& a, const Diagram& b, double tolerance, Metric metric) {
  if (!(tolerance >= 0 && std::isfinite(tolerance))) {
    throw Error("the tolerance is " + std::to_string(tolerance) + "; it must be a number from 0");
  }
  check_pair(a, b);
  const MeasuredFrames of_a = frames_of(seeds, a), of_b = frames_of(seeds, b);
  const Device& device = a.device();
  const Grid& grid = a.grid();
  const cl::Buffer differences = allocate(device, sizeof(cl_uint), "the similarity");
  fill(device, differences, cl_uint{0}, 1);
  const OuterSeeds* const outer = of_a.seeds->outer.get();
  Kernel(device, "distance_errors.cl", "count_distant", grid,
         {metric, Neighbourhood::moore, outer != nullptr ? outer->extent : Extent::grid})
      .over_items((grid.pixels() + pixels_per_item - 1) / pixels_per_item, a.labels(), b.labels(),
                  outer != nullptr ? outer->seeds : seeds.positions(), static_cast<cl_uint>(seeds.size()),
                  outer != nullptr ? outer->periods : cl_uint2{}, grid.width(), grid.height(),
                  static_cast<cl_uint>(pixels_per_item), static_cast<cl_float>(tolerance), differences);
  a.wait();
  b.wait();
  of_a.check();
  of_b.check();
  return percentage(download<cl_uint>(device, differences, 1).front(), grid.pixels());
}

}  // namespace vorocl
