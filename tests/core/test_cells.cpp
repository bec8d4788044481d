// Sums, shapes and statistics of cells, against straight host code.
#define BOOST_TEST_MODULE cells
#include <cstdlib>

#include "all_measures.hpp"
#include "measured_cases.hpp"
#include "read_measures.hpp"
#include "vorocl/cells.hpp"

using namespace vorocl;

namespace {

const bool long_tests = std::getenv("VOROCL_LONG_TESTS") != nullptr;

void check_sums(const std::string& name, const std::vector<Pixel>& pixels, const Diagram& diagram,
                CellSumsResult& result) {
  const Grid& grid = diagram.window().grid();
  cell_sums(diagram, result);
  const std::vector<CellSums> sums = result.read();
  std::vector<CellSums> expected(pixels.size());
  std::uint64_t labelled = 0, all = 0;
  each_pixel(grid, diagram.read(), [&](std::uint32_t label, int x, int y) {
    const Pixel image = nearest_image(grid, {x, y}, pixels[label]);
    ++labelled;
    ++expected[label].area;
    expected[label].sum_x += image.x;
    expected[label].sum_y += image.y;
  });
  BOOST_TEST_REQUIRE(sums.size() == expected.size());
  std::size_t wrong = 0;
  for (std::size_t id = 0; id < sums.size(); ++id) {
    all += sums[id].area;
    wrong += sums[id].area != expected[id].area || sums[id].sum_x != expected[id].sum_x ||
                     sums[id].sum_y != expected[id].sum_y
                 ? 1
                 : 0;
  }
  BOOST_TEST(wrong == 0u, name << ": " << wrong << " of " << sums.size() << " sums are wrong");
  BOOST_TEST(all == labelled, name);
}

void check_shapes(const std::string& name, const std::vector<Pixel>& pixels, const Diagram& diagram) {
  CellShapesResult result;
  cell_shapes(diagram, result);
  const std::vector<CellShape> shapes = result.read();
  const Grid& grid = diagram.window().grid();
  std::vector<CellShape> expected(pixels.size(), {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN, -1, false});
  each_pixel(grid, diagram.read(), [&](std::uint32_t label, int x, int y) {
    CellShape& cell = expected[label];
    const Pixel image = nearest_image(grid, {x, y}, pixels[label]);
    const auto column = static_cast<int>(image.x), row = static_cast<int>(image.y);
    cell.left = std::min(cell.left, column);
    cell.top = std::min(cell.top, row);
    cell.right = std::max(cell.right, column);
    cell.bottom = std::max(cell.bottom, row);
    cell.largest_distance = std::max(cell.largest_distance,
                                     static_cast<double>(distance(image, pixels[label], diagram.metric())));
    cell.touches_border |= (!has_x(grid.periodic()) && (x == 0 || x == grid.width() - 1)) ||
                           (!has_y(grid.periodic()) && (y == 0 || y == grid.height() - 1));
  });
  BOOST_TEST_REQUIRE(shapes.size() == expected.size());
  std::size_t wrong_boxes = 0, wrong_distances = 0, wrong_borders = 0;
  for (std::size_t id = 0; id < shapes.size(); ++id) {
    const CellShape &a = shapes[id], &b = expected[id];
    wrong_boxes += a.left != b.left || a.top != b.top || a.right != b.right || a.bottom != b.bottom ? 1 : 0;
    wrong_distances += a.largest_distance != b.largest_distance ? 1 : 0;
    wrong_borders += a.touches_border != b.touches_border ? 1 : 0;
  }
  BOOST_TEST(wrong_boxes == 0u, name << ": " << wrong_boxes << " boxes are wrong");
  BOOST_TEST(wrong_distances == 0u, name << ": " << wrong_distances << " distances are wrong");
  BOOST_TEST(wrong_borders == 0u, name << ": " << wrong_borders << " cells are wrong about the border");
}

}  // namespace

BOOST_AUTO_TEST_CASE(sums_and_shapes_are_those_of_the_host) {
  for (const Device& device : shapes()) {
    CellSumsResult result;  // one for all: its buffers grow, and hold what the last case left
    for (const Case& test : measured_cases(device)) {
      const Seeds seeds(device, test.grid, centres(test.seeds), to_centres);
      Diagram diagram(device, test.grid);
      const Metric metric = test.seeds.size() % 2 == 0 ? Metric::euclidean : Metric::manhattan;
      fill(seeds, diagram, metric);
      check_sums(test.name, test.seeds, diagram, result);
      check_shapes(test.name, test.seeds, diagram);
    }
  }
}

BOOST_AUTO_TEST_CASE(cells_in_many_pieces) {
  const Grid grid(600, 290);
  const std::vector<Pixel> pixels = random_pixels(grid, 300, 1);
  for (const Device& device : shapes()) {
    const Seeds seeds(device, grid, centres(pixels), to_centres);
    Diagram diagram(device, grid);
    CellSumsResult result;
    for (const Metric metric : both_metrics) {
      diagram.write(random_labels(grid, 300, 2), seeds, metric);
      check_sums("pieces", pixels, diagram, result);
      check_shapes("pieces", pixels, diagram);
    }
    diagram.write(std::vector<std::uint32_t>(grid.pixels(), no_label), seeds, Metric::euclidean);
    check_sums("no labels", pixels, diagram, result);
  }
}

BOOST_AUTO_TEST_CASE(sums_past_32_bits) {
  const Grid grid(4099, 2100);
  for (const Device& device : shapes()) {
    const Seeds seeds(device, grid, std::vector<Point>{{4000.5, 2000.5}}, to_centres);
    Diagram diagram(device, grid);
    diagram.write(std::vector<std::uint32_t>(grid.pixels(), 0), seeds, Metric::euclidean);
    CellSumsResult result;
    cell_sums(diagram, result);
    const CellSums cell = result.read().front();
    BOOST_TEST(cell.area == 4099u * 2100u);
    BOOST_TEST(cell.sum_x == 4098ll * 4099 / 2 * 2100);
    BOOST_TEST(cell.sum_x > 0xffffffffll);
    BOOST_TEST(cell.sum_y == 2099ll * 2100 / 2 * 4099);
    BOOST_TEST(cell.centroid().x == 4099 / 2.0);
    BOOST_TEST(cell.centroid().y == 2100 / 2.0);
  }
  BOOST_TEST(std::isnan(CellSums().centroid().x));
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
  each_pixel(large, dense.read(), [&](std::uint32_t label, int, int) { ++areas[label]; });
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
