// The C functions of measures that give numbers.
#include <algorithm>
#include <vector>

#include "calls.hpp"

using namespace vorocl;

vorocl_status vorocl_similarity(const vorocl_diagram* a, const vorocl_diagram* b, double* percent) {
  return answer(percent, "percent", [&] {
    SimilarityResult result;
    similarity(of(a), of(b), result);
    return result.read();
  });
}

vorocl_status vorocl_similarity_within(const vorocl_diagram* a, const vorocl_diagram* b, double tolerance,
                                       double* percent) {
  return answer(percent, "percent", [&] {
    SimilarityResult result;
    similarity(of(a), of(b), tolerance, result);
    return result.read();
  });
}

vorocl_status vorocl_changed_pixels(const vorocl_diagram* a, const vorocl_diagram* b, size_t* pixels) {
  return answer(pixels, "pixels", [&] {
    SimilarityResult result;
    similarity(of(a), of(b), result);
    return result.read_differences();
  });
}

vorocl_status vorocl_distance_errors(const vorocl_diagram* diagram, const vorocl_diagram* exact,
                                     vorocl_wrong_labels* wrong) {
  return answer(wrong, "wrong", [&] {
    DistanceErrorsResult result;
    distance_errors(of(diagram), of(exact), result);
    const DistanceErrors found = result.read();
    return vorocl_wrong_labels{found.pixels, found.wrong_pixels, found.unlabelled_pixels,
                               found.largest_excess, found.mean_excess};
  });
}

vorocl_status vorocl_energy(const vorocl_diagram* diagram, double* sum) {
  return answer(sum, "energy", [&] { return energy(of(diagram)); });
}

vorocl_status vorocl_cell_table(const vorocl_diagram* diagram, vorocl_cell_row* rows, size_t room,
                                size_t* count) {
  return guarded([&] {
    given(count, "count");
    if (room > 0) given(rows, "rows");
    const std::vector<CellRow> found = cell_table(of(diagram));
    for (std::size_t i = 0; i < std::min(room, found.size()); ++i) {
      const CellRow& cell = found[i];
      rows[i] = {cell.id,         to_c(cell.seed),      cell.pixels,
                 cell.area,       to_c(cell.centroid),  cell.touches_border ? 1 : 0,
                 cell.neighbours, cell.largest_distance};
    }
    *count = found.size();
  });
}

vorocl_status vorocl_vertices(const vorocl_diagram* diagram, vorocl_point* points, size_t room,
                              size_t* count) {
  return guarded([&] {
    given(count, "count");
    if (room > 0) given(points, "points");
    VerticesResult result;
    vertices(of(diagram), result);
    if (room > 0) {
      const std::vector<Point> found = result.read();
      for (std::size_t i = 0; i < std::min(room, found.size()); ++i) points[i] = to_c(found[i]);
    }
    *count = result.count();
  });
}
