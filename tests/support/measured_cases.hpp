// The diagrams whose measurements are tested, and straight host code to hold them against.
#pragma once

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "samples.hpp"
#include "vorocl/adjacency.hpp"

namespace vorocl {

/// Seeds in a few dense heaps, which leave most of the grid to cells on their rims.
inline std::vector<Pixel> clusters(const Grid& grid, std::size_t count) {
  std::mt19937 rng(3);
  const std::vector<Pixel> middles = random_pixels(grid, 5, 4);
  std::vector<Pixel> pixels;
  while (pixels.size() < count) {
    const Pixel& middle = middles[rng() % middles.size()];
    std::int64_t x = middle.x, y = middle.y;
    for (int i = 0; i < 4; ++i) x += static_cast<int>(rng() % 13) - 6, y += static_cast<int>(rng() % 13) - 6;
    if (x >= 0 && x < grid.width() && y >= 0 && y < grid.height()) pixels.push_back({x, y});
  }
  return pixels;
}

/// The device in the shapes that measurements differ for: large blocks with whole and cut vectors, small
/// blocks.
inline std::vector<Device> shapes() {
  const Device& device = test_device();
  const Shape shape = device.tuning().shape;
  return {device.with_tuning({16, 64, 1, shape}), device.with_tuning({4, 8, 1, shape}),
          device.with_tuning({1, 32, 8, shape})};
}

/// Whether a shape is for a grid. Kernels are built anew for grids that are narrower than their vectors: the
/// second shape alone takes these.
inline bool is_for(const Device& shape, const Grid& grid) {
  return shape.tuning().vector_width == 4 || grid.width() >= shape.tuning().vector_width;
}

/// Floods a diagram without vectors, whatever its device has: one engine's kernels serve all shapes and
/// widths.
inline Report fill(const Seeds& seeds, Diagram& diagram, Metric metric = Metric::euclidean) {
  Diagram flooded(test_device().with_tuning({1, 64, 1}), diagram.window());
  Report report = jump_flooding(seeds, flooded, {metric});
  diagram.write(flooded.labels(), seeds, metric);
  return report;
}

/// Labels at random, some of which name no seed: cells in many pieces.
inline std::vector<std::uint32_t> random_labels(const Grid& grid, std::uint32_t cells, unsigned rng_seed) {
  std::mt19937 rng(rng_seed);
  std::vector<std::uint32_t> labels(grid.pixels());
  for (std::uint32_t& label : labels) {
    const std::uint32_t drawn = static_cast<std::uint32_t>(rng()) % (cells + cells / 8 + 1);
    label = drawn < cells ? drawn : no_label;
  }
  return labels;
}

inline Seeds seeds_of(const Device& device, const Case& test) {
  std::vector<std::optional<Point>> points;
  for (const Point& point : centres(test.seeds)) points.emplace_back(point);
  for (std::size_t id = 0; id < test.absent.size(); ++id) {
    if (test.absent[id]) points[id].reset();
  }
  return {device, test.grid, points, to_centres};
}

inline std::vector<Case> cases_for(const Device& shape, std::vector<Case> cases) {
  const auto others =
      std::remove_if(cases.begin(), cases.end(), [&](const Case& c) { return !is_for(shape, c.grid); });
  cases.erase(others, cases.end());
  return cases;
}

/// Cells of planes.
inline std::vector<Case> plane_cases(const Device& shape) {
  std::vector<Case> cases = edge_cases();
  const Grid wide(700, 300), tall(130, 1000);
  cases.push_back({"few seeds", wide, random_pixels(wide, 7, 5)});
  cases.push_back({"random seeds", wide, random_pixels(wide, 1000, 6)});
  cases.push_back({"dense seeds", wide, random_pixels(wide, 30000, 7)});
  const Grid torus(700, 300, Axes::xy), cylinder(700, 300, Axes::x);
  for (const Case& small : cases_on({{1, 17, Axes::xy}, {67, 29, Axes::xy}})) cases.push_back(small);
  cases.push_back({"one seed on a torus", torus, random_pixels(torus, 1, 5)});
  cases.push_back({"few seeds on a torus", torus, random_pixels(torus, 7, 5)});
  cases.push_back({"random seeds on a torus", torus, random_pixels(torus, 1000, 6)});
  cases.push_back({"clusters on a cylinder", cylinder, clusters(cylinder, 2000)});
  cases.push_back({"tall", tall, random_pixels(tall, 500, 8)});
  cases.push_back({"clusters", wide, clusters(wide, 2000)});
  cases.push_back({"cities", Grid(1440, 720), cities(Grid(1440, 720))});
  return cases_for(shape, cases);
}

/// One cell, lumps of pixels with a common label, and single ones: along periodic axes cells go round, and
/// have pixels half a period away. Some seeds are absent.
inline void add_cases_in_pieces(std::vector<Case>& cases, const Grid& grid) {
  std::vector<bool> absent(20);
  for (std::size_t id = 3; id < absent.size(); id += 7) absent[id] = true;
  const std::vector<Pixel> seeds = random_pixels(grid, absent.size(), 1);
  const Labels pieces = random_labels(grid, 20, 2);
  Labels lumps;
  for (std::size_t i = 0; i < grid.pixels(); ++i) {
    const Pixel at = pixel_at(grid, i);
    lumps.push_back(
        pieces[static_cast<std::size_t>(at.x / 11 + at.y / 5 * 7 + at.z / 4 * 31) % pieces.size()]);
  }
  cases.push_back({"one cell", grid, random_pixels(grid, 20, 3), Labels(grid.pixels(), 0)});
  cases.push_back({"lumps", grid, seeds, lumps, absent});
  cases.push_back({"pieces", grid, seeds, pieces, absent});
}

/// All cases that are measured in a shape: planes, labels at random, volumes.
inline std::vector<Case> measured_cases(const Device& shape) {
  std::vector<Case> cases = plane_cases(shape);
  const Grid wide(700, 300), spaced(Axis(70).spaced(2), Axis(40), Axis(1).spaced(4));
  for (const std::size_t count : {300u, 301u}) {  // by either metric
    cases.push_back({"pieces", wide, random_pixels(wide, count, 1), random_labels(wide, 300, 2)});
    cases.push_back({"no labels", wide, random_pixels(wide, count, 1), Labels(wide.pixels(), no_label)});
  }
  const auto add = [&](const std::string& name, const Grid& grid, std::size_t count) {
    cases.push_back({name, grid, random_pixels(grid, count, 5)});
  };
  add("no seed", Grid(9, 8, 7), 0);
  add("one seed", Grid(17, 5, 3), 1);
  add("few", Grid(70, 40, 37), 9);
  add("some", Grid(70, 40, 37), 300);
  add("dense", Grid(65, 34, 35), 9000);
  add("flat", Grid(150, 70, 2), 40);
  add("a column of rows", Grid(1, 40, 90), 30);
  add("narrow", Grid(3, 1, 700), 200);
  add("several blocks along each axis", Grid(140, 72, 40), 60);
  add_cases_in_pieces(cases, Grid(70, 33, 36));
  if (shape.tuning().vector_width > 1) return cases_for(shape, cases);
  // Odd sides and even ones, periods of one voxel and of two, and voxels that are longer along one axis than
  // along another. They have programs of their own, and building these takes most of the time: one shape is
  // enough.
  for (const Grid& grid : {Grid(71, 40, 34, Axes::xyz), Grid(66, 35, 33, Axes::xyz),
                           Grid(70, 19, 10, Axes::z), Grid(37, 9, 12, Axes::xy), Grid(2, 1, 90, Axes::xyz)}) {
    add_cases_in_pieces(cases, grid);
    add("periodic", grid, 41);
  }
  add("spaced and periodic", Grid(Axis(18).spaced(2), Axis(15).periodic(), Axis(7).spaced(3).periodic()), 30);
  for (const Grid& grid : {spaced, Grid(Axis(70).spaced(2), Axis(40), Axis(37).spaced(4))}) {
    for (const std::size_t count : {9u, 300u})
      cases.push_back({"spaced", grid, random_pixels(grid, count, 5)});
    cases.push_back({"spaced pieces", grid, random_pixels(grid, 60, 1), random_labels(grid, 60, 2)});
  }
  return cases_for(shape, cases);
}

/// A diagram of a case: its own labels, else those of flooding. Returns the labels that measures count: those
/// that name an absent seed are none.
inline Labels fill(const Case& test, const Seeds& seeds, Diagram& diagram, Metric metric) {
  if (test.labels.empty()) {
    fill(seeds, diagram, metric);
  } else {
    diagram.write(test.labels, seeds, metric);
  }
  return transformed(diagram.read(), [&](std::uint32_t label) {
    return label < test.absent.size() && test.absent[label] ? no_label : label;
  });
}

/// Calls visit(label, pixel) for each pixel that has a label.
template <typename Visit>
void each_pixel(const Grid& grid, const std::vector<std::uint32_t>& labels, Visit visit) {
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != no_label) visit(labels[i], pixel_at(grid, i));
  }
}

