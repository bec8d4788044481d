// Launches every kernel on small grids, for checkers that watch memory and races (tools/checks/kernels.sh).
// Fails if the sources hold a kernel that was not launched, and if labels are wrong, because a checker then
// watches other work than a device does.
#include <dlfcn.h>

#include <cmath>
#include <iostream>
#include <set>
#include <sstream>

#include "all_measures.hpp"
#include "brute_force.hpp"
#include "list_length.hpp"
#include "reference.hpp"
#include "reference_flood.hpp"
#include "runtime/kernel_sources.hpp"
#include "runtime/opencl_info.hpp"
#include "runtime/program.hpp"
#include "seed_tree.hpp"
#include "snapped_seeds.hpp"
#include "tilted_box.hpp"
#include "true_positions.hpp"
#include "volume_points.hpp"
#include "vorocl/vorocl.hpp"
#include "weights.hpp"

using namespace vorocl;

namespace {

std::set<std::string> launched;

}  // namespace

/// Stands before the OpenCL loader's function and notes the kernel's name.
extern "C" __attribute__((visibility("default"))) cl_int clEnqueueNDRangeKernel(
    cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const std::size_t* offset,
    const std::size_t* global, const std::size_t* local, cl_uint events, const cl_event* wait_for,
    cl_event* event) {
  launched.insert(info<std::string>(clGetKernelInfo, kernel, CL_KERNEL_FUNCTION_NAME));
  static const auto next =
      reinterpret_cast<decltype(&clEnqueueNDRangeKernel)>(dlsym(RTLD_NEXT, "clEnqueueNDRangeKernel"));
  return next(queue, kernel, dimensions, offset, global, local, events, wait_for, event);
}

