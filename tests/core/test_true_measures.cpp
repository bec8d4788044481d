// Measures of exact diagrams of points within their pixels, against straight host code on the labels; and
// relaxation.
#define BOOST_TEST_MODULE true_measures
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "vorocl/cells.hpp"
#include "vorocl/relaxation.hpp"

using namespace vorocl;

namespace {

constexpr std::int64_t parts = 4096;

struct Way {
  std::int64_t x, y;  // whole numbers of 1/4096 pixel
};

/// A diagram with what its measures follow from.
struct Measured {
  Window window;
  Metric metric;
  Labels labels;
  std::vector<Way> seeds;  // from the window's first pixel

  /// From a seed to a pixel's centre, the shorter way round.
  Way way(std::uint32_t seed, std::int64_t x, std::int64_t y) const {
    const auto along = [](const Axis& axis, std::int64_t from, std::int64_t pixel) {
      std::int64_t way = pixel * parts + parts / 2 - from;
      if (!axis.is_periodic()) return way;
      const std::int64_t period = axis.pixels() * parts;
      way = (way % period + period) % period;
      return 2 * way > period ? way - period : way;
    };
    return {along(window.grid().x(), seeds[seed].x, x), along(window.grid().y(), seeds[seed].y, y)};
  }

  /// Where a pixel lies by the rule of place: beside its seed, along an axis that is shown whole.
  Pixel place(std::uint32_t seed, std::int64_t x, std::int64_t y) const {
    const auto along = [](bool whole, const Axis& axis, std::int64_t from, std::int64_t way,
                          std::int64_t at) {
      if (!whole) return at;
      const std::int64_t period = axis.pixels() * parts;
      return ((from % period + period) % period + way - parts / 2) / parts;
    };
    const Way to = way(seed, x, y);
    return {along(has_x(window.periodic()), window.grid().x(), seeds[seed].x, to.x, x),
            along(has_y(window.periodic()), window.grid().y(), seeds[seed].y, to.y, y)};
  }

  /// In pixels, squared if Euclidean.
  double distance(std::uint32_t seed, std::int64_t x, std::int64_t y) const {
    const Way to = way(seed, x, y);
    if (metric == Metric::manhattan) return static_cast<double>(std::abs(to.x) + std::abs(to.y)) / parts;
    return static_cast<double>(to.x * to.x + to.y * to.y) / static_cast<double>(parts * parts);
  }
};

struct Cell {
  std::int64_t area = 0, sum_x = 0, sum_y = 0;
  std::int64_t left = INT32_MAX, top = INT32_MAX, right = INT32_MIN, bottom = INT32_MIN;
  double largest_distance = -1;
};

std::vector<Cell> cells_on_host(const Measured& of) {
  std::vector<Cell> cells(of.seeds.size());
  std::size_t i = 0;
  for (std::int64_t y = 0; y < of.window.height(); ++y) {
    for (std::int64_t x = 0; x < of.window.width(); ++x) {
      const std::uint32_t label = of.labels[i++];
      Cell& cell = cells[label];
      const Pixel at = of.place(label, x, y);
      ++cell.area;
      cell.sum_x += at.x;
      cell.sum_y += at.y;
      cell.left = std::min(cell.left, at.x);
      cell.right = std::max(cell.right, at.x);
      cell.top = std::min(cell.top, at.y);
      cell.bottom = std::max(cell.bottom, at.y);
      cell.largest_distance = std::max(cell.largest_distance, of.distance(label, x, y));
    }
  }
  return cells;
}

double deviation_of_areas(const Diagram& diagram) {
  CellStatisticsResult statistics;
  cell_statistics(diagram, statistics);
  return statistics.read().area_deviation;
}

Report exactly(const Seeds& seeds, Diagram& diagram) { return exact_diagram(seeds, diagram); }

std::vector<Point> random_points(const Grid& grid, std::size_t count, unsigned rng_seed) {
  std::mt19937_64 rng(rng_seed);
  const auto below = [&](std::int64_t end) {
    return static_cast<double>(end) * static_cast<double>(rng() >> 11) * 0x1p-53;
  };
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = below(grid.width());
    points.push_back({x, below(grid.height())});
  }
  return points;
}

}  // namespace

