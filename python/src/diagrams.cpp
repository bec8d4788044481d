// Diagrams: methods that fill them, and what is measured of them.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <limits>
#include <string>

#include "module.hpp"

namespace vorocl::python {

namespace {

using Turn = std::lock_guard<std::mutex>;
using Turns = std::scoped_lock<std::mutex, std::mutex>;

Metric metric_of(const std::string& name) {
  if (name == "euclidean") return Metric::euclidean;
  if (name == "manhattan") return Metric::manhattan;
  throw Error("there is no metric \"" + name + "\"; there are euclidean, manhattan");
}

MethodOptions options_with(const std::string& metric) {
  MethodOptions options;
  options.metric = metric_of(metric);
  return options;
}

// --- making and filling ---

std::unique_ptr<DiagramObject> make(const Device& device, const Grid& grid) {
  return std::make_unique<DiagramObject>(Diagram(device, grid));
}

/// Over the buffer of a caller who uses OpenCL too.
std::unique_ptr<DiagramObject> over_buffer(const Device& device, const Grid& grid, std::uintptr_t labels) {
  return std::make_unique<DiagramObject>(Diagram(device, grid, retained<cl::Buffer>(labels)));
}

std::uintptr_t buffer(DiagramObject& diagram) {
  const Turn turn(diagram.mutex);
  return reinterpret_cast<std::uintptr_t>(diagram.diagram.labels()());
}

/// Without a displacement, seeds may have moved anywhere.
Report fill(DiagramObject& diagram, SeedsObject& seeds, const std::string& name, const std::string& metric,
            std::optional<double> max_displacement) {
  const Turns turns(diagram.mutex, seeds.mutex);
  const double farthest = diagram.diagram.grid().longest_side();
  return method(name).run(seeds.seeds, diagram.diagram, max_displacement.value_or(farthest),
                          options_with(metric));
}

template <typename T>
T* pixels_of(const Diagram& diagram, const Array<T, nb::ndim<2>>& image) {
  const Grid& grid = diagram.grid();
  if (image.shape(0) != static_cast<std::size_t>(grid.height()) ||
      image.shape(1) != static_cast<std::size_t>(grid.width())) {
    throw Error("the image has " + std::to_string(image.shape(0)) + " x " + std::to_string(image.shape(1)) +
                " rows x columns, the diagram " + std::to_string(grid.height()) + " x " +
                std::to_string(grid.width()));
  }
  return image.data();
}

void read(DiagramObject& diagram, const Array<std::uint32_t, nb::ndim<2>>& labels) {
  const Turn turn(diagram.mutex);
  diagram.diagram.read(pixels_of(diagram.diagram, labels));
}

void write(DiagramObject& diagram, const Array<const std::uint32_t, nb::ndim<2>>& labels) {
  const Turn turn(diagram.mutex);
  const std::uint32_t* const first = pixels_of(diagram.diagram, labels);
  diagram.diagram.write({first, first + labels.size()});
}

// --- measures ---

void distances(DiagramObject& diagram, SeedsObject& seeds, const std::string& metric,
               const Array<float, nb::ndim<2>>& values) {
  const Turns turns(diagram.mutex, seeds.mutex);
  float* const first = pixels_of(diagram.diagram, values);
  distance_field(seeds.seeds, diagram.diagram, diagram.distances, metric_of(metric));
  diagram.distances.read(first);
}

void squared_distances(DiagramObject& diagram, SeedsObject& seeds,
                       const Array<std::int32_t, nb::ndim<2>>& values) {
  const Turns turns(diagram.mutex, seeds.mutex);
  std::int32_t* const first = pixels_of(diagram.diagram, values);
  Field<std::int32_t> field;
  distance_field(seeds.seeds, diagram.diagram, field);
  field.read(first);
}

/// One cell, as CELL in vorocl/_objects.py says it: in pixels.
struct CellRow {
  double x, y, centroid_x, centroid_y, largest_distance;
  std::uint32_t area, perimeter, neighbours;
  std::int32_t left, top, right, bottom;
  bool touches_border;
};

CellRow row_of(const std::optional<Point>& seed, const CellSums& sums, const CellShape& shape,
               std::uint32_t perimeter, std::uint32_t neighbours, Metric metric) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Point place = seed.value_or(Point{none, none}), centroid = sums.centroid();
  if (sums.area == 0) {
    return {place.x, place.y, centroid.x, centroid.y, none, 0, perimeter, neighbours, 0, 0, -1, -1, false};
  }
  const auto distance = static_cast<double>(shape.largest_distance);
  const double farthest = metric == Metric::euclidean ? std::sqrt(distance) : distance;
  return {place.x,    place.y,    centroid.x, centroid.y,  farthest,     sums.area,           perimeter,
          neighbours, shape.left, shape.top,  shape.right, shape.bottom, shape.touches_border};
}

nb::ndarray<nb::numpy, std::uint8_t, nb::ndim<2>> cells(DiagramObject& diagram, SeedsObject& seeds,
                                                        const std::string& metric_name) {
  const Metric metric = metric_of(metric_name);
  std::vector<CellRow> rows;
  {
    const nb::gil_scoped_release unlocked;
    const Turns turns(diagram.mutex, seeds.mutex);
    cell_sums(seeds.seeds, diagram.diagram, diagram.sums);
    cell_shapes(seeds.seeds, diagram.diagram, diagram.shapes, metric);
    adjacency(seeds.seeds, diagram.diagram, diagram.adjacency);
    const auto places = seeds.seeds.read();
    const auto sums = diagram.sums.read();
    const auto shapes = diagram.shapes.read();
    const auto perimeters = diagram.adjacency.read_perimeters(),
               neighbours = diagram.adjacency.read_neighbours();
    rows.reserve(places.size());
    for (std::size_t id = 0; id < places.size(); ++id) {
      rows.push_back(row_of(places[id], sums[id], shapes[id], perimeters[id], neighbours[id], metric));
    }
  }
  return to_numpy<std::uint8_t>(std::move(rows));
}

/// The ids of each pair and the length of its border.
nb::ndarray<nb::numpy, std::uint32_t, nb::ndim<2>> find_adjacency(DiagramObject& diagram,
                                                                  SeedsObject& seeds) {
  std::vector<CellPair> pairs;
  {
    const nb::gil_scoped_release unlocked;
    const Turns turns(diagram.mutex, seeds.mutex);
    adjacency(seeds.seeds, diagram.diagram, diagram.adjacency);
    pairs = diagram.adjacency.read_pairs();
  }
  return to_numpy<std::uint32_t>(std::move(pairs));
}

std::size_t vertices(DiagramObject& diagram) {
  const Turn turn(diagram.mutex);
  return count_vertices(diagram.diagram);
}

DistanceErrors errors(DiagramObject& diagram, SeedsObject& seeds, const std::string& metric) {
  const Turns turns(diagram.mutex, seeds.mutex);
  Diagram exact(diagram.diagram.device(), diagram.diagram.grid());
  exact_diagram(seeds.seeds, exact, {metric_of(metric)});
  return distance_errors(seeds.seeds, diagram.diagram, exact, metric_of(metric));
}

/// Ctrl-C ends it after a round.
Relaxation relax(DiagramObject& diagram, SeedsObject& seeds, const std::string& name,
                 const std::string& metric, int rounds) {
  const Turns turns(diagram.mutex, seeds.mutex);
  const auto go_on = [](const Seeds&, const Diagram&, const Relaxation&) {
    const nb::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    return true;
  };
  const Simulation::Engine fills = engine(method(name), options_with(metric));
  return vorocl::relax(seeds.seeds, diagram.diagram, fills, rounds, go_on);
}

}  // namespace

