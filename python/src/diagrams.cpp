// Diagrams: methods that fill them, and what is measured of them.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <limits>
#include <string>
#include <tuple>

#include "module.hpp"

namespace vorocl::python {

Metric metric_of(const std::string& name) {
  if (name == "euclidean") return Metric::euclidean;
  if (name == "manhattan") return Metric::manhattan;
  if (name == "great-circle") return Metric::great_circle;
  throw Error("there is no metric \"" + name + "\"; there are euclidean, manhattan, great-circle");
}

namespace {

using Turn = std::lock_guard<std::mutex>;
using Turns = std::scoped_lock<std::mutex, std::mutex>;

MethodOptions options_with(const std::string& metric) {
  MethodOptions options;
  options.metric = metric_of(metric);
  return options;
}

// --- making and filling ---

/// Over the buffer of a caller who uses OpenCL too, if there is one.
std::unique_ptr<DiagramObject> make(const Device& device, const Grid& grid,
                                    std::optional<std::uintptr_t> labels) {
  return std::make_unique<DiagramObject>(labels ? Diagram(device, grid, retained<cl::Buffer>(*labels))
                                                : Diagram(device, grid));
}

std::uintptr_t buffer(DiagramObject& diagram) {
  const Turn turn(diagram.mutex);
  return reinterpret_cast<std::uintptr_t>(diagram.diagram.labels()());
}

/// A diagram that was made from a shape alone learns from its seeds which stretch of their plane it shows. It
/// keeps its buffer. What does not fit in another way is left to the library, which says so.
void show(Diagram& diagram, const Grid& grid) {
  const Grid& own = diagram.window().grid();
  const bool fits = own.width() == grid.width() && own.height() == grid.height() &&
                    own.depth() == grid.depth() && own.periodic() == grid.periodic();
  if (fits && own != grid) diagram = Diagram(diagram.device(), grid, diagram.labels());
}

/// Remembers the seeds that the labels name; a clone shares their frame. `snap` says what of them is the
/// truth.
void remember(DiagramObject& diagram, const Seeds& seeds, Snap snap = Snap::to_pixels) {
  diagram.seeds = seeds.clone();
  diagram.snap = snap;
}

/// While this lives the labels are made in an array, if the device can: it is the caller's, who may free it
/// after the call.
struct InArray {
  InArray(Diagram& of, std::uint32_t* place) : diagram(of) { diagram.put_labels_at(place); }
  ~InArray() { diagram.put_labels_at(nullptr); }
  Diagram& diagram;
};

/// With an array, the labels are in it alone: the diagram counts as never filled.
Report fill(DiagramObject& diagram, SeedsObject& seeds, const std::string& name, const std::string& metric,
            std::optional<double> max_displacement, const std::optional<Array<std::uint32_t>>& labels) {
  const Turns turns(diagram.mutex, seeds.mutex);
  const Method& filling = method(name);
  MethodOptions options = options_with(metric);
  options.max_displacement = max_displacement;
  diagram.seeds.reset();
  show(diagram.diagram, seeds.seeds.grid());
  if (labels) {
    const InArray in_array(diagram.diagram, labels->data());
    Report report = filling.run(seeds.seeds, diagram.diagram, options);
    diagram.diagram.read(labels->data());
    return report;
  }
  Report report = filling.run(seeds.seeds, diagram.diagram, options);
  remember(diagram, seeds.seeds, report.snapped() ? Snap::to_pixels : seeds.snap);
  return report;
}

// Images have the diagram's shape: Python has seen to it.

void read(DiagramObject& diagram, const Array<std::uint32_t>& labels) {
  const Turn turn(diagram.mutex);
  diagram.diagram.read(labels.data());
}

/// Labels that name these seeds, if there are any.
void write(DiagramObject& diagram, const Array<const std::uint32_t>& image, SeedsObject* seeds,
           const std::string& metric) {
  const Turn turn(diagram.mutex);
  std::vector<std::uint32_t> labels(image.data(), image.data() + image.size());
  diagram.seeds.reset();
  if (seeds == nullptr) {
    diagram.diagram.write(labels);
    return;
  }
  const Turn turn_of_seeds(seeds->mutex);
  show(diagram.diagram, seeds->seeds.grid());
  diagram.diagram.write(labels, seeds->seeds, metric_of(metric));
  remember(diagram, seeds->seeds);
}

// --- measures ---

void distances(DiagramObject& diagram, const Array<float>& values) {
  const Turn turn(diagram.mutex);
  distance_field(diagram.diagram, diagram.distances);
  diagram.distances.read(values.data());
}

/// What is measured of one cell, besides how its seed is given.
struct CellMeasures {
  const CellSums& sums;
  const CellShape& shape;
  std::uint32_t perimeter, neighbours;
  Metric metric;
};

/// One cell, as CELL in vorocl/_objects.py says it: in pixels.
struct Row {
  double x, y, z, centroid_x, centroid_y, centroid_z, largest_distance;
  std::uint32_t area, perimeter, neighbours;
  std::int32_t left, top, front, right, bottom, back;
  bool touches_border;
};

Row row_of(const std::optional<Point>& seed, const CellMeasures& cell) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Point place = seed.value_or(Point{none, none, none}), centroid = cell.sums.centroid();
  const double farthest = cell.shape.farthest(cell.metric);
  const CellShape box = cell.sums.area > 0 ? cell.shape : CellShape{0, 0, -1, -1, 0, false, 0, -1};
  return {place.x,   place.y,        place.z,        centroid.x,      centroid.y,        centroid.z,
          farthest,  cell.sums.area, cell.perimeter, cell.neighbours, box.left,          box.top,
          box.front, box.right,      box.bottom,     box.back,        box.touches_border};
}

/// The seeds that the labels name.
const Seeds& seeds_of(const DiagramObject& diagram) {
  if (!diagram.seeds) {
    throw Error("the diagram knows no seeds: fill it, or write labels with the seeds that they name");
  }
  return *diagram.seeds;
}

std::vector<Row> measure_cells(DiagramObject& diagram) {
  const std::vector<std::optional<Point>> places = seeds_of(diagram).read_pixels();
  const Metric metric = diagram.diagram.metric();
  cell_sums(diagram.diagram, diagram.sums);
  cell_shapes(diagram.diagram, diagram.shapes);
  adjacency(diagram.diagram, diagram.adjacency);
  const auto sums = diagram.sums.read();
  const auto shapes = diagram.shapes.read();
  const auto perimeters = diagram.adjacency.read_perimeters(),
             neighbours = diagram.adjacency.read_neighbours();
  std::vector<Row> rows;
  rows.reserve(places.size());
  for (std::size_t id = 0; id < places.size(); ++id) {
    rows.push_back(row_of(places[id], {sums[id], shapes[id], perimeters[id], neighbours[id], metric}));
  }
  return rows;
}

/// One cell on the globe, as GLOBE_CELL in vorocl/_objects.py says it: in degrees and square kilometres.
struct GlobeRow {
  double x, y, area, centroid_x, centroid_y, largest_distance;
  std::uint32_t pixels, neighbours;
  bool touches_border;
};

std::vector<GlobeRow> measure_globe(DiagramObject& diagram) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<GlobeRow> rows(seeds_of(diagram).size(), {none, none, 0, none, none, none, 0, 0, false});
  for (const CellRow& cell : cell_table(diagram.diagram))
    rows[cell.id] = {cell.seed.x,           cell.seed.y, cell.area,       cell.centroid.x,    cell.centroid.y,
                     cell.largest_distance, cell.pixels, cell.neighbours, cell.touches_border};
  return rows;
}

