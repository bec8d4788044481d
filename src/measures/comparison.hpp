// Two diagrams that are compared pixel by pixel: see walk.cl.
#pragma once

#include "measures/measurement.hpp"

namespace vorocl {

/// How the work-items of a kernel share out a diagram's pixels.
struct Walk {
  std::size_t groups, items_of_group;
  cl_uint4 steps;  // see walk.cl
};
Walk walk_through(const MeasuredDiagram& of, const Kernel& kernel);

/// Enqueues a kernel over the labels of two diagrams by such a walk, with these arguments behind.
template <typename... Arguments>
cl::Event compare(Kernel& kernel, const Walk& walk, const Diagram& a, const Diagram& b,
                  const Arguments&... arguments) {
  return kernel.in_groups_of(walk.items_of_group)
      .over_items(walk.groups * walk.items_of_group, a.labels(), b.labels(), walk.steps, arguments...);
}

/// What a result of two diagrams holds: what it is of, and the other one's seeds.
struct Compared : Measured {
  std::shared_ptr<const SeedsFrame> other;  // null: its labels name none

  /// Throws BadPoint if the seeds of either had one.
  void check() const {
    of->check();
    if (other) other->check();
  }
};

/// Throws Error unless the diagrams have one device and show one window.
void check_labels_fit(const Diagram& a, const Diagram& b);

/// As above, and unless they are of one frame of seeds and one metric. Returns the first one.
MeasuredDiagram cells_of_both(const Diagram& a, const Diagram& b);

}  // namespace vorocl
