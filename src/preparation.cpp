#include "vorocl/preparation.hpp"

#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "runtime/binary_cache.hpp"
#include "runtime/has_doubles.hpp"
#include "runtime/program.hpp"
#include "vorocl/analysis.hpp"
#include "vorocl/distance_transform.hpp"
#include "vorocl/error.hpp"
#include "vorocl/exact_diagram.hpp"
#include "vorocl/method.hpp"
#include "vorocl/motion.hpp"
#include "vorocl/relaxation.hpp"
#include "vorocl/similarity.hpp"

namespace vorocl {

namespace {

/// What kernels are compiled for besides the device.
struct Specialisation {
  Metric metric;
  Axes periodic;
};

/// What is prepared, the likeliest first. Each is a part of its own: it has programs that no other one has.
constexpr Specialisation specialisations[] = {
    {Metric::euclidean, Axes::none}, {Metric::euclidean, Axes::xy}, {Metric::manhattan, Axes::none},
    {Metric::euclidean, Axes::x},    {Metric::manhattan, Axes::xy}, {Metric::manhattan, Axes::x},
};

/// Grids and their seeds. PoCL compiles kernels anew for 2^16 work-items and more. A kernel may have one for
/// each seed, or for some pixels.
struct Scale {
  int width, height;
  std::size_t seeds;
};
constexpr Scale scales[] = {{300, 270, 1000}, {2048, 2048, 70000}};

/// Points in [0, width) x [0, height) x [0, depth], spread by the golden ratio and square roots.
std::vector<Point> spread_points(std::size_t count, double width, double height, double depth = 0) {
  std::vector<Point> points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = static_cast<double>(i);
    points.push_back({std::fmod(number * 0.6180339887, 1) * width,
                      std::fmod(number * 0.4142135624, 1) * height,
                      std::fmod(number * 0.7320508076, 1) * depth});
  }
  return points;
}

/// All measures of a diagram, and of how it stands to another one. Those of points have no whole distances.
void measure(const Diagram& diagram, const Diagram& other, Snap snap) {
  const bool is_plane = diagram.window().depth() == 1;
  CellSumsResult sums;
  CellShapesResult shapes;
  CellStatisticsResult statistics;
  AdjacencyResult pairs;
  VerticesResult vertices_found;
  Field<std::int32_t> squares;
  Field<float> distances;
  Field<std::uint8_t> borders;
  Field<std::uint32_t> mapped, expanded;
  SimilarityResult labels, within;
  DistanceErrorsResult wrong;
  cell_sums(diagram, sums);
  cell_shapes(diagram, shapes);
  cell_statistics(diagram, statistics);
  adjacency(diagram, pairs);
  pairs.read_pairs();  // results launch kernels of their own where they are read
  if (is_plane) vertices(diagram, vertices_found);
  if (snap == Snap::to_pixels) distance_field(diagram, squares);
  distance_field(diagram, distances);
  border_mask(diagram, borders);
  map_labels(diagram, std::vector<std::uint32_t>(shapes.size()), mapped);
  expand_labels(diagram, 5, expanded);
  similarity(diagram, other, labels);
  similarity(diagram, other, 0.5, within);
  distance_errors(other, diagram, wrong);
  diagram.wait();
  if (is_plane) vertices_found.read();
}

/// Those of few seeds around one, which has more edges than a kernel has private room for, those of many, and
/// those of volumes.
void prepare_exact_cells(const Device& device) {
  if (!has_doubles(device)) return;
  std::vector<Point> star = {{0, 0}};
  for (int i = 0; i < 200; ++i) star.push_back({std::cos(i), std::sin(i)});
  const Axis axis(2, -2, 2);
  for (const std::vector<Point>& points : {star, spread_points(scales[1].seeds, 1, 1, 1)}) {
    for (const Grid& grid : {Grid(axis, axis), Grid(axis, axis, axis)}) {
      ExactCellsResult cells;
      exact_cells(Seeds(device, grid, points), cells);
      if (grid.is_volume()) {
        cells.read_polyhedra();
      } else {
        cells.edges();
      }
    }
  }
  device.finish();
}

/// Volumes with few rows and with many, with periods along all axes or none.
void prepare_volumes(const Device& device, bool are_periodic) {
  const Axes periodic = are_periodic ? Axes::xyz : Axes::none;
  for (const Grid& grid : {Grid(40, 40, 40, periodic), Grid(16, 300, 300, periodic)}) {
    Diagram diagram(device, grid), other(device, grid);
    const std::vector<Point> points = spread_points(1000, 16, 40, 40);
    for (const Snap snap : {Snap::to_pixels, Snap::none}) {
      const Seeds seeds(device, grid, points, {Outside::count, snap});
      for (const Method& each : methods()) {
        if (each.volumes) each.run(seeds, other, {});
      }
      exact_diagram(seeds, diagram);
      method("jfa").run(seeds, other, {});
      measure(diagram, other, snap);
    }
  }
}

/// Tilted boxes, and weighted seeds in straight and tilted ones. A grid without periods has no tilt.
void prepare_weights_and_tilts(const Device& device, bool are_periodic) {
  const Grid plane(300, 270, are_periodic ? Axes::xy : Axes::none);
  const Grid volume(40, 40, 40, are_periodic ? Axes::xyz : Axes::none);
  std::vector<Grid> grids = {plane, volume};
  if (are_periodic) grids.insert(grids.end(), {plane.tilted(5), volume.tilted(5, 4)});
  std::vector<double> weights(1000);
  weights.front() = 1;
  for (const Grid& grid : grids) {
    const std::vector<Point> points = spread_points(weights.size(), 40, 40, grid.is_volume() ? 40 : 0);
    Diagram diagram(device, grid), other(device, grid);
    exact_diagram(Seeds(device, grid, Points(points).weighted(weights.data())), other);
    const Seeds seeds(device, grid, points);
    for (Diagram* const each : {&diagram, &other}) exact_diagram(seeds, *each);
    measure(diagram, other, Snap::none);
  }
}

/// Images of planes and volumes, with squared distances of 32 and of 64 bits; those of masks as seeds by both
/// metrics; seeds close together.
void prepare_images(const Device& device) {
  for (const Grid& grid : {Grid(300, 270), Grid(40, 40, 40)}) {
    std::vector<std::uint8_t> image(grid.pixels(), 1);
    image.front() = 0;
    std::vector<float> distances(grid.pixels());
    TransformTargets targets;
    targets.distances = {distances.data(), PixelType::float32};
    for (const double length : {1.0, 999.0}) {
      DistanceTransform transform(device, grid, {length, 1000, 1000});
      transform.run({image.data(), PixelType::uint8}, targets);
    }
    for (const Metric metric : {Metric::euclidean, Metric::manhattan}) {
      if (grid.is_volume() && metric == Metric::manhattan) continue;
      Diagram diagram(device, grid);
      exact_diagram(Seeds::from_mask(device, grid, image), diagram, {metric});
      diagram.wait();
    }
  }
  const Grid thin(4096, 1, 2);
  std::vector<Point> crowded;
  for (int i = 0; i < 100; ++i) {
    for (const double z : {0.5, 1.5}) crowded.push_back({i + 0.5, 0.5, z});
  }
  Diagram diagram(device, thin);
  exact_diagram(Seeds(device, thin, crowded, {Outside::count, Snap::to_pixels}), diagram);
  diagram.wait();
}

void prepare_at(const Scale& scale, const Device& device, const Specialisation& what) {
  const Grid grid(scale.width, scale.height, what.periodic);
  const MethodOptions options = {what.metric};
  for (const Method& each : methods()) {
    if (each.name == "low-resolution" && what.metric == Metric::manhattan) continue;
    prepare(each, device, grid, scale.seeds, options, Snap::to_pixels);
  }
  Seeds random = Seeds::random(device, grid, scale.seeds, 1);
  random_step(random, 1, Border::reflect, 1, 1);
  Diagram diagram(device, grid), other(device, grid);
  const Method& exact = method("exact");
  RelaxOptions by_weight;
  by_weight.density.assign(grid.pixels(), 1.0F);
  const std::vector<Point> points = spread_points(scale.seeds, scale.width, scale.height);
  for (const Snap snap : {Snap::to_pixels, Snap::none}) {
    Seeds seeds(device, grid, points, {Outside::count, snap});
    relax(seeds, diagram, engine(exact, options), 1);
    relax(seeds, diagram, engine(exact, options), 1, {}, by_weight);
    exact.run(seeds, other, options);
    measure(diagram, other, snap);
  }
}

/// A window with seeds around it.
void prepare_windows(const Device& device, const Specialisation& what) {
  constexpr int side = 4096;
  const Window window(Grid(side, side, what.periodic), 0, 0, 2048, 2048);
  Diagram diagram(device, window), other(device, window);
  const Seeds seeds(device, window.grid(), spread_points(10000, side, side),
                    {Outside::count, Snap::to_pixels});
  method("exact").run(seeds, diagram, {what.metric});
  method("exact").run(seeds, other, {what.metric});
  measure(diagram, other, Snap::to_pixels);
}

/// Great circles.
void prepare_globe(const Device& device) {
  if (!has_doubles(device)) return;
  const Grid map(Axis(400, -180, 180).periodic(), Axis(200, -90, 90));
  for (const double side : {180.0, 200.0}) {  // all in the map, and not
    Diagram diagram(device, side > 180 ? Window(map, 0, 0, 300, 200) : Window(map));
    Field<float> distances;
    exact_diagram(Seeds(device, map, spread_points(1000, side, 90)), diagram, {Metric::great_circle});
    distance_field(diagram, distances);
    cell_table(diagram);
  }
}

}  // namespace

std::size_t most_preparation_parts() { return std::size(specialisations); }

std::size_t prepare_programs(const Device& device, const PreparationPart& part) {
  if (part.index >= part.count) {
    throw Error("part " + std::to_string(part.index) + " of a preparation in " + std::to_string(part.count) +
                " parts is not possible; the first one is 0");
  }
  if (keeps_binaries(device)) open_binary_folder();  // before work of minutes
  for (std::size_t i = part.index; i < std::size(specialisations); i += part.count) {
    for (const Scale& scale : scales) prepare_at(scale, device, specialisations[i]);
    prepare_windows(device, specialisations[i]);
    // So that two processes have as much to do.
    if (i < 2) {
      const bool are_periodic = i == 1;
      prepare_volumes(device, are_periodic);
      prepare_weights_and_tilts(device, are_periodic);
    }
    if (i == 0) {
      prepare_images(device);
      prepare_exact_cells(device);
      prepare_globe(device);
    }
  }
  return keep_programs(device);
}

std::string binaries_folder() { return binary_folder(); }

}  // namespace vorocl