namespace {

/// The kernels of every file, as the compiler finds them.
std::set<std::string> kernels_in_the_sources(const Device& device) {
  std::set<std::string> kernels;
  for (const auto& [file, source] : kernel_sources()) {
    const cl::Program program =
        program_for(device, file,
                    "-cl-std=CL1.2 -DVOROCL_WIDTH=1 -DVOROCL_GUARD=16 -DVOROCL_EUCLIDEAN "
                    "-DVOROCL_NEIGHBOURS=9 -DVOROCL_BITS_X=11 -DVOROCL_BITS_Y=10 -DVOROCL_BITS_Z=10");
    std::istringstream names(info<std::string>(clGetProgramInfo, program(), CL_PROGRAM_KERNEL_NAMES));
    for (std::string name; std::getline(names, name, ';');) kernels.insert(name);
  }
  return kernels;
}

void expect(const Labels& labels, const Labels& expected, const std::string& what) {
  const std::size_t wrong = count_differences(labels, expected);
  if (wrong != 0) throw Error(std::to_string(wrong) + " labels of " + what + " are wrong");
}

void make_diagrams(const Device& device, const Grid& grid, Metric metric) {
  const std::vector<Pixel> pixels = random_pixels(grid, 9, 1);
  const Labels exact = brute_force(grid, pixels, metric);
  Seeds seeds(device, grid, centres(pixels), to_centres);
  for (const Method& method : methods()) {
    for (const auto mix : {NeighbourhoodMix::moore, NeighbourhoodMix::von_neumann}) {
      const bool is_usual = metric == Metric::euclidean && mix == NeighbourhoodMix::moore;
      if (method.name == "low-resolution" && !is_usual) continue;
      Diagram diagram(device, grid);
      const Report report = method.run(seeds, diagram, {metric, mix});
      if (method.exact) {
        expect(diagram.read(), exact, method.name);
      } else if (method.plan == nullptr) {
        expect(diagram.read(), reference_low_resolution(grid, pixels), method.name);
      } else {
        const Plan plan = method.plan(grid, report.waves(), {metric, mix});
        expect(diagram.read(), reference_flood(grid, pixels, plan, metric), method.name);
      }
    }
  }
  expect(reference_labels(seeds, metric), exact, "the reference");
  Diagram diagram(device, grid);
  DynamicJumpFloodingOptions options;
  options.metric = metric;
  dynamic_jump_flooding(seeds, diagram, options);
  random_step(seeds, 2, Border::reflect, 1, 1);
  dynamic_jump_flooding(seeds, diagram, options);
  const std::vector<Pixel> moved =
      pixels_of(transformed(seeds.read(), [](const auto& point) { return *point; }));
  const Verdict verdict = judge(grid, moved, metric, diagram.read(), brute_force(grid, moved, metric));
  if (verdict.invalid + verdict.too_near + verdict.unlabelled > 0)
    throw Error("labels of moved seeds are wrong");
  seeds.move_to(std::vector<std::optional<Point>>{Point{1, 1}, std::nullopt, Point{2, 2}});
  dynamic_jump_flooding(seeds, diagram, options);
  options.reach = Reach::paper;  // which looks for pixels that seeds which vanish leave without a label
  seeds.move_to({{1, 1}});
  dynamic_jump_flooding(seeds, diagram, options);
  expect(diagram.read(), Labels(grid.pixels(), 0), "the last seed");
}

/// Seeds on every pixel at the left, some in the middle and none at the right: the exact engine takes another
/// way in each part. Its lists of two entries overflow nearly always. `rows`: those that are full at the
/// left.
void make_exact_diagrams(const Device& device, const Grid& grid, int rows, Metric metric) {
  std::vector<Pixel> pixels = every_pixel({18, rows});
  for (Pixel pixel : random_pixels({40, grid.height()}, 40, 4)) pixels.push_back({pixel.x + 35, pixel.y});
  pixels.push_back(pixels.back());
  const Seeds seeds(device, grid, centres(pixels), to_centres);
  const Labels expected = tree_labels(grid, pixels, metric);
  for (const ListLength length : both_lengths) {
    Diagram diagram(with_lists(device, length), grid);
    exact_diagram(seeds, diagram, {metric});
    expect(diagram.read(), expected, "exact diagrams");
  }
}

/// Windows with seeds in and around them, at a distance: all of a grid, a part of a period, more than
/// one, whose right and lower parts have no labels, and one that all seeds are far from.
void make_windows(const Device& device, Metric metric) {
  const Grid plain(40, 25);
  for (const Window& window :
       {Window(plain), Window(Grid(50, 38, Axes::xy), 20, 20, 40, 25),
        Window(Grid(30, 18, Axes::xy), -3, -2, 40, 25), Window(Grid(1000000, 25), 500000, 0, 40, 25)}) {
    Diagram diagram(device, window), by_short_lists(with_lists(device, ListLength::two_entries), window);
    for (const int distance : {40, 100000}) {
      std::vector<Point> points = {{3, 4}, {30, 8}};
      for (int i = 0; i < 90; ++i)
        points.push_back({i * 1.5 - 40, i % 2 == 0 ? -3.0 - i % 7 : distance + i % 9});
      const Seeds seeds(device, window.grid(), points, to_centres);
      const Labels expected = brute_force(window, pixels_of(points), metric);
      exact_diagram(seeds, by_short_lists, {metric});
      exact_diagram(seeds, diagram, {metric});
      expect(by_short_lists.read(), expected, "windows by short lists");
      expect(diagram.read(), expected, "windows");
      AllMeasures measures;
      measures.take(diagram, by_short_lists);
      const bool is_near = distance < 1000 && window.x() < 1000;
      if (is_near) measures.read();  // farther, whole numbers are too short
      device.finish();
    }
  }
}

/// By a density that grows from pixel to pixel.
void relax_by_weights(Seeds& seeds, Diagram& diagram) {
  const auto engine = [](const Seeds& moved, Diagram& filled) { return exact_diagram(moved, filled); };
  RelaxOptions options;
  for (std::size_t i = 0; i < diagram.window().pixels(); ++i)
    options.density.push_back(static_cast<float>(i));
  relax(seeds, diagram, engine, 1, {}, options);
}

/// Points within their pixels: few, several in a pixel, many on one point; also around a window, and relaxed.
void make_diagrams_of_points(const Device& device, Metric metric) {
  std::vector<Point> points = {{3.25, 4.5}, {3.5, 4.5}, {30.125, 8.75}};
  for (int i = 0; i < 70; ++i) points.push_back({20.5, 10.25});
  for (int i = 0; i < 90; ++i) points.push_back({i * 0.4375, i % 13 * 1.9});
  for (const Window& window : {Window(Grid(40, 25)), Window(Grid(40, 25, Axes::xy)),
                               Window(Grid(30, 18, Axes::xy), -3, -2, 40, 25)}) {
    Seeds seeds(device, window.grid(), points, {Outside::count, Snap::none});
    Diagram diagram(device, window), by_short_lists(with_lists(device, ListLength::two_entries), window);
    const Labels expected =
        labels_by_definition(window, positions_of(window.grid(), {points.begin(), points.end()}), metric);
    exact_diagram(seeds, by_short_lists, {metric});
    exact_diagram(seeds, diagram, {metric});
    expect(by_short_lists.read(), expected, "points by short lists");
    expect(diagram.read(), expected, "points");
    CellSumsResult sums;
    CellShapesResult shapes;
    CellStatisticsResult statistics;
    Field<float> distances;
    DistanceErrorsResult errors;
    cell_sums(diagram, sums);
    cell_shapes(diagram, shapes);
    cell_statistics(diagram, statistics);
    distance_field(diagram, distances);
    distance_errors(diagram, by_short_lists, errors);
    device.finish();
    if (metric != Metric::euclidean) continue;
    if (window.is_whole()) relax_by_weights(seeds, diagram);
    const std::vector<double> weights = weights_of(points.size(), 40);
    const Seeds weighted(device, window.grid(), Points(points).weighted(weights.data()));
    const Labels power =
        labels_by_definition(window, positions_of(window.grid(), {points.begin(), points.end()}), metric,
                             lags_by_definition(weights, [](std::size_t) { return true; }));
    for (Diagram* const each : {&diagram, &by_short_lists}) {
      exact_diagram(weighted, *each);
      expect(each->read(), power, "weighted points");
    }
  }
}

/// On a circle, whose points tie at many pixels: the order of those in a list decides.
void make_ring(const Device& device, Metric metric) {
  const Grid grid(96, 64);
  std::vector<Point> points;
  for (int i = 0; i < 300; ++i)
    points.push_back(
        {48 + 25 * std::cos(std::acos(-1.0) * i / 150), 32 + 25 * std::sin(std::acos(-1.0) * i / 150)});
  Diagram diagram(device, grid);
  exact_diagram(Seeds(device, grid, points, {Outside::count, Snap::none}), diagram, {metric});
  expect(diagram.read(),
         labels_by_definition(grid, positions_of(grid, {points.begin(), points.end()}), metric), "a ring");
}

/// Of seeds of which one is absent. Blocks are small here.
void measure_volume(const Diagram& diagram) {
  CellSumsResult sums;
  CellShapesResult shapes;
  CellStatisticsResult statistics;
  AdjacencyResult pairs;
  cell_sums(diagram, sums);
  cell_shapes(diagram, shapes);
  cell_statistics(diagram, statistics);
  adjacency(diagram, pairs);
  pairs.read_pairs();
}

/// Volumes of few seeds, and of many in a part of them, one of which is measured with vectors.
void make_volumes(const Device& device, const Grid& grid) {
  int vector_width = grid.periodic() == Axes::none ? 1 : 4;
  for (const std::size_t count : {9u, 600u}) {
    const Seeds seeds = Seeds::random(device, Grid(10, grid.height(), grid.depth()), count, 1);
    auto points = transformed(seeds.read_pixels(), [](const auto& voxel) { return *voxel; });
    const Labels expected = brute_force(grid, pixels_of(points), Metric::euclidean);
    Seeds in_a_part(device, grid, points, to_centres);
    Diagram flooded(device, grid), exact(device, grid),
        by_short_lists(with_lists(device, ListLength::two_entries), grid);
    jump_flooding(in_a_part, flooded, {Metric::euclidean, Neighbourhood::von_neumann});
    jump_flooding(in_a_part, flooded);
    exact_diagram(in_a_part, by_short_lists);
    exact_diagram(in_a_part, exact);
    expect(by_short_lists.read(), expected, "volumes by short lists");
    expect(exact.read(), expected, "volumes");
    DistanceErrorsResult errors;
    Field<std::int32_t> squares;
    Field<float> distances;
    Field<std::uint32_t> near_ones;
    distance_errors(flooded, exact, errors);
    distance_field(flooded, squares);
    distance_field(flooded, distances);
    expand_labels(flooded, 2, near_ones);
    if (!grid.is_spaced()) {
      const auto engine = [](const Seeds& moved, Diagram& filled) { return jump_flooding(moved, filled); };
      relax(in_a_part, flooded, engine, 1);
      relax_by_weights(in_a_part, flooded);
    }
    in_a_part.move_to(std::vector<Point>{{1, 2, 3}});
    if (in_a_part.displacement() == 0) throw Error("the seeds' way is wrong");
    const Device measuring = device.with_tuning({vector_width, 4, 2, Shape::vector, 32});
    points[1].x = 1000;
    const Points outside(&points[0].x, &points[0].y, &points[0].z, points.size(), sizeof(Point));
    Diagram measured(measuring, grid);
    jump_flooding(Seeds(measuring, grid, outside, {Outside::absent}), measured);
    measure_volume(measured);
    device.finish();
    vector_width = 5 - vector_width;
  }
}

/// Points within their voxels: few, dense ones, many on one point and on a line, on a sphere. A plane that is
/// spaced is labelled as other planes are, in groups as a volume of one slice; its points have no z.
void make_volumes_of_points(const Device& device) {
  int number = 0;
  for (const Grid& grid : {Grid(20, 9, 6), Grid(18, 13, 7, Axes::xyz), Grid(Axis(20).spaced(2), Axis(9)),
                           Grid(Axis(19).spaced(2), Axis(9).periodic(), Axis(5).spaced(3))}) {
    for (int kind = 0; kind < (grid.depth() > 1 ? 5 : 4); ++kind) {
      // In groups, which take longest, each kind in every second grid.
      if (device.tuning().shape == Shape::group && kind > 0 && (kind + number) % 2 == 1) continue;
      std::vector<Spot> seeds;
      // More than short lists hold, and once more than a group looks at together or a tile has.
      const std::int64_t many = grid.depth() > 1 && grid.periodic() == Axes::none ? 150 : 40;
      const std::int64_t x = grid.width() * parts, y = grid.height() * parts, z = grid.depth() * parts;
      for (std::int64_t i = 0; i < (kind == 0 ? 3 : many); ++i) {
        if (kind < 2)
          seeds.push_back({i * 7919 * 31 % x, i * 104729 % y, grid.depth() > 1 ? i * 1299709 % z : z / 2});
        if (kind == 2) seeds.push_back({x / 3, y / 2, z / 2});
        if (kind == 3) seeds.push_back({i * 524287 % x, y / 2, z / 2});
        const double u = 1 - 2 * static_cast<double>(i) / static_cast<double>(many),
                     angle = static_cast<double>(i) * 2.4;
        const auto away = [](double way) { return std::llround(2 * parts * way); };
        const double flat = std::sqrt(std::max(0.0, 1 - u * u));
        if (kind == 4)
          seeds.push_back(
              {x / 2 + away(flat * std::cos(angle)), y / 2 + away(flat * std::sin(angle)), z / 2 + away(u)});
      }
      const auto labels_by = [&](const std::vector<std::int64_t>& lags) {
        Labels labels;
        for (std::int64_t i = 0; i < static_cast<std::int64_t>(grid.pixels()); ++i) {
          labels.push_back(label_by_definition(
              grid, seeds,
              {i % grid.width(), i / grid.width() % grid.height(), i / grid.width() / grid.height()}, lags));
        }
        return labels;
      };
      const Labels expected = labels_by({});
      const Seeds points(device, grid, points_at(seeds));
      Diagram diagram(device, grid), by_short_lists(with_lists(device, ListLength::two_entries), grid);
      exact_diagram(points, by_short_lists);
      exact_diagram(points, diagram);
      expect(by_short_lists.read(), expected, "points in volumes by short lists");
      expect(diagram.read(), expected, "points in volumes");
      if (kind == 1 && !grid.is_spaced()) {
        const std::vector<double> weights = weights_of(seeds.size(), 20);
        const auto lags = lags_by_definition(weights, [](std::size_t) { return true; });
        const Labels power = labels_by(lags);
        const std::vector<Point> at = points_at(seeds);
        for (Diagram* const each : {&diagram, &by_short_lists}) {
          exact_diagram(Seeds(device, grid, Points(at).weighted(weights.data())), *each);
          expect(each->read(), power, "weighted points in volumes");
        }
      }
      if (kind != 0) continue;
      Field<float> distances;
      DistanceErrorsResult errors;
      distance_field(diagram, distances);
      distance_errors(diagram, by_short_lists, errors);
      measure_volume(diagram);
      device.finish();
    }
    ++number;
  }
}

/// Points in boxes that are tilted, with few seeds and with crowds.
void make_tilted_volumes(const Device& device) {
  for (const TiltedBox& box : {TiltedBox{{17, 9, 6}, Axes::xyz, 5 * parts + 7, -3 * parts, 4 * parts + 1},
                               TiltedBox{{12, 5, 7}, Axes::xz, 0, 4 * parts + 9, 0}}) {
    std::vector<Spot> seeds;
    for (std::int64_t i = 0; i < 60; ++i) {
      const std::int64_t x = box.sides[0] * parts, y = box.sides[1] * parts, z = box.sides[2] * parts;
      seeds.push_back(i % 3 == 0 ? Spot{x / 3, y / 2, i}
                                 : Spot{i * 7919 * 31 % x, i * 104729 % y, i * 1299709 % z});
    }
    const Seeds points(device, box.grid(), points_at(seeds));
    Diagram diagram(device, box.grid()),
        by_short_lists(with_lists(device, ListLength::two_entries), box.grid());
    const Labels expected = labels_by_definition(box, seeds);
    for (Diagram* const each : {&diagram, &by_short_lists}) {
      exact_diagram(points, *each);
      expect(each->read(), expected, "points in tilted volumes");
    }
    Field<float> distances;
    distance_field(diagram, distances);
    measure_volume(diagram);
    device.finish();
  }
}

void check_transform(const Grid& grid, double length, const std::vector<std::uint8_t>& image,
                     const std::vector<float>& distances) {
  const auto width = static_cast<std::size_t>(grid.width()), height = static_cast<std::size_t>(grid.height());
  const auto way = [](std::size_t a, std::size_t b, std::size_t period) {
    const std::size_t inside = std::max(a, b) - std::min(a, b);
    return static_cast<double>(period == 0 ? inside : std::min(inside, period - inside));
  };
  for (std::size_t i = 0; i < image.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < image.size(); ++j) {
      if (image[j] != 0) continue;
      const double x = length * way(i % width, j % width, grid.x().is_periodic() ? width : 0);
      const double y =
          1000 * way(i / width % height, j / width % height, grid.y().is_periodic() ? height : 0);
      const double z = 1000 * way(i / width / height, j / width / height, 0);
      least = std::min(least, std::sqrt(x * x + y * y + z * z));
    }
    if (std::abs(static_cast<double>(distances[i]) - least) > 1e-6 * least)
      throw Error("distances are wrong");
  }
}

