// Tables of cells in the units of the data, against straight host code.
#define BOOST_TEST_MODULE cell_table
#include "measured_cases.hpp"
#include "vorocl/cells.hpp"

using namespace vorocl;

namespace {

/// The pixel of a coordinate along an axis, as Axis says it.
int pixel_along(const Axis& axis, double coordinate) {
  const auto pixels = static_cast<double>(axis.pixels());
  double pixel = std::floor((coordinate - axis.from()) * pixels / (axis.to() - axis.from()));
  if (axis.is_reversed()) pixel = pixels - 1 - pixel;
  if (axis.is_periodic()) pixel -= pixels * std::floor(pixel / pixels);
  return static_cast<int>(pixel);
}

/// The coordinate of a position in pixels.
double coordinate_along(const Axis& axis, double position) {
  const auto pixels = static_cast<double>(axis.pixels());
  const double share = (axis.is_reversed() ? pixels - position : position) / pixels;
  return axis.from() + share * (axis.to() - axis.from());
}

double size_of_one(const Axis& axis) {
  return (axis.to() - axis.from()) / static_cast<double>(axis.pixels());
}

void check_table(const Grid& grid, const std::vector<std::optional<Point>>& points, Metric metric) {
  const auto pixels = transformed(points, [&](const std::optional<Point>& point) {
    if (!point) return Pixel{0, 0};
    return Pixel{pixel_along(grid.x(), point->x), pixel_along(grid.y(), point->y),
                 pixel_along(grid.z(), point->z)};
  });
  const Seeds seeds(test_device(), grid, points, to_centres);
  Diagram diagram(test_device(), grid);
  exact_diagram(seeds, diagram, {metric});
  const std::vector<CellOnHost> expected = cells_on_host(grid, pixels, diagram.read(), metric).cells;
  const double area_of_one = size_of_one(grid.x()) * size_of_one(grid.y()) * size_of_one(grid.z());
  const std::vector<CellRow> table = cell_table(diagram);
  std::size_t at = 0;
  const auto close = boost::test_tools::tolerance(1e-9);
  for (std::uint32_t id = 0; id < points.size(); ++id) {
    if (!points[id]) continue;
    BOOST_TEST_REQUIRE(at < table.size());
    const CellRow& found = table[at++];
    const CellOnHost& right = expected[id];
    BOOST_TEST(found.id == id);
    BOOST_TEST(found.seed.x == points[id]->x);
    BOOST_TEST(found.seed.y == points[id]->y);
    BOOST_TEST((found.seed.z == points[id]->z || !grid.is_volume()));
    BOOST_TEST(found.pixels == right.area);
    BOOST_TEST(found.area == right.area * area_of_one, close);
    BOOST_TEST(found.touches_border == right.touches_border);
    BOOST_TEST(found.neighbours == right.neighbours);
    if (right.area == 0) {
      BOOST_TEST(std::isnan(found.largest_distance));
      BOOST_TEST((std::isnan(found.centroid.x) && std::isnan(found.centroid.y)));
    } else {
      const auto mean = [&](const Axis& axis, std::int64_t sum) {
        return coordinate_along(axis, static_cast<double>(sum) / right.area + 0.5);
      };
      const double distance = static_cast<double>(right.farthest);
      BOOST_TEST(found.largest_distance == (metric == Metric::euclidean ? std::sqrt(distance) : distance),
                 close);
      BOOST_TEST(found.centroid.x == mean(grid.x(), right.sum.x), close);
      BOOST_TEST(found.centroid.y == mean(grid.y(), right.sum.y), close);
      BOOST_TEST(found.centroid.z == mean(grid.z(), right.sum.z), close);
    }
  }
  BOOST_TEST(at == table.size());
}

/// Points all over a grid, some of which are absent, and two of which share a pixel.
std::vector<std::optional<Point>> points_on(const Grid& grid, std::size_t count) {
  std::mt19937 rng(5);
  const auto between = [&](const Axis& axis) {
    return axis.from() + (axis.to() - axis.from()) * (static_cast<double>(rng()) + 0.5) / 4294967296.0;
  };
  std::vector<std::optional<Point>> points;
  for (std::size_t id = 0; id < count; ++id) {
    const double x = between(grid.x());
    const double y = between(grid.y());
    points.emplace_back(Point{x, y, between(grid.z())});
  }
  points[1].reset();
  points[count / 2] = points[0];
  return points;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_table_is_in_the_units_of_the_data) {
  const Axis x(120, -3, 7), y(80, 1e4, 1e4 + 0.5);
  const Grid grids[] = {
      Grid(120, 80),
      Grid(120, 80, Axes::xy),
      Grid(x, y),
      Grid(x, y.reversed()),
      Grid(x.periodic(), y),
      Grid(x.periodic(), y.periodic().reversed()),
      Grid(x.reversed().closed(), y.closed()),
      Grid(Axis(20, -1, 3), Axis(15, 0, 30).reversed(), Axis(9, 5, 6).periodic()),
  };
  for (const Grid& grid : grids) {
    for (const std::size_t count : {3u, 40u, 900u}) {
      for (const Metric metric : both_metrics) {
        if (grid.is_volume() && metric == Metric::manhattan) continue;  // which flooding labels alone
        BOOST_TEST_CONTEXT(count << " seeds, axes " << static_cast<int>(grid.periodic()) << ", x "
                                 << grid.x().from() << " to " << grid.x().to() << ", y "
                                 << (grid.y().is_reversed() ? "up, " : "down, ") << name_of(metric)) {
          check_table(grid, points_on(grid, count), metric);
        }
      }
    }
  }
}

// By hand: two seeds on a ring, whose cells reach across its end.
BOOST_AUTO_TEST_CASE(a_cell_across_the_end_of_a_period) {
  const Grid grid(Axis(10, 0, 1).periodic(), Axis(4, 0, 8).reversed());
  Diagram diagram(test_device(), grid);
  exact_diagram(Seeds(test_device(), grid, {{0.05, 7}, {0.55, 7}}, to_centres), diagram);
  const std::vector<CellRow> table = cell_table(diagram);
  BOOST_TEST_REQUIRE(table.size() == 2u);
  // Columns 8, 9, 0, 1 and 2, and the 5 others.
  BOOST_TEST(table[0].pixels == 20u);
  BOOST_TEST(table[0].area == 4, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(table[0].centroid.x == 0.05, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(table[1].centroid.x == 0.55, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(table[0].centroid.y == 4, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(table[0].touches_border);  // of y
  BOOST_TEST(table[0].neighbours == 1u);
}

// A window that is a part of the grid: what it shows, in the same units; seeds outside it own pixels of it.
BOOST_AUTO_TEST_CASE(a_table_of_a_window_counts_what_it_shows) {
  const Grid grid(Axis(100, 0, 10).periodic(), Axis(100, 0, 10));
  const Seeds seeds(test_device(), grid, {{9.85, 0.45}, {0.25, 0.45}, {5, 5}}, to_centres);
  Diagram diagram(test_device(), Window(grid, 95, 0, 10, 10));  // crosses the end of x
  exact_diagram(seeds, diagram);
  const std::vector<CellRow> table = cell_table(diagram);
  BOOST_TEST_REQUIRE(table.size() == 3u);
  // Columns 95 to 99 are those of the seed in column 98, and 0 to 4 those of the seed in column 2, which
  // comes first in the grid: so it has the tie in column 0.
  BOOST_TEST(table[0].pixels == 50u);
  BOOST_TEST(table[1].pixels == 50u);
  BOOST_TEST(table[2].pixels == 0u);
  BOOST_TEST(std::isnan(table[2].centroid.x));
  BOOST_TEST(table[0].seed.x == 9.85);
  BOOST_TEST(table[0].touches_border);
  BOOST_TEST(table[0].neighbours == 1u);
  // Where the window shows them, or a period away from there.
  BOOST_TEST(std::abs(std::remainder(table[0].centroid.x - 9.75, 10)) < 1e-9);
  BOOST_TEST(std::abs(std::remainder(table[1].centroid.x - 0.25, 10)) < 1e-9);
  BOOST_TEST(table[0].centroid.y == 0.5, boost::test_tools::tolerance(1e-12));
}
