#include "vorocl/distance_errors.hpp"

#include <algorithm>
#include <string>

#include "measures/comparison.hpp"
#include "runtime/buffer.hpp"
#include "runtime/opencl_info.hpp"
// Last: it defines macros.
#include "measures/comparison_sizes.cl"

namespace vorocl {

// --- two diagrams ---

Walk walk_through(const MeasuredDiagram& of, const Kernel& kernel) {
  const auto divided_up = [](std::size_t number, std::size_t by) { return (number + by - 1) / by; };
  const Tuning& tuning = of.device.tuning();
  const std::size_t pixels = of.grid.pixels(), width = kernel.vector_width();
  const std::size_t items = std::min<std::size_t>(tuning.group_width * tuning.group_height, MOST_COMPARING);
  const std::size_t fewest = divided_up(pixels, MOST_OF_GROUP);
  if (tuning.shape == Shape::vector) {
    const auto chunk = static_cast<cl_uint>(divided_up(MOST_OF_GROUP, items));
    return {fewest, items, {{chunk, static_cast<cl_uint>(width), chunk}}};
  }
  // As many as a device runs at a time.
  const std::size_t units = device_info<cl_uint>(of.device.cl_device()(), CL_DEVICE_MAX_COMPUTE_UNITS);
  const std::size_t at_a_time = 8 * units;
  const std::size_t groups = std::max(std::min(divided_up(pixels, items * width), at_a_time), fewest);
  return {groups,
          items,
          {{static_cast<cl_uint>(width), static_cast<cl_uint>(groups * items * width),
            static_cast<cl_uint>(pixels)}}};
}

void check_labels_fit(const Diagram& a, const Diagram& b) {
  if (!a.device().same_as(b.device())) throw Error("the diagrams belong to different devices");
  if (a.window() != b.window()) throw Error("diagrams of different windows cannot be compared");
}

MeasuredDiagram cells_of_both(const Diagram& a, const Diagram& b) {
  check_labels_fit(a, b);
  MeasuredDiagram one = cells_of(a);
  MeasuredDiagram other = cells_of(b);
  if (one.metric != other.metric)
    throw Error("diagrams of different metrics cannot be compared by distances");
  // Clones of seeds have frames of their own, but share where they lie.
  if (one.placement != other.placement) {
    throw Error("the diagrams are of different frames of seeds, and cannot be compared by distances");
  }
  refuse_weights(*labels_of(b).seeds, "an error of distances");
  // Labels of points are judged by points, also where the others are of pixels.
  return one.points ? std::move(one) : std::move(other);
}

// --- errors ---

struct DistanceErrorsState : Compared {
  std::size_t groups = 0;
  cl::Buffer wrong, sums, greatest;  // of each work-group: see walk.cl
};

Report distance_errors(const Diagram& diagram, const Diagram& exact, DistanceErrorsResult& result) {
  Measuring<DistanceErrorsState> measuring(result);
  DistanceErrorsState& found = measuring.state();
  MeasuredDiagram of = cells_of_both(diagram, exact);
  Kernel& kernel =
      found.kernels.get(of.device, "measures/comparison.cl", "judge_labels", of.grid, of.options());
  const Walk walk = walk_through(of, kernel);
  found.groups = walk.groups;
  make_room(found.wrong, of.device, walk.groups * sizeof(cl_uint2));
  make_room(found.sums, of.device, walk.groups * sizeof(cl_long));
  make_room(found.greatest, of.device, walk.groups * sizeof(cl_float));
  const cl::Event judged = compare(kernel, walk, diagram, exact, of.positions(), of.count(), of.lattice(),
                                   of.size(), found.wrong, found.sums, found.greatest);
  found.other = labels_of(exact).seeds;
  return measuring.commit(std::move(of), judged, judged);
}

DistanceErrors DistanceErrorsResult::read() const {
  DistanceErrors errors;
  if (!state_ || state_->empty()) return errors;
  state_->check();
  const MeasuredDiagram& of = *state_->of;
  const std::size_t groups = state_->groups;
  errors.pixels = of.grid.pixels();
  for (const cl_uint2& some : download<cl_uint2>(of.device, state_->wrong, groups)) {
    errors.wrong_pixels += some.s[0];
    errors.unlabelled_pixels += some.s[1];
  }
  double parts = 0;
  for (const cl_long some : download<cl_long>(of.device, state_->sums, groups))
    parts += static_cast<double>(some);
  for (const cl_float some : download<cl_float>(of.device, state_->greatest, groups))
    errors.largest_excess = std::max(errors.largest_excess, static_cast<double>(some));
  errors.mean_excess = parts / PARTS_OF_EXCESS / static_cast<double>(errors.pixels);
  return errors;
}

}  // namespace vorocl