/// Images of planes and volumes with squared distances of 32 and of 64 bits, whose distances are compared
/// with each pixel's to every mark.
void transform_images(const Device& device) {
  for (const Grid& grid : {Grid(20, 35), Grid(35, 12, Axes::xy), Grid(18, 9, 6)}) {
    std::vector<std::uint8_t> image(grid.pixels(), 1);
    for (std::size_t i = 0; i < image.size(); i += 1 + i % 67) image[i] = 0;
    std::vector<float> distances(image.size());
    std::vector<std::uint32_t> ranks(image.size());
    TransformTargets targets;
    targets.distances = {distances.data(), PixelType::float32};
    targets.ranks = {ranks.data(), PixelType::uint32};
    for (const double length : {1.0, 999.0}) {
      DistanceTransform transform(device, grid, {length, 1000, 1000});
      transform.run({image.data(), PixelType::uint8}, targets);
      check_transform(grid, length, image, distances);
    }
  }
}

/// Seeds of a mask, and seeds close together.
void label_by_passes(const Device& device) {
  for (const Grid& grid : {Grid(20, 35), Grid(35, 12, Axes::xy), Grid(18, 9, 6)}) {
    std::vector<std::uint8_t> image(grid.pixels(), 1);
    for (std::size_t i = 0; i < image.size(); i += 1 + i % 67) image[i] = 0;
    Diagram diagram(device, grid);
    exact_diagram(Seeds::from_mask(device, grid, image), diagram);
    const Labels labels = diagram.read();
    std::uint32_t rank = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
      if (image[i] != 0 && labels[i] != rank++) throw Error("labels of a mask are wrong");
    }
  }
  const Grid thin(4096, 1, 2);
  std::vector<Point> crowded;
  for (int i = 0; i < 100; ++i) {
    for (const double z : {0.5, 1.5}) crowded.push_back({i + 0.5, 0.5, z});
  }
  Diagram diagram(device, thin);
  exact_diagram(Seeds(device, thin, crowded, to_centres), diagram);
  const Labels labels = diagram.read();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != 2 * std::min<std::size_t>(i % 4096, 99) + i / 4096)
      throw Error("crowded labels are wrong");
  }
}

