// What the sources of the extension module share: the objects behind Python's, and how arrays are passed.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vorocl/vorocl.hpp"

namespace vorocl::python {

namespace nb = nanobind;

/// While a function runs, other threads of Python may: it touches no object of Python's.
using without_gil = nb::call_guard<nb::gil_scoped_release>;

/// Arrays of Python's, C-contiguous and in this machine's byte order: Python has seen to it.
template <typename... What>
using Array = nb::ndarray<nb::c_contig, nb::device::cpu, What...>;

/// Rows (x, y), or (x, y, z) of a volume, aligned, with any strides.
using Rows = nb::ndarray<nb::device::cpu, const double, nb::ndim<2>>;

/// A new array of NumPy's that owns the rows: as many numbers T in each as fit.
template <typename T, typename Row>
nb::ndarray<nb::numpy, T, nb::ndim<2>> to_numpy(std::vector<Row>&& rows) {
  static_assert(sizeof(Row) % sizeof(T) == 0);
  auto* const owned = new std::vector<Row>(std::move(rows));
  const nb::capsule owner(owned,
                          [](void* vector) noexcept { delete static_cast<std::vector<Row>*>(vector); });
  return {owned->data(), {owned->size(), sizeof(Row) / sizeof(T)}, owner};
}

/// A handle of OpenCL as pyopencl passes it, retained.
template <typename Handle>
Handle retained(std::uintptr_t handle) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr)
  return Handle(reinterpret_cast<typename Handle::cl_type>(handle), true);
}

/// Seeds. The library wants one thread at a time; threads of Python take turns.
struct SeedsObject {
  explicit SeedsObject(Seeds made, Snap snapped = Snap::to_pixels) : seeds(std::move(made)), snap(snapped) {}

  std::mutex mutex;
  Seeds seeds;
  Snap snap;
  std::vector<std::uint8_t> present;  // of the last points, so that a move allocates nothing
};

/// A diagram, and what was measured of it last, so that the next measurement allocates nothing.
struct DiagramObject {
  explicit DiagramObject(Diagram made) : diagram(std::move(made)) {}

  std::mutex mutex;
  Diagram diagram;
  std::optional<Seeds> seeds;   // in the frame that its labels name; none if it is not known
  Snap snap = Snap::to_pixels;  // where an exact method has made the labels
  CellSumsResult sums;
  CellShapesResult shapes;
  AdjacencyResult adjacency;
  Field<float> distances;
};

/// Throws Error for a name that is none of a metric.
Metric metric_of(const std::string& name);

void bind_errors(nb::module_& module);
void bind_devices(nb::module_& module);
void bind_seeds(nb::module_& module);
void bind_diagrams(nb::module_& module);
void bind_exact_cells(nb::module_& module);
void bind_masks(nb::module_& module);

}  // namespace vorocl::python