BOOST_AUTO_TEST_CASE(measures_are_those_of_the_points) {
  std::mt19937_64 rng(8);
  const auto below = [&](std::int64_t end) {
    return static_cast<std::int64_t>(rng() % static_cast<std::uint64_t>(end));
  };
  for (unsigned number = 0; number < 80; ++number) {
    const std::int64_t beyond_a_block = number % 5 == 1 ? 300 : 0;  // of a CPU's work-items, too
    const std::int64_t columns = 16 + below(50) + beyond_a_block;
    const Grid grid(columns, 1 + below(60) + beyond_a_block, static_cast<Axes>(number % 4));
    const auto begin = [&](const Axis& axis) { return below(axis.pixels()); };
    const std::int64_t x = begin(grid.x()), y = begin(grid.y());
    const bool is_part = number % 3 == 0;
    const auto length = [&](const Axis& axis, std::int64_t from) {
      return 1 + below(axis.is_periodic() ? axis.pixels() : axis.pixels() - from);
    };
    const std::int64_t width = is_part ? length(grid.x(), x) : 0;
    const Window window = is_part ? Window(grid, x, y, width, length(grid.y(), y)) : Window(grid);
    const Metric metric = number % 5 == 0 ? Metric::manhattan : Metric::euclidean;
    std::vector<Point> points = random_points(grid, 1 + static_cast<std::size_t>(below(80)), number);
    for (Point& point : points) point = {point.x * 1.2 - 3, point.y * 1.2 - 3};
    const Seeds seeds(test_device(), grid, points, {Outside::count, Snap::none});
    Diagram diagram(test_device(), window);
    exact_diagram(seeds, diagram, {metric});
    Measured of = {window, metric, diagram.read(), {}};
    for (const Point& at : centres_of(seeds)) {
      of.seeds.push_back(
          {std::llround(at.x * parts) - window.x() * parts, std::llround(at.y * parts) - window.y() * parts});
    }

    CellSumsResult sums;
    CellShapesResult shapes;
    Field<float> distances;
    cell_sums(diagram, sums);
    cell_shapes(diagram, shapes);
    distance_field(diagram, distances);
    const std::vector<Cell> expected = cells_on_host(of);
    const std::vector<CellSums> found_sums = sums.read();
    const std::vector<CellShape> found_shapes = shapes.read();
    std::size_t wrong_sums = 0, wrong_shapes = 0, wrong_distances = 0;
    for (std::size_t id = 0; id < expected.size(); ++id) {
      const Cell& cell = expected[id];
      const CellShape& shape = found_shapes[id];
      wrong_sums += found_sums[id].area != cell.area || found_sums[id].sum_x != cell.sum_x ||
                    found_sums[id].sum_y != cell.sum_y;
      wrong_shapes += shape.largest_distance != cell.largest_distance;
      if (cell.area == 0) continue;
      wrong_shapes += shape.left != cell.left || shape.right != cell.right || shape.top != cell.top ||
                      shape.bottom != cell.bottom;
    }
    std::size_t i = 0;
    for (const float found : distances.read()) {
      const std::int64_t column = static_cast<std::int64_t>(i) % window.width(),
                         row = static_cast<std::int64_t>(i) / window.width();
      const double squared = of.distance(of.labels[i++], column, row);
      const double length = metric == Metric::euclidean ? std::sqrt(squared) : squared;
      wrong_distances += std::abs(static_cast<double>(found) - length) > 1e-6 * (1 + length);
    }
    BOOST_TEST(wrong_sums == 0u, "case " << number);
    BOOST_TEST(wrong_shapes == 0u, "case " << number);
    BOOST_TEST(wrong_distances == 0u, "case " << number);
  }
}