/// In buffers: good points, good ones that have moved, and a bad one.
void make_seeds(const Device& device, const Grid& grid) {
  Seeds::random(device, grid, 5, 1).read();
  const auto points_in = [&](const std::vector<cl_float2>& points) {
    return PointBuffer(cl::Buffer(device.queue(), points.begin(), points.end(), true), points.size());
  };
  Seeds seeds(device, grid, points_in({{{1, 2}}, {{2, 4}}}), kept_on_device);
  seeds.move_to(points_in({{{2, 2}}, {{2, 8}}}));
  if (seeds.displacement() != 4) throw Error("the seeds' way is wrong");
  try {
    Seeds(device, grid, points_in({{{1, 2}}, {{2, 400}}}), kept_on_device).check();
  } catch (const BadPoint&) {
    return;
  }
  throw Error("a bad point was not found");
}

void measure(const Device& device, const Grid& grid, Metric metric) {
  const std::vector<Point> points = centres(random_pixels(grid, 9, 2));
  std::vector<std::optional<Point>> one_absent(points.begin(), points.end());
  one_absent.push_back(std::nullopt);
  Seeds seeds(device, grid, one_absent, to_centres);
  Diagram diagram(device, grid), other(device, grid);
  const auto engine = [&](const Seeds& moved, Diagram& filled) {
    return jump_flooding(moved, filled, {metric});
  };
  relax(seeds, diagram, engine, 1);
  if (metric == Metric::euclidean) relax_by_weights(seeds, diagram);
  exact_diagram(seeds, other, {metric});
  jump_flooding(seeds, diagram, {metric});
  AllMeasures measures;
  measures.take(diagram, other);
  measures.read();
}

