// The C functions that cut cells as polygons and polyhedra.
#include <algorithm>

#include "calls.hpp"

using namespace vorocl;

struct vorocl_exact_cells {
  ExactCellsResult result;
};

struct vorocl_exact_polyhedra {
  ExactPolyhedra polyhedra;
  std::vector<vorocl_point> points;
};

namespace vorocl {

namespace {

ExactCellsResult& of(vorocl_exact_cells* cells) { return given(cells, "cells").result; }
const ExactCellsResult& of(const vorocl_exact_cells* cells) { return given(cells, "cells").result; }

}  // namespace

}  // namespace vorocl

vorocl_status vorocl_exact_cells_create(vorocl_exact_cells** cells) {
  return make_object(cells, "cells", [] { return vorocl_exact_cells{}; });
}

void vorocl_exact_cells_free(vorocl_exact_cells* cells) { delete cells; }

vorocl_status vorocl_exact_cells_cut(vorocl_exact_cells* cells, const vorocl_seeds* seeds) {
  return guarded([&] { exact_cells(of(seeds), of(cells)); });
}

vorocl_status vorocl_exact_cells_count(const vorocl_exact_cells* cells, size_t* count) {
  return answer(count, "count", [&] { return of(cells).size(); });
}

vorocl_status vorocl_exact_cells_read(const vorocl_exact_cells* all, vorocl_exact_cell* cells, size_t count) {
  return guarded([&] {
    check_count(of(all).size(), "cells", count);
    if (count > 0) given(cells, "cells");
    for (const ExactCell& cell : of(all).read()) {
      *cells++ = {cell.area,       to_c(cell.centroid),         cell.perimeter,
                  cell.neighbours, cell.touches_border ? 1 : 0, cell.certified ? 1 : 0};
    }
  });
}

vorocl_status vorocl_exact_cells_buffers(const vorocl_exact_cells* cells, cl_mem* areas, cl_mem* centroids,
                                         cl_mem* perimeters, cl_mem* neighbours, cl_mem* flags) {
  return guarded([&] {
    const ExactCellsResult& from = of(cells);
    store(areas, from.areas()());
    store(centroids, from.centroids()());
    store(perimeters, from.perimeters()());
    store(neighbours, from.neighbours()());
    store(flags, from.flags()());
  });
}

vorocl_status vorocl_exact_cells_edges(const vorocl_exact_cells* cells, size_t* edges) {
  return answer(edges, "edges", [&] { return of(cells).edges(); });
}

vorocl_status vorocl_exact_cells_polygon_buffers(const vorocl_exact_cells* cells, cl_mem* offsets,
                                                 cl_mem* vertices, cl_mem* neighbours, cl_mem* lengths) {
  return guarded([&] {
    const ExactCellsResult& from = of(cells);
    store(offsets, from.offsets()());
    store(vertices, from.vertices()());
    store(neighbours, from.edge_neighbours()());
    store(lengths, from.lengths()());
  });
}

vorocl_status vorocl_exact_cells_read_polygons(const vorocl_exact_cells* cells, uint32_t* offsets,
                                               size_t count, vorocl_point* vertices, uint32_t* neighbours,
                                               double* lengths, size_t edges) {
  return guarded([&] {
    check_count(of(cells).size(), "cells", count);
    check_count(of(cells).edges(), "edges", edges);
    const ExactPolygons polygons = of(cells).read_polygons();
    if (offsets != nullptr) std::copy(polygons.offsets.begin(), polygons.offsets.end(), offsets);
    if (vertices != nullptr) {
      std::transform(polygons.vertices.begin(), polygons.vertices.end(), vertices,
                     [](const Point& vertex) { return to_c(vertex); });
    }
    if (neighbours != nullptr) std::copy(polygons.neighbours.begin(), polygons.neighbours.end(), neighbours);
    if (lengths != nullptr) std::copy(polygons.lengths.begin(), polygons.lengths.end(), lengths);
  });
}

vorocl_status vorocl_exact_cells_read_faces(const vorocl_exact_cells* cells, vorocl_exact_face* faces,
                                            size_t room, size_t* count) {
  return guarded([&] {
    given(count, "count");
    if (room > 0) given(faces, "faces");
    const std::vector<ExactFace> found = of(cells).read_faces();
    for (std::size_t i = 0; i < std::min(room, found.size()); ++i) {
      const ExactFace& face = found[i];
      faces[i] = {face.a, face.b, face.area, {face.image[0], face.image[1], face.image[2]}};
    }
    *count = found.size();
  });
}

vorocl_status vorocl_exact_cells_polyhedra(const vorocl_exact_cells* cells,
                                           vorocl_exact_polyhedra** polyhedra) {
  return make_object(polyhedra, "polyhedra", [&] {
    vorocl_exact_polyhedra object = {of(cells).read_polyhedra(), {}};
    for (const Point& vertex : object.polyhedra.vertices) object.points.push_back(to_c(vertex));
    object.polyhedra.vertices = {};
    return object;
  });
}

vorocl_status vorocl_exact_polyhedra_arrays(const vorocl_exact_polyhedra* polyhedra,
                                            vorocl_polyhedra_arrays* arrays) {
  return answer(arrays, "arrays", [&] {
    const vorocl_exact_polyhedra& object = given(polyhedra, "polyhedra");
    const ExactPolyhedra& all = object.polyhedra;
    return vorocl_polyhedra_arrays{
        all.offsets.size() - 1, all.neighbours.size(),     all.corners.size(),  object.points.size(),
        all.offsets.data(),     all.neighbours.data(),     all.areas.data(),    all.corner_offsets.data(),
        all.corners.data(),     all.vertex_offsets.data(), object.points.data()};
  });
}

void vorocl_exact_polyhedra_free(vorocl_exact_polyhedra* polyhedra) { delete polyhedra; }
