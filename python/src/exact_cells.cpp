// Exact cells: what was cut of seeds, as arrays.
#include <nanobind/stl/unique_ptr.h>

#include "module.hpp"

namespace vorocl::python {

namespace {

// As EXACT_CELL and EXACT_PAIR of vorocl/_exact_cells.py say them.

struct CellRow {
  double area, centroid_x, centroid_y, perimeter;
  std::uint32_t neighbours;
  bool touches_border, certified;
};

struct PairRow {
  std::uint32_t a, b;
  double length, midpoint_x, midpoint_y;
};

/// What was read, so that seeds and device may go.
struct ExactCellsObject {
  std::vector<CellRow> cells;
  std::vector<PairRow> pairs;
  ExactPolygons polygons;
};

std::unique_ptr<ExactCellsObject> cut(SeedsObject& seeds) {
  const std::lock_guard<std::mutex> turn(seeds.mutex);
  ExactCellsResult result;
  exact_cells(seeds.seeds, result);
  auto object = std::make_unique<ExactCellsObject>();
  for (const ExactCell& cell : result.read()) {
    object->cells.push_back({cell.area, cell.centroid.x, cell.centroid.y, cell.perimeter, cell.neighbours,
                             cell.touches_border, cell.certified});
  }
  for (const ExactPair& pair : result.read_pairs()) {
    object->pairs.push_back({pair.a, pair.b, pair.length, pair.midpoint.x, pair.midpoint.y});
  }
  object->polygons = result.read_polygons();
  return object;
}

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
