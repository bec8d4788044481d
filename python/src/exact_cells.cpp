// Exact cells: what was cut of seeds, as arrays.
#include <nanobind/stl/optional.h>

#include <array>
#include <functional>

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

/// What was read without Python's lock, each to become an array with it, by the names of vorocl.ExactCells.
using Arrays = std::vector<std::pair<const char*, std::function<nb::object()>>>;

template <typename T, typename Row>
void add(Arrays& arrays, const char* name, std::vector<Row> rows) {
  const auto shared = std::make_shared<std::vector<Row>>(std::move(rows));
  arrays.emplace_back(name, [shared] { return nb::cast(to_numpy<T>(std::move(*shared))); });
}

void read_plane(const ExactCellsResult& result, Arrays& arrays) {
  std::vector<CellRow> cells;
  for (const ExactCell& cell : result.read()) {
    cells.push_back({cell.area, cell.centroid.x, cell.centroid.y, cell.perimeter, cell.neighbours,
                     cell.touches_border, cell.certified});
  }
  std::vector<PairRow> pairs;
  for (const ExactPair& pair : result.read_pairs()) {
    pairs.push_back({pair.a, pair.b, pair.length, pair.midpoint.x, pair.midpoint.y});
  }
  ExactPolygons polygons = result.read_polygons();
  add<std::uint8_t>(arrays, "cells", std::move(cells));
  add<std::uint8_t>(arrays, "pairs", std::move(pairs));
  add<std::uint32_t>(arrays, "offsets", std::move(polygons.offsets));
  add<double>(arrays, "vertices", std::move(polygons.vertices));
  add<std::uint32_t>(arrays, "neighbours", std::move(polygons.neighbours));
  add<double>(arrays, "lengths", std::move(polygons.lengths));
}

template <typename T>
std::vector<T> read_buffer(const Device& device, const cl::Buffer& buffer, std::size_t count) {
  std::vector<T> values(count);
  if (count > 0) device.queue().enqueueReadBuffer(buffer, CL_TRUE, 0, count * sizeof(T), values.data());
  return values;
}

void read_volume(const Device& device, const ExactCellsResult& result, bool with_polyhedra, Arrays& arrays) {
  std::vector<VolumeCellRow> cells;
  for (const ExactCell& cell : result.read()) {
    cells.push_back(
        {cell.area, cell.centroid, cell.perimeter, cell.neighbours, cell.touches_border, cell.certified});
  }
  std::vector<FaceRow> faces;
  for (const ExactFace& face : result.read_faces()) faces.push_back({face.a, face.b, face.area, face.image});
  add<std::uint8_t>(arrays, "cells", std::move(cells));
  add<std::uint8_t>(arrays, "pairs", std::move(faces));
  ExactPolyhedra found;
  if (with_polyhedra) {
    found = result.read_polyhedra();
    add<double>(arrays, "vertices", std::move(found.vertices));
    add<std::int64_t>(arrays, "vertex_offsets", std::move(found.vertex_offsets));
    add<std::int64_t>(arrays, "corner_offsets", std::move(found.corner_offsets));
    add<std::int64_t>(arrays, "corners", std::move(found.corners));
  } else {
    found.offsets = read_buffer<std::uint32_t>(device, result.offsets(), result.size() + 1);
    found.neighbours = read_buffer<std::uint32_t>(device, result.edge_neighbours(), result.edges());
    found.areas = read_buffer<double>(device, result.lengths(), result.edges());
  }
  add<std::uint32_t>(arrays, "offsets", std::move(found.offsets));
  add<std::uint32_t>(arrays, "neighbours", std::move(found.neighbours));
  add<double>(arrays, "areas", std::move(found.areas));
}

nb::typed<nb::dict, nb::str, nb::any> cut(SeedsObject& seeds, bool with_polyhedra) {
  Arrays arrays;
  {
    const nb::gil_scoped_release unlocked;
    const std::lock_guard<std::mutex> turn(seeds.mutex);
    ExactCellsResult result;
    exact_cells(seeds.seeds, result);
    if (seeds.seeds.grid().is_volume()) {
      read_volume(seeds.seeds.device(), result, with_polyhedra, arrays);
    } else {
      read_plane(result, arrays);
    }
  }
  nb::dict named;
  for (const auto& [name, make] : arrays) named[name] = make();
  return named;
}

}  // namespace

void bind_exact_cells(nb::module_& module) {
  module.def("exact_cells", cut, nb::arg("seeds"), nb::arg("with_polyhedra"));
}

}  // namespace vorocl::python
