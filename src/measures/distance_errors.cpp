#include "vorocl/distance_errors.hpp"

#include <algorithm>
#include <string>

#include "measures/comparison.hpp"
#include "runtime/buffer.hpp"

namespace vorocl {

// --- two diagrams ---

void check_labels_fit(const Diagram& a, const Diagram& b) {
  if (!a.device().same_as(b.device())) throw Error("the diagrams belong to different devices");
  if (a.window() != b.window()) throw Error("diagrams of different windows cannot be compared");
}

MeasuredDiagram cells_of_both(const Diagram& a, const Diagram& b) {
  check_labels_fit(a, b);
  MeasuredDiagram one = cells_of(a, Volumes::taken);
  MeasuredDiagram other = cells_of(b, Volumes::taken);
  if (one.metric != other.metric)
    throw Error("diagrams of different metrics cannot be compared by distances");
  // Clones of seeds have frames of their own, but share where they lie.
  if (one.placement != other.placement) {
    throw Error("the diagrams are of different frames of seeds, and cannot be compared by distances");
  }
  // Labels of points are judged by points, also where the others are of pixels.
  return one.points ? std::move(one) : std::move(other);
}

// --- errors ---

struct DistanceErrorsState : Compared {
  cl::Buffer wrong, excesses;  // of each work-item: see comparison.cl
};

DistanceErrorsResult::DistanceErrorsResult() = default;
DistanceErrorsResult::~DistanceErrorsResult() = default;
DistanceErrorsResult::DistanceErrorsResult(DistanceErrorsResult&& other) noexcept = default;
DistanceErrorsResult& DistanceErrorsResult::operator=(DistanceErrorsResult&& other) noexcept = default;

Report distance_errors(const Diagram& diagram, const Diagram& exact, DistanceErrorsResult& result) {
  Measuring<DistanceErrorsState> measuring(result);
  DistanceErrorsState& found = measuring.state();
  MeasuredDiagram of = cells_of_both(diagram, exact);
  const std::size_t items = comparing_items(of.grid);
  make_room(found.wrong, of.device, items * sizeof(cl_uint2));
  make_room(found.excesses, of.device, items * sizeof(cl_float2));
  const int width = of.grid.width(), height = of.grid.height();
  constexpr auto chunk = static_cast<cl_uint>(pixels_per_item);
  const auto kernel = [&](const char* file) -> Kernel& {
    return found.kernels.get(of.device, file, "judge_labels", of.grid, of.options());
  };
  const cl::Event judged =
      of.grid.is_volume()
          ? kernel("volumes/measures.cl")
                .over_items(items, diagram.labels(), exact.labels(), of.positions(), of.count(), width,
                            height, static_cast<cl_uint>(of.grid.pixels()), chunk, found.wrong,
                            found.excesses)
          : kernel("measures/comparison.cl")
                .over_items(items, diagram.labels(), exact.labels(), of.positions(), of.count(), of.periods(),
                            width, height, chunk, found.wrong, found.excesses);
  found.other = labels_of(exact, Volumes::taken).seeds;
  return measuring.commit(std::move(of), judged, judged);
}

DistanceErrors DistanceErrorsResult::read() const {
  DistanceErrors errors;
  if (!state_ || state_->empty()) return errors;
  state_->check();
  const MeasuredDiagram& of = *state_->of;
  const std::size_t items = comparing_items(of.grid);
  errors.pixels = of.grid.pixels();
  for (const cl_uint2& some : download<cl_uint2>(of.device, state_->wrong, items)) {
    errors.wrong_pixels += some.s[0];
    errors.unlabelled_pixels += some.s[1];
  }
  double sum = 0;
  for (const cl_float2& some : download<cl_float2>(of.device, state_->excesses, items)) {
    sum += some.s[0];
    errors.largest_excess = std::max(errors.largest_excess, static_cast<double>(some.s[1]));
  }
  errors.mean_excess = sum / static_cast<double>(errors.pixels);
  return errors;
}

}  // namespace vorocl