std::vector<std::uint32_t> measure_areas(DiagramObject& diagram) {
  std::vector<std::uint32_t> result;
  cell_sums(diagram.diagram, diagram.sums);
  for (const CellSums& sums : diagram.sums.read()) result.push_back(sums.area);
  return result;
}

/// The ids of each pair and the length of its border.
std::vector<CellPair> measure_adjacency(DiagramObject& diagram) {
  adjacency(diagram.diagram, diagram.adjacency);
  return diagram.adjacency.read_pairs();
}

std::vector<Point> measure_vertices(DiagramObject& diagram) {
  VerticesResult result;
  vertices(diagram.diagram, result);
  return result.read();
}

/// What is measured, as rows of numbers T.
template <typename T, auto measure>
nb::ndarray<nb::numpy, T, nb::ndim<2>> measured(DiagramObject& diagram) {
  decltype(measure(diagram)) rows;
  {
    const nb::gil_scoped_release unlocked;
    const Turn turn(diagram.mutex);
    rows = measure(diagram);
  }
  return to_numpy<T>(std::move(rows));
}

/// Turns positions in pixels, NaN too, into the units of the points that the diagram was filled from.
void to_data(DiagramObject& diagram, const Array<double, nb::shape<-1, 3>>& points) {
  const Turn turn(diagram.mutex);
  const Grid& grid = diagram.diagram.window().grid();
  double* xyz = points.data();
  for (std::size_t row = 0; row < points.shape(0); ++row, xyz += 3) {
    const Point point = grid.point({xyz[0], xyz[1], xyz[2]});
    xyz[0] = point.x;
    xyz[1] = point.y;
    xyz[2] = point.z;
  }
}