/// Three parts of the list of cells, where a work-group has two items: one item is past the last part.
void measure_many_cells(const Device& device, const Grid& grid) {
  const Device in_twos = device.with_tuning({1, 2, 1, Shape::vector, 32});
  Diagram diagram(in_twos, grid);
  jump_flooding(Seeds::random(in_twos, grid, 2100, 1), diagram);
  CellStatisticsResult statistics;
  cell_statistics(diagram, statistics);
  statistics.read();
}

/// One cell around all others, which has more pairs than its list takes.
void measure_islands(const Device& device) {
  const Grid grid(13, 9);
  std::vector<std::uint32_t> labels(grid.pixels(), 0);
  std::uint32_t islands = 0;
  for (std::size_t i = 0; i < labels.size(); i += 4) labels[i] = ++islands;
  Diagram diagram(device, grid);
  diagram.write(labels, Seeds::random(device, grid, islands + 1, 1), Metric::euclidean);
  AdjacencyResult pairs;
  adjacency(diagram, pairs);
  if (pairs.pairs() != islands) throw Error("the pairs of islands are wrong");
}

void make_tiles(const Device& device, Metric metric) {
  const Grid grid(40, 25);
  const std::vector<Point> points = {{3, 3}, {30, 20}, {17, 9}};
  const auto check = [&](const TileLabels& tile) {
    expect({tile.labels, tile.labels + tile.tile.pixels()}, brute_force(tile.tile, pixels_of(points), metric),
           "tiles");
  };
  exact_tiles(device, PlaneSeeds(grid, points, to_centres), Tiling(grid, 16), check, {metric});
  device.finish();
}

