// Exact cells: what was cut of seeds, as arrays.
#include <nanobind/stl/unique_ptr.h>

#include <array>

#include "module.hpp"

namespace vorocl::python {

namespace {

// As EXACT_CELL and EXACT_PAIR of vorocl/_exact_cells.py say them, and EXACT_VOLUME_CELL and EXACT_FACE.

struct CellRow {
  double area, centroid_x, centroid_y, perimeter;
  std::uint32_t neighbours;
  bool touches_border, certified;
};

struct PairRow {
  std::uint32_t a, b;
  double length, midpoint_x, midpoint_y;
};

struct VolumeCellRow {
  double volume;
  Point centroid;
  double surface;
  std::uint32_t neighbours;
  bool touches_border, certified;
};

struct FaceRow {
  std::uint32_t a, b;
  double area;
  std::array<std::int32_t, 3> image;
};

/// What was read, so that seeds and device may go. Of a plane, or of a volume.
struct ExactCellsObject {
  std::vector<CellRow> cells;
  std::vector<PairRow> pairs;
  ExactPolygons polygons;
  std::vector<VolumeCellRow> volume_cells;
  std::vector<FaceRow> faces;
  ExactPolyhedra polyhedra;
};

void read_plane(const ExactCellsResult& result, ExactCellsObject& object) {
  for (const ExactCell& cell : result.read()) {
    object.cells.push_back({cell.area, cell.centroid.x, cell.centroid.y, cell.perimeter, cell.neighbours,
                            cell.touches_border, cell.certified});
  }
  for (const ExactPair& pair : result.read_pairs()) {
    object.pairs.push_back({pair.a, pair.b, pair.length, pair.midpoint.x, pair.midpoint.y});
  }
  object.polygons = result.read_polygons();
}

template <typename T>
void read_buffer(const Device& device, const cl::Buffer& buffer, std::size_t count, std::vector<T>& values) {
  values.resize(count);
  if (count > 0) device.queue().enqueueReadBuffer(buffer, CL_TRUE, 0, count * sizeof(T), values.data());
}

void read_volume(const Device& device, const ExactCellsResult& result, bool with_polyhedra,
                 ExactCellsObject& object) {
  for (const ExactCell& cell : result.read()) {
    object.volume_cells.push_back(
        {cell.area, cell.centroid, cell.perimeter, cell.neighbours, cell.touches_border, cell.certified});
  }
  for (const ExactFace& face : result.read_faces())
    object.faces.push_back({face.a, face.b, face.area, face.image});
  if (with_polyhedra) {
    object.polyhedra = result.read_polyhedra();
    return;
  }
  read_buffer(device, result.offsets(), result.size() + 1, object.polyhedra.offsets);
  read_buffer(device, result.edge_neighbours(), result.edges(), object.polyhedra.neighbours);
  read_buffer(device, result.lengths(), result.edges(), object.polyhedra.areas);
}

std::unique_ptr<ExactCellsObject> cut(SeedsObject& seeds, bool with_polyhedra) {
  const std::lock_guard<std::mutex> turn(seeds.mutex);
  ExactCellsResult result;
  exact_cells(seeds.seeds, result);
  auto object = std::make_unique<ExactCellsObject>();
  if (seeds.seeds.grid().is_volume()) {
    read_volume(seeds.seeds.device(), result, with_polyhedra, *object);
  } else {
    read_plane(result, *object);
  }
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
      .def("lengths", [](const Object& of) { return copy_of<double>(of.polygons.lengths); })
      .def("volume_cells", [](const Object& of) { return copy_of<std::uint8_t>(of.volume_cells); })
      .def("faces", [](const Object& of) { return copy_of<std::uint8_t>(of.faces); })
      .def("face_offsets", [](const Object& of) { return copy_of<std::uint32_t>(of.polyhedra.offsets); })
      .def("face_neighbours",
           [](const Object& of) { return copy_of<std::uint32_t>(of.polyhedra.neighbours); })
      .def("face_areas", [](const Object& of) { return copy_of<double>(of.polyhedra.areas); })
      .def("corner_offsets",
           [](const Object& of) { return copy_of<std::uint64_t>(of.polyhedra.corner_offsets); })
      .def("corners", [](const Object& of) { return copy_of<std::uint64_t>(of.polyhedra.corners); })
      .def("vertex_offsets",
           [](const Object& of) { return copy_of<std::uint64_t>(of.polyhedra.vertex_offsets); })
      .def("polyhedron_vertices", [](const Object& of) { return copy_of<double>(of.polyhedra.vertices); });
  module.def("exact_cells", cut, nb::arg("seeds"), nb::arg("with_polyhedra"), without_gil());
}

}  // namespace vorocl::python
