#include "vorocl/distance_errors.hpp"

#include <algorithm>

#include "measures/judged_labels.hpp"
#include "runtime/buffer.hpp"

namespace vorocl {

DistanceErrors distance_errors(const Seeds& seeds, const Diagram& diagram, const Diagram& exact,
                               Metric metric) {
  frames_of(seeds, exact);
  const auto measured = frames_of(seeds, diagram);
  const Device& device = diagram.device();
  const std::size_t items = judging_items(diagram.grid());
  const cl::Buffer wrong = allocate(device, items * sizeof(cl_uint2), "the errors");
  const cl::Buffer excesses = allocate(device, items * sizeof(cl_float2), "the errors");
  enqueue_judging("judge_labels", seeds, *measured.seeds, diagram, exact, metric, wrong, excesses);
  diagram.wait();
  exact.wait();
  measured.check();

  DistanceErrors errors;
  errors.pixels = diagram.grid().pixels();
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