/// Of few seeds, and of one with more neighbours than the first kernel has room for.
void cut_exact_cells(const Device& device) {
  std::vector<Point> star = {{50, 50}};
  for (int i = 0; i < 30; ++i) star.push_back({50 + 40 * std::cos(0.2 * i), 50 + 40 * std::sin(0.2 * i)});
  for (const Grid& grid : {Grid(100, 100), Grid(100, 100, Axes::xy)}) {
    ExactCellsResult cells;
    exact_cells(Seeds(device, grid, star, to_centres), cells);
    const ExactCellsCheck check = cells.check();
    if (check.not_mutual > 0 || check.uncertified > 0) throw Error("exact cells are wrong");
  }
  std::vector<Point> ball = {{50, 50, 50}};
  for (int i = 0; i < 60; ++i) {
    const double z = (2 * i + 1) / 60.0 - 1, r = std::sqrt(1 - z * z);
    ball.push_back({50 + 40 * r * std::cos(2.4 * i), 50 + 40 * r * std::sin(2.4 * i), 50 + 40 * z});
  }
  for (const bool periodic : {false, true}) {
    const Axis side = periodic ? Axis(100).periodic() : Axis(100);
    ExactCellsResult cells;
    exact_cells(Seeds(device, Grid(side, side, side), ball, to_centres), cells);
    const ExactCellsCheck check = cells.check();
    if (check.not_mutual > 0 || check.uncertified > 0) throw Error("exact cells of volumes are wrong");
    if (cells.read_polyhedra().offsets.at(1) != 60) throw Error("the faces of polyhedra are wrong");
  }
}

