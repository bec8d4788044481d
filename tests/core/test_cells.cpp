// Sums, shapes and statistics of cells, against straight host code.
#define BOOST_TEST_MODULE cells
#include <cstdlib>
#include <numeric>

#include "all_measures.hpp"
#include "measured_cases.hpp"
#include "read_measures.hpp"
#include "vorocl/cells.hpp"

using namespace vorocl;

namespace {

const bool long_tests = std::getenv("VOROCL_LONG_TESTS") != nullptr;

/// Results that measure one diagram after the other: their buffers grow, and hold what the last one left.
struct Results {
  CellSumsResult sums;
  CellShapesResult shapes;
  CellStatisticsResult statistics, of_sums;
  AdjacencyResult pairs;
};

bool is(const CellSums& sums, const CellOnHost& cell) {
  return sums.area == cell.area && sums.sum_x == cell.sum.x && sums.sum_y == cell.sum.y &&
         sums.sum_z == cell.sum.z;
}

bool is(const CellShape& shape, const CellOnHost& cell) {
  return shape.left == cell.least.x && shape.top == cell.least.y && shape.front == cell.least.z &&
         shape.right == cell.greatest.x && shape.bottom == cell.greatest.y && shape.back == cell.greatest.z &&
         shape.largest_distance == static_cast<double>(cell.farthest) &&
         shape.touches_border == cell.touches_border;
}

template <typename T>
std::size_t count_wrong(const std::vector<T>& found, const std::vector<CellOnHost>& cells) {
  BOOST_TEST_REQUIRE(found.size() == cells.size());
  std::size_t wrong = 0;
  for (std::size_t id = 0; id < found.size(); ++id) wrong += is(found[id], cells[id]) ? 0 : 1;
  return wrong;
}

void check_statistics(const Case& test, const std::vector<CellOnHost>& cells,
                      const CellStatistics& statistics) {
  std::vector<double> areas;
  for (std::size_t id = 0; id < cells.size(); ++id) {
    if (test.absent.empty() || !test.absent[id]) areas.push_back(cells[id].area);
  }
  const double pixels = std::accumulate(areas.begin(), areas.end(), 0.0);
  BOOST_TEST(statistics.cells == areas.size());
  BOOST_TEST(statistics.empty_cells == static_cast<std::size_t>(std::count(areas.begin(), areas.end(), 0)));
  BOOST_TEST(static_cast<double>(statistics.pixels) == pixels);
  if (areas.empty()) return;
  const auto count = static_cast<double>(areas.size());
  double squares = 0;
  for (const double area : areas) squares += std::pow(area - pixels / count, 2);
  BOOST_TEST(statistics.mean_area == pixels / count);
  BOOST_TEST(std::abs(statistics.area_deviation - std::sqrt(squares / count)) < 1e-6 * pixels / count + 1e-9);
}

void check_pairs(const CellsOnHost& expected, const AdjacencyResult& pairs) {
  BOOST_TEST(pairs.pairs() == expected.pairs.size());
  BOOST_TEST((pairs.read_pairs() == expected.pairs));
  const auto neighbours = pairs.read_neighbours(), perimeters = pairs.read_perimeters();
  std::size_t wrong = 0;
  for (std::size_t id = 0; id < neighbours.size(); ++id) {
    const CellOnHost& cell = expected.cells[id];
    wrong += neighbours[id] != cell.neighbours || perimeters[id] != cell.perimeter ? 1 : 0;
  }
  BOOST_TEST(wrong == 0u);
}

void check_measures(const Case& test, const Diagram& diagram, const Labels& labels, Results& results) {
  BOOST_TEST_CONTEXT(test.name << " in " << test.grid.width() << " x " << test.grid.height() << " x "
                               << test.grid.depth()) {
    const CellsOnHost expected = cells_on_host(test.grid, test.seeds, labels, diagram.metric());
    cell_sums(diagram, results.sums);
    cell_shapes(diagram, results.shapes);
    cell_statistics(diagram, results.statistics);
    cell_statistics(results.sums, results.of_sums);
    adjacency(diagram, results.pairs);
    BOOST_TEST(count_wrong(results.sums.read(), expected.cells) == 0u);
    BOOST_TEST(count_wrong(results.shapes.read(), expected.cells) == 0u);
    const auto areas = transformed(expected.cells, [](const CellOnHost& cell) { return cell.area; });
    BOOST_TEST((results.statistics.read_areas() == areas));
    check_statistics(test, expected.cells, results.statistics.read());
    check_statistics(test, expected.cells, results.of_sums.read());
    check_pairs(expected, results.pairs);
  }
}

void check_case(const Device& device, const Case& test, Results& results) {
  const Seeds seeds = seeds_of(device, test);
  Diagram diagram(device, test.grid);
  const Metric metric = test.seeds.size() % 2 == 0 ? Metric::euclidean : Metric::manhattan;
  const Labels labels = fill(test, seeds, diagram, metric);
  check_measures(test, diagram, labels, results);
}

}  // namespace

