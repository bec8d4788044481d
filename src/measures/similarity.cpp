#include "vorocl/similarity.hpp"

#include <cmath>

#include "measures/judged_labels.hpp"
#include "runtime/buffer.hpp"
#include "vorocl/cells.hpp"

namespace vorocl {

namespace {
double percentage(std::size_t differences, std::size_t pixels) {
  return 100.0 * static_cast<double>(pixels - differences) / static_cast<double>(pixels);
}

/// A counter on the device, which is 0.
cl::Buffer no_differences(const Device& device) {
  cl::Buffer counter = allocate(device, sizeof(cl_uint), "the similarity");
  fill(device, counter, cl_uint{0}, 1);
  return counter;
}

/// What the counter says. Waits.
std::size_t counted(const cl::Buffer& differences, const Device& device) {
  return download<cl_uint>(device, differences, 1).front();
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

std::size_t changed_pixels(const Diagram& a, const Diagram& b) {
  check_pair(a, b);
  const cl::Buffer differences = no_differences(a.device());
  Kernel(a.device(), "measures/similarity.cl", "count_differences", a.grid())
      .over_items(judging_items(a.grid()), a.labels(), b.labels(), static_cast<cl_uint>(a.grid().pixels()),
                  static_cast<cl_uint>(judged_per_item), differences);
  a.wait();
  b.wait();
  return counted(differences, a.device());
}

double similarity(const Diagram& a, const Diagram& b) {
  return percentage(changed_pixels(a, b), a.grid().pixels());
}

double similarity(const Seeds& seeds, const Diagram& a, const Diagram& b, double tolerance, Metric metric) {
  if (!(tolerance >= 0 && std::isfinite(tolerance))) {
    throw Error("the tolerance is " + std::to_string(tolerance) + "; it must be a number from 0");
  }
  check_pair(a, b);
  const MeasuredFrames of_a = frames_of(seeds, a), of_b = frames_of(seeds, b);
  const cl::Buffer differences = no_differences(a.device());
  enqueue_judging("count_distant", seeds, *of_a.seeds, a, b, metric, static_cast<cl_float>(tolerance),
                  differences);
  a.wait();
  b.wait();
  of_a.check();
  of_b.check();
  return percentage(counted(differences, a.device()), a.grid().pixels());
}

}  // namespace vorocl
