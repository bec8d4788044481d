// The C functions that measure cells.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "calls.hpp"

using namespace vorocl;

struct vorocl_cell_sums {
  CellSumsResult result;
  CellStatisticsResult statistics;
};

struct vorocl_cell_shapes {
  CellShapesResult result;
};

struct vorocl_adjacency {
  AdjacencyResult result;
};

namespace vorocl {

namespace {

CellSumsResult& of(vorocl_cell_sums* sums) { return given(sums, "sums").result; }
const CellSumsResult& of(const vorocl_cell_sums* sums) { return given(sums, "sums").result; }
CellShapesResult& of(vorocl_cell_shapes* shapes) { return given(shapes, "shapes").result; }
const CellShapesResult& of(const vorocl_cell_shapes* shapes) { return given(shapes, "shapes").result; }
AdjacencyResult& of(vorocl_adjacency* adjacency) { return given(adjacency, "adjacency").result; }
const AdjacencyResult& of(const vorocl_adjacency* adjacency) { return given(adjacency, "adjacency").result; }

}  // namespace

}  // namespace vorocl

// --- sums ---

vorocl_status vorocl_cell_sums_create(vorocl_cell_sums** sums) {
  return make_object(sums, "sums", [] { return vorocl_cell_sums{}; });
}

void vorocl_cell_sums_free(vorocl_cell_sums* sums) { delete sums; }

vorocl_status vorocl_cell_sums_measure(vorocl_cell_sums* sums, const vorocl_diagram* diagram) {
  return guarded([&] { cell_sums(of(diagram), of(sums)); });
}

vorocl_status vorocl_cell_sums_count(const vorocl_cell_sums* sums, size_t* count) {
  return answer(count, "count", [&] { return of(sums).size(); });
}

vorocl_status vorocl_cell_sums_buffers(const vorocl_cell_sums* sums, cl_mem* area, cl_mem* sum_x,
                                       cl_mem* sum_y, cl_mem* sum_z) {
  return guarded([&] {
    const CellSumsResult& from = of(sums);
    store(area, from.area()());
    store(sum_x, from.sum_x()());
    store(sum_y, from.sum_y()());
    store(sum_z, from.sum_z()());
  });
}

vorocl_status vorocl_cell_sums_read(const vorocl_cell_sums* sums, uint32_t* area, int64_t* sum_x,
                                    int64_t* sum_y, int64_t* sum_z, size_t count) {
  return guarded([&] {
    check_count(of(sums).size(), "cells", count);
    std::size_t id = 0;
    for (const CellSums& cell : of(sums).read()) {
      if (area != nullptr) area[id] = cell.area;
      if (sum_x != nullptr) sum_x[id] = cell.sum_x;
      if (sum_y != nullptr) sum_y[id] = cell.sum_y;
      if (sum_z != nullptr) sum_z[id] = cell.sum_z;
      ++id;
    }
  });
}

vorocl_status vorocl_cell_sums_centroids(const vorocl_cell_sums* sums, vorocl_point* centroids,
                                         size_t count) {
  return guarded([&] {
    check_count(of(sums).size(), "cells", count);
    if (count > 0) given(centroids, "centroids");
    for (const CellSums& cell : of(sums).read()) *centroids++ = to_c(cell.centroid());
  });
}

vorocl_status vorocl_cell_sums_statistics(vorocl_cell_sums* sums, vorocl_cell_statistics* statistics) {
  return guarded([&] {
    given(statistics, "statistics");
    cell_statistics(of(sums), sums->statistics);
    const CellStatistics found = sums->statistics.read();
    *statistics = {found.cells, found.empty_cells, found.pixels, found.mean_area, found.area_deviation};
  });
}

// --- shapes ---

vorocl_status vorocl_cell_shapes_create(vorocl_cell_shapes** shapes) {
  return make_object(shapes, "shapes", [] { return vorocl_cell_shapes{}; });
}

void vorocl_cell_shapes_free(vorocl_cell_shapes* shapes) { delete shapes; }

vorocl_status vorocl_cell_shapes_measure(vorocl_cell_shapes* shapes, const vorocl_diagram* diagram) {
  return guarded([&] { cell_shapes(of(diagram), of(shapes)); });
}

vorocl_status vorocl_cell_shapes_count(const vorocl_cell_shapes* shapes, size_t* count) {
  return answer(count, "count", [&] { return of(shapes).size(); });
}

vorocl_status vorocl_cell_shapes_buffers(const vorocl_cell_shapes* shapes, cl_mem* boxes,
                                         cl_mem* largest_distances) {
  return guarded([&] {
    const CellShapesResult& from = of(shapes);
    store(boxes, from.boxes()());
    store(largest_distances, from.largest_distances()());
  });
}

vorocl_status vorocl_cell_shapes_read(const vorocl_cell_shapes* shapes, vorocl_cell_shape* cells,
                                      size_t count) {
  return guarded([&] {
    check_count(of(shapes).size(), "cells", count);
    if (count > 0) given(cells, "cells");
    for (const CellShape& cell : of(shapes).read()) {
      *cells++ = {
          cell.left,  cell.top, cell.right, cell.bottom, cell.largest_distance, cell.touches_border ? 1 : 0,
          cell.front, cell.back};
    }
  });
}

// --- adjacency ---

vorocl_status vorocl_adjacency_create(vorocl_adjacency** adjacency) {
  return make_object(adjacency, "adjacency", [] { return vorocl_adjacency{}; });
}

void vorocl_adjacency_free(vorocl_adjacency* adjacency) { delete adjacency; }

vorocl_status vorocl_adjacency_find(vorocl_adjacency* adjacency, const vorocl_diagram* diagram) {
  return guarded([&] { vorocl::adjacency(of(diagram), of(adjacency)); });
}

vorocl_status vorocl_adjacency_pairs(const vorocl_adjacency* adjacency, size_t* pairs) {
  return answer(pairs, "pairs", [&] { return of(adjacency).pairs(); });
}

vorocl_status vorocl_adjacency_buffers(const vorocl_adjacency* adjacency, cl_mem* pair_list,
                                       cl_mem* neighbours, cl_mem* perimeters) {
  return guarded([&] {
    const AdjacencyResult& from = of(adjacency);
    store(pair_list, from.pair_list()());
    store(neighbours, from.neighbours()());
    store(perimeters, from.perimeters()());
  });
}

vorocl_status vorocl_adjacency_read_pairs(const vorocl_adjacency* adjacency, vorocl_cell_pair* pairs,
                                          size_t count) {
  return guarded([&] {
    check_count(of(adjacency).pairs(), "pairs", count);
    if (count > 0) given(pairs, "pairs");
    for (const CellPair& pair : of(adjacency).read_pairs()) *pairs++ = {pair.a, pair.b, pair.length};
  });
}

vorocl_status vorocl_adjacency_read_cells(const vorocl_adjacency* adjacency, uint32_t* neighbours,
                                          uint32_t* perimeters, size_t count) {
  return guarded([&] {
    const std::vector<std::uint32_t> of_neighbours = of(adjacency).read_neighbours();
    check_count(of_neighbours.size(), "cells", count);
    const std::vector<std::uint32_t> of_perimeters = of(adjacency).read_perimeters();
    if (neighbours != nullptr) std::copy(of_neighbours.begin(), of_neighbours.end(), neighbours);
    if (perimeters != nullptr) std::copy(of_perimeters.begin(), of_perimeters.end(), perimeters);
  });
}