BOOST_AUTO_TEST_CASE(flooding_is_judged_by_pixels_or_by_points) {
  const Grid grid(200, 150);
  const Seeds seeds(test_device(), grid, random_points(grid, 400, 5), {Outside::count, Snap::none});
  Diagram of_points(test_device(), grid), flooded(test_device(), grid);
  exact_diagram(seeds, of_points);
  jump_flooding(seeds, flooded);
  DistanceErrorsResult errors;
  distance_errors(flooded, of_points, errors);
  // By the points: on the host, from the positions themselves.
  const Labels exact = of_points.read(), flood = flooded.read();
  const std::vector<Point> at = centres_of(seeds);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double x = static_cast<double>(i % 200) + 0.5, y = static_cast<double>(i / 200) + 0.5;
    const auto squared = [&](std::uint32_t id) {
      return (at[id].x - x) * (at[id].x - x) + (at[id].y - y) * (at[id].y - y);
    };
    wrong += squared(flood[i]) > squared(exact[i]) ? 1 : 0;
  }
  BOOST_TEST(wrong > 100u);
  BOOST_TEST(errors.read().wrong_pixels == wrong);
  // A flood's own measures are of the pixels that it knows.
  Field<float> distances;
  distance_field(flooded, distances);
  for (const float distance : distances.read()) {
    const auto squared = static_cast<double>(distance) * static_cast<double>(distance);
    BOOST_TEST_REQUIRE(std::abs(squared - std::round(squared)) < 1e-3);
  }
}

BOOST_AUTO_TEST_CASE(whole_numbers_are_refused) {
  const Grid grid(30, 20);
  const Seeds seeds(test_device(), grid, {{3.25, 4.5}}, {Outside::count, Snap::none});
  Diagram diagram(test_device(), grid);
  exact_diagram(seeds, diagram);
  Field<std::int32_t> distances;
  check_error([&] { distance_field(diagram, distances); }, {"whole numbers", "floats", "snap"});
}

BOOST_AUTO_TEST_CASE(labels_expand_to_distances_from_points) {
  const Grid grid(40, 30);
  const Seeds seeds(test_device(), grid, {{10.25, 10.75}, {30.5, 20.125}}, {Outside::count, Snap::none});
  Diagram diagram(test_device(), grid);
  exact_diagram(seeds, diagram);
  Field<std::uint32_t> expanded;
  Field<float> distances;
  distance_field(diagram, distances);
  for (const double most : {0.0, 0.5, 3.25, 1000.0}) {
    expand_labels(diagram, most, expanded);
    const Labels labels = diagram.read(), found = expanded.read();
    const std::vector<float> at = distances.read();
    for (std::size_t i = 0; i < labels.size(); ++i) {
      BOOST_TEST_REQUIRE(found[i] == (static_cast<double>(at[i]) <= most ? labels[i] : no_label));
    }
  }
}

BOOST_AUTO_TEST_CASE(relaxed_points_are_no_lattice) {
  const Grid grid(300, 300, Axes::xy);
  const std::vector<Point> points = random_points(grid, 200, 3);
  double deviations[2] = {};
  for (const Snap snap : {Snap::to_pixels, Snap::none}) {
    Seeds seeds(test_device(), grid, points, {Outside::count, snap});
    Diagram diagram(test_device(), grid);
    const Relaxation relaxation = relax(seeds, diagram, exactly, 400);
    BOOST_TEST(relaxation.converged);
    deviations[snap == Snap::none ? 1 : 0] = deviation_of_areas(diagram);
    if (snap == Snap::to_pixels) continue;
    // No seed is farther from its cell's centroid than the tolerance.
    CellSumsResult sums;
    cell_sums(diagram, sums);
    const std::vector<CellSums> cells = sums.read();
    const std::vector<Point> at = centres_of(seeds);
    for (std::size_t id = 0; id < at.size(); ++id) {
      const Point centroid = cells[id].centroid();
      BOOST_TEST(std::abs(std::remainder(centroid.x - at[id].x, 300)) <
                 RelaxOptions().tolerance + 1.0 / parts);
      BOOST_TEST(std::abs(std::remainder(centroid.y - at[id].y, 300)) <
                 RelaxOptions().tolerance + 1.0 / parts);
    }
    for (std::size_t round = 1; round < relaxation.energies.size(); ++round) {
      BOOST_TEST(relaxation.energies[round] < relaxation.energies[round - 1] * (1 + 1e-6));
    }
  }
  // Whole pixels stall where the cells' areas are far from equal.
  BOOST_TEST(deviations[1] < 0.6 * deviations[0]);
  check_error(
      [&] {
        Seeds seeds(test_device(), grid, points, to_centres);
        Diagram diagram(test_device(), grid);
        relax(seeds, diagram, exactly, 4, {}, {0.0});
      },
      {"tolerance", "above 0"});
}