std::size_t count_vertices(DiagramObject& diagram) {
  const Turn turn(diagram.mutex);
  VerticesResult result;
  vertices(diagram.diagram, result);
  return result.count();
}

/// The fields of vorocl.DistanceErrors: by the points that were given, or the centres of their pixels; else
/// by what the labels were made of.
auto errors(DiagramObject& diagram, std::optional<bool> of_points) {
  const Turn turn(diagram.mutex);
  const Snap snap = !of_points ? diagram.snap : *of_points ? Snap::none : Snap::to_pixels;
  const Seeds& named = seeds_of(diagram);
  const Seeds seeds(named.device(), named.grid(), named.read(), {Outside::count, snap});
  const Metric metric = diagram.diagram.metric();
  const Device& device = diagram.diagram.device();
  Diagram exact(device, diagram.diagram.window()), judged(device, diagram.diagram.window());
  exact_diagram(seeds, exact, {metric});
  judged.write(diagram.diagram.labels(), seeds, metric);
  DistanceErrorsResult result;
  distance_errors(judged, exact, result);
  const DistanceErrors found = result.read();
  return std::tuple(found.pixels, found.wrong_pixels, found.unlabelled_pixels, found.largest_excess,
                    found.mean_excess);
}

/// The energies, what each round moved and whether it converged. Ctrl-C ends it after a round.
auto relax(DiagramObject& diagram, SeedsObject& seeds, const std::string& name, const std::string& metric,
           int rounds, const std::optional<Array<const float>>& density, bool exact) {
  const Turns turns(diagram.mutex, seeds.mutex);
  const auto go_on = [](const Seeds&, const Diagram&, const Relaxation&) {
    const nb::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    return true;
  };
  const Simulation::Engine fills = engine(method(name), options_with(metric));
  diagram.seeds.reset();
  show(diagram.diagram, seeds.seeds.grid());
  RelaxOptions options;
  options.exact = exact;
  if (density) options.density.assign(density->data(), density->data() + density->size());
  Relaxation done = vorocl::relax(seeds.seeds, diagram.diagram, fills, rounds, go_on, options);
  remember(diagram, seeds.seeds, method(name).exact ? seeds.snap : Snap::to_pixels);
  return std::tuple(done.energies, done.moved, done.converged);
}

}  // namespace

void bind_diagrams(nb::module_& module) {
  module.def("methods", [] {  // their names; whether they are exact, and go on from the last frame
    std::vector<std::tuple<std::string, bool, bool>> all;
    for (const Method& each : methods()) all.emplace_back(each.name, each.exact, each.continues);
    return all;
  });

  nb::class_<DiagramObject>(module, "Diagram")
      .def(nb::new_(&make), nb::arg("device"), nb::arg("grid"), nb::arg("labels").none(), without_gil())
      .def_prop_ro("buffer", buffer, without_gil())
      .def("fill", fill, nb::arg("seeds"), nb::arg("method"), nb::arg("metric"),
           nb::arg("max_displacement").none(), nb::arg("labels").none(), without_gil())
      .def("read", read, nb::arg("labels"), without_gil())
      .def("write", write, nb::arg("labels"), nb::arg("seeds").none(), nb::arg("metric"), without_gil())
      .def("distances", distances, nb::arg("values"), without_gil())
      .def("cells", measured<std::uint8_t, measure_cells>)
      .def("globe_cells", measured<std::uint8_t, measure_globe>)
      .def("areas", measured<std::uint32_t, measure_areas>)
      .def("to_data", to_data, nb::arg("points"), without_gil())
      .def("adjacency", measured<std::uint32_t, measure_adjacency>)
      .def("count_vertices", count_vertices, without_gil())
      .def("vertices", measured<double, measure_vertices>)
      .def("errors", errors, nb::arg("of_points").none(), without_gil())
      .def("relax", relax, nb::arg("seeds"), nb::arg("method"), nb::arg("metric"), nb::arg("rounds"),
           nb::arg("density").none(), nb::arg("exact"), without_gil());
}

}  // namespace vorocl::python