inline std::uint32_t label_at(const Grid& grid, const std::vector<std::uint32_t>& labels,
                              const Pixel& pixel) {
  return labels[index_of(grid, pixel)];
}

/// The pixels whose faces one shares.
inline std::vector<Pixel> beside(const Grid& grid, const Pixel& pixel) {
  const auto [x, y, z] = pixel;
  std::vector<Pixel> found;
  for (const Pixel& at : {Pixel{x + 1, y, z}, Pixel{x - 1, y, z}, Pixel{x, y + 1, z}, Pixel{x, y - 1, z},
                          Pixel{x, y, z + 1}, Pixel{x, y, z - 1}}) {
    if (const auto inside = in_grid(grid, at)) found.push_back(*inside);
  }
  return found;
}

/// Whether a pixel is at an end of an axis that has ends.
inline bool is_at_the_border(const Grid& grid, const Pixel& pixel) {
  const auto is_end = [](std::int64_t at, const Axis& axis) {
    return !axis.is_periodic() && (at == 0 || at == axis.pixels() - 1);
  };
  return is_end(pixel.x, grid.x()) || is_end(pixel.y, grid.y()) ||
         (grid.is_volume() && is_end(pixel.z, grid.z()));
}

/// A cell, counted pixel by pixel, each where it is nearest to the seed.
struct CellOnHost {
  std::uint32_t area = 0;
  Pixel sum = {0, 0}, least = {INT32_MAX, INT32_MAX, INT32_MAX}, greatest = {INT32_MIN, INT32_MIN, INT32_MIN};
  std::int64_t farthest = -1;  // squared by the Euclidean metric
  bool touches_border = false;
  std::uint32_t neighbours = 0, perimeter = 0;
};

