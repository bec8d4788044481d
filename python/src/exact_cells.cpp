// Exact cells: what was cut of seeds, as arrays.
#include <nanobind/stl/unique_ptr.h>

#include "module.hpp"

namespace vorocl::python {

namespace {

/// What was read, so that seeds and device may go.
struct ExactCellsObject {
  std::vector<ExactCell> cells;
  std::vector<ExactPair> pairs;
  ExactPolygons polygons;
};

std::unique_ptr<ExactCellsObject> cut(SeedsObject& seeds) {
  const std::lock_guard<std::mutex> turn(seeds.mutex);
  ExactCellsResult result;
  exact_cells(seeds.seeds, result);
  return std::make_unique<ExactCellsObject>(
      ExactCellsObject{result.read(), result.read_pairs(), result.read_polygons()});
}

// As EXACT_CELL and EXACT_PAIR of vorocl/_exact_cells.py say them.
static_assert(sizeof(ExactCell) == 40 && sizeof(ExactPair) == 32);

template <typename T, typename Row>
auto copy_of(const std::vector<Row>& rows) {
  return to_numpy<T>(std::vector<Row>(rows));
}

}  // namespace

void bind_exact_cells(nb::module_& module) {
  using Object = ExactCellsObject;
  nb::class_<Object>(module, "ExactCells")
      .def("cells", [](const Object& of) { return copy_of<std::uint8_t>(of.cells); })
      .def("pairs", [](const Object& of) { return copy_of<std::uint8_t>(of.pairs); })
      .def("offsets", [](const Object& of) { return copy_of<std::uint32_t>(of.polygons.offsets); })
      .def("vertices", [](const Object& of) { return copy_of<double>(of.polygons.vertices); })
      .def("neighbours", [](const Object& of) { return copy_of<std::uint32_t>(of.polygons.neighbours); })
      .def("lengths", [](const Object& of) { return copy_of<double>(of.polygons.lengths); });
  module.def("exact_cells", cut, nb::arg("seeds"), without_gil());
}

}  // namespace vorocl::python