BOOST_AUTO_TEST_CASE(measures_are_those_of_the_host) {
  for (const Device& device : shapes()) {
    Results results;
    for (const Case& test : measured_cases(device)) check_case(device, test, results);
  }
}

/// More neighbours than the first table has room for: they are found again in a larger one. In the plane
/// 7,140 pairs are nearly all there are.
BOOST_AUTO_TEST_CASE(cells_with_many_neighbours_have_all_of_them) {
  const Grid plane(600, 290), volume(64, 64, 32);
  for (const Device& device : shapes()) {
    Results results;
    check_case(device, {"confetti", plane, random_pixels(plane, 120, 1), random_labels(plane, 120, 2)},
               results);
    BOOST_TEST(results.pairs.pairs() > 7000u);
  }
  Results results;
  check_case(test_device(),
             {"confetti", volume, random_pixels(volume, 400, 1), random_labels(volume, 400, 2)}, results);
  BOOST_TEST(results.pairs.pairs() > 16u * 400);
}

BOOST_AUTO_TEST_CASE(one_cell_around_all_others) {
  const Grid grid(301, 201);
  Labels labels(grid.pixels(), 0);
  std::uint32_t id = 0;
  for (int y = 1; y < grid.height() - 1; y += 2) {
    for (int x = 1; x < grid.width() - 1; x += 2) labels[index_of(grid, {x, y})] = ++id;
  }
  Results results;
  check_case(test_device(), {"islands", grid, random_pixels(grid, id + 1, 1), labels}, results);
  BOOST_TEST(results.pairs.pairs() == id);
}

BOOST_AUTO_TEST_CASE(sums_past_32_bits) {
  for (const Device& device : shapes()) {
    for (const Grid& grid : {Grid(4099, 2100), Grid(3, 2000, 1500)}) {
      const Seeds seeds(device, grid, std::vector<Point>{{1.5, 1999.5, 0.5}}, to_centres);
      Diagram diagram(device, grid);
      diagram.write(Labels(grid.pixels(), 0), seeds, Metric::euclidean);
      CellSumsResult result;
      cell_sums(diagram, result);
      const CellSums cell = result.read().front();
      const auto expected = [&](const Axis& axis) {
        const auto area = static_cast<std::int64_t>(grid.pixels());
        return (axis.pixels() - 1) * axis.pixels() / 2 * (area / axis.pixels());
      };
      BOOST_TEST(cell.area == grid.pixels());
      BOOST_TEST(cell.sum_x == expected(grid.x()));
      BOOST_TEST(cell.sum_y == expected(grid.y()));
      BOOST_TEST(cell.sum_z == expected(grid.z()));
      BOOST_TEST(cell.sum_y > 0xffffffffll);
      BOOST_TEST(cell.centroid().x == static_cast<double>(grid.width()) / 2);
      BOOST_TEST(cell.centroid().y == static_cast<double>(grid.height()) / 2);
      BOOST_TEST(cell.centroid().z == static_cast<double>(grid.depth()) / 2);
    }
  }
  BOOST_TEST((std::isnan(CellSums().centroid().x) && std::isnan(CellSums().centroid().z)));
}

/// Two cells side by side share one face for each voxel between them, a known area.
BOOST_AUTO_TEST_CASE(halves_of_a_box_touch_in_their_section) {
  const Grid grid(20, 11, 7);
  const Seeds seeds(test_device(), grid, std::vector<Point>{{4, 5, 3}, {15, 5, 3}}, to_centres);
  Diagram diagram(test_device(), grid);
  jump_flooding(seeds, diagram);
  AdjacencyResult pairs;
  adjacency(diagram, pairs);
  BOOST_TEST((pairs.read_pairs() == std::vector<CellPair>{{0, 1, 11 * 7}}));
}

