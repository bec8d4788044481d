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

  /// Fills it by a kernel of a volume's, which gets the rows, and numbers of its own.
  template <typename... Numbers>
  cl::Event fill_volume(const MeasuredDiagram& of, const char* name, const cl::Buffer& labels,
                        const Numbers&... numbers) {
    return kernels.get(of.device, "volumes/measures.cl", name, of.grid, of.options())
        .over_items(of.grid.rows(), labels, of.positions(), of.count(), of.grid.width(), of.grid.height(),
                    static_cast<cl_uint>(of.grid.rows()), numbers..., values);
  }
};

}  // namespace vorocl
