#include "globe/globe.hpp"
#include "measures/measurement.hpp"
#include "vorocl/adjacency.hpp"
#include "vorocl/cells.hpp"
#include "vorocl/fields.hpp"

namespace vorocl {

namespace {

double length_of_pixel(const Axis& axis) {
  return (axis.to() - axis.from()) / static_cast<double>(axis.pixels());
}

/// A position in pixels from a window's first one, in the units of the data.
Point point_in(const Window& window, const Point& position) {
  return window.grid().point({position.x + static_cast<double>(window.x()),
                              position.y + static_cast<double>(window.y()), position.z});
}

}  // namespace

std::vector<CellRow> cell_table(const Diagram& diagram) {
  const MeasuredDiagram of = cells_of(diagram, OnGlobe::yes);
  AdjacencyResult pairs;
  adjacency(diagram, pairs);
  const std::vector<std::uint32_t> neighbours = pairs.read_neighbours();
  if (of.metric == Metric::great_circle) {
    Field<float> distances;
    distance_field(diagram, distances);
    return cells_on_globe(of, diagram.read(), distances.read(), neighbours);
  }
  CellSumsResult sums_of_cells;
  CellShapesResult shapes_of_cells;
  cell_sums(diagram, sums_of_cells);
  cell_shapes(diagram, shapes_of_cells);
  const std::vector<CellSums> sums = sums_of_cells.read();
  const std::vector<CellShape> shapes = shapes_of_cells.read();

  const Window& window = of.window;
  const Grid& grid = window.grid();
  const double area_of_pixel = length_of_pixel(grid.x()) * length_of_pixel(grid.y()) *
                               (grid.is_volume() ? length_of_pixel(grid.z()) : 1);
  const std::vector<std::optional<Point>> points = of.seeds->read_given();
  std::vector<CellRow> rows;
  for (std::uint32_t id = 0; id < points.size(); ++id) {
    if (!points[id]) continue;
    const Point centroid = sums[id].centroid();
    rows.push_back({id, *points[id], sums[id].area, sums[id].area * area_of_pixel, point_in(window, centroid),
                    shapes[id].touches_border, neighbours[id], shapes[id].farthest(of.metric)});
  }
  return rows;
}

}  // namespace vorocl