/// More seeds than a block's list holds.
void label_globe(const Device& device) {
  const Grid grid(Axis(20, -180, 180).periodic(), Axis(17, -90, 90));
  std::vector<Point> points;
  for (int i = 0; i < 150; ++i) points.push_back({std::fmod(i * 222.5, 360), 89 - i * 1.19});
  Diagram diagram(device, grid);
  Field<float> distances;
  exact_diagram(Seeds(device, grid, points), diagram, {Metric::great_circle});
  distance_field(diagram, distances);
  const auto direction = [](const Point& point) {
    const double degree = std::acos(-1.0) / 180, north = std::cos(point.y * degree);
    return Point{north * std::cos(point.x * degree), north * std::sin(point.x * degree),
                 std::sin(point.y * degree)};
  };
  const std::vector<float> found = distances.read();
  for (std::size_t pixel = 0; pixel < found.size(); ++pixel) {
    const Point p = direction(
        grid.point({static_cast<double>(pixel % 20) + 0.5, static_cast<double>(pixel / 20) + 0.5, 0.5}));
    double most = -1;
    for (const Point& point : points) {
      const Point v = direction(point);
      most = std::max(most, p.x * v.x + p.y * v.y + p.z * v.z);
    }
    if (std::abs(6371.0088 * std::acos(most) - static_cast<double>(found[pixel])) > 0.01)
      throw Error("the globe is wrong");
  }
}

}  // namespace