BOOST_AUTO_TEST_CASE(statistics_of_areas) {
  const Grid grid(4, 3);
  Seeds seeds(test_device(), grid, {{0.5, 0.5}, {0.5, 0.5}, {3.5, 0.5}, {2.5, 2.5}}, to_centres);
  seeds.move_to(
      std::vector<std::optional<Point>>{Point{0.5, 0.5}, Point{0.5, 0.5}, Point{3.5, 0.5}, std::nullopt});
  Diagram diagram(test_device(), grid);
  diagram.write({0, 0, 2, 2, 0, 0, 2, 2, no_label, 0, 2, 2}, seeds, Metric::euclidean);
  const CellStatistics statistics = statistics_of(diagram);
  BOOST_TEST(statistics.cells == 3u);
  BOOST_TEST(statistics.empty_cells == 1u);
  BOOST_TEST(statistics.pixels == 11u);
  CellStatisticsResult of_diagram;
  BOOST_TEST(of_diagram.read_areas().empty());
  cell_statistics(diagram, of_diagram);
  const std::vector<std::uint32_t> three_areas = {5, 0, 6, 0};
  BOOST_TEST(of_diagram.read_areas() == three_areas, boost::test_tools::per_element());
  BOOST_TEST(statistics.mean_area == 11 / 3.0);
  BOOST_TEST(statistics.area_deviation == std::sqrt((25 + 36) / 3.0 - 121 / 9.0),
             boost::test_tools::tolerance(1e-12));

  const Seeds none(test_device(), grid, std::vector<Point>{}, to_centres);
  Diagram without(test_device(), grid);
  jump_flooding(none, without);
  const CellStatistics empty = statistics_of(without);
  BOOST_TEST(empty.cells == 0u);
  BOOST_TEST(empty.pixels == 0u);
  BOOST_TEST(empty.mean_area == 0);

  const Grid large(700, 300);
  const Seeds many(test_device(), large, centres(random_pixels(large, 30000, 9)), to_centres);
  Diagram dense(test_device(), large);
  jump_flooding(many, dense);
  std::map<std::uint32_t, double> areas;
  for (const std::uint32_t label : dense.read()) ++areas[label];
  double variance = 0;
  std::vector<std::uint32_t> all_areas;
  for (std::uint32_t id = 0; id < 30000; ++id) {
    const double area = areas.count(id) > 0 ? areas[id] : 0;
    variance += (area - 7) * (area - 7) / 30000;
    all_areas.push_back(static_cast<std::uint32_t>(area));
  }
  cell_statistics(dense, of_diagram);
  BOOST_TEST((of_diagram.read_areas() == all_areas));
  CellSumsResult sums;
  CellStatisticsResult of_sums;
  cell_statistics(sums, of_sums);
  BOOST_TEST(of_sums.read().cells == 0u);
  cell_sums(dense, sums);
  cell_statistics(sums, of_sums);
  BOOST_TEST(of_sums.read().area_deviation == std::sqrt(variance), boost::test_tools::tolerance(1e-9));
  BOOST_TEST((of_sums.read_areas() == all_areas));
  cell_sums(diagram, sums);  // fewer, into the same buffers
  cell_statistics(sums, of_sums);
  BOOST_TEST(of_sums.read().cells == 3u);
  BOOST_TEST(of_sums.read_areas() == three_areas, boost::test_tools::per_element());
  const CellStatistics spread = statistics_of(dense);
  BOOST_TEST(spread.mean_area == 7);
  BOOST_TEST(spread.empty_cells == 30000 - areas.size());
  BOOST_TEST(spread.area_deviation == std::sqrt(variance), boost::test_tools::tolerance(1e-9));
}

// Labels that name an absent seed are as good as none to all measures that know seeds.
BOOST_AUTO_TEST_CASE(absent_seeds_own_nothing) {
  const Grid plain(83, 47), torus(83, 47, Axes::xy);
  const std::vector<Device> all = shapes();
  std::size_t turn = 0;
  // Near, far away, and of the window's own: each in one shape, with VOROCL_LONG_TESTS in all.
  for (const auto& [grid, beside] :
       {std::pair(plain, 0.0), std::pair(plain, 20.0), std::pair(plain, 3e6), std::pair(torus, 0.0)}) {
    std::vector<std::optional<Point>> points;
    for (const Point& point : centres(random_pixels(grid, 30, 1))) points.push_back(point);
    points[3]->x -= beside;
    points[7].reset();
    points[11].reset();
    const std::vector<std::uint32_t> labels = random_labels(grid, 30, 2);
    std::vector<std::uint32_t> without = labels;
    for (std::uint32_t& label : without) label = label == 7 || label == 11 ? no_label : label;
    const Device& own = all[turn++ % all.size()];
    for (const Device& device : long_tests ? all : std::vector<Device>{own}) {
      const Seeds seeds(device, grid, points, to_centres);
      Diagram diagram(device, grid), expected(device, grid);
      diagram.write(labels, seeds, Metric::euclidean);
      expected.write(without, seeds, Metric::euclidean);
      AllMeasures a, b;
      a.take(diagram, diagram);
      b.take(expected, expected);
      const std::vector<double> found = a.read_of_cells(), right = b.read_of_cells();
      BOOST_TEST(found == right, boost::test_tools::per_element());
      BOOST_TEST((table_of(diagram) == table_of(expected)));
    }
  }
}

BOOST_AUTO_TEST_CASE(labels_of_no_seeds_have_no_cells) {
  const Grid grid(20, 10);
  Diagram diagram(test_device(), grid);
  CellSumsResult sums;
  CellShapesResult shapes;
  CellStatisticsResult statistics;
  check_error([&] { cell_sums(diagram, sums); }, {"seeds"});  // never filled
  exact_diagram(Seeds(test_device(), grid, {{1, 1}}, to_centres), diagram);
  cell_sums(diagram, sums);
  cell_shapes(diagram, shapes);
  cell_statistics(diagram, statistics);
  diagram.write(std::vector<std::uint32_t>(grid.pixels(), 0));
  check_error([&] { cell_sums(diagram, sums); }, {"seeds"});
  check_error([&] { cell_shapes(diagram, shapes); }, {"seeds"});
  check_error([&] { cell_statistics(diagram, statistics); }, {"seeds"});
  check_error([&] { cell_table(diagram); }, {"seeds"});
  BOOST_TEST(sums.read().empty());
  BOOST_TEST(shapes.size() == 0u);
  BOOST_TEST(statistics.read().cells == 0u);
}
