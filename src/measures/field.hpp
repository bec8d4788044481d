// What a Field holds.
#pragma once

#include "measures/measurement.hpp"
#include "vorocl/fields.hpp"

namespace vorocl {

template <typename T>
struct FieldState : Measured {
  cl::Buffer values;
  cl::Buffer too_long;  // whether a distance does not fit: see fields.cl
  cl::Buffer table;     // that labels are looked up in

  /// Makes room for a value per pixel, which a kernel of fields.cl then fills.
  void make_room_for(const MeasuredDiagram& diagram) {
    make_room(values, diagram.device, diagram.grid.pixels() * sizeof(T));
  }
  Kernel& kernel(const MeasuredDiagram& diagram, const char* name, const KernelOptions& options) {
    return kernels.get(diagram.device, "measures/fields.cl", name, diagram.grid, options);
  }
};

}  // namespace vorocl
