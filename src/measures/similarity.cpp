#include "vorocl/similarity.hpp"

#include <cmath>
#include <string>

#include "measures/comparison.hpp"
#include "runtime/buffer.hpp"

namespace vorocl {

struct SimilarityState : Compared {
  cl::Buffer differences;
};

const cl::Buffer& SimilarityResult::differences() const {
  return buffer_of(state_, &SimilarityState::differences);
}

namespace {

double percentage(std::size_t differences, std::size_t pixels) {
  return 100.0 * static_cast<double>(pixels - differences) / static_cast<double>(pixels);
}

/// Counts differences by a kernel, which gets the labels, the walk, these arguments, and the counter.
template <typename... Arguments>
Report count(Measuring<SimilarityState>& measuring, const MeasuredDiagram& of, const Diagram& a,
             const Diagram& b, const char* name, const KernelOptions& options,
             const Arguments&... arguments) {
  SimilarityState& found = measuring.state();
  make_room(found.differences, of.device, sizeof(cl_uint));
  const cl::Event first = fill(of.device, found.differences, cl_uint{0}, 1);
  Kernel& kernel = found.kernels.get(of.device, "measures/comparison.cl", name, of.grid, options);
  const cl::Event last = compare(kernel, walk_through(of, kernel), a, b, arguments..., found.differences);
  found.other = labels_of(b).seeds;
  return measuring.commit(MeasuredDiagram(of), first, last);
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

Report similarity(const Diagram& a, const Diagram& b, SimilarityResult& result) {
  Measuring<SimilarityState> measuring(result);
  check_labels_fit(a, b);
  const MeasuredDiagram of = labels_of(a);
  const auto pixels = static_cast<cl_uint>(of.grid.pixels());
  return count(measuring, of, a, b, "count_differences", {}, pixels);
}

Report similarity(const Diagram& a, const Diagram& b, double tolerance, SimilarityResult& result) {
  Measuring<SimilarityState> measuring(result);
  if (!(tolerance >= 0 && std::isfinite(tolerance))) {
    throw Error("the tolerance is " + std::to_string(tolerance) + "; it must be a number from 0");
  }
  const MeasuredDiagram of = cells_of_both(a, b);
  return count(measuring, of, a, b, "count_distant", of.options(), of.positions(), of.count(), of.lattice(),
               of.size(), static_cast<cl_float>(tolerance));
}

std::size_t SimilarityResult::read_differences() const {
  if (!state_ || state_->empty()) return 0;
  state_->check();
  return download<cl_uint>(state_->of->device, state_->differences, 1).front();
}

double SimilarityResult::read() const {
  if (!state_ || state_->empty()) return 100;
  return percentage(read_differences(), state_->of->grid.pixels());
}

}  // namespace vorocl
