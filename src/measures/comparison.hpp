// Two diagrams that are compared pixel by pixel: see comparison.cl.
#pragma once

#include "measures/measurement.hpp"

namespace vorocl {

/// The pixels that a work-item compares, and the work-items of a grid.
constexpr std::size_t pixels_per_item = 1024;
inline std::size_t comparing_items(const PixelGrid& grid) {
  return (grid.pixels() + pixels_per_item - 1) / pixels_per_item;
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