int main() {
  const Device device = Device::select();
  // With and without vectors. A metric is arithmetic, not another way through memory: each kernel takes one,
  // and the exact engine each in both shapes and on both kinds of axes.
  for (const Shape shape : {Shape::group, Shape::vector}) {
    const bool in_groups = shape == Shape::group;
    const Device shaped = device.with_tuning({in_groups ? 1 : 4, 4, 2, shape, 32});
    const Metric metric = in_groups ? Metric::manhattan : Metric::euclidean,
                 other = in_groups ? Metric::euclidean : Metric::manhattan;
    for (const Grid& grid : {Grid(13, 9), Grid(3, 11)}) {
      make_diagrams(shaped, grid, metric);
      make_seeds(shaped, grid);
    }
    // Few seeds, and many: of so many as 66 rows have without groups, passes label the plane.
    const Grid plane = in_groups ? Grid(80, 36) : Grid(176, 90),
               torus = in_groups ? Grid(76, 40, Axes::xy) : Grid(140, 66, Axes::xy);
    for (const int rows : {9, in_groups ? 33 : 66}) {
      make_exact_diagrams(shaped, plane, rows, metric);
      make_exact_diagrams(shaped, torus, rows, other);
    }
    if (!in_groups) make_exact_diagrams(shaped, Grid(520, 260), 1, metric);  // a region has one list
    make_windows(shaped, metric);
    make_diagrams_of_points(shaped, metric);
    if (!in_groups) make_ring(shaped, metric);
    make_tiles(shaped, metric);
    transform_images(shaped);
    label_by_passes(shaped);
    for (const Grid& grid : {Grid(40, 19), Grid(3, 11), Grid(70, 9, Axes::xy)}) measure(shaped, grid, metric);
  }
  measure_many_cells(device, Grid(13, 9));
  measure_islands(device);
  const Device for_volumes = device.with_tuning({4, 4, 2, Shape::vector, 32});
  for (const Shape shape : {Shape::group, Shape::vector}) {
    make_volumes_of_points(device.with_tuning({4, 4, 2, shape, 32}));
    make_tilted_volumes(device.with_tuning({4, 4, 2, shape, 32}));
  }
  make_volumes(for_volumes, Grid(20, 12, 9));
  make_volumes(for_volumes, Grid(Axis(18).periodic(), Axis(11).periodic().spaced(2), Axis(5).periodic()));
  cut_exact_cells(device);
  label_globe(for_volumes);
  const std::set<std::string> kernels = kernels_in_the_sources(device);
  std::size_t missing = 0;
  for (const std::string& name : kernels) {
    if (launched.count(name) != 0) continue;
    std::cerr << "the kernel " << name << " was not launched\n";
    ++missing;
  }
  std::cout << kernels.size() - missing << " of " << kernels.size() << " kernels were launched\n";
  return missing == 0 && !kernels.empty() ? 0 : 1;
}