struct CellsOnHost {
  std::vector<CellOnHost> cells;
  std::vector<CellPair> pairs;  // in order
};

/// Labels of no seed are none's.
inline CellsOnHost cells_on_host(const Grid& grid, const std::vector<Pixel>& seeds,
                                 const std::vector<std::uint32_t>& labels, Metric metric) {
  CellsOnHost found;
  found.cells.resize(seeds.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> faces;
  const DistanceIn distance(grid, metric);
  each_pixel(grid, labels, [&](std::uint32_t label, const Pixel& pixel) {
    if (label >= seeds.size()) return;
    CellOnHost& cell = found.cells[label];
    const Pixel image = nearest_image(grid, pixel, seeds[label]);
    ++cell.area;
    for (const auto along : {&Pixel::x, &Pixel::y, &Pixel::z}) {
      cell.sum.*along += image.*along;
      cell.least.*along = std::min(cell.least.*along, image.*along);
      cell.greatest.*along = std::max(cell.greatest.*along, image.*along);
    }
    cell.farthest = std::max(cell.farthest, distance(pixel, seeds[label]));
    cell.touches_border |= is_at_the_border(grid, pixel);
    for (const Pixel& next : beside(grid, pixel)) {
      const std::uint32_t other = label_at(grid, labels, next);
      if (other >= seeds.size() || other == label) continue;
      ++cell.perimeter;
      ++faces[{label, other}];
    }
  });
  for (const auto& [pair, length] : faces) {
    ++found.cells[pair.first].neighbours;
    if (pair.first < pair.second) found.pairs.push_back({pair.first, pair.second, length});
  }
  return found;
}

}  // namespace vorocl