void bind_diagrams(nb::module_& module) {
  nb::class_<Method>(module, "Method")
      .def_ro("name", &Method::name)
      .def_ro("exact", &Method::exact)
      .def_ro("continues", &Method::continues);
  module.def("methods", &methods);

  nb::class_<DistanceErrors>(module, "DistanceErrors")
      .def_ro("pixels", &DistanceErrors::pixels)
      .def_ro("wrong_pixels", &DistanceErrors::wrong_pixels)
      .def_ro("unlabelled_pixels", &DistanceErrors::unlabelled_pixels)
      .def_ro("largest_excess", &DistanceErrors::largest_excess)
      .def_ro("mean_excess", &DistanceErrors::mean_excess)
      .def_prop_ro("wrong_percent", &DistanceErrors::wrong_percent)
      .def("__repr__", [](const nb::handle& self) {
        return shown(self, {"pixels", "wrong_pixels", "unlabelled_pixels", "largest_excess", "mean_excess"});
      });

  nb::class_<Relaxation>(module, "Relaxation")
      .def_ro("energies", &Relaxation::energies)
      .def_ro("moved", &Relaxation::moved)
      .def_ro("converged", &Relaxation::converged);

  nb::class_<DiagramObject>(module, "Diagram")
      .def(nb::new_(&make), nb::arg("device"), nb::arg("grid"))
      .def_static("over_buffer", over_buffer, nb::arg("device"), nb::arg("grid"), nb::arg("labels"),
                  without_gil())
      .def_prop_ro("buffer", buffer, without_gil())
      .def("fill", fill, nb::arg("seeds"), nb::arg("method"), nb::arg("metric"),
           nb::arg("max_displacement").none(), without_gil())
      .def("read", read, nb::arg("labels"), without_gil())
      .def("write", write, nb::arg("labels"), without_gil())
      .def("distances", distances, nb::arg("seeds"), nb::arg("metric"), nb::arg("values"), without_gil())
      .def("squared_distances", squared_distances, nb::arg("seeds"), nb::arg("values"), without_gil())
      .def("cells", cells, nb::arg("seeds"), nb::arg("metric"))
      .def("adjacency", find_adjacency, nb::arg("seeds"))
      .def("count_vertices", vertices, without_gil())
      .def("errors", errors, nb::arg("seeds"), nb::arg("metric"), without_gil())
      .def("relax", relax, nb::arg("seeds"), nb::arg("method"), nb::arg("metric"), nb::arg("rounds"),
           without_gil());
}

}  // namespace vorocl::python
